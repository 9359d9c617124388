"""Splines through points and near noisy ones, places on curves, torsion on uneven points."""

from __future__ import annotations

import pickle

import numpy as np
import pytest
from support import HELIX, KNOTS, SMOOTH, SmoothCurve, orders, uninstall, unit
from test_curve_precision import TURN

from pyrod.curve import Polyline

TREFOIL = KNOTS[0]


def grid(smooth: SmoothCurve, n: int, seed: int = 5) -> np.ndarray:
    return smooth.uneven(n, np.random.default_rng(seed))


def points(smooth: SmoothCurve, t: np.ndarray) -> Polyline:
    """Without tangents at the ends."""
    return Polyline(smooth.polyline(t).positions, smooth.closed)


# Tangents and torsion on uneven points ------------------------------------------------------------


@pytest.mark.parametrize("smooth", SMOOTH, ids=repr)
def test_circle_tangents_are_of_second_order_on_random_grids(smooth: SmoothCurve) -> None:
    found, halves = [], []
    for n in (250, 500, 1000):
        worst = np.zeros(2)
        for seed in range(4):
            t = grid(smooth, n, seed)
            arc = points(smooth, t)
            exact = unit(smooth.derivative(t[: len(arc.positions)], 1))
            for i, told in enumerate((arc.circle_tangents, arc.vertex_tangents)):
                worst[i] += np.abs(told - exact).max() / 4
        found.append(worst[0])
        halves.append(worst[1])
    assert orders(found).min() > 1.7
    assert orders(halves).max() < 1.4
    assert found[-1] < 0.2 * halves[-1]


def test_circle_tangents_of_a_circle_are_exact() -> None:
    t = np.sort(np.random.default_rng(2).uniform(0, 5, 30))
    r = np.column_stack([np.cos(t), np.sin(t), 0 * t]) @ TURN.T
    exact = np.column_stack([-np.sin(t), np.cos(t), 0 * t]) @ TURN.T
    np.testing.assert_allclose(Polyline(r).circle_tangents, exact, rtol=0, atol=1e-12)
    held = Polyline(r, start_tangent=TURN[0]).circle_tangents
    np.testing.assert_allclose(held[0], TURN[0], rtol=0, atol=1e-15)
    closed = Polyline(r, closed=True).circle_tangents
    np.testing.assert_allclose(closed, exact, rtol=0, atol=1e-12)
    assert Polyline(r[:2]).circle_tangents == pytest.approx(Polyline(r[:2]).vertex_tangents)


@pytest.mark.parametrize("smooth", [HELIX, TREFOIL], ids=repr)
def test_torsion_on_uneven_points(smooth: SmoothCurve) -> None:
    """Divided by the edge it does not converge; by the way between the binormals it does."""
    even, uneven = [], []
    for n in (250, 1000):
        t = grid(smooth, n)
        arc = points(smooth, t)
        middle = (t[1:] + t[:-1]) / 2
        exact = smooth.frenet(middle)[1]
        inner = slice(None) if arc.closed else slice(1, -1)
        even.append(np.abs(arc.torsion() - exact)[inner].max())
        uneven.append(np.abs(arc.torsion(spacing="uneven") - exact)[inner].max())
    assert min(even) > 0.2
    assert uneven[1] < uneven[0] / 3
    assert uneven[1] < 0.05 * even[1]


def test_torsion_on_even_points_is_the_same_by_either_spacing() -> None:
    s = np.linspace(0, 4, 41)
    helix = Polyline(np.column_stack([np.cos(s), np.sin(s), 0.3 * s]))
    by = {
        spacing: helix.torsion(spacing=spacing, ends="continued") for spacing in ("even", "uneven")
    }
    np.testing.assert_allclose(by["even"], by["uneven"], rtol=1e-10)
    told = helix.at_vertices(helix.torsion(spacing="uneven"))
    np.testing.assert_allclose(told, 0.3 / 1.09, rtol=2e-3)
    with pytest.raises(ValueError, match="spacing: expected 'even' or 'uneven', got 'odd'"):
        helix.torsion(spacing="odd")  # type: ignore[arg-type]


