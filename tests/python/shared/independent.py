"""A solver of one rod that has nothing in common with pyrod's: shooting with the continuous rod.

The state along the rod is position r, rotation matrix R (nine numbers), section force n and moment
m, both in space. SciPy's DOP853 integrates

    r' = R (e3 + S R^T n),  R' = R hat(K0 + C^-1 R^T m),  n' = -f,  m' = -l - r' x n

piece by piece between the places where something jumps, and Newton's method finds the n and m of
the start for which the end is free, or where it is held. Started from pyrod's own answer (it may be
a poor one) it converges to the equilibrium nearby, to its own tolerance, which knows no grids.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

Array = np.ndarray
Along = Callable[[float], Array]
ZERO = np.zeros(3)
INSIDE = 1e-13  #: of a rod of unit length: on which side of a jump a function is asked


@dataclass
class Problem:
    """A rod that is clamped at its start; its end is free, or held at a point (``pinned``)."""

    length: float
    compliance: Along  #: (1/EI1, 1/EI2, 1/GJ, 1/GA1, 1/GA2, 1/EA) at s
    K0: Along = lambda s: ZERO
    force: Along = lambda s: ZERO
    moment: Along = lambda s: ZERO
    following: Along = lambda s: ZERO
    points: list[tuple[float, Array, Array]] = field(default_factory=list)
    """(s, force, moment) that act at inner places."""
    springs: list[tuple[float, float, Array]] = field(default_factory=list)
    """(s, stiffness, position) that pull towards a position."""
    end_force: Array = field(default_factory=lambda: np.zeros(3))
    end_moment: Array = field(default_factory=lambda: np.zeros(3))
    pinned: Array | None = None
    breaks: Sequence[float] = ()  #: where something jumps or has a kink


def hat(v: Array) -> Array:
    return np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


def slope(p: Problem, s: float, y: Array) -> Array:
    """The derivative of (r, R, n, m) by arc length."""
    R, n, m = y[3:12].reshape(3, 3), y[12:15], y[15:18]
    C = p.compliance(s)
    dr = R @ (np.array([0, 0, 1.0]) + C[3:] * (R.T @ n))
    dR = R @ hat(p.K0(s) + C[:3] * (R.T @ m))
    f = p.force(s) + R @ p.following(s)
    return np.concatenate([dr, dR.ravel(), -f, -p.moment(s) - np.cross(dr, n)])


def pieces(p: Problem) -> Array:
    inner = [*p.breaks, *(s for s, *_ in p.points), *(s for s, *_ in p.springs)]
    return np.unique([0.0, *(s for s in inner if 0 < s < p.length), p.length])


def jump(p: Problem, s: float, y: Array) -> Array:
    """What n and m lose at an inner place."""
    out = np.zeros(18)
    for at, F, M in p.points:
        if at == s:
            out[12:15] += F
            out[15:18] += M
    for at, k, x in p.springs:
        if at == s:
            out[12:15] -= k * (y[:3] - x)
    return out


def shoot(p: Problem, start: Array, tol: float) -> tuple[Array, list[Any]]:
    """The state at the end from (n, m) at the start, and the integrals of the pieces."""
    y, dense = np.concatenate([ZERO, np.eye(3).ravel(), start]), []
    for a, b in pairwise(pieces(p)):

        def at(s: float, y: Array, a: float = a, b: float = b) -> Array:
            return slope(p, min(max(s, a + INSIDE), b - INSIDE), y)

        run = solve_ivp(at, (a, b), y, "DOP853", rtol=tol, atol=tol, dense_output=True)
        dense.append(run.sol)
        y = run.y[:, -1] - jump(p, b, run.y[:, -1])
    return y, dense


def residual(p: Problem, start: Array, tol: float) -> Array:
    y = shoot(p, start, tol)[0]
    force = y[12:15] - p.end_force if p.pinned is None else y[:3] - p.pinned
    return np.concatenate([force, y[15:18] - p.end_moment])


def shot(p: Problem, start: Array, tol: float = 1e-12) -> tuple[Array, Callable[[float], Array]]:
    """Reaction (n, m) of the start, and the state along the rod, from a start that is near.

    Newton's method with the differences of the start; refuses what does not converge.
    """
    x = np.array(start, dtype=float)
    scale = max(1.0, float(np.abs(x).max()))
    h = 1e-4 * scale
    sides = [[residual(p, x + t * e, 1e-10) for t in (h, -h)] for e in np.eye(6)]
    J = np.column_stack([(a - b) / (2 * h) for a, b in sides])
    for _ in range(12):
        dx = np.linalg.solve(J, -residual(p, x, tol))
        x = x + dx
        if np.abs(dx).max() < 1e-11 * scale:
            break
    else:
        raise RuntimeError(f"shooting does not converge: {dx}")
    ends, (_, dense) = pieces(p), shoot(p, x, tol)

    def state(s: float) -> Array:
        i = int(np.clip(np.searchsorted(ends, s, "left") - 1, 0, len(dense) - 1))
        return dense[i](s)

    return x, state


@dataclass
class Elastica:
    """A plane cantilever, clamped along z, under a dead force at its end; EI varies along it."""

    length: float
    EI: Callable[[float], float]
    force: Array  #: (2,) along x and z
    breaks: Sequence[float] = ()

    def backwards(self, angle: float) -> Array:
        """Angle at the start, end less start, and moment at the start; ``angle`` is the end's."""
        ends = np.unique([0.0, *self.breaks, self.length])[::-1]
        y = np.array([angle, 0, 0, 0])
        for b, a in pairwise(ends):

            def slope(s: float, y: Array, a: float = a, b: float = b) -> Array:
                c, d = np.cos(y[0]), np.sin(y[0])
                EI = self.EI(min(max(s, a + INSIDE), b - INSIDE))
                across = self.force[0] * c - self.force[1] * d
                return np.array([y[3] / EI, d, c, -across])

            y = solve_ivp(slope, (b, a), y, "DOP853", rtol=1e-12, atol=1e-12).y[:, -1]
        return np.array([y[0], -y[1], -y[2], y[3]])

    def solved(self, angle: float) -> tuple[Array, float]:
        """The end (x, z), and the moment at the start; from an angle of the end that is near."""
        low, high = angle, angle + 1e-6
        at, near = self.backwards(low), self.backwards(high)
        for _ in range(20):
            low, high = high, high - near[0] * (high - low) / (near[0] - at[0])
            at, near = near, self.backwards(high)
            if abs(near[0]) < 1e-13 or high == low:
                break
        if abs(near[0]) > 1e-11:
            raise RuntimeError(f"the elastica does not converge: {near[0]}")
        return near[1:3], float(near[3])
