"""Rotations against SciPy, against many digits, and against themselves; angles from 0 past pi."""

from __future__ import annotations

from itertools import pairwise

import mpmath
import numpy as np
import pytest
from hypothesis import given
from scipy.spatial.transform import Rotation
from support import angle_between, frames, random_frames, unit, vectors

from pyrod import rotation

ANGLES = [
    0.0,
    1e-300,
    1e-160,
    1e-12,
    1e-8,
    1e-4,
    0.1,
    1.0,
    3.0,
    np.pi - 1e-9,
    np.pi,
    np.pi + 1e-9,
    4.0,
    6.0,
]
AXIS = unit([2.0, -3.0, 6.0])
E3 = np.array([0.0, 0.0, 1.0])
turned_frames = frames().filter(lambda q: np.linalg.norm(q[1:]) > 1e-6)  # those that have an axis
directions = vectors().filter(lambda v: np.linalg.norm(v) > 1e-3)


def exact_exp(vector: np.ndarray) -> list[mpmath.mpf]:
    """The quaternion of a rotation vector to 50 digits."""
    with mpmath.workdps(50):
        v = [mpmath.mpf(float(x)) for x in vector]
        angle = mpmath.sqrt(sum(x * x for x in v))
        ratio = mpmath.sin(angle / 2) / angle if angle else mpmath.mpf(1) / 2
        return [mpmath.cos(angle / 2), *(ratio * x for x in v)]


def exact_log(quaternion: np.ndarray) -> list[mpmath.mpf]:
    """The rotation vector of a quaternion, made unit, to 50 digits; up to 2 pi long."""
    with mpmath.workdps(50):
        w, *v = (mpmath.mpf(float(x)) for x in quaternion)
        sine = mpmath.sqrt(sum(x * x for x in v))
        ratio = 2 * mpmath.atan2(sine, w) / sine if sine else 2 / w
        return [ratio * x for x in v]


def relative_error(computed: np.ndarray, exact: list[mpmath.mpf]) -> float:
    """Length of the difference over the length of the exact vector."""
    with mpmath.workdps(50):
        scale = mpmath.norm(exact)
        error = mpmath.norm(
            [mpmath.mpf(float(c)) - e for c, e in zip(computed, exact, strict=True)]
        )
        return float(error / scale if scale else error)


# Exponential and logarithm ------------------------------------------------------------------------


@pytest.mark.parametrize("angle", ANGLES)
def test_exp_to_rounding(angle: float) -> None:
    vector = angle * AXIS
    q, exact = rotation.exp(vector), exact_exp(vector)
    assert relative_error(q, exact) < 4e-16
    condition = max(1, abs(angle / 2 / np.tan(angle / 2))) if angle else 1  # of the sine
    assert relative_error(q[1:], exact[1:]) < 4e-16 * condition  # small parts are accurate, too


@pytest.mark.parametrize("angle", ANGLES)
def test_log_to_rounding(angle: float) -> None:
    q = rotation.exp(angle * AXIS)
    assert relative_error(rotation.log(q), exact_log(q)) < 6e-16


@pytest.mark.parametrize("angle", ANGLES)
def test_log_inverts_exp_past_pi(angle: float) -> None:
    vector = angle * AXIS
    # towards 2 pi the vector part of the quaternion loses digits that no logarithm can bring back
    np.testing.assert_allclose(rotation.log(rotation.exp(vector)), vector, rtol=4e-15, atol=0)


@given(turned_frames)
def test_exp_inverts_log_for_both_signs(q: np.ndarray) -> None:
    np.testing.assert_allclose(rotation.exp(rotation.log(q)), q, rtol=0, atol=1e-15)


@given(turned_frames)
def test_logs_of_both_signs_are_a_turn_apart(q: np.ndarray) -> None:
    lengths = [np.linalg.norm(rotation.log(p)) for p in (q, -q)]
    assert sum(lengths) == pytest.approx(2 * np.pi, rel=1e-14)


def test_log_of_minus_one_which_has_no_axis_is_zero() -> None:
    np.testing.assert_array_equal(rotation.log([-1.0, 0.0, 0.0, 0.0]), np.zeros(3))


# Against SciPy ------------------------------------------------------------------------------------


@given(vectors(3.0))
def test_exp_is_scipys(vector: np.ndarray) -> None:
    theirs = Rotation.from_rotvec(vector)
    np.testing.assert_allclose(
        rotation.to_matrix(rotation.exp(vector)), theirs.as_matrix(), rtol=0, atol=2e-15
    )


