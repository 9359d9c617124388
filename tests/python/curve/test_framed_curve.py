"""Framed curves: frames and their signs, strains and back, twist, ribbons and their edges."""

from __future__ import annotations

import pickle

import numpy as np
import pytest
from support import CUBIC, UNKNOT, random_frames, unit

from pyrod import rotation
from pyrod.curve import FramedCurve, Polyline

MEASURES = ("log", "chord", "cayley")
E3 = np.array([0.0, 0.0, 1.0])


def ribbon(n: int = 12, closed: bool = False) -> FramedCurve:
    """Adapted to a random arc, with any twist; an open one is held at both ends."""
    rng = np.random.default_rng(n)
    r = np.cumsum(rng.normal(size=(n + (not closed), 3)), axis=0)
    ends = () if closed else (rng.normal(size=3), rng.normal(size=3))
    arc = Polyline(r, closed, *ends)
    made = arc.bishop().turned(rng.uniform(-3, 3, n))
    if closed:
        return made
    end = rotation.multiply(made.frames[-1], rotation.exp([0, 0, 0.3]))
    held = FramedCurve(arc, made.frames, None, made.start_frame, end)
    return held.adapted(limit=3.1)


def moved(curve: FramedCurve, q: np.ndarray, shift: np.ndarray) -> FramedCurve:
    p = curve.polyline
    tangents = [
        None if t is None else rotation.rotate(q, t) for t in (p.start_tangent, p.end_tangent)
    ]
    ends = [
        None if f is None else rotation.multiply(q, f) for f in (curve.start_frame, curve.end_frame)
    ]
    arc = Polyline(rotation.rotate(q, p.positions) + shift, p.closed, *tangents)
    return FramedCurve(arc, rotation.multiply(q, curve.frames), curve.edge_lengths, *ends)


# Frames -------------------------------------------------------------------------------------------


def test_matrices_and_quaternions_are_interchangeable() -> None:
    """Neighbours that differ by less than pi: signs continued, the same strains."""
    made = FramedCurve.sampled(2.0, 20, lambda s: [4.5 * s, 10.0, -14 * s])  # to 3.1 rad an edge
    matrices = rotation.to_matrix(made.frames)
    ends = rotation.to_matrix(made.start_frame), rotation.to_matrix(made.end_frame)
    again = FramedCurve(made.polyline, matrices, None, *ends)
    np.testing.assert_allclose(again.matrices, matrices, rtol=0, atol=1e-15)
    np.testing.assert_allclose(again.K, made.K, rtol=0, atol=1e-12)
    np.testing.assert_allclose(again.Gamma, made.Gamma, rtol=0, atol=1e-15)
    assert (np.sum(again.frames[1:] * again.frames[:-1], axis=1) > 0).all()


def test_signs_of_quaternions_tell_turns_beyond_pi() -> None:
    turn = np.array([[0, 0, 0], [0, 0, 4.0]])
    arc = Polyline([[0, 0, 0], [0, 0, 1], [0, 0, 2]])
    long = FramedCurve(arc, rotation.exp(turn))
    short = FramedCurve(arc, rotation.to_matrix(rotation.exp(turn)))
    np.testing.assert_allclose(long.K[1], [0, 0, 4.0], rtol=1e-15)
    np.testing.assert_allclose(short.K[1], [0, 0, 4.0 - 2 * np.pi], rtol=1e-15)
    np.testing.assert_allclose(long.twist, 4 / (2 * np.pi), rtol=1e-15)
    with pytest.raises(ValueError, match=r"frames\[1\]: turned by pi or more.*use measure log"):
        long.strains("chord")


