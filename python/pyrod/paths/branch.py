"""What a path of equilibria consists of."""

from __future__ import annotations

from collections.abc import Iterable
from functools import cached_property
from time import perf_counter
from typing import TYPE_CHECKING, Any

import numpy as np

import pyrod._core as _core
from pyrod.base.arrays import whole
from pyrod.base.immutable import Array
from pyrod.base.optional import need
from pyrod.base.words import shortly
from pyrod.paths.family import Scenes, entry_of
from pyrod.paths.picture import draw_path
from pyrod.result.equilibrium import Equilibrium
from pyrod.scene.scene import Scene
from pyrod.solving.job import DEFAULTS, How, equilibrium_of

if TYPE_CHECKING:
    import pandas as pd

_HOW = How(DEFAULTS, stable=False, eigenvalue=False, tol=None)
_APART = 1e-3
"""Relative to entries: over which scenes are differenced."""
COLUMNS = ("tip.0", "tip.1", "tip.2", "energy")
"""What `Branch.to_pandas` has of each equilibrium unless told otherwise."""


class BranchPoint:
    """An equilibrium on a path. All but two numbers is worked out when it is asked for."""

    def __init__(self, _branch: Branch, _number: int) -> None:
        self._branch, self._number = _branch, _number
        self.value = float(_branch.values[_number])  #: of the number that changes
        self.index = int(_branch.indices[_number])
        """Stability index, directions in which the energy falls; -1 if there is no potential."""

    @property
    def stable(self) -> bool | None:
        """Whether the energy has a minimum here; None if the loads have no potential."""
        return None if self.index < 0 else self.index == 0

    @cached_property
    def equilibrium(self) -> Equilibrium:
        """On the edges of the scene."""
        return self._made(eigenvalue=False)

    @cached_property
    def with_mode(self) -> Equilibrium:
        """The same with its lowest eigenvalue and the mode of that."""
        return self._made(eigenvalue=True)

    @property
    def lowest_eigenvalue(self) -> float | None:
        """Of the second variation [N m], see `Equilibrium`; None if there is no potential."""
        return self.with_mode.lowest_eigenvalue

    def _made(self, eigenvalue: bool) -> Equilibrium:
        began = perf_counter()
        found = self._branch._compiled.equilibrium(self._number, eigenvalue)
        how = _HOW._replace(eigenvalue=eigenvalue and self.index >= 0)
        return equilibrium_of(self._branch._scenes(self.value), found, how, perf_counter() - began)

    def __repr__(self) -> str:
        return f"BranchPoint({self._branch.name} {self.value:.9g}, {_index(self.index)})"


class SpecialPoint:
    """Where a path turns back, or where another branch crosses it."""

    def __init__(self, _branch: Branch, _number: int, _told: tuple[Any, ...]) -> None:
        self._branch, self._number = _branch, _number
        self.kind: str
        """"fold", "transcritical", "supercritical pitchfork", "subcritical pitchfork"; "double":
        several modes lose their stiffness at once; "unresolved": the index changes, and no reason
        was found."""
        self.value: float  #: of the number that changes; with ``tol``, extrapolated
        self.error: float
        """Of ``value``: on the edges of the scenes that of the search, and rounding; with ``tol``
        what the grids tell."""
        self.index_before: int  #: stability index before it, along the path; -1 without a potential
        self.index_behind: int
        self.behind: int  #: so many points of the branch lie before it
        self.branches: bool  #: whether another branch crosses, which `switch` follows
        self.mode: Array
        """(edges of all rods, 3) turns of the edges in their frames in the mode without stiffness;
        the largest component is 1."""
        (
            self.kind,
            self.value,
            self.error,
            self.index_before,
            self.index_behind,
            self.behind,
            self.mode,
            self.branches,
        ) = _told
        self.grid_value = self.value  #: on the edges of ``equilibrium``

    @cached_property
    def equilibrium(self) -> Equilibrium:
        """The one there, on the edges of the scene, with ``mode`` as its mode."""
        began = perf_counter()
        found = self._branch._compiled.special_equilibrium(self._number)
        scene = self._branch._scenes(self.grid_value)
        return equilibrium_of(scene, found, _HOW, perf_counter() - began)

    def gradient(self, wrt: str | Iterable[str]) -> dict[str, Array]:
        """The derivative of the value of a fold in entries of the scene, by their paths.

        Dot products with the mode, on these edges. NaN where a scene may not change, as out of the
        plane of a planar one.

        Raises
        ------
        ValueError
            This is no fold, or the loads have no potential.
        """
        scene = self._branch._scenes(self.grid_value)
        names = [wrt] if isinstance(wrt, str) else list(wrt)
        return {path: self._gradient(scene, path) for path in names}

    def _gradient(self, scene: Scene, path: str) -> Array:
        old = np.asarray(entry_of(scene, path))
        shape = (3,) if path.endswith(".frame") else old.shape
        step = _APART * (float(np.abs(old).max()) or 1.0)
        out = np.empty(shape)
        for at in np.ndindex(shape):
            unit = np.zeros(shape)
            unit[at] = 1.0
            scenes = Scenes((scene, path, unit if shape else 1.0))
            out[at] = self._derivative(scenes, step)
        return out

    def _derivative(self, scenes: Scenes, step: float) -> float:
        find = self._branch._compiled.derivative
        if self.kind != "fold" or self.index_before < 0:
            return find(self._number, lambda _: None, step)  # which refuses that in words
        try:
            return find(self._number, scenes.compiled, step)
        except ValueError:
            return float("nan")

    def switch(
        self,
        side: int = 1,
        start: float | None = None,
        stop: float | None = None,
        *,
        max_points: int | None = None,
    ) -> Branch:
        """The branch that crosses here, followed from its first point.

        Parameters
        ----------
        side : 1 or -1
            In the direction of ``mode``, or against it.
        start, stop : float
            The branch ends at ``stop``, or as far on the other side of ``start``; default: those of
            the branch that this is a point of.
        max_points : int
            Default: as of that.

        Raises
        ------
        ValueError
            No single branch crosses here, see ``kind``.
        """
        if side not in (1, -1):
            raise ValueError(f"side: expected 1 or -1, got {shortly(side)}")
        branch = self._branch
        start = branch.start if start is None else float(start)
        stop = branch.stop if stop is None else float(stop)
        most = branch.max_points if max_points is None else whole(max_points, "max_points")
        found = branch._compiled.switched(self._number, side, start, stop, most, None)
        return Branch(found, branch._scenes, (start, stop, most))

    def __repr__(self) -> str:
        return (
            f"SpecialPoint({self.kind} at {self.value:.12g} ± {self.error:.1g}, "
            f"index {self.index_before} to {self.index_behind})"
        )