@given(frames())
def test_log_is_scipys_up_to_pi(q: np.ndarray) -> None:
    q = q if q[0] >= 0 else -q
    theirs = Rotation.from_quat(q, scalar_first=True).as_rotvec()
    if q[0] > 1e-9:  # at pi both directions are right
        np.testing.assert_allclose(rotation.log(q), theirs, rtol=0, atol=1e-14)


@given(frames(), frames())
def test_multiply_is_scipys_product(a: np.ndarray, b: np.ndarray) -> None:
    theirs = Rotation.from_quat(a, scalar_first=True) * Rotation.from_quat(b, scalar_first=True)
    ours = rotation.multiply(a, b)
    assert angle_between(ours, theirs.as_quat(scalar_first=True)) < 4e-15


@given(frames(), vectors())
def test_rotate_is_scipys(q: np.ndarray, v: np.ndarray) -> None:
    theirs = Rotation.from_quat(q, scalar_first=True).apply(v)
    np.testing.assert_allclose(rotation.rotate(q, v), theirs, rtol=0, atol=4e-15)


# Products keep signs ------------------------------------------------------------------------------


def test_multiply_follows_hamilton_with_signs() -> None:
    one, i, j, k = np.eye(4)
    for a, b, product in [
        (i, j, k),
        (j, k, i),
        (k, i, j),
        (j, i, -k),
        (i, i, -one),
        (-one, -one, one),
    ]:
        np.testing.assert_array_equal(rotation.multiply(a, b), product)


@given(frames())
def test_conjugate_undoes_exactly_one_turn(q: np.ndarray) -> None:
    one = rotation.multiply(q, rotation.conjugate(q))
    np.testing.assert_allclose(one, [1, 0, 0, 0], rtol=0, atol=1e-15)


def test_columns_of_the_matrix_are_the_directors() -> None:
    q = random_frames(np.random.default_rng(1))
    directors = [rotation.rotate(q, e) for e in np.eye(3)]
    np.testing.assert_allclose(rotation.to_matrix(q), np.transpose(directors), rtol=0, atol=1e-15)


# Matrices -----------------------------------------------------------------------------------------


@given(frames())
def test_matrix_round_trip(q: np.ndarray) -> None:
    back = rotation.from_matrix(rotation.to_matrix(q))
    assert angle_between(back, q) < 2e-15


@pytest.mark.parametrize("axis", [*np.eye(3), *-np.eye(3), AXIS])
def test_matrix_round_trip_at_half_a_turn(axis: np.ndarray) -> None:
    q = np.concatenate([[0.0], axis])
    assert angle_between(rotation.from_matrix(rotation.to_matrix(q)), q) < 1e-15


def test_slightly_off_matrices_are_brought_back_to_unit_quaternions() -> None:
    R = rotation.to_matrix(random_frames(np.random.default_rng(2)))
    q = rotation.from_matrix(R * (1 + 1e-8))
    assert np.linalg.norm(q) == pytest.approx(1, abs=3e-16)
    assert angle_between(q, rotation.from_matrix(R)) < 1e-8


@pytest.mark.parametrize(
    "matrix", [np.zeros((3, 3)), 1.001 * np.eye(3), np.diag([1.0, 1.0, -1.0]), np.eye(3) + 1e-4]
)
def test_what_is_no_rotation_is_refused(matrix: np.ndarray) -> None:
    with pytest.raises(ValueError, match=r"matrix\[1\]: expected a rotation"):
        rotation.from_matrix([np.eye(3), matrix])


# Cayley -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("angle", [*ANGLES, 2 * np.pi - 1e-3])
def test_cayley_turns_by_four_times_the_arctangent(angle: float) -> None:
    vector = np.tan(angle / 4) * AXIS
    np.testing.assert_allclose(
        rotation.cayley(vector), rotation.exp(angle * AXIS), rtol=2e-15, atol=5e-16
    )


@pytest.mark.parametrize("angle", [*ANGLES, 2 * np.pi - 1e-3])
def test_inverse_cayley_inverts(angle: float) -> None:
    vector = np.tan(angle / 4) * AXIS
    back = rotation.inverse_cayley(rotation.cayley(vector))
    # the vector part of the quaternion is near zero at 2 pi, where its digits are those of 1
    np.testing.assert_allclose(back, vector, rtol=4e-15, atol=0)


# Shapes -------------------------------------------------------------------------------------------

