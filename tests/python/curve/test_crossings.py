"""Open chains: Gauss's integral, crossings of pairs of edges, writhe of stretches."""

from __future__ import annotations

import numpy as np
import pytest
from support import KNOTS, random_frames

from pyrod import rotation
from pyrod.curve import (
    Polyline,
    average_crossing_number,
    crossings,
    gauss_integral,
    linking_number,
)

TREFOIL = KNOTS[0].polyline(KNOTS[0].even(90))
NODES, WEIGHTS = np.polynomial.legendre.leggauss(40)


def walk(n: int, seed: int, closed: bool = False) -> Polyline:
    steps = np.random.default_rng(seed).normal(size=(n, 3))
    return Polyline(np.cumsum(steps, axis=0), closed)


def by_quadrature(a: np.ndarray, b: np.ndarray) -> float:
    """Gauss's integral of two straight edges, as it is written."""
    x, w = (NODES + 1) / 2, WEIGHTS / 2
    p, q = a[0] + x[:, None] * (a[1] - a[0]), b[0] + x[:, None] * (b[1] - b[0])
    gap = p[:, None] - q[None]
    volume = np.einsum("nmi,i->nm", gap, np.cross(a[1] - a[0], b[1] - b[0]))
    return float(w @ (volume / np.linalg.norm(gap, axis=-1) ** 3) @ w) / (4 * np.pi)


def seen(a: Polyline, b: Polyline, views: int, seed: int) -> tuple[float, float]:
    """Crossings of the shadows of two curves, with their signs and without, in the mean."""
    signed = count = 0.0
    for q in random_frames(np.random.default_rng(seed), views):
        p, r = (rotation.rotate(q, arc.positions) for arc in (a, b))
        u, v = np.diff(p, axis=0)[:, None], np.diff(r, axis=0)[None]
        gap = r[:-1][None] - p[:-1][:, None]
        det = u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0]
        det[det == 0] = 1.0  # an edge and itself
        s = (gap[..., 0] * v[..., 1] - gap[..., 1] * v[..., 0]) / det
        t = (gap[..., 0] * u[..., 1] - gap[..., 1] * u[..., 0]) / det
        cross = (s > 0) & (s < 1) & (t > 0) & (t < 1)
        if a is b:
            cross &= np.triu(np.ones(cross.shape, dtype=bool), 2)
        over = (gap + t[..., None] * v - s[..., None] * u)[..., 2]
        sign = -np.sign(det * over)
        signed += (sign * cross).sum()
        count += cross.sum()
    return signed / views, count / views


def test_gauss_integral_of_two_edges() -> None:
    """A square of directions, far enough apart for the quadrature to be exact to rounding."""
    rng = np.random.default_rng(3)
    for _ in range(5):
        a, b = rng.normal(size=(2, 3)), rng.normal((6, 0, 0), size=(2, 3))
        exact = by_quadrature(a, b)
        assert gauss_integral(a, b) == pytest.approx(exact, rel=1e-9)
        assert crossings(a, b)[0, 0] / 2 == pytest.approx(exact, rel=1e-9)
        assert gauss_integral(b, a[::-1]) == pytest.approx(-exact, rel=1e-9)


def test_crossed_edges_see_each_other_in_half_of_all_views() -> None:
    """Long edges near each other: all but the views along the gap."""
    a, b = [[-1e4, 0, 0], [1e4, 0, 0]], [[0, -1e4, 1], [0, 1e4, 1]]
    assert abs(gauss_integral(a, b)) == pytest.approx(0.5, abs=1e-3)
    assert average_crossing_number(a, b) == pytest.approx(1, abs=1e-3)


def test_open_chains_as_their_shadows_cross() -> None:
    """2 LG is the mean of the signs of all crossings (Gauss), to what 4000 views tell."""
    a, b = walk(12, 1), walk(15, 2)
    signed, count = seen(a, b, 4000, 4)
    assert 2 * gauss_integral(a, b) == pytest.approx(signed, abs=0.08)
    assert average_crossing_number(a, b) == pytest.approx(count, abs=0.1)
    signed, count = seen(a, a, 4000, 5)
    assert a.writhe() == pytest.approx(signed, abs=0.08)
    assert average_crossing_number(a) == pytest.approx(count, abs=0.1)


def test_gauss_integral_of_closed_curves_is_their_link() -> None:
    ring = Polyline([[1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0]], closed=True)
    other = Polyline(ring.positions[:, [0, 2, 1]] + [1, 0, 0], closed=True)
    assert linking_number(ring, other) in (-1, 1)
    assert gauss_integral(ring, other) == pytest.approx(linking_number(ring, other), abs=1e-12)
    opened = np.vstack([other.positions, other.positions[:1]])
    assert gauss_integral(ring, opened) == pytest.approx(gauss_integral(ring, other), abs=1e-12)
    with pytest.raises(ValueError, match="b: expected a Polyline or positions"):
        gauss_integral(ring, 3)


