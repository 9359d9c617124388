"""Joints: rods that share points and frames, frames of beams, rings, grids."""

from __future__ import annotations

import pickle
from typing import Any

import numpy as np
import pytest
from support import (
    FLAT,
    IDENTITY,
    ROUND,
    SOFT,
    SPACES,
    X,
    Y,
    Z,
    angle_between,
    differences,
    extrapolated,
    orders,
    table,
)

import pyrod
from pyrod import Clamp, DistributedForce, Force, Joint, Rod, Scene, Section, Slider, solve
from pyrod.rotation import conjugate, multiply

SMALL = 1e-5
HALF = Rod.straight(0.5, 8, SOFT)


def ring(n: int, section: Section, turns: int = 0, **more: Any) -> pyrod.Equilibrium:
    rod = Rod.straight(1.0, n, section)
    return solve(Scene(rod, joints=Joint(("start", "end"), turns=turns)), **more)


# Arguments ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Joint(()), "points: a joint needs two or more, got 0"),
        (lambda: Joint(("start",)), "points: a joint needs two or more, got 1"),
        (lambda: Joint(("start", "middle")), "at: expected 'start', 'end' or an arc length"),
        (lambda: Joint(("start", "end"), "glue"), "kind: expected 'rigid', 'hinge' or 'ball'"),
        (lambda: Joint(("start", "end"), turns=0.5), "turns: must be a whole number, got 0.5"),
        (lambda: Joint(("start", "end"), "hinge"), "axis: a hinge needs one"),
        (lambda: Joint(("start", "end"), axis=X), "axis: a hinge needs one, other joints have no"),
        (lambda: Joint(("start", "end"), "hinge", axis=0 * X), "axis: expected a direction"),
    ],
)
def test_arguments_are_refused(make: Any, message: str) -> None:
    with pytest.raises(ValueError, match=f"^{message}"):
        make()


@pytest.mark.parametrize(
    ("joints", "message"),
    [
        (Joint(((0, "end"), (2, "start"))), "at: there is no rod 2, the scene has 2"),
        (Joint(((0, "end"), (1, 9.0))), "at: must be an arc length on the rod"),
        (Joint(((0, "end"), (0, 0.5))), "joints: the points .* are not different vertices"),
        (
            [Joint(((0, "end"), (1, "start"))), Joint(((0, "start"), (1, "start")))],
            "joints: vertex 0 of rod 1 is joined twice",
        ),
    ],
)
def test_a_scene_refuses(joints: Any, message: str) -> None:
    with pytest.raises(ValueError, match=f"^{message}"):
        Scene([HALF, HALF], Clamp(), joints=joints)


def test_joints_are_values() -> None:
    joint = Joint(((0, "end"), (1, "start")), "ball")
    assert joint == pickle.loads(pickle.dumps(joint)) == Joint([(0, "end"), (1, "start")], "ball")
    assert joint != Joint(((0, "end"), (1, "start")))
    assert "ball" in repr(joint)


# Two rods are one ---------------------------------------------------------------------------------