def test_torsion_of_a_held_helix_on_its_first_edge() -> None:
    """Two binormals of an end stand a third of two edges apart, not of three."""
    s = np.linspace(0, 4, 401)
    ends = [(-np.sin(x), np.cos(x), 0.3) for x in s[[0, -1]]]
    helix = Polyline(np.column_stack([np.cos(s), np.sin(s), 0.3 * s]), False, *ends)
    told = helix.torsion(spacing="uneven")
    np.testing.assert_allclose(told, 0.3 / 1.09, rtol=1e-2)
    assert helix.torsion()[0] == pytest.approx(2 / 3 * 0.3 / 1.09, rel=1e-2)


# Splines ------------------------------------------------------------------------------------------


@pytest.mark.parametrize("held", [False, True])
@pytest.mark.parametrize("smooth", SMOOTH, ids=repr)
def test_splines_converge_on_random_grids(smooth: SmoothCurve, held: bool) -> None:
    found = []
    for n in (100, 200, 400):
        errors = np.zeros(5)
        for seed in range(3):
            t = grid(smooth, n, seed)
            arc = smooth.polyline(t) if held else points(smooth, t)
            curve = arc.smooth_curve()
            at = t[: len(arc.positions)]
            kappa, tau, R = smooth.frenet(at)
            s = smooth.arc_lengths(t)
            errors += [
                abs(curve.length - s[-1]),
                np.abs(curve.places - s[: len(at)]).max(),
                np.abs(curve.tangents() - R[..., 2]).max(),
                np.abs(curve.curvature() - kappa).max() / kappa.max(),
                np.abs(curve.torsion() - tau).max() / np.abs(tau).max(),
            ]
        found.append(errors)
    seen = orders(np.array(found)).mean(axis=0)
    assert (seen > [4.5, 4.5, 4.2, 3.4, 2.5]).all(), seen
    assert (found[-1] < [1e-6, 1e-6, 1e-5, 1e-3, 1e-2]).all(), found[-1]


@pytest.mark.parametrize("smooth", [HELIX, TREFOIL], ids=repr)
def test_resampled_curves_bend_as_the_smooth_one(smooth: SmoothCurve) -> None:
    """From random points to equal steps; on the polygon all of the bend is at its corners."""
    t = grid(smooth, 300)
    arc = points(smooth, t).resampled(200)
    assert arc.edges == 200
    assert arc.closed == smooth.closed
    assert np.ptp(arc.edge_lengths) < 5e-4 * arc.edge_lengths[0]
    s = smooth.arc_lengths(t)[-1] * np.arange(len(arc.positions)) / 200
    at = smooth.parameters_at(s)
    np.testing.assert_allclose(arc.positions, smooth.derivative(at), rtol=0, atol=1e-6)
    kappa = smooth.frenet(at)[0]
    inner = slice(None) if arc.closed else slice(1, -1)
    assert np.abs(arc.curvature() / kappa - 1)[inner].max() < 0.02
    polygon = points(smooth, t).resampled(200, smooth=False)
    assert np.abs(polygon.curvature() / kappa - 1)[inner].max() > 0.1
    np.testing.assert_allclose(polygon.positions, arc.positions, rtol=0, atol=0.02)


def test_a_resampled_curve_keeps_what_it_was_told() -> None:
    t = np.linspace(0, 3, 20)
    arc = Polyline(np.column_stack([t, t**2]), False, [1, 0], None, 0.01, 1e-4)
    again = arc.resampled(10)
    assert again.start_tangent == pytest.approx([1, 0, 0])
    assert (again.end_tangent, again.straight, again.resolution) == (None, 0.01, 1e-4)
    np.testing.assert_array_equal(again.positions[:, 2], 0)
    np.testing.assert_allclose(again.positions[[0, -1]], arc.positions[[0, -1]], atol=1e-13)


