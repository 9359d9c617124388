"""The smooth curve behind points: a spline, told by its own arc length."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from pyrod.base.arrays import array
from pyrod.base.borrowed import borrowed
from pyrod.base.immutable import Array, Immutable, Once
from pyrod.base.optional import need

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(8)
"""Of Gauss's rule: exact to the 15th degree on each piece of a spline."""
_STEPS = 8
"""Of Newton's method to a parameter, from one that is nearly right."""
_STRAIGHT = 1e-10
"""Curvature times length below which a curve has no plane, and no torsion."""


@dataclass(frozen=True, eq=False, init=False, repr=False)
class SmoothCurve(Immutable):
    """A spline through the points of a `Polyline`, or near them: see `Polyline.smooth_curve`.

    All that it tells is by its own arc length s, from 0 to `length`; that of a closed curve goes
    round. Where no s is given it is told at the points that the curve was made of (`places`).

    Parameters
    ----------
    knots : (m + degree + 1,) array
    coefficients : (m, 3) array [m]
    degree : int
    closed : bool
    parameters : (k,) array
        Values of the parameter at the points.
    """

    knots: Array
    coefficients: Array
    degree: int
    closed: bool
    parameters: Array

    def __init__(
        self, knots: Array, coefficients: Array, degree: int, closed: bool, parameters: Array
    ) -> None:
        self._set(
            knots=knots,
            coefficients=coefficients,
            degree=degree,
            closed=closed,
            parameters=parameters,
        )
        for values in (knots, coefficients, parameters):
            values.setflags(write=False)

    def __repr__(self) -> str:
        kind = "closed" if self.closed else "open"
        return f"SmoothCurve({kind}, points={len(self.parameters)}, length={self.length:g})"

    # Arc length -----------------------------------------------------------------------------------

    @property
    def length(self) -> float:
        """Length of the spline [m]."""
        return float(self._arc[1][-1])

    @property
    def places(self) -> Array:
        """Arc length [m] at the points that the curve was made of."""
        return self._lengths_at(self.parameters)

    @Once
    def _spline(self) -> Any:
        made = need("scipy.interpolate", "all").BSpline(
            self.knots, self.coefficients, self.degree, extrapolate=self._beyond
        )
        return [made, *(made.derivative(i) for i in range(1, min(self.degree, 3) + 1))]

    @property
    def _beyond(self) -> Any:
        return "periodic" if self.closed else True

    @Once
    def _arc(self) -> tuple[Array, Array]:
        """Values of the parameter between which the spline is one polynomial, and lengths there."""
        inside = self.knots[self.degree : len(self.knots) - self.degree]
        u = np.unique(inside)
        return u, np.concatenate([[0.0], np.cumsum(self._between(u[:-1], u[1:]))])

    def _between(self, start: Array, end: Array) -> Array:
        """Lengths between pairs of parameters of one piece."""
        half = (end - start) / 2
        at = (start + half)[:, None] + half[:, None] * _NODES
        return (self._speed(at) @ _WEIGHTS) * half

    def _speed(self, u: Array) -> Array:
        return np.asarray(np.linalg.norm(self._spline[1](u), axis=-1))

    def _lengths_at(self, u: Array) -> Array:
        ends, lengths = self._arc
        piece = np.clip(np.searchsorted(ends, u, side="right") - 1, 0, len(ends) - 2)
        return lengths[piece] + self._between(ends[piece], u)

    def _parameters_at(self, s: ArrayLike | None) -> Array:
        """By Newton's method on the piece where an arc length is."""
        if s is None:
            return self.parameters
        given = array(s, "s")
        x = given.ravel()
        ends, lengths = self._arc
        if self.closed:
            x = x % self.length
        _refuse_outside(x, self.length)
        piece = np.clip(np.searchsorted(lengths, x, side="right") - 1, 0, len(ends) - 2)
        start, low, step = ends[piece], lengths[piece], np.diff(ends)[piece]
        u = start + step * (x - low) / np.diff(lengths)[piece]
        for _ in range(_STEPS):
            u = u - (low + self._between(start, u) - x) / self._speed(u)
            u = np.clip(u, start, start + step)
        return np.asarray(u.reshape(given.shape))

    # What it tells --------------------------------------------------------------------------------

    def at(self, s: ArrayLike | None = None) -> Array:
        """(..., 3) positions [m]; sixth order in the distance of the points if nothing is rough.

        Parameters
        ----------
        s : (...) array [m]
            Default: `places`.

        Raises
        ------
        ValueError
            Beyond the ends of an open curve.
        """
        return np.asarray(self._spline[0](self._parameters_at(s)))

    def tangents(self, s: ArrayLike | None = None) -> Array:
        """(..., 3) unit tangents, as for `at`."""
        d = self._derivatives(s)[0]
        return np.asarray(d / np.linalg.norm(d, axis=-1, keepdims=True))

    def curvature(self, s: ArrayLike | None = None) -> Array:
        """(...) curvature [1/m], as for `at`."""
        d1, d2, _ = self._derivatives(s)
        cross = np.linalg.norm(np.cross(d1, d2), axis=-1)
        return np.asarray(cross / np.linalg.norm(d1, axis=-1) ** 3)

    def torsion(self, s: ArrayLike | None = None) -> Array:
        """(...) torsion [1/m], as for `at`; 0 where the curve is straight."""
        d1, d2, d3 = self._derivatives(s)
        cross = np.cross(d1, d2)
        area = np.linalg.norm(cross, axis=-1)
        straight = area * self.length <= _STRAIGHT * np.linalg.norm(d1, axis=-1) ** 3
        volume = np.einsum("...i,...i->...", cross, d3)
        return np.asarray(np.where(straight, 0.0, volume / np.where(straight, 1.0, area) ** 2))

    def _derivatives(self, s: ArrayLike | None) -> list[Array]:
        u = self._parameters_at(s)
        told = [np.asarray(one(u)) for one in self._spline[1:]]
        return [*told, *(np.zeros_like(told[0]) for _ in range(3 - len(told)))]

    @borrowed("pyrod.curve._smooth:polyline_on")
    def polyline(self, edges: int) -> Any:
        """A `Polyline` of as many equal steps of arc length."""


def _refuse_outside(s: Array, length: float) -> None:
    """NaN is outside, too."""
    slack = 1e-9 * length
    wrong = ~((s >= -slack) & (s <= length + slack))
    if wrong.any():
        raise ValueError(f"s: must be from 0 to the length {length:g}, got {s[np.argmax(wrong)]}")
