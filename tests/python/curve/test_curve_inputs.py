"""Forms in which curves and their frames are given, and words for what is not meant."""

from __future__ import annotations

import warnings

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from test_curve_precision import BISHOP, HELIX, TURN, knot

import pyrod
from pyrod import CurveWarning, rotation
from pyrod.curve import FramedCurve, Polyline, linking_number, without_repeats

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