@pytest.mark.parametrize("arc", [TREFOIL, walk(40, 3), walk(40, 3, True)], ids=repr)
def test_the_map_of_crossings_adds_up(arc: Polyline) -> None:
    told = crossings(arc)
    assert told.shape == (arc.edges, arc.edges)
    np.testing.assert_allclose(told, told.T, rtol=0, atol=1e-13)
    assert told.sum() / 2 == pytest.approx(arc.writhe(), abs=1e-11)
    assert average_crossing_number(arc) == pytest.approx(np.abs(told).sum() / 2, rel=1e-12)
    n = arc.edges
    for i in range(n - 1):
        assert told[i, i] == told[i, i + 1] == 0
    assert (told[0, n - 1] == 0) == arc.closed


def test_the_trefoil_has_more_crossings_than_writhe() -> None:
    """Three at least in every view."""
    assert average_crossing_number(TREFOIL) > max(3, abs(TREFOIL.writhe()))


def test_maps_are_made_in_parts(monkeypatch: pytest.MonkeyPatch) -> None:
    a, b = walk(12, 1), walk(15, 2)
    whole, own = crossings(a, b), crossings(a)
    assert whole.sum() / 2 == pytest.approx(gauss_integral(a, b), abs=1e-12)
    monkeypatch.setattr("pyrod.curve._crossings._AT_ONCE", 20)
    np.testing.assert_array_equal(crossings(a, b), whole)
    np.testing.assert_array_equal(crossings(a), own)
    monkeypatch.setattr("pyrod.curve._crossings._MOST", 13)
    with pytest.raises(ValueError, match="a map of 11 by 14 edges is too large; take local_writhe"):
        crossings(a, b)


def test_curves_that_meet() -> None:
    a = [[0, 0, 0], [1, 0, 0], [1, 1, 0]]
    with pytest.raises(ValueError, match="has a vertex of another on it"):
        crossings(a, [[1, 0, 0], [1, 0, 1]])
    with pytest.raises(ValueError, match="meets edge"):
        gauss_integral(a, [[1, 0, 0], [1, 0, 1]])


# Writhe of stretches ------------------------------------------------------------------------------


def stretch(arc: Polyline, j: int, window: float) -> float:
    """The writhe of the edges around vertex j, cut out."""
    n, total = arc.edges, arc.length
    away = arc.centre_arc_lengths - arc.arc_lengths[j]
    if arc.closed:
        away = (away + total / 2) % total - total / 2
        first = (j - int((away[np.abs(away) <= window / 2] < 0).sum())) % n
        count = int((np.abs(away) <= window / 2).sum())
        index = (first + np.arange(count + 1)) % n
    else:
        inside = np.flatnonzero(np.abs(away) <= window / 2)
        index = np.arange(inside[0], inside[-1] + 2)
    return Polyline(arc.positions[index]).writhe() if len(index) > 1 else 0.0


@pytest.mark.parametrize("window", [0.01, 4.0, 11.0])
@pytest.mark.parametrize("arc", [TREFOIL, walk(40, 3), walk(40, 3, True)], ids=repr)
def test_local_writhe_is_that_of_the_stretch_cut_out(arc: Polyline, window: float) -> None:
    if window == 0.01:
        np.testing.assert_array_equal(arc.local_writhe(window), 0)
        return
    told = arc.local_writhe(window)
    assert told.shape == (len(arc.positions),)
    exact = [stretch(arc, j, window) for j in range(len(arc.positions))]
    np.testing.assert_allclose(told, exact, rtol=0, atol=1e-11)


def test_local_writhe_is_found_in_parts(monkeypatch: pytest.MonkeyPatch) -> None:
    told = TREFOIL.local_writhe(11)
    monkeypatch.setattr("pyrod.curve._crossings._AT_ONCE", 20)
    np.testing.assert_allclose(TREFOIL.local_writhe(11), told, rtol=0, atol=1e-13)


def test_local_writhe_of_the_whole() -> None:
    arc = walk(40, 3)
    np.testing.assert_allclose(arc.local_writhe(3 * arc.length), arc.writhe(), rtol=0, atol=1e-11)
    with pytest.raises(ValueError, match="window: must be positive and less than 31"):
        TREFOIL.local_writhe(40)
    with pytest.raises(ValueError, match="window: must be positive"):
        arc.local_writhe(0)


def test_a_coil_in_a_long_line_is_where_it_writhes() -> None:
    """Inside of a helix a turn of length l and pitch p writhes 1 - p/l, whatever the window."""
    t = np.linspace(0, 60 * np.pi, 1200)
    coil = np.column_stack([np.cos(t) - 1, np.sin(t), 0.1 * t])
    low = np.column_stack([np.zeros((50, 2)), np.linspace(-40, -0.5, 50)])
    high = np.column_stack([np.zeros((50, 2)), np.linspace(6 * np.pi + 0.5, 60, 50)])
    arc = Polyline(np.vstack([low, coil, high]))
    turn = 2 * np.pi * np.hypot(1, 0.1)
    told = {turns: arc.local_writhe(turns * turn) for turns in (20, 24)}
    worst = int(np.argmax(np.abs(told[20])))
    assert 100 < worst < 1200
    per_turn = (told[24] - told[20])[600:700].mean() / 4
    assert per_turn == pytest.approx(1 - 0.2 * np.pi / turn, rel=0.01)
    assert np.abs(arc.local_writhe(30)[[0, -1]]).max() < 1e-10
