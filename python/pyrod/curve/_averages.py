"""Differences and means along an arc: from vertices to edges, and the other way round."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

import pyrod._core as _core
from pyrod.base.arrays import Array, array
from pyrod.curve._ends import Ends, is_torsion, with_ends
from pyrod.curve._polyline import Polyline


def derivative(arc: Polyline, parameter: ArrayLike) -> Array:
    """(n, 3) derivative by a parameter, l/h: second order at the centres of the intervals.

    Its length tells how far the parameter is from arc length (Linn, A.3).

    Parameters
    ----------
    arc : `Polyline`
    parameter : (n + 1,) array
        Its values at the vertices, increasing; for a closed arc with the value of vertex 0
        after one period as a last entry.
    """
    xi = array(parameter, "parameter")
    if xi.shape != (arc.edges + 1,) or not np.isfinite(xi).all() or not (np.diff(xi) > 0).all():
        raise ValueError(
            f"parameter: expected {arc.edges + 1} increasing numbers, got shape {xi.shape}"
        )
    return arc.edge_vectors / np.diff(xi)[:, None]


def vertex_tangents(arc: Polyline) -> Array:
    """Unit tangents at the vertices that halve the turn; a free end has that of its edge."""
    t = arc.tangents
    if arc.closed:
        before, behind = np.roll(t, 1, axis=0), t
    else:
        start, end = (
            edge if held is None else held / np.linalg.norm(held)
            for edge, held in ((t[0], arc.start_tangent), (t[-1], arc.end_tangent))
        )
        before, behind = np.vstack([start, t]), np.vstack([t, end])
    mean = before + behind
    return mean / np.linalg.norm(mean, axis=1, keepdims=True)


def circle_tangents(arc: Polyline) -> Array:
    """Unit tangents at the vertices of the circles through three of them: of second order.

    On any grid, also at free ends, which have the circle of the next vertex. An end that a tangent
    holds has that.
    """
    t, h = arc.tangents, arc.edge_lengths
    if arc.edges < 2:
        return vertex_tangents(arc)
    if arc.closed:
        before, of_before = np.roll(t, 1, axis=0), np.roll(h, 1)
        return _weighted(before, h, t, of_before)
    inner = _weighted(t[:-1], h[1:], t[1:], h[:-1])
    ends = [
        2 * (edge @ beside) * edge - beside if held is None else held / np.linalg.norm(held)
        for edge, beside, held in (
            (t[0], inner[0], arc.start_tangent),
            (t[-1], inner[-1], arc.end_tangent),
        )
    ]
    return np.vstack([ends[0], inner, ends[1]])


def _weighted(a: Array, of_a: Array, b: Array, of_b: Array) -> Array:
    """Unit vectors: the sines of the angles to the chords of a circle are as their lengths."""
    mean = of_a[:, None] * a + of_b[:, None] * b
    return np.asarray(mean / np.linalg.norm(mean, axis=1, keepdims=True))


def at_vertices(arc: Polyline, values: ArrayLike, *, ends: Ends = "free") -> Array:
    """Values given per edge, (n, ...), at the vertices: linear between the edge centres.

    At the ends of an open arc on the continuation of the last line. Second order on any grid.

    Parameters
    ----------
    arc : `Polyline`
    values : (n, ...) array
    ends : "free" or "continued"
        "continued": edges to ends that no tangent holds have the values of the next ones, whatever
        is given. So it is always for the arc's own `torsion`, as it is not known there.
    """
    x = array(values, "values")
    if x.shape[:1] == (arc.edges,):
        x = with_ends(arc, x, "continued" if is_torsion(arc, x) else ends)
    return _averaged(arc, _core.curve.at_vertices, x)


def at_centres(arc: Polyline, values: ArrayLike) -> Array:
    """Values given per vertex at the centres of the edges, (n, ...): the mean of two."""
    return _averaged(arc, _core.curve.at_centres, array(values, "values"))


def _averaged(arc: Polyline, average: Any, x: Array) -> Array:
    columns = x.reshape(len(x), -1) if x.ndim else x
    out = average(arc.edge_lengths, columns, arc.closed)
    return out.reshape((len(out), *x.shape[1:]))