@pytest.mark.parametrize("count", [2, 3, 4, 5, 6, 7])
@pytest.mark.parametrize("held", [0, 1, 2])
def test_splines_of_few_points(count: int, held: int) -> None:
    t = np.linspace(0, 0.5, count)
    r = np.column_stack([np.cos(t), np.sin(t), 0.3 * t])
    ends = [(-np.sin(x), np.cos(x), 0.3) for x in t[[0, -1]]]
    arc = Polyline(r, False, *[ends[i] if i < held else None for i in range(2)])
    curve = arc.smooth_curve()
    np.testing.assert_allclose(curve.at(), r, rtol=0, atol=1e-13)
    assert curve.length == pytest.approx(0.5 * np.hypot(1, 0.3), rel=0.02)
    if held:
        np.testing.assert_allclose(curve.tangents()[0], unit(ends[0]), rtol=0, atol=1e-12)
    assert np.isfinite(curve.torsion()).all()


def test_degree_three_and_what_is_none() -> None:
    arc = points(TREFOIL, TREFOIL.even(200))
    curve = arc.smooth_curve(degree=3)
    assert curve.degree == 3
    exact = TREFOIL.frenet(TREFOIL.even(200)[:-1])[0]
    np.testing.assert_allclose(curve.curvature(), exact, rtol=1e-2)
    with pytest.raises(ValueError, match="degree: expected 3 or 5, got 4"):
        arc.smooth_curve(degree=4)


def test_a_smooth_curve_by_its_arc_length() -> None:
    curve = points(TREFOIL, TREFOIL.even(200)).smooth_curve()
    s = np.linspace(-3, 2 * curve.length, 12).reshape(3, 4)
    assert curve.at(s).shape == curve.tangents(s).shape == (3, 4, 3)
    assert curve.curvature(s).shape == curve.torsion(s).shape == (3, 4)
    np.testing.assert_allclose(curve.at(s), curve.at(s + curve.length), rtol=0, atol=1e-12)
    step = 1e-4
    speed = np.linalg.norm(curve.at(s + step) - curve.at(s - step), axis=-1) / (2 * step)
    np.testing.assert_allclose(speed, 1, rtol=0, atol=1e-7)
    opened = points(HELIX, HELIX.even(100)).smooth_curve()
    for outside in (-0.1, opened.length + 0.1, np.nan):
        with pytest.raises(ValueError, match="s: must be from 0 to the length"):
            opened.at(outside)
    with pytest.raises(ValueError, match="edges: must be at least 1"):
        opened.polyline(0)
    again = pickle.loads(pickle.dumps(curve))
    assert again == curve
    np.testing.assert_array_equal(again.at(s), curve.at(s))
    assert repr(curve) == "SmoothCurve(closed, points=200, length=31.8986)"


def test_straight_lines_have_no_torsion() -> None:
    line = Polyline(np.outer(np.arange(9.0), [1, 2, 3])).smooth_curve()
    np.testing.assert_allclose(line.curvature(), 0, atol=1e-12)
    np.testing.assert_array_equal(line.torsion(), 0)


def test_splines_need_scipy(monkeypatch: pytest.MonkeyPatch) -> None:
    arc = points(HELIX, HELIX.even(10))
    uninstall(monkeypatch, "scipy")
    with pytest.raises(ImportError, match="scipy is not installed"):
        arc.smooth_curve()
    assert arc.resampled(5, smooth=False).edges == 5


# Noise --------------------------------------------------------------------------------------------


def noisy(smooth: SmoothCurve, n: int, sigma: np.ndarray | float, seed: int = 1) -> Polyline:
    exact = points(smooth, smooth.even(n))
    noise = np.random.default_rng(seed).normal(size=exact.positions.shape) * sigma
    return Polyline(exact.positions + noise, smooth.closed)


