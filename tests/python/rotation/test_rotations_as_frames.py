"""Rotations of SciPy are frames wherever frames are taken, and no vectors."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np
import pytest
from arguments import ARC, E3, FRAMES, HELD, Call, named, refused
from scipy.spatial.transform import Rotation

import pyrod
from pyrod import Rod, rotation
from pyrod.curve import FramedCurve, Polyline

TURN = Rotation.from_euler("xyz", [0.3, -0.2, 0.5])
MATRIX = TURN.as_matrix()


@pytest.mark.parametrize(("argument", "call"), named(FRAMES))
def test_a_rotation_is_a_frame(argument: str, call: Call) -> None:
    """As a quaternion, the scalar first, or a matrix: the same."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        made = [call(x) for x in (TURN, MATRIX, TURN.as_quat(scalar_first=True))]
    assert not isinstance(made[0], pyrod.Clamp) or made[0].frame == pytest.approx(
        TURN.as_quat(scalar_first=True), abs=1e-15
    )
    for other in made[1:]:
        alike(made[0], other)


def alike(a: Any, b: Any) -> None:
    if isinstance(a, tuple):
        for x, y in zip(a, b, strict=True):
            alike(x, y)
    elif isinstance(a, np.ndarray):
        np.testing.assert_allclose(a, b, atol=1e-14)
    elif isinstance(a, FramedCurve):
        np.testing.assert_allclose(a.matrices, b.matrices, atol=1e-14)
    elif isinstance(a, pyrod.Energy):
        assert a.bend_twist == pytest.approx(b.bend_twist, rel=1e-12)
    elif isinstance(a, Rod):
        np.testing.assert_allclose(a.placement[1], b.placement[1], atol=1e-14)
    else:
        np.testing.assert_allclose(a.frame, b.frame, atol=1e-14)


def test_rotations_where_quaternions_are_taken() -> None:
    q = TURN.as_quat(scalar_first=True)
    assert rotation.log(TURN) == pytest.approx(TURN.as_rotvec(), abs=1e-15)
    assert rotation.rotate(TURN, E3) == pytest.approx(TURN.apply(E3), abs=1e-15)
    assert rotation.multiply(TURN, TURN) == pytest.approx(rotation.multiply(q, q), abs=1e-15)
    assert rotation.to_matrix(TURN) == pytest.approx(MATRIX, abs=1e-15)


def test_a_start_of_rotations() -> None:
    found = pyrod.solve(HELD)
    again = pyrod.solve(HELD, start=Rotation.from_quat(found.frames, scalar_first=True))
    assert again.tip == pytest.approx(found.tip, abs=1e-12)
    assert again.iterations <= 1


@pytest.mark.parametrize("where", [pyrod.Force, pyrod.Clamp, Polyline, rotation.exp])
def test_a_rotation_is_no_vector(where: Call) -> None:
    assert "got a Rotation; give .as_rotvec()" in refused(where, TURN)


def test_frames_lie_on_their_side() -> None:
    assert "got shape (4, 5); transpose it" in refused(
        lambda x: FramedCurve(ARC, x), np.ones((4, 5))
    )
