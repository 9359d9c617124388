"""Values of special points, as they are on ever finer grids."""

from __future__ import annotations

import warnings
from collections.abc import Callable

import numpy as np

import pyrod._core as _core
from pyrod.base.calls import users_level
from pyrod.paths.branch import Branch
from pyrod.result.equilibrium import Equilibrium
from pyrod.result.errors import AccuracyWarning

_MOST = 6
"""Grids, at the most."""
Follow = Callable[[int, Equilibrium | None], Branch]


def extrapolated(follow: Follow, start: Equilibrium | None, tol: float, least: float) -> Branch:
    """The branch on the first grid that has what all finer ones have.

    Its special points are at the values that those of all grids tend to. Errors are relative to the
    values, or to ``least`` where these are smaller.
    """
    grids: list[Branch] = []
    best: list[tuple[float, float]] = []
    for level in range(_MOST):
        branch = follow(level, start)
        start = branch.points[0].equilibrium
        if grids and _kinds(branch) != _kinds(grids[-1]):
            grids, best = [], []  # too coarse to tell what there is
        grids.append(branch)
        if len(grids) < 3:
            continue
        best = _better(best, _limits(grids))
        if all(_relative(*one, least) <= tol for one in best):
            break
    else:
        _warn(grids, best, tol, least)
    first = grids[0]
    for point, (value, error) in zip(first.special, best, strict=False):
        point.value, point.error = value, error
    return first


def _relative(value: float, error: float, least: float) -> float:
    return error / max(abs(value), least)


def _kinds(branch: Branch) -> list[str]:
    return [point.kind for point in branch.special]


def _limits(grids: list[Branch]) -> list[tuple[float, float]]:
    return [_limit(grids, k) for k in range(len(grids[0].special))]


def _limit(grids: list[Branch], k: int) -> tuple[float, float]:
    values = [np.array([branch.special[k].value]) for branch in grids]
    searched = max(branch.special[k].error for branch in grids)
    noise = searched / (abs(values[-1][0]) or 1.0)
    even = grids[0].points[0].equilibrium.scene.space == "planar"
    value, error, _ = _core.limit(values, even, noise)
    return float(value[0]), max(float(error), searched)


def _better(
    before: list[tuple[float, float]], now: list[tuple[float, float]]
) -> list[tuple[float, float]]:
    if not before:
        return now
    return [min(pair, key=lambda one: one[1]) for pair in zip(before, now, strict=True)]


def _warn(grids: list[Branch], best: list[tuple[float, float]], tol: float, least: float) -> None:
    if not best:
        told = "; ".join(", ".join(_kinds(branch)) or "nothing" for branch in grids[-2:])
        words = f"the grids differ in what the path meets ({told}), so that nothing is extrapolated"
    else:
        most = max(_relative(*one, least) for one in best)
        words = f"the values of special points have errors of {most:.1e}, {tol:.1e} was wanted"
    warnings.warn(words, AccuracyWarning, stacklevel=users_level())
