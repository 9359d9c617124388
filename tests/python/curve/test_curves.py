"""Curves of other people: what they brought, and what is right."""

from __future__ import annotations

import re
import warnings

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import pyrod
from pyrod import CurveWarning, rotation
from pyrod.curve import FramedCurve, Polyline, linking_number, without_repeats

TURN = np.array([[0.36, -0.8, -0.48], [0.48, 0.6, -0.64], [0.8, 0.0, 0.6]])
S = np.linspace(0, 4, 41)
HELIX = Polyline(np.column_stack([np.cos(S), np.sin(S), 0.3 * S]))
BISHOP = HELIX.bishop()


def knot(n: int = 100) -> np.ndarray:
    t = 2 * np.pi * np.arange(n) / n
    x, y = np.sin(t) + 2 * np.sin(2 * t), np.cos(t) - 2 * np.cos(2 * t)
    return np.column_stack([x, y, -np.sin(3 * t)])


def square() -> np.ndarray:
    """Three edges to a side."""
    x, o = np.arange(3) / 3, np.zeros(3)
    sides = np.column_stack([np.r_[x, 1 + o, 1 - x, o], np.r_[o, x, 1 + o, 1 - x], np.zeros(12)])
    return sides @ TURN.T


def stadium(n: int, radius: float = 0.3) -> np.ndarray:
    """Two straight sides of length 1 and two half circles, in an oblique plane."""
    u = np.arange(n) * (2 + 2 * np.pi * radius) / n
    side = u % (1 + np.pi * radius)
    angle = np.maximum(side - 1, 0) / radius
    x, y = np.minimum(side, 1) - 0.5 + radius * np.sin(angle), -radius * np.cos(angle)
    half = np.where(u < 1 + np.pi * radius, 1, -1)
    return np.column_stack([half * x, half * y, np.zeros(n)]) @ TURN.T


# Ends of open curves ------------------------------------------------------------------------------


def test_the_torsion_of_a_helix_is_the_same_at_every_point() -> None:
    """Smooth: 0.3/1.09 = 0.2752; what edges of 0.1 make of it is within 2e-3."""
    at_vertices = HELIX.at_vertices(HELIX.torsion())
    np.testing.assert_allclose(at_vertices, 0.3 / 1.09, rtol=2e-3)
    np.testing.assert_allclose(np.ptp(at_vertices), 0, atol=1e-12)
    np.testing.assert_allclose(HELIX.torsion(ends="continued"), at_vertices[0], rtol=1e-11)


def test_the_curvature_of_a_helix_is_the_same_at_every_point() -> None:
    np.testing.assert_allclose(HELIX.curvature(ends="continued"), 1 / 1.09, rtol=1e-3)
    assert HELIX.curvature()[0] == HELIX.curvature()[-1] == 0  # free ends do not turn


@pytest.mark.parametrize("measure", ["log", "chord", "cayley", "sauer"])
def test_torsion_at_vertices_in_every_measure(measure: str) -> None:
    tau = HELIX.torsion(measure)  # type: ignore[arg-type]
    np.testing.assert_allclose(tau[[0, -1]], 0, atol=1e-13)
    np.testing.assert_allclose(HELIX.at_vertices(tau), tau[1], rtol=1e-11)


def test_other_values_that_vanish_at_the_ends_are_not_touched() -> None:
    values = HELIX.torsion() * 2
    assert HELIX.at_vertices(values)[0] == pytest.approx(-values[1] / 2)
    continued = HELIX.at_vertices(values, ends="continued")
    np.testing.assert_allclose(continued, values[1], rtol=1e-11)


def test_an_end_that_is_held_has_its_own_value() -> None:
    held = Polyline(HELIX.positions, start_tangent=[0, 1, 0.3])
    kappa = held.curvature(ends="continued")
    assert kappa[0] == held.curvature()[0] != kappa[1]
    assert kappa[-1] == kappa[-2]
    tau = held.torsion(ends="continued")
    assert tau[0] == held.torsion()[0] != tau[1]
    assert tau[-1] == tau[-2] != 0


@pytest.mark.parametrize("points", [2, 3, 4])
def test_short_curves_have_what_they_can(points: int) -> None:
    short = Polyline(HELIX.positions[:points])
    kappa, tau = short.curvature(ends="continued"), short.torsion(ends="continued")
    assert (kappa > 0.9).all() if points > 2 else not kappa.any()
    assert (tau > 0.27).all() if points > 3 else np.abs(tau).max() < 1e-12


