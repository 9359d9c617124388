"""Several branches that are connected."""

from __future__ import annotations

from contextlib import suppress
from typing import Any

import numpy as np

from pyrod.base.arrays import whole
from pyrod.base.calls import spelled
from pyrod.base.immutable import Array
from pyrod.paths.branch import Branch, SpecialPoint
from pyrod.paths.family import Family
from pyrod.paths.follow import follow
from pyrod.result.equilibrium import Equilibrium

_SAME = 1e-6
"""Relative difference of values, and turn [rad], of special points that are one."""


class Diagram:
    """Branches, each with those that cross it, up to a depth; make one with `diagram`."""

    def __init__(self, branches: list[Branch]) -> None:
        self.branches = tuple(branches)  #: the first is that which was followed first

    def plot(self, x: str = "λ", y: str = "tip.0", ax: Any = None, **style: Any) -> Any:
        """All branches.

        Parameters
        ----------
        x, y, ax, style : as for `Branch.plot`
        """
        for branch in self.branches:
            ax = branch.plot(x, y, ax, **style)
        return ax

    def __len__(self) -> int:
        return len(self.branches)

    def __repr__(self) -> str:
        inside = "".join(f"\n  {branch!r}," for branch in self.branches)
        return f"Diagram({len(self)} branches:{inside}\n)"


@spelled
def diagram(
    family: Family,
    start: float,
    stop: float,
    *,
    depth: int = 1,
    max_points: int = 500,
    equilibrium: Equilibrium | None = None,
) -> Diagram:
    """The branch that begins at ``start``, and those that cross it, to both sides.

    Parameters
    ----------
    family, start, stop : as for `follow`
    depth : int
        How often another branch is switched to from the first; default 1. Where a branch comes to
        a point that was met before, it is not switched to again.
    max_points, equilibrium : as for `follow`

    Returns
    -------
    Diagram
        Ctrl-C ends it, and keeps what was found.
    """
    depth = whole(depth, "depth")
    first = follow(family, start, stop, max_points=max_points, equilibrium=equilibrium)
    branches = [first]
    with suppress(KeyboardInterrupt):  # between branches; within one it ends that
        _extend(branches, depth)
    return Diagram(branches)


def _extend(branches: list[Branch], depth: int) -> None:
    """By those that cross, and those that cross these; until one is interrupted."""
    last = branches[:]
    known: list[tuple[float, Array]] = []
    for _ in range(depth):
        crossing = [
            (point, side)
            for branch in last
            for point in branch.special
            if point.branches and _is_new(point, known)
            for side in (1, -1)
        ]
        last = []
        for point, side in crossing:
            if branches[-1].ended == "interrupted":
                return
            last.append(point.switch(side))
            branches.append(last[-1])


def _is_new(point: SpecialPoint, known: list[tuple[float, Array]]) -> bool:
    """Whether it was not met before; from now on it was."""
    frames = np.vstack([rod.frames for rod in point.equilibrium.rods])
    for value, others in known:
        near = abs(value - point.grid_value) <= _SAME * max(abs(value), abs(point.grid_value))
        if near and (1 - np.abs((frames * others).sum(axis=1))).max() < _SAME:
            return False
    known.append((point.grid_value, frames))
    return True
