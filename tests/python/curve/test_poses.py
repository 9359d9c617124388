"""Poses, frames at any place, frames by a rule, and ribbons of two curves."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from support import HELIX, KNOTS, unit
from test_curve_inputs import as_rotation, base_pairs
from test_curve_precision import TURN

from pyrod import rotation
from pyrod.curve import FramedCurve, Polyline, from_poses, linking_number

TREFOIL = KNOTS[0].polyline(KNOTS[0].even(200))


def homogeneous(r: np.ndarray, q: np.ndarray) -> np.ndarray:
    made = np.zeros((len(r), 4, 4))
    made[:, :3, :3], made[:, :3, 3], made[:, 3, 3] = rotation.to_matrix(q), r, 1
    return made


FORMS = [
    (lambda r, q: homogeneous(r, q), {}),
    (lambda r, q: np.hstack([r, q]), {"order": "wxyz"}),
    (lambda r, q: np.hstack([r, np.roll(q, -1, axis=1)]), {"order": "xyzw"}),
    (lambda r, q: (r, q), {"order": "wxyz"}),
    (lambda r, q: (r, as_rotation(q).as_quat()), {"order": "xyzw"}),
    (lambda r, q: (r, as_rotation(q)), {}),
    (lambda r, q: (r, rotation.to_matrix(q)), {}),
]


@pytest.mark.parametrize(("form", "options"), FORMS)
def test_the_twist_of_base_pairs_in_every_form(form, options) -> None:
    """Eleven steps of 34.3 degrees."""
    r, q = base_pairs()
    made = from_poses(form(r, q), **options)
    assert 360 * made.twist == pytest.approx(377.3, abs=1e-9)
    np.testing.assert_array_equal(made.polyline.positions, r)


@pytest.mark.parametrize("along", ["x", "y", "z"])
def test_tools_that_look_along_another_axis(along: str) -> None:
    """x, y, z is a3; the axis after it is a1, so that the frame stays right-handed."""
    exact = HELIX.polyline(HELIX.even(50)).bishop().turned(0.3)
    a3 = "xyz".index(along)
    cycle = np.eye(3)[:, [(a3 + 1) % 3, (a3 + 2) % 3, a3]]
    given = rotation.to_matrix(exact.vertex_frames) @ cycle.T
    made = from_poses((exact.polyline.positions, given), along=along)  # type: ignore[arg-type]
    ours, theirs = (rotation.to_matrix(curve.vertex_frames) for curve in (made, exact))
    np.testing.assert_allclose(ours[1:-1], theirs[1:-1], rtol=0, atol=4e-2)
    np.testing.assert_allclose(ours[0], theirs[0], rtol=0, atol=1e-12)


def test_closed_poses() -> None:
    ribbon = TREFOIL.closed_ribbon(-3)
    poses = homogeneous(TREFOIL.positions, ribbon.vertex_frames)
    assert from_poses(poses, closed=True).adapted().link() == -3


R, Q = base_pairs()


@pytest.mark.parametrize(
    ("poses", "options", "message"),
    [
        (np.hstack([R, Q]), {}, "order: say where the scalar .*'xyzw' .ROS, SciPy.*got None"),
        ((R, Q), {"order": "wzyx"}, "order: say where .*got 'wzyx'"),
        (homogeneous(R, Q), {"along": "a3"}, "along: expected 'x', 'y' or 'z', got 'a3'"),
        (homogeneous(R, Q).transpose(0, 2, 1), {}, r"poses\[1\]: expected the last row.*transpose"),
        (np.zeros((4, 3)), {}, r"poses: expected shape \(k, 4, 4\), \(k, 7\) or a pair"),
        (
            np.hstack([R, np.roll(Q, -1, axis=1)]) @ np.diag([1] * 6 + [2]),
            {"order": "xyzw"},
            "unit",
        ),
    ],
)
def test_poses_that_are_refused(poses, options, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        from_poses(poses, **options)


# Frames at any place ------------------------------------------------------------------------------


def test_frames_by_arc_length() -> None:
    """A straight ribbon that turns evenly: exact."""
    z = np.linspace(0, 2, 9)
    q = rotation.exp(np.outer(z, [0, 0, 2.5]))
    made = FramedCurve.from_vertex_frames(np.column_stack([0 * z, 0 * z, z]), q)
    s = np.random.default_rng(1).uniform(0, 2, (4, 5))
    r, frames = made.at(s)
    np.testing.assert_allclose(r[..., 2], s, rtol=0, atol=1e-14)
    np.testing.assert_allclose(frames, rotation.exp(s[..., None] * [0, 0, 2.5]), atol=1e-12)
    for place in (0.0, 2.0):
        np.testing.assert_allclose(made.at(place)[1], rotation.exp([0, 0, 2.5 * place]), atol=1e-12)
    with pytest.raises(ValueError, match="s: must be from 0 to the length 2"):
        made.at(2.1)


def test_frames_by_arc_length_around_a_closed_curve() -> None:
    for link in (-3, -4):  # closes with the same sign of its quaternions, or with the other
        ribbon = TREFOIL.closed_ribbon(link)
        _, frames = ribbon.at(TREFOIL.centre_arc_lengths)
        np.testing.assert_allclose(frames, ribbon.frames, rtol=0, atol=1e-12)
        near = 1e-9 * np.array([-1.0, 1.0])
        _, seam = ribbon.at(near)
        assert abs(seam[0] @ seam[1]) == pytest.approx(1, abs=1e-12)


@pytest.mark.parametrize("link", [-3, -4, 0])
@pytest.mark.parametrize("edges", [150, 300])
def test_resampled_ribbons_keep_their_link(link: int, edges: int) -> None:
    ribbon = TREFOIL.closed_ribbon(link).resampled(edges)
    assert ribbon.polyline.edges == edges
    assert ribbon.link() == link


def test_resampled_frames_of_an_open_curve() -> None:
    arc = HELIX.polyline(HELIX.even(80))
    made = FramedCurve(arc, arc.bishop().turned(3 * arc.centre_arc_lengths).frames)
    again = made.resampled(100)
    np.testing.assert_allclose(again.Gamma, np.tile([0, 0, 1], (100, 1)), rtol=0, atol=1e-12)
    np.testing.assert_allclose(again.K[5:-5, 2], 3, rtol=5e-3)
    leaning = FramedCurve(arc, rotation.multiply(made.frames, rotation.exp([0.2, 0, 0])))
    assert leaning.resampled(100, smooth=False).Gamma[50] == pytest.approx(
        leaning.Gamma[40], abs=2e-2
    )


# Frames by a rule ---------------------------------------------------------------------------------


def test_frames_that_look_up() -> None:
    """On a helix: a1 is the binormal, which leans from z by the slope."""
    arc = HELIX.polyline(HELIX.even(60))
    up = arc.facing([0, 0, 5.0])
    a1, a2, a3 = np.moveaxis(up.matrices, 2, 0)
    np.testing.assert_allclose(a3, arc.tangents, rtol=0, atol=1e-14)
    np.testing.assert_allclose(a2[:, 2], 0, rtol=0, atol=1e-14)
    assert (a1[:, 2] > 0.9).all()
    np.testing.assert_allclose(up.K[1:-1], np.tile(up.K[1], (59, 1)), rtol=0, atol=1e-12)
    R = rotation.to_matrix(up.start_frame)
    np.testing.assert_allclose(R[:, 2], unit(arc.start_tangent), rtol=0, atol=1e-14)
    closed = KNOTS[2].polyline(KNOTS[2].even(100)).facing([0, 0, 1])
    assert closed.start_frame is None


def test_frames_that_look_where_each_vertex_says() -> None:
    arc = HELIX.polyline(HELIX.even(200))
    inwards = -arc.positions * [1, 1, 0]
    made = arc.facing(inwards)
    np.testing.assert_allclose(
        made.matrices[:, :, 0], -unit(arc.centres * [1, 1, 0]), rtol=0, atol=1e-12
    )
    assert 2 * np.pi * made.twist == pytest.approx(0.3 / 1.09 * arc.length, rel=1e-3)


def test_directions_that_are_refused() -> None:
    arc = Polyline([[0, 0, 0], [0, 0, 1], [0, 1, 1]])
    with pytest.raises(ValueError, match=r"directions: at edge 0 there is none across.*bishop"):
        arc.facing([0, 0, 1])
    with pytest.raises(ValueError, match="directions: at edge 1 there is none"):
        arc.facing(np.array([[1.0, 0, 0], [1, 0, 0], [-1, 0, 0]]))
    with pytest.raises(ValueError, match=r"directions: expected 3 numbers or 3 times 3"):
        arc.facing(np.zeros((2, 3)))


# Two curves ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("turns", [-2, 0.5, 3.25])
def test_the_twist_of_one_strand_about_another(turns: float) -> None:
    z = np.linspace(0, 1, 101)
    axis = np.column_stack([0 * z, 0 * z, z]) @ TURN.T
    phi = 2 * np.pi * turns * z
    strand = np.column_stack([0.1 * np.cos(phi), 0.1 * np.sin(phi), z]) @ TURN.T
    assert Polyline(axis).towards(strand).twist == pytest.approx(turns, abs=1e-12)
    by_place = Polyline(axis).towards(Polyline(strand), by="nearest")
    assert by_place.twist == pytest.approx(turns, abs=0.06)  # past the ends it looks askew


@pytest.mark.parametrize("link", [-5, -3, 0, 2])
def test_link_twist_and_writhe_of_two_closed_curves(link: int) -> None:
    ribbon = TREFOIL.closed_ribbon(link)
    other = ribbon.edge(0.1)
    found = TREFOIL.towards(other)
    assert found.twist + TREFOIL.writhe() == pytest.approx(link, abs=1e-9)
    assert found.link() == linking_number(TREFOIL, other) == link


def test_strands_that_do_not_fit() -> None:
    with pytest.raises(ValueError, match=r"other: expected as many points, 200, got 40.*nearest"):
        TREFOIL.towards(TREFOIL.resampled(40))
    with pytest.raises(ValueError, match="by: expected 'number' or 'nearest', got 'name'"):
        TREFOIL.towards(TREFOIL, by="name")  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="at edge 0 there is none across"):
        TREFOIL.towards(TREFOIL)


# The least twist ----------------------------------------------------------------------------------


@pytest.mark.parametrize("smooth", KNOTS, ids=repr)
def test_closed_frames_twist_the_least_by_themselves(smooth) -> None:
    arc = smooth.polyline(smooth.even(150))
    ribbon = arc.closed_ribbon()
    assert abs(ribbon.twist) <= 0.5
    assert ribbon.link() == round(arc.writhe())
    for link in (-1, 1):
        assert abs(arc.closed_ribbon(ribbon.link() + link).twist) >= abs(ribbon.twist)


def test_rotations_of_scipy_are_poses() -> None:
    r, q = base_pairs()
    turned = Rotation.from_matrix(TURN) * as_rotation(q)
    made = from_poses((r @ TURN.T, turned))
    assert 360 * made.twist == pytest.approx(377.3, abs=1e-9)
