"""What holds at any coarseness: circles, helices, plane curves and constant strains."""

from __future__ import annotations

import numpy as np
import pytest
from support import random_frames

from pyrod import rotation
from pyrod.curve import FramedCurve, Polyline

COARSENESS = [3, 4, 5, 17]
MEASURES = ("log", "chord", "cayley")


def size(theta: float, measure: str) -> float:
    return {"log": theta, "chord": 2 * np.sin(theta / 2), "cayley": 2 * np.tan(theta / 2)}[measure]


def moved(points: np.ndarray) -> np.ndarray:
    """Somewhere in space, so that no coordinate is special."""
    turned = rotation.rotate(random_frames(np.random.default_rng(5)), points)
    return turned + np.array([0.3, -0.2, 0.5])


def rounding(arc: Polyline) -> float:
    """What rounded vertices do to the direction of an edge: one unit of their size at either
    end."""
    return 2 * np.finfo(float).eps * np.abs(arc.positions).max() / arc.edge_lengths.min()


# Circles ------------------------------------------------------------------------------------------


def regular_polygon(n: int, radius: float = 0.7) -> np.ndarray:
    angle = 2 * np.pi * np.arange(n) / n
    return radius * np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)


@pytest.mark.parametrize("n", COARSENESS)
def test_circles_have_constant_curvature(n: int) -> None:
    """By its chord a turn gives 1/r of the circle through the vertices, by its tangent that of the
    circle which the edges touch; log lies between."""
    arc = Polyline(moved(regular_polygon(n)), closed=True)
    exact = {
        "log": np.pi / n / (0.7 * np.sin(np.pi / n)),
        "chord": 1 / 0.7,
        "cayley": 1 / (0.7 * np.cos(np.pi / n)),
    }
    for measure in MEASURES:
        # two directions; a tangent grows up to 4 times as fast as its angle, at 2 pi/3
        np.testing.assert_allclose(
            arc.curvature(measure), exact[measure], rtol=2 * 4 * rounding(arc) / (2 * np.pi / n)
        )
    tolerance = 2 * 2 * rounding(arc) / np.sin(2 * np.pi / n) / arc.edge_lengths[0]
    np.testing.assert_allclose(arc.torsion(), 0, rtol=0, atol=tolerance)
    np.testing.assert_allclose(arc.turning_angles.sum(), 2 * np.pi, rtol=1e-15)


@pytest.mark.parametrize("n", COARSENESS)
def test_a_circle_turns_frames_by_nothing(n: int) -> None:
    arc = Polyline(moved(regular_polygon(n)), closed=True)
    assert abs(arc.writhe()) < 1e-15
    assert abs(arc.holonomy()) < 1e-15 * n
    assert arc.frenet_link() == 0
    np.testing.assert_allclose(arc.frenet().twist, 0, rtol=0, atol=1e-15 * n)


# Helices ------------------------------------------------------------------------------------------


def helix_numbers(delta: float, rise: float, radius: float = 1.0) -> tuple[float, float, float]:
    """Edge length, turning angle and dihedral angle of a polygon on a helix that turns by delta and
    rises from vertex to vertex: the screw turns t about the axis, and the frames of the vertices by
    theta/2 about b, alpha about t, theta/2 about b."""
    chord = 2 * radius * np.sin(delta / 2)
    length = np.hypot(chord, rise)
    theta = 2 * np.arcsin(chord / length * np.sin(delta / 2))
    alpha = 2 * np.arcsin(rise / length * np.sin(delta / 2) / np.cos(theta / 2))
    return length, theta, alpha


@pytest.mark.parametrize(("delta", "rise"), [(2.8, 0.9), (1.1, -0.4), (0.1, 2.0), (0.01, 1e-3)])
@pytest.mark.parametrize("n", COARSENESS)
def test_helices_have_constant_curvature_and_torsion(n: int, delta: float, rise: float) -> None:
    angle = delta * np.arange(n + 1)
    points = np.stack([np.cos(angle), np.sin(angle), rise * np.arange(n + 1)], axis=1)
    arc = Polyline(moved(points))
    length, theta, alpha = helix_numbers(delta, rise)
    for measure in MEASURES:
        kappa, tau = size(theta, measure) / length, size(alpha, measure) / length
        tolerance = 2 * rounding(arc) / length  # of two directions
        if measure == "cayley":  # the slope of the tangent
            tolerance /= np.cos(max(theta, abs(alpha)) / 2) ** 2
        found = arc.curvature(measure)[1:-1], arc.torsion(measure)[1:-1]
        np.testing.assert_allclose(found[0], kappa, rtol=4e-16, atol=tolerance)
        np.testing.assert_allclose(  # two axes, that of a small turn is less certain
            found[1], tau, rtol=4e-16, atol=2 * tolerance / np.sin(theta)
        )
    np.testing.assert_array_equal(arc.curvature()[[0, -1]], 0)