ARC = Polyline(np.arange(5.0)[:, None] * E3)
FOUR = np.tile([1.0, 0, 0, 0], (4, 1))
HALF_TURN = np.diag([1.0, -1, -1])
REFUSED = [
    ({"frames": FOUR[:3]}, "frames: expected 4 rows"),
    ({"frames": FOUR[:, :3]}, r"frames: expected quaternions of shape \(n, 4\) or rotation matri"),
    ({"frames": 2 * FOUR}, r"frames\[0\]: expected a unit quaternion"),
    ({"frames": np.where(np.eye(4)[2][:, None], np.nan, FOUR)}, r"frames\[2\]: expected finite"),
    ({"frames": np.tile(np.diag([1, 1, -1.0]), (4, 1, 1))}, r"\[0\]"),
    ({"frames": FOUR * [[1], [1], [-1], [-1]]}, r"frames\[2\]: turned by 2 pi .*other sign"),
    ({"frames": [np.eye(3), np.eye(3), HALF_TURN, HALF_TURN]}, r"frames\[2\]: turned by pi .*more"),
    ({"start_frame": -FOUR[0]}, r"frames\[0\]: turned by 2 pi"),
    ({"end_frame": -FOUR[0]}, r"frames\[4\]: turned by 2 pi"),
    ({"end_frame": [1, 0, 0]}, "end_frame: expected quaternions"),
    ({"start_frame": [1, 1, 0, 0]}, "start_frame.*unit"),
    ({"edge_lengths": np.ones(5)}, r"edge_lengths: expected 4, got shape \(5,\)"),
    ({"edge_lengths": [1, 0, 1, 1]}, r"edge_lengths\[1\]: must be positive"),
    ({"edge_lengths": [1, 1, np.nan, 1]}, r"edge_lengths\[2\]: expected finite"),
]