class Branch:
    """Equilibria one behind the other, and what lies between; make one with `follow`."""

    def __init__(
        self, _compiled: _core.Branch, _scenes: Scenes, _limits: tuple[float, float, int]
    ) -> None:
        compiled = self._compiled = _compiled
        self._scenes = _scenes
        self.start, self.stop, self.max_points = _limits
        self.name = _scenes.name  #: of the number that changes
        self.values: Array = compiled.values  #: of that number at the points
        self.indices: Array = compiled.indices
        """Stability indices of the points; -1 if the loads have no potential."""
        self.ended: str = compiled.ended
        """Why there are no more points, "reached" (``stop``), "turned back" (as far on the other
        side of ``start``), "max_points", "interrupted" (by Ctrl-C) or "lost" (no next point was
        found, see ``reason``)."""
        self.reason: str = compiled.reason  #: why it was lost, if a scene was refused there
        self.special = tuple(SpecialPoint(self, i, told) for i, told in enumerate(compiled.special))

    @cached_property
    def points(self) -> tuple[BranchPoint, ...]:
        """One behind the other."""
        return tuple(BranchPoint(self, i) for i in range(len(self.values)))

    def __len__(self) -> int:
        return len(self.values)

    def __getitem__(self, name: str) -> np.ndarray:
        """A quantity of all points: "value" or the name of what changes, "index",
        "lowest_eigenvalue", or a path into their equilibria: "tip.0", "rods.1.tip.2",
        "reactions.0.force", "energy"."""
        if name in ("value", "λ", self.name):
            return self.values
        if name == "index":
            return self.indices
        if name == "lowest_eigenvalue":
            return np.array([point.lowest_eigenvalue for point in self.points], dtype=float)
        return np.array([told_at(point.equilibrium, name) for point in self.points])

    def to_pandas(self, columns: Iterable[str] | None = None) -> pd.DataFrame:
        """A row per point: the value, the index, and quantities by their paths.

        ``columns`` : those of the equilibria, numbers all; default: where the end of the last rod
        is, and the energy.
        """
        several = len(self.points[0].equilibrium.rods) > 1
        names = list(COLUMNS) if columns is None else list(columns)
        if columns is None and several:
            last = len(self.points[0].equilibrium.rods) - 1
            names = [f"rods.{last}.{n}" if n.startswith("tip") else n for n in names]
        table = {self.name: self.values, "index": self.indices}
        table |= {name: self[name] for name in names}
        frame = need("pandas", "follow").DataFrame(table)
        frame.index.name = "point"
        return frame

    def plot(self, x: str = "λ", y: str = "tip.0", ax: Any = None, **style: Any) -> Any:
        """One quantity over another, solid where equilibria are stable, with the special points.

        Parameters
        ----------
        x, y : str
            See `__getitem__`; "λ" is the number that changes.
        ax : Axes
            To draw on; made if not given.
        style : object
            Passed to ``Axes.plot``.

        Returns
        -------
        Axes
        """
        marks = [(self._at(one, x), self._at(one, y), one.kind) for one in self.special]
        ax = draw_path(self[x], self[y], self.indices <= 0, marks, ax, style)
        ax.set(xlabel=self.name if x == "λ" else x, ylabel=self.name if y == "λ" else y)
        return ax

    def _at(self, point: SpecialPoint, name: str) -> float:
        if name in ("value", "λ", self.name):
            return point.value
        if name == "index":
            return float(min(point.index_before, point.index_behind))
        return 0.0 if name == "lowest_eigenvalue" else float(told_at(point.equilibrium, name))

    def __repr__(self) -> str:
        words = [
            f"{len(self)} points",
            f"{self.name} {self.values[0]:.6g} to {self.values[-1]:.6g}",
        ]
        words += [f"{point.kind} at {point.value:.6g}" for point in self.special]
        if self.ended != "reached":
            words.append(self.ended + (f": {self.reason}" if self.reason else ""))
        return f"Branch({', '.join(words)})"


def told_at(result: Equilibrium, path: str) -> Any:
    """What a path leads to."""
    found: Any = result
    for word in path.split("."):
        try:
            found = found[int(word)] if word.isdecimal() else getattr(found, word)
        except (AttributeError, IndexError, TypeError) as error:
            raise ValueError(
                f"{shortly(path)}: is no quantity of an equilibrium, {error}"
            ) from None
    return found


def _index(index: int) -> str:
    return "no potential" if index < 0 else f"index {index}"
