"""Linear responses on the edges of a scene, on these halved, and so on, and what they tend to."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

import numpy as np

import pyrod._core as _core
from pyrod.base.immutable import Array
from pyrod.linear.grid import Grid
from pyrod.linear.numbers import Entry
from pyrod.linear.told import resolved
from pyrod.scene.scene import Scene
from pyrod.solving.run import solved
from pyrod.stability.state import halved

_MOST = 6
"""Grids, at the most."""
_AT_VERTICES = ("positions", "vertex_frames")
"""What is told at the same places of all grids, and converges like them."""


class Rungs:
    """The grids of a result with a tolerance; of one without there is its own only."""

    def __init__(self, first: Grid, errors: dict[str, float]) -> None:
        accuracy = first.result.accuracy
        self.climbs = accuracy is not None
        self._tol = accuracy.tol if accuracy else 0.0
        self.first = first
        self._grids, self._errors = [first], errors

    def _grid(self, level: int) -> Grid:
        while len(self._grids) <= level:
            scene = self._grids[0].scene.refined(len(self._grids))
            before = halved(self._grids[-1].result)
            found = solved(scene, start=before, stable=False)
            self._grids.append(Grid(found, self._grids[0], len(self._grids)))
        return self._grids[level]

    def limit(self, name: str, of: Callable[[Grid], Array]) -> Array:
        """Of one array; on the only grid it is as it is."""
        if not self.climbs:
            return of(self._grids[0])
        return self.limits(lambda grid: {name: of(grid)})[name]

    def limits(self, of: Callable[[Grid], dict[str, Any]]) -> dict[str, Array]:
        """Of arrays by their names, each with its error, which goes to the errors of the first."""
        grids: list[dict[str, Any]] = []
        best: dict[str, Array] = {}
        errors: dict[str, float] = {}
        for level in range(_MOST):
            grids.append(of(self._grid(level)))
            if level < 2:
                continue
            better = False
            for name in grids[0]:
                value, error = self._limit([np.asarray(grid[name]) for grid in grids])
                if name not in errors or error < errors[name]:
                    best[name], errors[name], better = value, error, True
            if max(errors.values()) <= self._tol or not better:
                break
        self._errors.clear()
        self._errors.update(errors)
        return best

    def judged(
        self, of: Callable[[Grid], dict[str, Any]]
    ) -> tuple[dict[str, Array], dict[str, float]]:
        """The same and the relative errors, for answers that tell errors of their own."""
        best = self.limits(of)
        return best, {name: self._errors.pop(name) for name in best}

    def _limit(self, grids: list[Array]) -> tuple[Array, float]:
        known = np.isfinite(grids[-1])
        flat = [np.where(known, grid, 0.0).reshape(-1) for grid in grids]
        edges = max(rod.edges for rod in self._grid(len(grids) - 1).scene.rods)
        even = self._grids[0].scene.space == "planar"
        noise = 16 * float(np.finfo(float).eps) * edges
        value, error, _ = _core.limit(flat, even, noise)
        size = float(np.abs(flat[-1]).max(initial=0.0)) or 1.0
        return np.where(known, value.reshape(known.shape), np.nan), error / size

    def told(self, of: Callable[[Grid], dict[str, Any]]) -> dict[str, Array]:
        """Of what a product tells, that which is at the same places of all grids."""
        return self.limits(lambda grid: self._on_first(grid, of(grid)))

    def _on_first(self, grid: Grid, told: dict[str, Any]) -> dict[str, Any]:
        stride = 2**grid.level
        out = {}
        for name, value in told.items():
            what = name.rsplit(".", 1)[-1]
            if name.startswith("rods.") and what in _AT_VERTICES:
                out[name] = value[::stride]
            elif not name.startswith("rods.") and name != "multipliers":
                out[name] = value
        return out


def refuse_of_one_grid(scene: Scene, outputs: Iterable[str], whole: bool) -> None:
    """Refuses outputs that are not at the same places of all grids; ``whole``: not arrays."""
    for output in outputs:
        path, row = resolved(scene, output)
        what = path.rsplit(".", 1)[-1]
        same = what in _AT_VERTICES and (whole or row is not None)
        if path == "multipliers" or (path.startswith("rods.") and not same):
            raise ValueError(
                f"{output}: with a tolerance jacobian tells tip, tip_frame, energy and reactions; "
                "jvp and vjp know positions and vertex_frames, too"
            )


def refuse_entries(entries: Iterable[Entry]) -> None:
    """Of loads along a rod: only their own edges know them."""
    for entry in entries:
        if entry.is_of_one_grid:
            raise ValueError(
                f"{entry.path}: belongs to one grid; solve without a tolerance for its derivatives"
            )