@pytest.mark.parametrize(("change", "message"), REFUSED)
def test_framed_curves_are_refused(change: dict[str, object], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        FramedCurve(**{"polyline": ARC, "frames": FOUR, **change})


def test_a_closed_curve_has_no_end_frames_and_the_smaller_turn_at_its_seam() -> None:
    arc = UNKNOT.polyline(UNKNOT.even(20))
    for name in ("start_frame", "end_frame"):
        with pytest.raises(ValueError, match="a closed curve has no ends"):
            FramedCurve(arc, arc.bishop().frames, **{name: [1.0, 0, 0, 0]})
    once = arc.closed_ribbon(0)  # its quaternions come back with the other sign
    assert once.frames[0] @ once.frames[-1] < 0
    np.testing.assert_allclose(
        once.twist_angles / arc.cell_lengths, once.twist_angles[0] / arc.cell_lengths[0], rtol=1e-12
    )


def test_the_frame_of_an_end_given_as_a_matrix_takes_the_sign_of_its_edge() -> None:
    frames = rotation.exp(np.outer([0.0, 1, 2, 3.0], [0, 0, 2.0]))  # beyond pi in all
    made = FramedCurve(ARC, frames, None, np.eye(3), rotation.to_matrix(frames[3]))
    np.testing.assert_allclose(made.K[[0, -1]], 0, rtol=0, atol=1e-15)
    assert made.twist == pytest.approx(6 / (2 * np.pi), rel=1e-15)


@pytest.mark.parametrize("closed", [False, True])
def test_pickles_equality_repr_and_read_only_arrays(closed: bool) -> None:
    made = ribbon(closed=closed)
    back = pickle.loads(pickle.dumps(made))
    assert back == made
    assert made != made.turned(0.1)
    np.testing.assert_array_equal(back.K, made.K)
    kind = "closed" if closed else "open"
    assert repr(made) == f"FramedCurve({kind}, edges=12, length={made.polyline.length:g})"
    for name in ("frames", "edge_lengths", "K", "Gamma", "twist_angles", "vertex_frames"):
        with pytest.raises(ValueError, match="read-only"):
            getattr(back, name)[0] = 0.0


# Strains and back ---------------------------------------------------------------------------------


@pytest.mark.parametrize("measure", MEASURES)
def test_strains_come_back_also_after_a_rigid_motion(measure: str) -> None:
    rng = np.random.default_rng(3)
    h, n = rng.uniform(0.5, 1.0, 30), 30
    K, Gamma = rng.uniform(-1.2, 1.2, (n + 1, 3)), rng.normal(size=(n, 3))
    first = [FramedCurve.from_strains(h, K, Gamma, (1, 2, 3), random_frames(rng), measure=measure)]
    first.append(moved(first[0], random_frames(rng), rng.normal(size=3)))
    for made in first:
        K_back, Gamma_back = made.strains(measure)
        np.testing.assert_allclose(K_back, K, rtol=0, atol=1e-13)
        np.testing.assert_allclose(Gamma_back, Gamma, rtol=0, atol=1e-13)
        again = FramedCurve.from_strains(
            h, K_back, Gamma_back, made.polyline.positions[0], made.start_frame, measure=measure
        )
        np.testing.assert_allclose(
            again.polyline.positions, made.polyline.positions, rtol=0, atol=1e-13 * n
        )
        np.testing.assert_allclose(again.frames, made.frames, rtol=0, atol=1e-13)
        np.testing.assert_allclose(again.end_frame, made.end_frame, rtol=0, atol=1e-13)


@pytest.mark.parametrize("measure", MEASURES)
def test_curvature_and_torsion_come_back(measure: str) -> None:
    """Also from the strains of its Bishop frames, which are no longer seen in the result."""
    rng = np.random.default_rng(4)
    h, n = rng.uniform(0.5, 1.0, 30), 30
    kappa, tau = rng.uniform(0.2, 1.8, n + 1), rng.uniform(-1.8, 1.8, n)
    made = FramedCurve.from_frenet(h, kappa, tau, (1, 2, 3), random_frames(rng), measure=measure)
    arc = made.polyline
    np.testing.assert_allclose(arc.edge_lengths, h, rtol=0, atol=1e-14)
    np.testing.assert_allclose(arc.curvature(measure), kappa, rtol=0, atol=2e-13)
    np.testing.assert_allclose(arc.torsion(measure), tau, rtol=0, atol=2e-12)  # rounding/theta
    np.testing.assert_allclose(made.twist_angles, 0, rtol=0, atol=1e-15)
    frame = rotation.to_matrix(made.start_frame)
    np.testing.assert_allclose(arc.binormals[0], frame[:, 1], rtol=0, atol=1e-14)
    np.testing.assert_allclose(arc.start_tangent, frame[:, 2], rtol=0, atol=1e-15)
    np.testing.assert_allclose(made.Gamma, np.tile(E3, (n, 1)), rtol=0, atol=1e-14)


def test_an_arc_comes_back_from_its_own_numbers() -> None:
    arc = CUBIC.polyline(CUBIC.uneven(40, np.random.default_rng(1)))
    start = arc.vertex_frenet_frames()[0]
    b, t = arc.binormals[0], unit(arc.start_tangent)
    start = rotation.from_matrix(np.stack([np.cross(b, t), b, t], axis=1))
    made = FramedCurve.from_frenet(
        arc.edge_lengths, arc.curvature(), arc.torsion(), arc.positions[0], start
    )
    np.testing.assert_allclose(made.polyline.positions, arc.positions, rtol=0, atol=1e-13)
    np.testing.assert_allclose(made.frames, arc.bishop(frame=start).frames, rtol=0, atol=1e-12)
    K = arc.bishop(frame=start).K.copy()
    K[-1] = made.K[-1]  # bishop() leaves the end to its edge
    back = FramedCurve.from_strains(arc.edge_lengths, K, None, arc.positions[0], start)
    np.testing.assert_allclose(back.polyline.positions, arc.positions, rtol=0, atol=1e-13)


def test_sampled_takes_values_functions_and_lengths() -> None:
    s = np.linspace(0, 2.0, 9)
    K, Gamma = np.column_stack([s, s**2, 1 - s]), np.column_stack([0 * s, 0.1 * s, 1 + s])
    middle = (s[1:] + s[:-1]) / 2
    at_middle = np.column_stack([0 * middle, 0.1 * middle, 1 + middle])
    given = FramedCurve.sampled(2.0, 8, K, at_middle)
    assert given == FramedCurve.sampled(
        2.0, 8, lambda s: [s, s**2, 1 - s], lambda s: [0, 0.1 * s, 1 + s]
    )
    assert given == FramedCurve.sampled(np.diff(s), None, K, at_middle)
    np.testing.assert_allclose(given.K, K, rtol=0, atol=1e-14)
    np.testing.assert_allclose(given.Gamma, at_middle, rtol=0, atol=1e-14)
    for arguments, message in [
        ((2.0, 8, K[:-1]), r"K: expected 3 numbers, or 9 times 3 \(one per vertex\)"),
        ((2.0, 8, K, Gamma), r"Gamma: expected 3 numbers, or 8 times 3 \(one per edge\)"),
        ((2.0, 0, K), "edges: must be a whole number, at least 1"),
        ((-2.0, 8, K), "length: must be positive"),
        (([1.0, 1.0], 2, K), "edges: give None together with the lengths"),
    ]:
        with pytest.raises(ValueError, match=message):
            FramedCurve.sampled(*arguments)


def test_strains_count_per_reference_length() -> None:
    """The pull-back of Linn (48) and (50): K per reference length of the cell, not per present."""
    made = ribbon()
    h = np.random.default_rng(9).uniform(0.5, 2.0, 12)
    pulled = FramedCurve(made.polyline, made.frames, h, made.start_frame, made.end_frame)
    cells = np.append(h / 2, 0) + np.append(0, h / 2)
    turns = made.K * made.polyline.cell_lengths[:, None]
    np.testing.assert_allclose(pulled.K * cells[:, None], turns, rtol=0, atol=1e-14)
    stretch = made.polyline.edge_lengths / h
    np.testing.assert_allclose(pulled.Gamma, stretch[:, None] * E3, rtol=0, atol=1e-14)
    np.testing.assert_array_equal(pulled.twist_angles, made.twist_angles)


# Twist, ribbons, edges ----------------------------------------------------------------------------


@pytest.mark.parametrize("closed", [False, True])
def test_turned_and_angles_from_are_inverse(closed: bool) -> None:
    made = ribbon(closed=closed)
    phi = np.random.default_rng(6).uniform(-3.0, 3.0, 12).cumsum()
    phi[1:] = phi[0] + np.cumsum(np.clip(np.diff(phi), -3.1, 3.1))
    away = made.turned(phi)
    found = away.angles_from(made)
    whole = 2 * np.pi * np.round((found - phi)[0] / (2 * np.pi))
    np.testing.assert_allclose(found, phi + whole, rtol=0, atol=1e-13)
    np.testing.assert_allclose(
        np.abs(np.sum(away.turned(-phi).frames * made.frames, axis=1)), 1, rtol=1e-15
    )
    inner = slice(1, 12)  # the twist changes by the difference of the angles
    change = away.twist_angles[inner] - made.twist_angles[inner] - np.diff(phi)
    np.testing.assert_allclose(np.remainder(change + np.pi, 2 * np.pi), np.pi, rtol=0, atol=1e-13)
    np.testing.assert_allclose(
        rotation.rotate(away.frames, E3), rotation.rotate(made.frames, E3), rtol=0, atol=1e-15
    )


def test_angles_from_takes_the_smaller_of_two_ways() -> None:
    made = ribbon()
    found = made.turned(4.0 * np.arange(12)).angles_from(made)
    np.testing.assert_allclose(np.diff(found), 4 - 2 * np.pi, rtol=1e-13)


def test_ends_are_turned_with_their_edges() -> None:
    made = ribbon()
    away = made.turned(np.linspace(0.5, 1.0, 12))
    for end, angle in (("start_frame", 0.5), ("end_frame", 1.0)):
        turned = rotation.multiply(getattr(made, end), rotation.exp([0, 0, angle]))
        np.testing.assert_allclose(getattr(away, end), turned, rtol=0, atol=1e-15)
    np.testing.assert_allclose(away.twist_angles[[0, -1]], made.twist_angles[[0, -1]], atol=1e-14)
    with pytest.raises(ValueError, match=r"angles: expected one or 12.*got shape \(11,\)"):
        made.turned(np.zeros(11))


def test_adapted_turns_the_least_way_and_tells_what_is_too_far() -> None:
    made = ribbon()
    axes = rotation.rotate(made.frames, unit([1.0, 2.0, 0.0]))  # across a3: a least turn undoes it
    off = rotation.multiply(rotation.exp(0.3 * axes), made.frames)
    tilted = FramedCurve(made.polyline, off, None, made.start_frame, made.end_frame)
    np.testing.assert_allclose(tilted.adapted().frames, made.frames, rtol=0, atol=1e-15)
    off[4] = rotation.multiply(rotation.exp(0.5 * axes[4]), off[4])
    tilted = FramedCurve(made.polyline, off, None, made.start_frame, made.end_frame)
    with pytest.raises(ValueError, match=r"frames\[4\]: a3 is 0.8 rad away from the edge"):
        tilted.adapted()
    np.testing.assert_allclose(tilted.adapted(0.9).frames, made.frames, rtol=0, atol=1e-15)


def test_frames_at_vertices_lie_between_those_of_the_edges() -> None:
    """Where the arc length says, and at the ends those that hold."""
    h = np.array([1.0, 3.0, 2.0])
    turn = [0, np.pi / 4, 0]
    made = FramedCurve.from_strains(h, np.tile(turn, (4, 1)))
    s = np.append(0, np.cumsum(h))
    expected = rotation.exp(s[:, None] * turn)
    np.testing.assert_allclose(made.vertex_frames, expected, rtol=0, atol=1e-15)
    loose = FramedCurve(made.polyline, made.frames)
    ends = loose.vertex_frames[[0, -1]]
    np.testing.assert_allclose(ends, made.frames[[0, -1]], rtol=0, atol=3e-16)
    np.testing.assert_array_equal(loose.K[[0, -1]], 0)