def test_ends_is_one_of_two() -> None:
    for ask in (HELIX.curvature, HELIX.torsion):
        with pytest.raises(ValueError, match="ends: expected 'free' or 'continued', got 'open'"):
            ask(ends="open")  # type: ignore[arg-type]


# Single precision ---------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", ["f8", "f4"])
def test_a_square_is_plane_in_either_precision(kind: str) -> None:
    arc = Polyline(square().astype(kind), closed=True)
    assert arc.frenet_link() == 0
    assert np.abs(arc.torsion()).max() < 1e-6


@pytest.mark.parametrize("far", [0.0, 100.0])
def test_a_coil_in_single_precision_has_no_link(far: float) -> None:
    """0.03 rad per vertex, which rounding 100 m off the origin turns by 6e-3 rad."""
    arc = Polyline((stadium(400) + far).astype(np.float32), closed=True)
    assert arc.frenet_link() == 0
    double = Polyline(stadium(400) + far, closed=True)
    assert double.frenet_link() == 0
    assert np.abs(double.torsion()).max() < 1e-5


def test_a_straight_line_in_single_precision_is_straight() -> None:
    line = Polyline((np.arange(501)[:, None] * 0.1 * TURN[0]).astype(np.float32))
    assert np.abs(line.dihedral_angles).sum() < 1e-6


def test_edges_that_fold_back_in_single_precision() -> None:
    fold = np.array([[0, 0, 0], [1, 0, 0], [0.5, 1e-8, 0]])
    Polyline(fold)  # the plane of the turn is known
    with pytest.raises(ValueError, match=r"positions\[1\].*antiparallel within the resolution"):
        Polyline(fold.astype(np.float32))


def test_a_resolution_of_positions_is_told_in_metres() -> None:
    noise = 1e-4 * np.random.default_rng(3).uniform(-0.5, 0.5, (400, 3))
    rough = stadium(400) + noise
    assert np.abs(Polyline(rough, closed=True).torsion()).max() > 50
    arc = Polyline(rough, closed=True, resolution=1e-4)
    straight = np.abs(arc.positions @ TURN[:, 1]) > 0.2999
    assert straight.sum() > 100
    inside = straight & np.roll(straight, 1) & np.roll(straight, -1) & np.roll(straight, -2)
    assert np.abs(arc.torsion()[inside]).max() < 0.02
    with pytest.raises(ValueError, match="resolution: must be finite and not negative, got -1"):
        Polyline(rough, resolution=-1)


def test_precision_is_kept_in_copies() -> None:
    import pickle

    arc = Polyline(square().astype(np.float32), closed=True)
    again = pickle.loads(pickle.dumps(arc))
    assert again == arc
    assert np.array_equal(again.torsion(), arc.torsion())


def test_short_edges_are_not_the_measure_of_long_ones() -> None:
    """Each vertex has the tolerance of its own edges: the long ones turn by less than what the
    short ones hide, and still bend."""
    ends = np.cumsum([0, 1, 1, 1, 1, 3e-5, 3e-5, 1, 1, 1, 1])
    turns = np.zeros(len(ends))
    turns[1:5] = 3e-4
    tangents = np.cumsum(turns)[:-1]
    steps = np.diff(ends)[:, None] * np.column_stack([np.cos(tangents), np.sin(tangents)])
    arc = Polyline(np.vstack([[0, 0], np.cumsum(steps, axis=0)]).astype(np.float32))
    np.testing.assert_allclose(np.abs(arc.binormals[1:5, 2]), 1, rtol=1e-12)


# Masks, repeats -----------------------------------------------------------------------------------


def masked() -> np.ma.MaskedArray:
    return np.ma.masked_values([[0, 0, 0], [1, 0, 0], [-9999, -9999, -9999], [2, 1, 0.0]], -9999)


@pytest.mark.parametrize("take", [Polyline, without_repeats])
def test_masked_points_are_refused(take: type) -> None:
    with pytest.raises(ValueError, match=r"positions\[2, 0\]: is masked.*compress_rows"):
        take(masked())


def test_without_the_masked_row_it_is_right() -> None:
    assert Polyline(np.ma.compress_rows(masked())).length == pytest.approx(1 + np.sqrt(2))
    assert Polyline(np.ma.asarray(HELIX.positions)) == HELIX  # nothing is masked


def test_masked_points_of_a_rod() -> None:
    r = np.ma.asarray(HELIX.positions.copy())
    r[3] = np.ma.masked
    with pytest.raises(ValueError, match=r"positions\[3, 0\]: is masked"):
        pyrod.Rod.from_curve(r, BISHOP.frames, pyrod.Section(1, 1, 1))


