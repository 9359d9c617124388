"""Splines through the vertices of polylines, and through what is left of them without noise."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from pyrod.base.arrays import Array, array, whole
from pyrod.base.optional import need
from pyrod.curve._polyline import Polyline
from pyrod.curve._spline import SmoothCurve

_ROUNDS = 3
"""Of taking the arc length of a spline for the parameter of the next."""


def smooth_curve(arc: Polyline, noise: ArrayLike = 0.0, *, degree: int = 5) -> SmoothCurve:
    """The spline through the vertices, or near them as their noise lets it: a `SmoothCurve`.

    Without noise it goes through all vertices, in the directions that hold the ends; where they
    are those of a smooth curve, curvature is of fourth and torsion of third order, on any grid. It
    rings at corners. With noise it has the fewest knots with which it stays as far from the
    vertices, across the curve, as noise explains (SciPy's ``splprep``). Needs SciPy.

    Parameters
    ----------
    arc : `Polyline`
    noise : float, (3,), (k,) or (3, 3) array [m]
        Standard deviation of the errors of the positions, independent from point to point: one for
        all, one along each of x, y, z, or one for each of the k vertices; or the covariance [m^2].
        See `Polyline.estimated_noise`.
    degree : int
        3 or 5; curves of few points get a lower one.

    Raises
    ------
    ValueError
        Noise of another shape, or not positive where positions vary.
    """
    degree = whole(degree, "degree")
    if degree not in (3, 5):
        raise ValueError(f"degree: expected 3 or 5, got {degree}")
    sigma = array(noise, "noise")
    if not sigma.any():
        return _through(arc, degree)
    return _near(arc, sigma, degree)


def polyline_on(curve: SmoothCurve, edges: int) -> Polyline:
    """A `Polyline` of as many equal steps of arc length; an open one is held by the tangents.

    Parameters
    ----------
    curve : `SmoothCurve`
    edges : int
    """
    n = whole(edges, "edges")
    if n < 1:
        raise ValueError(f"edges: must be at least 1, got {n}")
    if curve.closed:
        return Polyline(curve.at(np.arange(n) * (curve.length / n)), closed=True)
    ends = curve.tangents([0.0, curve.length])
    return Polyline(curve.at(np.linspace(0, curve.length, n + 1)), False, ends[0], ends[1])


# Through the points -------------------------------------------------------------------------------


def _through(arc: Polyline, degree: int) -> SmoothCurve:
    """Chords are no smooth parameter where steps are uneven: arc length takes their place."""
    u = np.append(0.0, np.cumsum(arc.edge_lengths))
    made = _interpolated(arc, u, degree)
    for _ in range(_ROUNDS):
        u = np.append(made.places, made.length) if arc.closed else made.places
        made = _interpolated(arc, u, degree)
    return made


def _interpolated(arc: Polyline, u: Array, degree: int) -> SmoothCurve:
    make = need("scipy.interpolate", "all").make_interp_spline
    r = arc.positions
    if arc.closed:
        spline = make(u, np.vstack([r, r[:1]]), degree, bc_type="periodic")
        return _spline_of(spline.t, spline.c, degree, True, u[:-1])
    held = [t is not None for t in (arc.start_tangent, arc.end_tangent)]
    k = min(degree, len(r) + sum(held) - 1)  # few points: one polynomial
    first, last = ((degree + 1) // 2 - is_held for is_held in held)
    inside = u[first : len(u) - last] if k == degree else u[:0]
    knots = np.concatenate([np.full(k + 1, u[0]), inside, np.full(k + 1, u[-1])])
    ends = [
        [(1, t / np.linalg.norm(t))] if t is not None else None
        for t in (arc.start_tangent, arc.end_tangent)
    ]
    spline = make(u, r, k, t=knots, bc_type=ends if any(held) else None)
    return _spline_of(spline.t, spline.c, k, False, u)


def _spline_of(t: Any, c: Any, degree: int, closed: bool, u: Array) -> SmoothCurve:
    knots, coefficients = (np.array(x, dtype=np.float64, order="C") for x in (t, c))
    return SmoothCurve(knots, coefficients, degree, closed, np.array(u))


# Near the points ----------------------------------------------------------------------------------


def _near(arc: Polyline, sigma: Array, degree: int) -> SmoothCurve:
    """In units of the noise, in which the squares of the distances add up to their number.

    What of the noise is along the curve moves a point on it and leaves no distance: so it is looked
    how far the last spline was from its points along its tangents, across it must be as far as the
    noise explains. The lengths of the last one are the parameter of the next, as chords between
    noisy points are too long.
    """
    r, n = arc.positions, len(arc.positions)
    varies = np.ptp(r, axis=0) > 0
    units, weights = _units(sigma, n, varies)
    points = r @ units.T
    u, across = np.append(0.0, np.cumsum(arc.edge_lengths)), (varies.sum() - 1) * n
    allowed = float(across + n)
    for _ in range(_ROUNDS + 1):
        made = _fitted(points[:, varies], weights, u, allowed, degree, arc.closed)
        away = points[:, varies] - made.at()
        along = weights * np.einsum("ni,ni->n", away, made.tangents())
        u, allowed = made.places, float(across + along @ along)
        if arc.closed:
            u = np.append(u, made.length)
    filled = np.tile(points[0], (len(made.coefficients), 1))
    filled[:, varies] = made.coefficients
    back = np.linalg.inv(units).T
    return _spline_of(made.knots, filled @ back, made.degree, arc.closed, made.parameters)


def _fitted(
    points: Array, weights: Array, u: Array, allowed: float, degree: int, closed: bool
) -> SmoothCurve:
    """With so large a sum of weighted squares, and few knots."""
    if closed:
        points, weights = np.vstack([points, points[:1]]), np.append(weights, weights[0])
    k = min(degree, len(points) - 1)
    k -= k > 1 and k % 2 == 0
    splprep = need("scipy.interpolate", "all").splprep
    (t, c, k), _ = splprep(points.T, w=weights, u=u, k=k, s=allowed, per=closed)
    return _spline_of(t, np.transpose(c), k, closed, u[:-1] if closed else u)


def _units(sigma: Array, n: int, varies: Array) -> tuple[Array, Array]:
    """What makes the noise of a point one in every direction, and the weights of the points."""
    weights = np.ones(n)
    if sigma.shape == (3, 3):
        return np.asarray(np.linalg.inv(_square_root(sigma)), dtype=np.float64), weights
    if sigma.size != 1 and sigma.shape not in ((3,), (n,)):
        raise ValueError(
            f"noise: expected one, 3 (of x, y, z), {n} (of the vertices) or a covariance (3, 3), "
            f"got shape {sigma.shape}"
        )
    along = np.broadcast_to(sigma, 3) if sigma.size == 1 else sigma
    needed = along[varies] if along.shape == (3,) else along
    if not (np.isfinite(needed).all() and (needed > 0).all()):
        raise ValueError(f"noise: must be positive where positions vary, got {sigma}")
    if along.shape == (3,):
        return np.diag(np.where(varies, 1 / np.where(varies, along, 1.0), 1.0)), weights
    return np.eye(3), 1 / along


def _square_root(covariance: Array) -> Array:
    try:
        return np.asarray(np.linalg.cholesky((covariance + covariance.T) / 2), dtype=np.float64)
    except np.linalg.LinAlgError:
        raise ValueError("noise: a covariance must be positive definite") from None
