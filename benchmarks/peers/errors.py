"""Errors of a shape against the exact one."""

from __future__ import annotations

from typing import Any

import numpy as np

from peers.exact import Exact
from peers.problem import Array

FAR = 1e3
"""Positions beyond, in lengths of the rod, are no solution but what is left of a solve."""


def errors(truth: Exact, row: dict[str, Any]) -> dict[str, float | None]:
    """Largest distance along the rod over L; of force and energy where they are there, relative."""
    s, r = np.array(row["s"]), np.array(row["r"], dtype=float)
    found: dict[str, float | None] = {"error": None}
    if np.isfinite(r).all() and np.abs(r).max() < FAR * truth.problem.L:
        right = truth.positions(s)
        if truth.problem.ring:
            r = aligned(r, right)
        found["error"] = float(np.linalg.norm(r - right, axis=1).max()) / truth.problem.L
    more = row["more"]
    if "energy" in more:
        found["energy_error"] = abs(more["energy"] / truth.energy - 1)
    if "force" in more:
        off = np.linalg.norm(np.array(more["force"]) - truth.n)
        found["force_error"] = float(off / np.linalg.norm(truth.n))
    return found


def aligned(r: Array, to: Array) -> Array:
    """Moved rigidly onto another shape, as near as can be: what nothing holds may lie anywhere."""
    a, b = r - r.mean(axis=0), to - to.mean(axis=0)
    u, _, vt = np.linalg.svd(a.T @ b)
    flip = np.diag([1, 1, np.sign(np.linalg.det(u @ vt))])
    return a @ u @ flip @ vt + to.mean(axis=0)