def test_a_point_told_twice_with_other_digits() -> None:
    points = np.vstack([knot(), knot()[:1] + 1e-7])
    with pytest.warns(
        CurveWarning, match=r"positions\[0\] nearly repeats positions\[100\]"
    ) as told:
        Polyline(points, closed=True)
    assert told[0].filename == __file__
    distance = re.search(r"distance=([0-9.e-]+)", str(told[0].message))
    assert distance is not None
    kept, _ = without_repeats(points, closed=True, distance=float(distance[1]))
    arc = Polyline(kept, closed=True)
    assert arc.curvature().max() == pytest.approx(0.77355, rel=1e-4)
    assert np.abs(arc.torsion()).max() == pytest.approx(0.35186, rel=1e-4)
    assert arc.writhe() == pytest.approx(-3.35423, rel=1e-5)


@pytest.mark.parametrize("place", [0, 17, 40])
def test_near_repeats_on_open_curves(place: int) -> None:
    points = np.insert(HELIX.positions, place + 1, HELIX.positions[place] + [0, 0, -1e-6], axis=0)
    with pytest.warns(CurveWarning, match=f"nearly repeats positions.{place}."):
        Polyline(points)


def test_short_edges_along_the_curve_are_none() -> None:
    """A small chamfer, and points of uneven sampling."""
    Polyline([[0, 0], [1, 0], [1.0001, 0.0001], [1.0001, 1]])
    s = np.sort(np.append(S, S[10] + 1e-6))
    Polyline(np.column_stack([np.cos(s), np.sin(s), 0.3 * s]))


# Inflections --------------------------------------------------------------------------------------


@pytest.mark.parametrize("n", [10, 300])
def test_a_plane_curve_with_inflections_has_no_frenet_link(n: int) -> None:
    t = 2 * np.pi * np.arange(n) / n
    r = 1 + 0.6 * np.cos(2 * t + 0.1)
    bean = np.column_stack([r * np.cos(t), r * np.sin(t), 0 * t])
    for seed in range(12):
        turned = bean @ Rotation.random(rng=seed).as_matrix().T
        arc = Polyline(turned, closed=True)
        with pytest.raises(ValueError, match=r"frenet_link: on the edges \d+, \d+, \d+, \d+ the"):
            arc.frenet_link()
        assert arc.closed_ribbon(2).link() == 2


def test_a_curve_in_space_keeps_its_frenet_link() -> None:
    t = 2 * np.pi * np.arange(256) / 256
    r = 2 + np.cos(3 * t)
    trefoil = np.column_stack([r * np.cos(2 * t), r * np.sin(2 * t), np.sin(3 * t)])
    for seed in range(5):
        turned = trefoil @ Rotation.random(rng=seed).as_matrix().T
        assert Polyline(turned, closed=True).frenet_link() == -6


# Frames -------------------------------------------------------------------------------------------


def base_pairs() -> tuple[np.ndarray, np.ndarray]:
    n, turn = 12, np.radians(34.3)
    r = np.column_stack([np.zeros((n, 2)), 3.32 * np.arange(n)])
    return r, rotation.exp(np.column_stack([np.zeros((n, 2)), turn * np.arange(n)]))


def as_matrices(q: np.ndarray) -> np.ndarray:
    return rotation.to_matrix(q)


def as_rotation(q: np.ndarray) -> Rotation:
    return Rotation.from_quat(q, scalar_first=True)


@pytest.mark.parametrize("form", [np.asarray, as_matrices, as_rotation])
def test_the_twist_of_base_pairs(form: type) -> None:
    """Eleven steps of 34.3 degrees."""
    r, q = base_pairs()
    assert 360 * FramedCurve.from_vertex_frames(r, form(q)).twist == pytest.approx(377.3)
    with pytest.raises(ValueError, match=r"got 12; frames at the points .*from_vertex_frames"):
        FramedCurve(r, form(q))
    with pytest.raises(ValueError, match=r"got 12; frames at the points .*from_vertex_frames"):
        pyrod.Rod.from_curve(r, form(q), pyrod.Section(1, 1, 1))


def test_vertex_frames_of_a_closed_curve() -> None:
    ribbon = Polyline(knot(), closed=True).closed_ribbon(-3)
    again = FramedCurve.from_vertex_frames(ribbon.polyline, ribbon.vertex_frames)
    assert again.twist == pytest.approx(ribbon.twist, abs=2e-3)
    assert again.adapted().link() == -3


def test_a_frame_for_each_vertex() -> None:
    r, q = base_pairs()
    with pytest.raises(ValueError, match=r"frames: expected 12 rows \(one per vertex\), got 11"):
        FramedCurve.from_vertex_frames(r, q[:-1])


