"""Scenes to be solved as jobs for the compiled solver, and what they return as equilibria."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from pyrod import _core
from pyrod._arrays import number_as
from pyrod._core import Options
from pyrod._immutable import sealed
from pyrod._progress import Watch
from pyrod.accuracy import accuracy_of
from pyrod.equilibrium import Equilibrium, Reaction, RodEquilibrium
from pyrod.rotation import as_frames, continued

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from pyrod.scene import Scene

DEFAULT_TOLERANCE = 1e-6
"""For rods that leave their edges to the solver."""


class How(NamedTuple):
    """How to solve."""

    options: Options
    stable: bool
    eigenvalue: bool
    tol: float | None


class Job:
    """A scene, and how it is to be solved."""

    def __init__(self, scene: Scene, start: Equilibrium | ArrayLike | None, how: How) -> None:
        if how.tol is None and scene._chooses_edges:
            how = how._replace(tol=DEFAULT_TOLERANCE)
        self.how = how._replace(tol=checked_tolerance(how.tol))
        self.scene = scene if how.tol is None else scene._ladder.scene
        self.network = not (self.scene.is_cantilever and how.stable and not how.eigenvalue)
        self.compiled = self._compiled(_start(start, self.scene, self.network))

    def run(self, trace: Callable[..., Any] | None) -> _core.Solution:
        """What the job finds; a ``trace`` that watches jobs is shown this one."""
        if isinstance(trace, Watch):
            trace.job = self.compiled
        return self.compiled.run(trace)

    def _compiled(self, start: tuple[Any, ...] | None) -> _core.Job:
        scene, (options, stable, eigenvalue, tol) = self.scene, self.how
        if tol is not None:
            ladder = scene._ladder.compiled(self.network)
            if start is not None:
                start = scene._ladder.brought(start[0]), *start[1:]
            return ladder.job(start, options, stable, eigenvalue, tol)
        space = _core.Dimension.__members__[scene.space]
        if self.network:
            net = scene._network.compiled
            return net.job(space, *scene.plane, start, options, stable, eigenvalue)
        rod = scene.rods[0]
        model = _core.Model.__members__[rod.model]
        held = scene.clamp_position, scene.clamp_frame
        args = rod._rod, space, model, *held, scene._loads[0]
        return _core.cantilever_job(*args, start, options)

    def again(self, found: _core.Solution) -> Job | None:
        """The job that leaves a saddle, if that was found; it can be left as a network only."""
        if self.network or found.index <= 0:
            return None
        other = object.__new__(Job)
        other.how, other.scene, other.network = self.how, self.scene, True
        frames = found.rods[0].frames
        other.compiled = other._compiled((frames, *_NO_NODES))
        return other

    def equilibrium(
        self, found: _core.Solution, time: float, choice: str | None = None
    ) -> Equilibrium:
        """What was found."""
        scene = self.scene
        rods = tuple(map(RodEquilibrium._of, scene.rods, found.rods))
        nodes = None
        if self.network:
            forces, moments = found.reaction_forces, found.reaction_moments
            at = scene._network.support_nodes()
            reactions = tuple(Reaction(forces[v], moments[v]) for v in at)
            nodes = found.node_positions, found.node_frames
        else:
            loads = scene._loads[0]
            acting = loads.force if self.how.tol is None else rods[0].load  # of the limit
            force, moment = -acting.sum(axis=0), -rods[0].moment[0] - loads.start_moment
            reactions = (Reaction(*sealed((force, moment))),)
        return Equilibrium._of(
            found,
            scene=scene,
            rods=rods,
            reactions=reactions,
            time=time,
            lowest_eigenvalue=found.lowest_eigenvalue if self.how.eigenvalue else None,
            accuracy=accuracy_of(self.how.tol, found.reached, self.network, found.neutral),
            choice=choice,
            _nodes=nodes,
        )


_NO_NODES = sealed((np.zeros((0, 3)), np.zeros((0, 4))))


def checked_tolerance(tol: float | None) -> float | None:
    """The tolerance, if it is one."""
    if tol is None:
        return None
    wanted = "must be a number in (0, 0.1]"
    value = 0.0 if isinstance(tol, bool) else number_as(tol, "tol", wanted)
    if not 0 < value <= 0.1:
        raise ValueError(f"tol: {wanted}, got {tol!r}")
    return value


def _start(
    start: Equilibrium | ArrayLike | None, scene: Scene, network: bool
) -> tuple[Any, ...] | None:
    if start is None:
        return None
    if isinstance(start, Equilibrium):
        _refuse_other_edges(start, scene)
        frames = np.vstack([rod.frames for rod in start.rods])
        return (frames, *(_nodes_near(start, scene) if network else _NO_NODES))
    frames = as_frames(start, "start")
    if len(scene.rods) == 1:
        first = scene.clamp_frame if scene.supports else frames[0]
        frames = continued(np.vstack([first, frames]))[1:]
    return (frames, *_NO_NODES)


def _refuse_other_edges(start: Equilibrium, scene: Scene) -> None:
    had = [len(rod.frames) for rod in start.rods]
    edges = [rod.edges for rod in scene.rods]
    if had != edges:
        expected, got = (", ".join(map(str, counts)) for counts in (edges, had))
        raise ValueError(
            f"start: expected {expected} rows, as many as the rods have edges, got {got}; a "
            "support or a joint between two vertices gives its rod one more"
        )


def _nodes_near(start: Equilibrium, scene: Scene) -> tuple[Any, Any]:
    """Positions and frames of the scene's nodes in an equilibrium, perhaps of another scene.

    A node is matched by what it is, see `Network.places`; others are placed by the rods.
    """
    known: dict[tuple[int, float], tuple[Any, Any]] = {}
    if start._nodes is not None:
        places = start.scene._network.places()
        known = dict(zip(places, zip(*start._nodes, strict=True), strict=False))  # free ends: none
    found = []
    for place, (i, j) in zip(scene._network.places(), scene._network.points, strict=True):
        rod = start.rods[i]
        found.append(known.get(place, (rod.positions[j], rod.vertex_frames[j])))
    positions, frames = zip(*found, strict=True)
    return np.array(positions), np.array(frames)