RNG = np.random.default_rng(3)
ONE_ARGUMENT = [
    (rotation.exp, (3,), (4,)),
    (rotation.log, (4,), (3,)),
    (rotation.cayley, (3,), (4,)),
    (rotation.inverse_cayley, (4,), (3,)),
    (rotation.conjugate, (4,), (4,)),
    (rotation.to_matrix, (4,), (3, 3)),
]


@pytest.mark.parametrize("lead", [(), (1,), (5,), (2, 3), (0,)])
@pytest.mark.parametrize(("function", "inner", "outer"), ONE_ARGUMENT)
def test_leading_axes_are_kept(function, inner, outer, lead) -> None:
    values = RNG.normal(size=lead + inner)
    values = unit(values) if inner == (4,) else values
    out = function(values)
    assert out.shape == lead + outer
    for place in np.ndindex(*lead):
        np.testing.assert_array_equal(out[place], function(values[place]))


@pytest.mark.parametrize("lead", [(), (5,), (2, 3), (0,)])
def test_matrices_keep_leading_axes(lead: tuple[int, ...]) -> None:
    q = random_frames(RNG, *lead)
    assert rotation.from_matrix(rotation.to_matrix(q)).shape == q.shape


@pytest.mark.parametrize(("a", "b"), [((), (5,)), ((5,), ()), ((2, 1), (1, 3)), ((4,), (4,))])
def test_products_broadcast(a: tuple[int, ...], b: tuple[int, ...]) -> None:
    q, p, v = random_frames(RNG, *a), random_frames(RNG, *b), RNG.normal(size=(*b, 3))
    shape = np.broadcast_shapes(a, b)
    Q, P, V = (
        np.broadcast_to(q, (*shape, 4)),
        np.broadcast_to(p, (*shape, 4)),
        np.broadcast_to(v, (*shape, 3)),
    )
    np.testing.assert_array_equal(rotation.multiply(q, p), rotation.multiply(Q, P))
    np.testing.assert_array_equal(rotation.rotate(q, v), rotation.rotate(Q, V))
    assert rotation.multiply(q, p).shape == (*shape, 4)


@pytest.mark.parametrize(
    ("function", "values"),
    [
        (rotation.exp, np.zeros(4)),
        (rotation.exp, 1.0),
        (rotation.log, np.zeros(3)),
        (rotation.to_matrix, np.zeros((4, 2))),
        (rotation.from_matrix, np.zeros((3, 4))),
        (rotation.conjugate, np.zeros(3)),
    ],
)
def test_wrong_shapes_are_refused(function, values) -> None:
    with pytest.raises(ValueError, match=r"expected .*shape"):
        function(values)


def test_products_refuse_wrong_shapes() -> None:
    with pytest.raises(ValueError, match="shape"):
        rotation.multiply([1, 0, 0, 0], [1, 0, 0])
    with pytest.raises(ValueError, match="shape"):
        rotation.rotate([1, 0, 0, 0], [1, 0, 0, 0])
    with pytest.raises(ValueError, match="shape"):
        rotation.rotate([1, 0, 0], [1, 0, 0])
    with pytest.raises(ValueError, match=r"broadcast|shape"):
        rotation.rotate(random_frames(RNG, 2), np.zeros((3, 3)))


@pytest.mark.parametrize("values", [[1.0, np.nan, 0.0], [np.inf, 0.0, 0.0]])
def test_numbers_that_are_not_finite_are_refused(values: list[float]) -> None:
    with pytest.raises(ValueError, match="finite"):
        rotation.exp(values)


@pytest.mark.parametrize("length", [0.0, 0.999, 1.00001])
def test_quaternions_that_are_not_unit_are_refused(length: float) -> None:
    with pytest.raises(ValueError, match=r"quaternion\[1\]: expected a unit quaternion"):
        rotation.log([[1.0, 0.0, 0.0, 0.0], [length, 0.0, 0.0, 0.0]])


# Frames along a tangent ---------------------------------------------------------------------------


@given(directions)
def test_frame_along_turns_the_shortest_way(tangent: np.ndarray) -> None:
    q = rotation.frame_along(tangent)
    t = unit(tangent)
    np.testing.assert_allclose(rotation.rotate(q, E3), t, rtol=0, atol=1e-15)
    angle = np.arctan2(np.hypot(t[0], t[1]), t[2])
    assert np.linalg.norm(rotation.log(q)) == pytest.approx(angle, abs=1e-15)