@pytest.mark.parametrize("smooth", [HELIX, TREFOIL], ids=repr)
@pytest.mark.parametrize("sigma", [1e-3, 1e-2])
def test_noise_is_taken_away(smooth: SmoothCurve, sigma: float) -> None:
    """Of 500 points: positions twice as near, curvature within some percent; the polygon's is
    that of the noise."""
    rough = noisy(smooth, 500, sigma)
    t = smooth.even(500)[: len(rough.positions)]
    kappa, tau, _ = smooth.frenet(t)
    curve = rough.smooth_curve(noise=sigma)
    inner = slice(25, -25)
    left = np.linalg.norm(np.cross(curve.at() - smooth.derivative(t), curve.tangents()), axis=1)
    assert np.sqrt((left**2).mean()) < 0.6 * np.sqrt(2) * sigma
    wrong = np.abs(curve.curvature() - kappa)[inner]
    assert np.sqrt((wrong**2).mean()) < 0.1 * kappa.max()
    of_polygon = np.abs(rough.curvature() - kappa)[inner]
    assert np.sqrt((of_polygon**2).mean()) > 5 * np.sqrt((wrong**2).mean())
    off = np.abs(curve.torsion() - tau)[inner]
    assert np.median(off) < 0.2 * np.abs(tau).max()
    assert rough.smoothed(sigma).edges == rough.edges
    assert rough.smoothed(sigma, 40).edges == 40
    assert rough.smoothed(sigma, 40).length == pytest.approx(curve.length, rel=0.02)


@pytest.mark.parametrize("smooth", [HELIX, TREFOIL], ids=repr)
def test_noise_is_estimated(smooth: SmoothCurve) -> None:
    sigma = np.array([1e-3, 2e-3, 4e-3])
    found = noisy(smooth, 500, sigma).estimated_noise()
    np.testing.assert_allclose(found, sigma, rtol=0.15)
    with pytest.raises(ValueError, match="needs at least 12 vertices, got 11"):
        Polyline(np.eye(11)[:, :3] + np.arange(11)[:, None]).estimated_noise()


def test_noise_of_every_kind_is_the_same_if_it_is() -> None:
    rough = noisy(TREFOIL, 300, 5e-3)
    one = rough.smooth_curve(5e-3).at()
    for kind in (np.full(3, 5e-3), np.full(300, 5e-3), 25e-6 * np.eye(3)):
        np.testing.assert_allclose(rough.smooth_curve(kind).at(), one, rtol=0, atol=1e-9)


def test_noise_that_differs_by_direction_or_point() -> None:
    """Tomograms have thick slices: what is known well is kept. A bad point is left alone."""
    sigma = np.array([1e-3, 1e-3, 3e-2])
    rough = noisy(TREFOIL, 400, sigma)
    curve = rough.smooth_curve(sigma)
    away = np.sqrt(((curve.at() - rough.positions) ** 2).mean(axis=0))
    assert (away < 2 * sigma).all()
    turned = Polyline(rough.positions @ TURN.T, True)
    again = turned.smooth_curve(TURN @ np.diag(sigma**2) @ TURN.T)
    np.testing.assert_allclose(again.at(), curve.at() @ TURN.T, rtol=0, atol=1e-6)
    bad = noisy(TREFOIL, 400, 1e-3).positions.copy()
    bad[100] += [0, 0, 0.3]
    of_points = np.full(400, 1e-3)
    of_points[100] = 0.3
    smooth = Polyline(bad, True).smooth_curve(of_points)
    exact = TREFOIL.derivative(TREFOIL.even(400)[100])
    assert smooth.polyline(4000).nearest(exact).distance < 2e-3


@pytest.mark.parametrize(
    ("noise", "message"),
    [
        (np.ones(7), r"noise: expected one, 3 .*41 \(of the vertices\) .*got shape \(7,\)"),
        (-1.0, "noise: must be positive"),
        ([0.1, 0, 0.1], "noise: must be positive where positions vary"),
        (np.nan, "noise: must be positive"),
        (-np.eye(3), "noise: a covariance must be positive definite"),
    ],
)
def test_noise_that_is_none(noise: object, message: str) -> None:
    rough = noisy(HELIX, 40, 0.01)
    with pytest.raises(ValueError, match=message):
        rough.smooth_curve(noise)  # type: ignore[arg-type]


