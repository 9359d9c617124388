"""Frames along a tangent, and the signs along a row of frames."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from support import Z, angle_between, random_frames, unit
from test_rotation import AXIS, directions

from pyrod import rotation

# Frames along a tangent ---------------------------------------------------------------------------


@given(directions)
def test_frame_along_turns_the_shortest_way(tangent: np.ndarray) -> None:
    q = rotation.frame_along(tangent)
    t = unit(tangent)
    np.testing.assert_allclose(rotation.rotate(q, Z), t, rtol=0, atol=1e-15)
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
    tangent = unit(offset * np.array(direction) - Z)
    q = rotation.frame_along(tangent)
    assert np.linalg.norm(q) == pytest.approx(1, abs=4e-16)
    np.testing.assert_allclose(rotation.rotate(q, Z), tangent, rtol=0, atol=2e-15)


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
    np.testing.assert_allclose(rotation.rotate(q, Z), tangent, rtol=0, atol=1e-15)


@pytest.mark.parametrize("tangent", [[0, 0, 0], [1, 0], [np.nan, 0, 1], [[1, 0, 0]]])
def test_frame_along_refuses_what_is_no_direction(tangent) -> None:
    with pytest.raises(ValueError, match="tangent: expected a vector"):
        rotation.frame_along(tangent)
    with pytest.raises(ValueError, match="normal: expected a vector"):
        rotation.frame_along(Z, tangent)


@pytest.mark.parametrize("normal", [[0, 0, 2], [0, 0, -1], [1e-8, 0, 1]])
def test_frame_along_refuses_a_normal_along_the_tangent(normal) -> None:
    with pytest.raises(ValueError, match="normal: must not be parallel"):
        rotation.frame_along(Z, normal)


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
    q = random_frames(np.random.default_rng(3), 3)
    np.testing.assert_array_equal(rotation.as_frames(q, "frames"), q)
    assert angle_between(rotation.as_frames(rotation.to_matrix(q), "frames"), q).max() < 2e-15
    with pytest.raises(ValueError, match=r"place: expected quaternions of shape \(n, 4\)"):
        rotation.as_frames(np.zeros((3, 3)), "place")
