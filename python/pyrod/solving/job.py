"""What the compiled solver takes, and what it returns as an equilibrium."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from numpy.typing import ArrayLike

import pyrod._core as _core
from pyrod._core import Options
from pyrod.base.immutable import lazily
from pyrod.base.words import shortly
from pyrod.result.accuracy import accuracy_of, checked_tolerance
from pyrod.result.equilibrium import Equilibrium
from pyrod.rod.rod import Rod
from pyrod.rotation import as_frames
from pyrod.scene.scene import Scene

DEFAULTS = Options()


class How(NamedTuple):
    """How to solve."""

    options: Options
    stable: bool
    eigenvalue: bool
    tol: float | None

    def checked(self) -> How:
        """The same; refuses a tolerance that is none, and options that are none."""
        given: object = self.options
        if not isinstance(given, Options):
            hint = ""
            if isinstance(given, (int, float)):
                hint = f"; a tolerance is given by name, tol={given}"
            raise TypeError(f"options: expected Options(...), got {shortly(given)}{hint}")
        return self if self.tol is None else self._replace(tol=checked_tolerance(self.tol))


def start_of(start: Equilibrium | ArrayLike | None, scene: Scene) -> Any:
    """What the compiled solver takes to start from: frames, or the shape of each rod."""
    if start is None:
        return None
    if not isinstance(start, Equilibrium):
        return as_frames(start, "start")
    _refuse_other_edges(start, scene)
    return [(rod.positions, rod.vertex_frames, rod.frames) for rod in start.rods]


def _refuse_other_edges(start: Equilibrium, scene: Scene) -> None:
    had = [len(rod.frames) for rod in start.rods]
    edges = [rod.edges for rod in scene.rods]
    if had != edges and had != [rod.edges for rod in scene._climbing.rods]:
        expected, got = (", ".join(map(str, counts)) for counts in (edges, had))
        raise ValueError(
            f"start: expected {expected} rows, as many as the rods have edges, got {got}; a "
            "support or a joint between two vertices gives its rod one more"
        )


def equilibrium_of(
    scene: Scene, found: _core.Equilibrium, how: How, time: float, choice: str | None = None
) -> Equilibrium:
    """What was found."""
    accuracy = None
    if (told := found.accuracy) is not None:
        scene, accuracy = scene._climbing, accuracy_of(told, found.neutral)
    return _made(found, how, time, scene.rods, scene=scene, accuracy=accuracy, choice=choice)


def equilibrium_later(
    make: Callable[[], Scene],
    rods: tuple[Rod, ...],
    found: _core.Equilibrium,
    how: How,
    time: float,
) -> Equilibrium:
    """The same without a tolerance, of a scene that is made when it is asked for."""
    return _made(found, how, time, rods, _make_scene=make, accuracy=None, choice=None)


def _made(
    found: _core.Equilibrium, how: How, time: float, rods: tuple[Rod, ...], **known: Any
) -> Equilibrium:
    return lazily(
        Equilibrium,
        found,
        status=found.status,
        time=time,
        lowest_eigenvalue=found.lowest_eigenvalue if how.eigenvalue else None,
        _made_of=rods,
        **known,
    )