def test_noise_in_the_plane() -> None:
    t = np.linspace(0, 3, 200)
    noise = np.random.default_rng(3).normal(size=(200, 2)) * 1e-3
    flat = Polyline(np.column_stack([np.cos(t), np.sin(t)]) + noise)
    for sigma in (1e-3, [1e-3, 1e-3, 0]):
        curve = flat.smooth_curve(sigma)
        np.testing.assert_array_equal(curve.at()[:, 2], 0)
        assert np.abs(curve.curvature() - 1)[20:-20].max() < 0.1


# Places -------------------------------------------------------------------------------------------


def test_places_of_a_polygon_by_arc_length() -> None:
    corner = Polyline([[0, 0], [3, 0], [3, 4]])
    np.testing.assert_allclose(
        corner.at([0, 1.5, 5, 7]), [[0, 0, 0], [1.5, 0, 0], [3, 2, 0], [3, 4, 0]]
    )
    np.testing.assert_allclose(corner.at(5), [3, 2, 0])
    np.testing.assert_allclose(corner.at([[1.5], [5]], [10, 20, 60]), [[15], [40]])
    radii = np.arange(6.0).reshape(3, 2)
    np.testing.assert_allclose(corner.at(1.5, radii), [1, 2])
    closed = Polyline([[0, 0], [3, 0], [3, 4]], closed=True)
    np.testing.assert_allclose(
        closed.at([-5, 9.5, 12]), [[3, 4, 0], [1.5, 2, 0], [0, 0, 0]], atol=1e-14
    )
    np.testing.assert_allclose(closed.at(9.5, [10, 20, 60]), 35)
    for outside in (-0.1, 7.1, np.nan):
        with pytest.raises(ValueError, match="s: must be from 0 to the length 7"):
            corner.at(outside)
    with pytest.raises(ValueError, match=r"values: expected 3 rows \(one per vertex\)"):
        corner.at(1, [1, 2])


def test_nearest_places() -> None:
    corner = Polyline([[0, 0], [3, 0], [3, 4]])
    found = corner.nearest([[1, 1, 0], [5, 5, 0], [-1, 0, 2], [4, 1, 0]])
    np.testing.assert_allclose(found.s, [1, 7, 0, 4])
    np.testing.assert_allclose(found.distance, [1, np.sqrt(5), np.sqrt(5), 1])
    np.testing.assert_allclose(found.positions, [[1, 0, 0], [3, 4, 0], [0, 0, 0], [3, 1, 0]])
    np.testing.assert_array_equal(found.edge, [0, 1, 0, 1])
    one = corner.nearest([2, -1, 0])
    assert (one.s, one.distance, one.edge) == (2, 1, 0)
    assert one.positions.shape == (3,)
    assert corner.nearest([[2, -1]]).s == pytest.approx([2])
    with pytest.raises(ValueError, match=r"points: expected shape \(n, 3\)"):
        corner.nearest(np.zeros((3, 5)))
    with pytest.raises(ValueError, match="points: expected finite"):
        corner.nearest([np.nan, 0, 0])


def test_nearest_places_of_many_points(monkeypatch: pytest.MonkeyPatch) -> None:
    """As the best of all places on all edges; also when it is done in parts."""
    rng = np.random.default_rng(8)
    arc = points(TREFOIL, TREFOIL.even(60))
    p = rng.normal(size=(40, 3)) * 2
    found = arc.nearest(p)
    fine = arc.at(np.linspace(0, arc.length, 60_001)[:-1])
    best = np.array([np.linalg.norm(fine - x, axis=1).min() for x in p])
    np.testing.assert_allclose(found.distance, best, rtol=0, atol=1e-4)
    assert (found.distance <= best + 1e-12).all()
    np.testing.assert_allclose(np.linalg.norm(found.positions - p, axis=1), found.distance)
    np.testing.assert_allclose(arc.at(found.s), found.positions, rtol=0, atol=1e-12)
    monkeypatch.setattr("pyrod.curve._places._AT_ONCE", 100)
    for mine, its in zip(found, arc.nearest(p), strict=True):
        np.testing.assert_array_equal(mine, its)