@pytest.mark.parametrize(
    ("frames", "remedy"),
    [
        (np.roll(BISHOP.frames, -1, axis=1), r"quaternions \(x, y, z, w\).*numpy.roll"),
        (BISHOP.matrices.transpose(0, 2, 1), "rows are the directors: transpose"),
    ],
)
def test_frames_in_another_order_are_told(frames: np.ndarray, remedy: str) -> None:
    with pytest.raises(ValueError, match=remedy):
        FramedCurve(HELIX, frames)
    with pytest.raises(ValueError, match=remedy):
        pyrod.Rod.from_curve(HELIX.positions, frames, pyrod.Section(1, 1, 1))


def test_frames_far_from_every_edge() -> None:
    across = rotation.multiply(BISHOP.frames, rotation.exp([1.4, 0, 0]))
    with pytest.warns(CurveWarning, match=r"a3 is 1\.4 rad from the edge"):
        FramedCurve(HELIX, across)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        FramedCurve(HELIX, rotation.multiply(BISHOP.frames, rotation.exp([0.9, 0, 0])))


def test_rotations_of_scipy_are_frames() -> None:
    given = as_rotation(BISHOP.frames)
    made = FramedCurve(HELIX, given, None, given[0], given[-1])
    np.testing.assert_allclose(made.matrices, BISHOP.matrices, atol=1e-15)
    assert made.twist == pytest.approx(0, abs=1e-15)
    assert HELIX.bishop(frame=given[0]).matrices == pytest.approx(BISHOP.matrices, abs=1e-15)
    assert HELIX.bishop(frame=BISHOP.matrices[0]).matrices == pytest.approx(
        BISHOP.matrices, abs=1e-15
    )


def test_makers_take_matrices() -> None:
    R = TURN
    turned = rotation.from_matrix(R)
    for frame in (R, Rotation.from_matrix(R)):
        made = FramedCurve.from_strains([1, 1], np.ones((3, 3)), frame=frame)
        assert made.start_frame == pytest.approx(turned, abs=1e-15)
        made = FramedCurve.from_frenet([1, 1], np.ones(3), np.ones(2), frame=frame)
        assert made.start_frame == pytest.approx(turned, abs=1e-15)


# Words --------------------------------------------------------------------------------------------


def test_closed_forgotten() -> None:
    ring = np.vstack([knot(), knot()[:1]])
    with pytest.raises(ValueError, match=r"the last point is the first again.*closed=True"):
        Polyline(ring).writhe()


def test_the_measures_are_named() -> None:
    with pytest.raises(ValueError, match="log, chord, cayley, sauer, got 'Sauer'"):
        HELIX.torsion("Sauer")  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="log, chord, cayley, got 'sauer'"):
        HELIX.curvature("sauer")  # type: ignore[arg-type]


def test_pairs_of_positions() -> None:
    t = 2 * np.pi * np.arange(60) / 60
    ring = np.column_stack([np.cos(t), np.sin(t), 0 * t])
    other = np.column_stack([1 + np.cos(t), 0 * t, np.sin(t)])
    lists = linking_number(ring.tolist(), other)
    assert lists == linking_number(Polyline(ring, True), Polyline(other, True)) != 0
    assert HELIX.approach(ring) == HELIX.approach(Polyline(ring))
    with pytest.raises(
        ValueError, match="b: expected a Polyline or positions; positions: expected"
    ):
        linking_number(ring, other.T)
    with pytest.raises(TypeError, match=r"other: expected a Polyline or positions; .*got a dict"):
        HELIX.approach({})  # type: ignore[arg-type]


@pytest.mark.parametrize("take", [Polyline, without_repeats])
def test_points_in_columns(take: type) -> None:
    with pytest.raises(ValueError, match=r"got \(3, 41\); transpose it"):
        take(HELIX.positions.T)


def test_one_angle_per_edge_even_if_all_are_zero() -> None:
    with pytest.raises(ValueError, match=r"angles: expected one or 40, .*got shape \(7,\)"):
        HELIX.bishop(angles=np.zeros(7))


@pytest.mark.parametrize("closed", [0.1, "no", None])
def test_closed_is_a_truth(closed: object) -> None:
    with pytest.raises(TypeError, match="closed: expected True or False"):
        Polyline(HELIX.positions, closed)  # type: ignore[arg-type]


def test_tangents_in_the_plane() -> None:
    flat = Polyline([[0, 0], [1, 0], [1, 1]], start_tangent=[0, 1])
    assert flat.start_tangent == pytest.approx([0, 1, 0])