# Constant strains ---------------------------------------------------------------------------------


@pytest.mark.parametrize("measure", MEASURES)
@pytest.mark.parametrize("n", COARSENESS)
def test_constant_frenet_numbers_come_back(n: int, measure: str) -> None:
    """On any grid that the turns fit on: here up to 2.2 rad at an edge."""
    h = np.random.default_rng(n).uniform(0.5, 1.0, n)
    kappa, tau = 1.9, -1.6
    made = FramedCurve.from_frenet(
        h, np.full(n + 1, kappa), np.full(n, tau), frame=[0.5, 0.5, 0.5, 0.5], measure=measure
    )
    np.testing.assert_allclose(made.polyline.curvature(measure), kappa, rtol=1e-14)
    np.testing.assert_allclose(made.polyline.torsion(measure), tau, rtol=2e-14)
    np.testing.assert_allclose(made.twist_angles, 0, rtol=0, atol=1e-15)


@pytest.mark.parametrize("n", COARSENESS)
def test_constant_strains_sampled_are_the_same_curve_at_any_coarseness(n: int) -> None:
    """Every edge makes the same screw: one of n edges out of three times as many has its frames."""
    K, Gamma = np.array([0.5, -1.5, 2.0]), np.array([0.2, -0.1, 1.1])
    coarse, fine = (FramedCurve.sampled(2.0, m, K, Gamma) for m in (n, 3 * n))
    np.testing.assert_allclose(coarse.frames, fine.frames[1::3], rtol=0, atol=1e-14)
    np.testing.assert_allclose(coarse.end_frame, rotation.exp(2.0 * K), rtol=0, atol=1e-14)
    for values, expected in zip(coarse.strains(), (K, Gamma), strict=True):
        np.testing.assert_allclose(values, np.tile(expected, (len(values), 1)), rtol=0, atol=2e-14)


# Plane curves -------------------------------------------------------------------------------------


@pytest.mark.parametrize("closed", [False, True])
@pytest.mark.parametrize("n", [*COARSENESS, 100])
def test_bishop_frames_of_plane_curves_keep_the_normal(n: int, closed: bool) -> None:
    rng = np.random.default_rng(n)
    flat = np.column_stack([rng.normal(size=(n, 2)), np.zeros(n)])
    q = random_frames(np.random.default_rng(5))
    arc = Polyline(moved(flat), closed=closed)
    normal = rotation.rotate(q, [0.0, 0.0, 1.0])
    framed = arc.bishop(normal)
    a1 = rotation.rotate(framed.frames, [1.0, 0.0, 0.0])
    np.testing.assert_allclose(a1, np.tile(normal, (arc.edges, 1)), rtol=0, atol=1e-15 * n)
    signed = arc.curvature() * np.sign(arc.binormals @ normal)  # bending about a1, and no other
    scale = 1 / arc.edge_lengths.min()
    inner = slice(1, None)  # the turn at vertex 0 of a closed arc may come with the other sign
    np.testing.assert_allclose(framed.K[inner, 0], signed[inner], rtol=0, atol=1e-14 * n * scale)
    np.testing.assert_allclose(framed.K[:, 1:], 0, rtol=0, atol=1e-14 * n * scale)


@pytest.mark.parametrize("n", [*COARSENESS, 100])
def test_plane_curves_do_not_twist(n: int) -> None:
    """The osculating plane turns by 0, or by pi where the curve bends the other way; the signed
    curvature does not notice."""
    rng = np.random.default_rng(n)
    turns = rng.choice([-1, 1], n + 1) * rng.uniform(0.1, 1, n + 1)
    made = FramedCurve.from_strains(np.ones(n), np.outer(2 * turns, [1, 0, 0]))
    arc = made.polyline
    bends_back = turns[1:] * turns[:-1] < 0
    np.testing.assert_allclose(np.abs(arc.dihedral_angles), np.pi * bends_back, rtol=0, atol=1e-13)
    signed = arc.curvature_binormals() @ [1.0, 0.0, 0.0]
    np.testing.assert_allclose(signed[1:-1], 2 * turns[1:-1], rtol=0, atol=1e-14)
