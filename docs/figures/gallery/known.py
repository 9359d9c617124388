"""Smooth curves whose invariants are known exactly: what polylines are measured against.

The formulas are those of the files G_*.json in tests/reference.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from pyrod.curve import Polyline
from pyrod.rotation import from_matrix

Array = np.ndarray
Derivatives = Callable[[Array], Array]  # t -> r, r', r'', r''' as an array (4, ..., 3)


@dataclass(frozen=True)
class Known:
    """A curve on an interval of its parameter t, with the exact geometry in every point."""

    name: str
    interval: tuple[float, float]
    closed: bool
    derivatives: Derivatives
    writhe: float | None = None

    def position(self, t: Array) -> Array:
        return self.derivatives(t)[0]

    def speed(self, t: Array) -> Array:
        return np.linalg.norm(self.derivatives(t)[1], axis=-1)

    def curvature(self, t: Array) -> Array:
        _, r1, r2, _ = self.derivatives(t)
        return np.linalg.norm(np.cross(r1, r2), axis=-1) / self.speed(t) ** 3

    def torsion(self, t: Array) -> Array:
        _, r1, r2, r3 = self.derivatives(t)
        b = np.cross(r1, r2)
        return (b * r3).sum(-1) / (b * b).sum(-1)

    def frenet(self, t: Array) -> Array:
        """Frames (n, b, t) as matrices (..., 3, 3)."""
        _, r1, r2, _ = self.derivatives(t)
        b = np.cross(r1, r2)
        T, B = (v / np.linalg.norm(v, axis=-1, keepdims=True) for v in (r1, b))
        return np.stack([np.cross(B, T), B, T], axis=-1)

    def bishop(self, start: float, t: Array) -> Array:
        """Parallel frames that are Frenet's at ``start``: these, turned back by the torsion."""
        angle = -np.cumsum(self.integral(self.torsion, np.concatenate([[start], t])))
        c, s, R = np.cos(angle)[:, None], np.sin(angle)[:, None], self.frenet(t)
        n, b = R[..., 0], R[..., 1]
        return np.stack([c * n + s * b, c * b - s * n, R[..., 2]], axis=-1)

    def integral(self, f: Callable[[Array], Array], t: Array) -> Array:
        """Integrals of f ds from each parameter to the next, by Gauss's rule with 16 points."""
        x, w = np.polynomial.legendre.leggauss(16)
        half = np.diff(t)[:, None] / 2
        at = (t[1:] + t[:-1])[:, None] / 2 + half * x
        return (half * w * f(at) * self.speed(at)).sum(axis=1)

    def length(self, f: Callable[[Array], Array] = np.ones_like) -> float:
        """The length, or the integral of f ds along all of the curve."""
        return float(self.integral(f, np.linspace(*self.interval, 257)).sum())

    def parameters(self, n: int, seed: int | None = None) -> Array:
        """n + 1 of them: equidistant, or with intervals at random that differ by up to four."""
        a, b = self.interval
        if seed is None:
            return np.linspace(a, b, n + 1)
        steps = np.random.default_rng(seed).uniform(0.4, 1.6, n)
        return a + (b - a) * np.concatenate([[0.0], np.cumsum(steps)]) / steps.sum()

    def polyline(self, t: Array) -> Polyline:
        """Through the points of the parameters t; an open one is held by the tangents."""
        r = self.position(t)
        if self.closed:
            return Polyline(r[:-1], closed=True)
        ends = self.derivatives(t[[0, -1]])[1]
        return Polyline(r, False, *ends)

    def frame(self, t: float) -> Array:
        """The Frenet frame in one point, a quaternion."""
        return from_matrix(self.frenet(np.array([t])))[0]


def trigonometric(f: Callable[[Array], list[Array]], period: float = 2 * np.pi) -> Derivatives:
    """Derivatives of a trigonometric polynomial, from its Fourier coefficients."""
    m = 32
    c = np.fft.fft(np.transpose(f(period * np.arange(m) / m)), axis=0) / m
    c[abs(c) < 1e-15] = 0
    iw = 2j * np.pi / period * np.fft.fftfreq(m, 1 / m)
    powers = iw ** np.arange(4)[:, None]

    def derivatives(t: Array) -> Array:
        waves = np.exp(np.asarray(t)[..., None] * iw)
        return np.stack([((waves * p) @ c).real for p in powers])

    return derivatives


def helix(t: Array) -> Array:
    c, s, one = np.cos(t), np.sin(t), np.ones_like(t)
    rows = [(c, s, 0.3 * t), (-s, c, 0.3 * one), (-c, -s, 0 * t), (s, -c, 0 * t)]
    return np.stack([np.stack(row, axis=-1) for row in rows])


def cubic(t: Array) -> Array:
    one, no = np.ones_like(t), np.zeros_like(t)
    rows = [(t, t**2, t**3), (one, 2 * t, 3 * t**2), (no, 2 * one, 6 * t), (no, no, 6 * one)]
    return np.stack([np.stack(row, axis=-1) for row in rows])


def torus(turns: int, winds: int, radius: float) -> Derivatives:
    """Knot that goes ``turns`` times around the axis of a torus and ``winds`` times about it."""

    def f(t: Array) -> list[Array]:
        r = radius + np.cos(winds * t)
        return [r * np.cos(turns * t), r * np.sin(turns * t), np.sin(winds * t)]

    return trigonometric(f)


def unknot(t: Array) -> list[Array]:
    c2, s2 = np.cos(2 * t), np.sin(2 * t)
    return [
        np.cos(t) + 0.2 * c2 + 0.1 * s2,
        np.sin(t) - 0.15 * c2,
        0.3 * c2 + 0.25 * s2 + 0.1 * np.sin(3 * t),
    ]


def viviani(t: Array) -> list[Array]:
    return [1 + np.cos(t), np.sin(t), 2 * np.sin(t / 2)]


ONCE = (0.0, 2 * np.pi)
HELIX = Known("helix", (0.0, 4 * np.pi), False, helix)
CUBIC = Known("twisted cubic", (-1.0, 1.0), False, cubic)
TREFOIL = Known("trefoil", ONCE, True, torus(2, 3, 2.0), writhe=-3.51823923103885975)
TORUS_32 = Known("torus knot (3, 2)", ONCE, True, torus(3, 2, 3.0), writhe=-3.94478068387737251)
UNKNOT = Known("unknot", ONCE, True, trigonometric(unknot), writhe=-0.0207267096244057266)
VIVIANI = Known("Viviani", (0.0, 4 * np.pi), True, trigonometric(viviani, 4 * np.pi))
CURVES = (HELIX, CUBIC, TREFOIL, TORUS_32, UNKNOT, VIVIANI)
