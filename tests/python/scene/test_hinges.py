"""Hinges between rods: free about one axis, which goes with the first rod."""

from __future__ import annotations

import numpy as np
import pytest
from support import SOFT, X, Y, Z

import pyrod
from pyrod import Clamp, Force, Hinge, Joint, Rod, Scene, rotation, solve


def elbow(kind: str, axis: np.ndarray | None = None) -> pyrod.Equilibrium:
    """Two rods at a right angle in the plane of x and z, pushed out of it and along it."""
    up = Rod.straight(1.0, 16, SOFT)
    across = Rod.straight(1.0, 16, SOFT).placed((0, 0, 1), tangent=(1, 0, 0), normal=(0, 0, -1))
    joint = Joint(((0, "end"), (1, "start")), kind=kind, axis=axis)
    supports = [Clamp(at=(0, "start")), Hinge(at=(1, "end"))]
    return solve(Scene([up, across], supports, Force((0.3, -1, -2), at=(1, 0.5)), joints=joint))


@pytest.mark.parametrize("axis", [X, Y, Z, np.array([1.0, 2.0, -2.0])])
def test_a_hinge_carries_no_moment_about_its_axis(axis: np.ndarray) -> None:
    result = elbow("hinge", axis)
    first, second = result.rods
    now = rotation.rotate(first.tip_frame, axis / np.linalg.norm(axis))  # it starts along z
    assert abs(second.moment[0] @ now) < 1e-11
    assert np.linalg.norm(second.moment[0]) > 0.01
    np.testing.assert_allclose(first.moment[-1], second.moment[0], rtol=0, atol=1e-11)


def test_a_hinge_turns_about_its_axis_only() -> None:
    first, second = elbow("hinge", Y).rods
    between = rotation.multiply(rotation.conjugate(first.tip_frame), second.vertex_frames[0])
    at_rest = rotation.exp([0, np.pi / 2, 0])
    turn = rotation.log(rotation.multiply(between, rotation.conjugate(at_rest)))
    assert np.abs(turn[[0, 2]]).max() < 1e-14
    assert 0.01 < abs(turn[1]) < 1


def test_a_hinge_is_softer_than_a_rigid_joint_and_stiffer_than_a_ball() -> None:
    shapes = (elbow("rigid"), elbow("hinge", Y), elbow("ball"))
    sag = [1 - shape.rods[1].positions[8, 2] for shape in shapes]
    assert sag[0] < sag[1] < sag[2]


@pytest.mark.parametrize(("axis", "like"), [(Y, "ball"), (X, "rigid"), (Z, "rigid")])
def test_in_the_plane_a_hinge_is_a_ball_or_rigid(axis: np.ndarray, like: str) -> None:
    def portal(kind: str, axis: np.ndarray | None = None) -> pyrod.Equilibrium:
        up = Rod.straight(1.0, 8, SOFT)
        across = Rod.straight(1.0, 8, SOFT).placed((0, 0, 1), frame=rotation.exp([0, np.pi / 2, 0]))
        joint = Joint(((0, "end"), (1, "start")), kind=kind, axis=axis)
        supports = [Clamp(at=(0, "start")), Hinge(at=(1, "end"))]
        load = Force((0, 0, -1), at=(1, 0.5))
        return solve(Scene([up, across], supports, load, "planar", joint))

    np.testing.assert_allclose(
        portal("hinge", axis).rods[1].positions, portal(like).rods[1].positions, rtol=0, atol=1e-13
    )