@pytest.mark.parametrize("length", [1e-300, 1e-170, 1.0, 1e170, 1e300])
def test_frame_along_does_not_mind_the_length(length: float) -> None:
    expected = rotation.frame_along([3.0, -2.0, -6.0], [1.0, 1.0, 0.0])
    scaled = length * np.array([3.0, -2.0, -6.0])
    q = rotation.frame_along(scaled, length * np.array([1.0, 1.0, 0.0]))
    np.testing.assert_allclose(q, expected, rtol=0, atol=1e-15)
    np.testing.assert_allclose(
        rotation.frame_along(scaled), rotation.frame_along(scaled / length), rtol=0, atol=1e-15
    )


@pytest.mark.parametrize("offset", [0.0, 1e-300, 1e-9, 1e-7, 1e-6, 1e-5, 1e-3])
@pytest.mark.parametrize("direction", [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.6, -0.8, 0.0]])
def test_frame_along_minus_e3_and_near_it(offset: float, direction: list[float]) -> None:
    tangent = unit(offset * np.array(direction) - E3)
    q = rotation.frame_along(tangent)
    assert np.linalg.norm(q) == pytest.approx(1, abs=4e-16)
    np.testing.assert_allclose(rotation.rotate(q, E3), tangent, rtol=0, atol=2e-15)


@given(directions, directions)
def test_frame_along_puts_a1_as_near_to_the_normal_as_can_be(tangent, normal) -> None:
    t, n = unit(tangent), unit(normal)
    if np.linalg.norm(np.cross(t, n)) < 1e-3:
        return
    R = rotation.to_matrix(rotation.frame_along(tangent, normal))
    np.testing.assert_allclose(R[:, 2], t, rtol=0, atol=1e-15)
    assert abs(R[:, 1] @ n) < 1e-15  # the normal lies in the plane of a1 and a3
    assert R[:, 0] @ n > 0


@pytest.mark.parametrize("offset", [1e-5, 1e-3, 0.1])
def test_a_normal_near_the_tangent_leaves_a3_exact(offset: float) -> None:
    tangent = unit([1.0, 2.0, 3.0])
    q = rotation.frame_along(tangent, tangent + offset * unit([3.0, 0.0, -1.0]))
    np.testing.assert_allclose(rotation.rotate(q, E3), tangent, rtol=0, atol=1e-15)


@pytest.mark.parametrize("tangent", [[0, 0, 0], [1, 0], [np.nan, 0, 1], [[1, 0, 0]]])
def test_frame_along_refuses_what_is_no_direction(tangent) -> None:
    with pytest.raises(ValueError, match="tangent: expected a vector"):
        rotation.frame_along(tangent)
    with pytest.raises(ValueError, match="normal: expected a vector"):
        rotation.frame_along(E3, tangent)


@pytest.mark.parametrize("normal", [[0, 0, 2], [0, 0, -1], [1e-8, 0, 1]])
def test_frame_along_refuses_a_normal_along_the_tangent(normal) -> None:
    with pytest.raises(ValueError, match="normal: must not be parallel"):
        rotation.frame_along(E3, normal)


# Signs along a row of frames ----------------------------------------------------------------------


def test_continued_chooses_neighbours_of_like_sign() -> None:
    rng = np.random.default_rng(4)
    q = random_frames(rng, 200)
    given_signs = q * rng.choice([-1.0, 1.0], size=(200, 1))
    out = rotation.continued(given_signs)
    np.testing.assert_array_equal(np.abs(out), np.abs(q))
    np.testing.assert_array_equal(out[0], given_signs[0])
    assert all(a @ b >= 0 for a, b in pairwise(out))


def test_continued_follows_many_turns() -> None:
    true = rotation.exp(np.outer(np.linspace(0, 6.2, 50), AXIS))  # ends near -1
    flipped = true * np.where(true[:, :1] < 0, -1.0, 1.0)
    np.testing.assert_array_equal(rotation.continued(flipped), true)


def test_continued_leaves_its_argument_alone() -> None:
    q = np.array([[1.0, 0, 0, 0], [-1.0, 0, 0, 0]])
    rotation.continued(q)
    assert q[1, 0] == -1


@pytest.mark.parametrize("n", [0, 1])
def test_continued_of_few(n: int) -> None:
    assert rotation.continued(np.zeros((n, 4))).shape == (n, 4)


def test_as_frames_takes_quaternions_and_matrices() -> None:
    q = random_frames(RNG, 3)
    np.testing.assert_array_equal(rotation.as_frames(q, "frames"), q)
    assert angle_between(rotation.as_frames(rotation.to_matrix(q), "frames"), q).max() < 2e-15
    with pytest.raises(ValueError, match=r"place: expected quaternions of shape \(n, 4\)"):
        rotation.as_frames(np.zeros((3, 3)), "place")
