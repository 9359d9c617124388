"""Rotations against SciPy, against many digits, and against themselves; angles from 0 past pi."""

from __future__ import annotations

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