def cut(n: int, load: Any, space: str = "spatial", start: float = 0.5) -> pyrod.Equilibrium:
    """A cantilever of two rods, the second at rest from the given height."""
    half = Rod.straight(0.5, n // 2, SOFT)
    joint = Joint(((0, "end"), (1, "start")), aligned=True)
    rods = [half, half.placed((0, 0, start))]
    return solve(Scene(rods, Clamp(), Force(load, at=(1, "end")), space, joint))


@pytest.mark.parametrize("space", SPACES)
@pytest.mark.parametrize("start", [0.0, 0.5])
def test_two_rods_joined_in_line_are_one(space: str, start: float) -> None:
    """Exactly if all turns have one axis. Also if the second rod lies elsewhere at rest."""
    load = (0.5, 0.0, -2.0)
    whole = solve(Scene(Rod.straight(1.0, 16, SOFT), Clamp(), Force(load), space))
    parts = cut(16, load, space, start)
    assert whole.tip[0] > 0.1
    for part, of in zip(parts.rods, (slice(9), slice(8, None)), strict=True):
        assert differences(part.positions, whole.positions[of]) < 1e-12
    assert np.isclose(parts.energy, whole.energy, rtol=1e-12)
    assert parts.index == whole.index == 0
    assert parts.reactions[0].force == pytest.approx(whole.reaction.force, abs=1e-12)
    assert parts.reactions[0].moment == pytest.approx(whole.reaction.moment, abs=1e-12)


def test_two_rods_joined_in_line_are_one_in_space() -> None:
    """The two half cells at the joint turn one after the other: a difference of third order."""
    load, differ = (0.5, 1.0, -2.0), []
    for n in (16, 32, 64):
        whole = solve(Scene(Rod.straight(1.0, n, SOFT), Clamp(), Force(load)))
        differ.append(differences(cut(n, load).rods[1].positions, whole.positions[n // 2 :]))
    assert differ[0] < 1e-6
    assert np.abs(orders(differ) - 3).max() < 0.05


def test_a_rigid_joint_keeps_the_angle_that_the_rods_have_at_rest() -> None:
    second = HALF.placed((0, 0, 0.5), tangent=(1, 2, 2))
    rest = second.placement[1]
    joint = Joint(((0, "end"), (1, "start")))
    r = solve(Scene([HALF, second], Clamp(), Force((1, 0, -1), at=(1, "end")), joints=joint))
    kept = multiply(conjugate(r.rods[0].tip_frame), r.rods[1].vertex_frames[0])
    assert angle_between(kept, rest) < 1e-9
    assert angle_between(r.rods[0].tip_frame, IDENTITY) > 0.1


@pytest.mark.parametrize("space", SPACES)
def test_a_ball_joint_carries_no_moment(space: str) -> None:
    """A bar on a ball hangs in the direction of its force, and the first rod has no end moment."""
    load = np.array([1.0, 0.0, -1.0]) / np.sqrt(2)
    rods = [HALF, HALF.placed((0, 0, 0.5))]
    joint = Joint(((0, "end"), (1, "start")), "ball")
    r = solve(Scene(rods, Clamp(), Force(load, at=(1, "end")), space, joint))
    alone = solve(Scene(HALF, Clamp(), Force(load), space))
    assert differences(r.rods[0].positions, alone.positions) < 1e-9
    bar = r.rods[1].tip - r.rods[0].tip
    assert np.abs(np.cross(bar, load)).max() < 1e-9
    assert np.abs(r.rods[1].moment).max() < 1e-9


# Frames of beams ----------------------------------------------------------------------------------


@pytest.mark.parametrize("space", SPACES)
def test_the_l_frame(space: str) -> None:
    """A force P along the post at the end of the arm: (P L^3/2, 4/3 P L^3)/EI."""
    found = []
    for n in (4, 8, 16, 32):
        post = Rod.straight(1.0, n, FLAT)
        arm = post.placed((0, 0, 1), tangent=X, normal=-Z)
        joint = Joint(((0, "end"), (1, "start")))
        load = Force(-SMALL * Z, at=(1, "end"))
        r = solve(Scene([post, arm], Clamp(), load, space, joint))
        found.append(r.rods[1].tip - X - Z)
    # what bends by 1e-5 shortens by 1e-10
    assert np.allclose(extrapolated(found) / SMALL, [1 / 2, 0, -4 / 3], rtol=0, atol=3e-5)


def portal(n: int, H: float, space: str) -> pyrod.Equilibrium:
    """Two posts and a beam of unit length, clamped at the feet, pushed at the left corner."""
    post = Rod.straight(1.0, n, FLAT)
    rods = [
        post,
        post.placed((0, 0, 1), tangent=X, normal=-Z),
        post.placed((1, 0, 0), tangent=Z, normal=X),
    ]
    joints = [Joint(((0, "end"), (1, "start"))), Joint(((1, "end"), (2, "end")))]
    feet = [Clamp(at=(0, "start")), Clamp(at=(2, "start"))]
    return solve(Scene(rods, feet, Force(H * X, at=(0, "end")), space, joints))


@pytest.mark.parametrize("space", SPACES)
def test_the_portal(space: str) -> None:
    """Sway 5/84 H, moments 2/7 H at the feet, which lift by 3/7 H: slope deflection by hand."""
    found = []
    for n in (4, 8, 16, 32):
        r = portal(n, SMALL, space)
        left, right = r.reactions
        found.append([r.rods[0].tip[0], left.moment[1], right.moment[1], left.force[2]])
        assert np.isclose(left.force[0], right.force[0], rtol=1e-4)  # an anti-symmetric frame
        assert max(r.balance) < 1e-14 / SMALL  # forces are rounded as 1
    exact = [5 / 84, -2 / 7, -2 / 7, -3 / 7]
    assert np.allclose(extrapolated(found) / SMALL, exact, rtol=0, atol=3e-5)


def test_a_tree_tells_its_forces() -> None:
    """Trunk and two boughs under weights: the trunk carries both, whatever the shape."""
    trunk = Rod.straight(1.0, 8, SOFT)
    boughs = [trunk.placed(Z, tangent=t) for t in ((1, 0, 1), (-1, 1, 1))]
    loads = [Force((0, 0, -0.3), at=(1, "end")), Force((0, 0.1, -0.2), at=(2, "end"))]
    joint = Joint(((0, "end"), (1, "start"), (2, "start")))
    r = solve(Scene([trunk, *boughs], Clamp(), loads, joints=joint))
    assert r.multipliers == 0
    assert np.abs(r.rods[0].force - [0, 0.1, -0.5]).max() < 1e-15
    assert max(r.balance) < 1e-14
    lever = [r.rods[i].tip - r.rods[0].tip for i in (1, 2)]
    crown = np.cross(lever[0], loads[0].force) + np.cross(lever[1], loads[1].force)
    assert np.abs(r.rods[0].moment[-1] - crown).max() < 1e-9
    assert r.stable


def grid(n: int, *loads: Any) -> pyrod.Equilibrium:
    """Three rods each way, crossing at nine nodes, on pins at the four corners."""
    rod = Rod.straight(2.0, 2 * n, ROUND)
    rods = [rod.placed((0, i, 0), tangent=X, normal=Z) for i in range(3)]
    rods += [rod.placed((i, 0, 0), tangent=Y, normal=Z) for i in range(3)]
    joints = [Joint(((i, float(j)), (3 + j, float(i)))) for i in range(3) for j in range(3)]
    corners = [(0, "start"), (0, "end"), (2, "start"), (2, "end")]
    supports: list[Any] = [Slider(normal=Z, at=corner) for corner in corners[1:]]
    return solve(Scene(rods, [Clamp(at=corners[0]), *supports], loads, joints=joints))


def test_a_grid_of_nine_nodes() -> None:
    """Symmetric about its diagonal, as its supports are; rods meet where they are joined."""
    r = grid(4, *[DistributedForce((0, 0, -0.1), i) for i in range(6)])
    assert r.stable
    assert max(r.balance) < 1e-13
    for i in range(3):
        for j in range(3):
            assert np.abs(r.rods[i].positions[4 * j] - r.rods[3 + j].positions[4 * i]).max() < 1e-9
        mirrored = r.rods[3 + i].positions[:, [1, 0, 2]]
        assert np.abs(r.rods[i].positions - mirrored).max() < 1e-9
    assert r.rods[1].positions[4, 2] < -0.01


# Rings --------------------------------------------------------------------------------------------


@pytest.mark.parametrize("space", SPACES)
@pytest.mark.parametrize("n", [3, 8, 17, 64])
def test_a_rod_bent_to_a_ring_is_a_polygon(space: str, n: int) -> None:
    """All turns are 2 pi/n, and the energy is that of the circle exactly."""
    rod = Rod.straight(3.0, n, FLAT)
    r = solve(Scene(rod, space=space, joints=Joint(("start", "end"))))
    assert np.isclose(r.energy, 2 * np.pi**2 / 3, rtol=1e-12)
    assert (
        np.abs(r.K - 2 * np.pi / 3 * Y).max() < 1e-9 or np.abs(r.K + 2 * np.pi / 3 * Y).max() < 1e-9
    )
    assert r.index == 0
    assert np.abs(r.positions[0] - r.positions[-1]).max() < 1e-12
    radius = np.linalg.norm(r.positions[:-1] - r.positions[:-1].mean(axis=0), axis=1)
    assert np.allclose(radius, 3 / n / 2 / np.sin(np.pi / n), rtol=1e-9)


def test_rings_with_inserted_turns() -> None:
    """Below Michell's threshold the ring stays a circle: 2 pi^2 (EI + GJ Tw^2)/L."""
    section = Section(1, 1, 0.75)
    for turns in (1, -1, 2):
        energies = [ring(n, section, turns).energy for n in (32, 64, 128, 256)]
        exact = 2 * np.pi**2 * (1 + 0.75 * turns**2)
        assert abs(extrapolated(energies) / exact - 1) < 1e-5


def test_rings_leave_the_plane_at_michells_threshold() -> None:
    """The lowest eigenvalue changes its sign at Tw GJ/EI = sqrt(3), here with Tw = 2."""
    exact = float(table("S5_rings")["zajac"]["rows"][0]["total_twist_angle*GJ/EI"]) / (4 * np.pi)
    thresholds = []
    for n in (32, 64, 128):
        circle = ring(n, Section(1, 1, 0.8), 2)
        rows = []
        for GJ in exact * np.array([1.1, 1.12, 1.14]):
            scene = Scene(
                Rod.straight(1.0, n, Section(1, 1, GJ)), joints=Joint(("start", "end"), turns=2)
            )
            r = solve(scene, start=circle, stable=False, eigenvalue=True)
            assert r.index == 2
            rows.append((r.lowest_eigenvalue, GJ))
        thresholds.append(np.polyval(np.polyfit(*np.transpose(rows), 2), 0.0))
    assert abs(extrapolated(thresholds) / exact - 1) < 1e-3


def test_a_ring_beyond_the_threshold_becomes_another() -> None:
    """Three turns with Tw GJ/EI = 2.4 > sqrt(3): two of them go into writhe."""
    r = ring(64, Section(1, 1, 0.8), 3)
    circle = 2 * np.pi**2 * (1 + 0.8 * 9)
    assert r.stable
    assert r.descents > 0 or r.energy < circle - 1
    assert r.energy < 0.5 * circle
