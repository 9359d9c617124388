"""Rods made from curves, and frames that lean."""

from __future__ import annotations

from math import nan

import numpy as np
import pytest
from support import IDENTITY, SOFT, Z, angle_between, solved, unit
from test_rod import some_curve

from pyrod import Rod, rotation
from pyrod.curve import Polyline

RNG = np.random.default_rng(1)


@pytest.mark.parametrize("n", [1, 2, 3, 40])
def test_from_curve_keeps_the_shape(n: int) -> None:
    r, q = some_curve(n)
    rod = Rod.from_curve(r, q, SOFT)
    back, frames = rod.at_rest()
    np.testing.assert_allclose(back, r, rtol=0, atol=1e-14)
    assert angle_between(frames, q).max() < 1e-14
    np.testing.assert_allclose(
        rod.edge_lengths, np.linalg.norm(np.diff(r, axis=0), axis=1), rtol=1e-15
    )


def test_from_curve_without_frames_does_not_twist() -> None:
    r, _ = some_curve(40)
    rod = Rod.from_curve(r, None, SOFT)
    np.testing.assert_allclose(rod.K0[:, 2], 0, rtol=0, atol=1e-13)
    np.testing.assert_allclose(rod.at_rest()[0], r, rtol=0, atol=1e-14)
    assert rod == Rod.from_curve(r, Polyline(r).bishop().frames, SOFT)


def test_from_curve_is_at_rest_in_its_place() -> None:
    r, q = some_curve(40)
    rod = Rod.from_curve(r, q, SOFT)
    at_rest = solved(rod)
    np.testing.assert_allclose(at_rest.positions, r, rtol=0, atol=1e-13)
    assert at_rest.energy < 1e-24


@pytest.mark.parametrize("as_matrices", [False, True])
def test_signs_of_the_frames_do_not_matter(as_matrices: bool) -> None:
    r, q = some_curve(40)
    shuffled = q * RNG.choice([-1.0, 1.0], (40, 1))
    given_frames = rotation.to_matrix(shuffled) if as_matrices else shuffled
    rod = Rod.from_curve(r, given_frames, SOFT)
    np.testing.assert_allclose(rod.K0, Rod.from_curve(r, q, SOFT).K0, rtol=0, atol=1e-12)


def test_frames_that_lean_are_turned_the_shortest_way() -> None:
    r, q = some_curve(40)
    lean = np.concatenate([0.3 * unit(RNG.normal(size=(40, 2))), np.zeros((40, 1))], axis=1)
    rod = Rod.from_curve(r, rotation.multiply(q, rotation.exp(lean)), SOFT)
    np.testing.assert_allclose(rod.at_rest()[0], r, rtol=0, atol=1e-14)
    np.testing.assert_allclose(rod.K0, Rod.from_curve(r, q, SOFT).K0, rtol=0, atol=1e-12)


@pytest.mark.parametrize(("angle", "refused"), [(0.49, False), (0.51, True), (np.pi, True)])
def test_frames_that_lean_too_far_are_refused(angle: float, refused: bool) -> None:
    r, q = some_curve(5)
    q[3] = rotation.multiply(q[3], rotation.exp([angle, 0, 0]))
    if refused:
        with pytest.raises(ValueError, match=r"frames\[3\]: a3 is .* rad away from the edge"):
            Rod.from_curve(r, q, SOFT)
    else:
        Rod.from_curve(r, q, SOFT)


def test_frames_turned_by_pi_are_refused() -> None:
    r = np.outer(np.arange(4.0), Z)
    q = np.tile(IDENTITY, (3, 1))
    q[2] = [0, 0, 0, 1]
    with pytest.raises(ValueError, match=r"frames\[2\]: turned by pi"):
        Rod.from_curve(r, q, SOFT)


@pytest.mark.parametrize(
    ("r", "q", "message"),
    [
        (np.zeros((1, 3)), np.tile(IDENTITY, (0, 1)), "positions: expected"),
        (np.zeros((3, 4)), np.tile(IDENTITY, (2, 1)), "positions: expected"),
        ([[0, 0, 0], [0, 0, nan]], [IDENTITY], r"positions\[1\]: expected finite"),
        (
            [[0, 0, 0], [0, 0, 1], [0, 0, 1]],
            np.tile(IDENTITY, (2, 1)),
            r"positions\[2\]: coincides",
        ),
        (
            [[0, 0, 0], [0, 0, 1]],
            np.tile(IDENTITY, (2, 1)),
            r"frames: expected 1 rows \(one per edge\), got 2",
        ),
        ([[0, 0, 0], [0, 0, 1]], np.zeros((1, 5)), "frames: expected quaternions"),
        ([[0, 0, 0], [0, 0, 1]], [2 * IDENTITY], "expected a unit quaternion"),
    ],
)
def test_from_curve_refuses(r, q, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        Rod.from_curve(r, q, SOFT)
