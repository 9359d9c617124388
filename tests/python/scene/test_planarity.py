"""Scenes that lie in a plane, what leaves it, and stability out of it."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from support import FLAT, IDENTITY, REFERENCE, X, Y, Z, about_y

import pyrod
from pyrod import (
    Clamp,
    DistributedForce,
    DistributedMoment,
    Force,
    Gravity,
    Hinge,
    Joint,
    Moment,
    Options,
    Pivot,
    Rod,
    Scene,
    Section,
    Slider,
    Spring,
    solve,
)
from pyrod.reference import Case, load
from pyrod.rotation import exp, frame_along, multiply, rotate

CASES = load(REFERENCE)
HEAVY = Section(4, 1, 2, mass_per_length=1.0)
STRAIGHT = Rod.straight(1.0, 8, HEAVY)
FINE = Rod.straight(1.0, 32, HEAVY)
FLAT_ROD = Rod.straight(1.0, 16, FLAT)
END = Clamp((0.3, 0, 0.7), at="end")
ASKEW = exp(np.array([0.3, -0.5, 0.7]))


def is_solved_in_the_plane(*scene: Any, **more: Any) -> bool:
    """Whether the planar solver takes it."""
    try:
        solve(Scene(*scene, space="planar", **more), Options(max_iterations=1), strict=False)
    except ValueError as error:
        assert "plane" in str(error) or "director" in str(error)  # noqa: PT017
        return False
    return True


# Detection ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("case", CASES, ids=str)
def test_planar_cases_are_detected(case: Case) -> None:
    found = pyrod.is_planar(case.scene(2 * case.intervals, "spatial"))
    assert bool(found) == ("planar" in case.spaces)
    assert (found.plane == "a1-a3") == bool(found)
    assert bool(found.why) != bool(found)


def tilted(frame: Any) -> list[Any]:
    """A scene with all that may be in a plane, moved out of that of x and z as a whole."""
    turn = lambda v: rotate(frame, np.array(v, dtype=float))  # noqa: E731
    other = Rod.precurved(1.0, 6, HEAVY, (0, 0.7, 0)).placed(
        turn((0, 0, 1)) + 5 * turn(Z), multiply(frame, about_y(0.4))
    )
    rod = Rod.precurved(1.0, 8, HEAVY, (0, 1, 0)).placed(5 * turn(Z), frame)
    supports = [
        Clamp(5 * turn(Z), frame),
        Slider(turn((1, 0, 1)), position=turn((0.4, 0, 5.9)), at=(1, "end")),
        Spring(2.0, 1.0, turn((0, 0, 5.5)), multiply(frame, about_y(0.1)), at=0.5),
        Slider(normal=turn(Y), position=turn((0.2, 0, 5.4)), at=0.25),
        Pivot(turn(X), turn((0.1, 0, 6.4)), multiply(frame, about_y(0.2)), at=(1, 0.5)),
    ]
    loads = [
        Force(turn((1, 0, 2)), at=0.3),
        Moment(turn(Y), at=(1, 0.2)),
        DistributedForce(lambda s: s * turn(X), rod=1),
        DistributedMoment(turn(Y)),
        Gravity(turn((3, 0, -4))),
        Force((1, 0, 1), at=0.8, follower=True),
        Moment((0, 1, 0), at=0.8, follower=True),
    ]
    joint = Joint(((0, "end"), (1, "start")), "hinge", axis=turn(Y), aligned=False)
    return [[rod, other], supports, loads, joint]


def test_a_plane_of_any_direction_is_found() -> None:
    for frame in (IDENTITY, ASKEW):
        rods, supports, loads, joint = tilted(frame)
        scene = Scene(rods, supports, loads, joints=joint)
        assert pyrod.is_planar(scene) == pyrod.Planarity("a1-a3", "")
        assert is_solved_in_the_plane(rods, supports, loads, joints=joint)


LEAVING: dict[str, tuple[Any, ...]] = {
    "load 1 (Force) has a component 0.3 along a2": (
        STRAIGHT,
        Clamp(),
        [Force(X), Force(X + 0.3 * Y)],
    ),
    "load 0 (Moment) has a component 0.2 along a3": (STRAIGHT, Clamp(), Moment(Y + 0.2 * Z)),
    "load 0 (Moment) has a component -1 along a1": (STRAIGHT, Clamp(), Moment(-X, at=0.3)),
    "load 0 (DistributedForce) has a component 0.5 along a2": (
        STRAIGHT,
        [Clamp(), END],
        DistributedForce((1, 0.5, 0)),
    ),
    "load 0 (DistributedMoment) has a component 2 along a1": (
        STRAIGHT,
        Clamp(),
        DistributedMoment((2, 0, 0)),
    ),
    "load 0 (Gravity) has a component -9.81 along a2": (STRAIGHT, Clamp(), Gravity((0, -9.81, 0))),
    "load 0 (Force) has a component 1e-20 along a2": (
        STRAIGHT,
        Clamp(),
        Force((1, 1e-20, 0), follower=True),
    ),
    "load 0 (Moment) has a component 1 along a3": (
        STRAIGHT,
        Clamp(),
        Moment(Z, follower=True),
    ),
    "rod 0 is twisted at rest, K0 = 0.4": (
        Rod.precurved(1.0, 8, HEAVY, (0, 1, 0.4)),
        Clamp(),
        Force(X),
    ),
    "rod 0 bends about a1 at rest, K0 = -2": (
        Rod.precurved(1.0, 8, HEAVY, (-2, 1, 0)),
        Clamp(),
        Force(X),
    ),
    "support 1 (Clamp) is 0.1 off the plane": (
        STRAIGHT,
        [Clamp(), Clamp((0.3, 0.1, 0.7), at="end")],
    ),
    "the frame of support 1 (Clamp) is not one turned about a2": (
        STRAIGHT,
        [Clamp(), Clamp((0.3, 0, 0.7), exp(0.1 * Z), at="end")],
    ),
    "rod 1 is 0.2 off the plane at rest": (
        [STRAIGHT, STRAIGHT.placed((0, 0.2, 1))],
        [Clamp(), Hinge((0, 0, 1.5), at=(1, "end"))],
    ),
    "the frame of rod 1 at rest is not one turned about a2": (
        [STRAIGHT, STRAIGHT.placed((0, 0, 1), exp(np.pi / 2 * Z))],
        [Clamp(), Hinge((0, 0, 1.9), at=(1, "end"))],
    ),
}


@pytest.mark.parametrize("why", LEAVING)
def test_what_leaves_the_plane_is_named(why: str) -> None:
    """The planar solver refuses it, too."""
    parts = LEAVING[why]
    found = pyrod.is_planar(Scene(*parts))
    assert found.why == why
    assert found.plane != "a1-a3"
    assert not is_solved_in_the_plane(*parts)


@pytest.mark.parametrize(
    ("size", "planar"), [(1e-13, True), (0.5e-12, True), (2e-12, False), (1e-9, False)]
)
def test_rounding_is_none_of_the_plane(size: float, planar: bool) -> None:
    for load_ in (Force(X + size * Y), Moment(Y + size * X)):
        for supports in (Clamp(), [Clamp(), END]):
            assert bool(pyrod.is_planar(Scene(STRAIGHT, supports, load_))) == planar
            assert is_solved_in_the_plane(STRAIGHT, supports, load_) == planar
    held = [Clamp(), Clamp((0.3, 1e3 * size, 0.7), at="end")]
    assert bool(pyrod.is_planar(Scene(STRAIGHT, held))) == planar
    assert is_solved_in_the_plane(STRAIGHT, held) == planar


ASLANT = {
    "support 1 (Slider) may move aslant to the plane": [Slider((1, 0.1, 0), position=0.9 * Z)],
    "support 1 (Pivot) turns about an axis aslant to the plane": [
        Pivot((0.1, 1, 0.1), 0.9 * Z, at="end")
    ],
    "support 1 (Clamp) twists the rod, turns = 1": [Clamp(0.9 * Z, at="end", turns=1)],
}


@pytest.mark.parametrize("why", ASLANT)
def test_what_is_planar_only_when_it_must(why: str) -> None:
    """The planar solver takes it, but its solution is none in space."""
    supports = [Clamp(), *ASLANT[why]]
    found = pyrod.is_planar(Scene(STRAIGHT, supports))
    assert (found.plane, found.why) == (None, why)
    result = solve(Scene(FINE, supports, space="planar"))
    with pytest.raises(ValueError, match="in space it is no equilibrium"):
        pyrod.out_of_plane_index(result)


def test_joints_that_leave_the_plane() -> None:
    other = STRAIGHT.placed((0, 0, 1), tangent=X, normal=-Z)
    twisted = STRAIGHT.placed((0, 0, 1), tangent=X, normal=Y)
    places = ((0, "end"), (1, "start"))
    supports = [Clamp(), Clamp((1, 0, 1), tangent=X, normal=-Z, at=(1, "end"))]
    for second, joint, why in (
        (other, Joint(places), ""),
        (other, Joint(places, "hinge", axis=X), ""),
        (other, Joint(places, "hinge", axis=Y), ""),
        (other, Joint(places, "hinge", axis=(0, 1, 1)), "has an axis aslant"),
        (twisted, Joint(places), "holds rod 1 turned out of the plane"),
    ):
        scene = Scene([STRAIGHT, second], supports, joints=joint)
        found = pyrod.is_planar(scene)
        assert why in found.why
        assert bool(why) == bool(found.why)
        assert is_solved_in_the_plane([STRAIGHT, second], supports, joints=joint) == (not why)


def test_the_other_plane_is_told() -> None:
    """Bending about a1 only."""
    rod = Rod.precurved(1.0, 8, HEAVY, (1, 0, 0))
    found = pyrod.is_planar(Scene(rod, Clamp(), [Force(Y + Z), Moment(X)]))
    assert found.plane == "a2-a3"
    assert found.why == "rod 0 bends about a1 at rest, K0 = 1"
    assert pyrod.is_planar(Scene(rod, Clamp(), Force(X))).plane is None


@pytest.mark.parametrize("stable", [True, False])
def test_a_clamp_may_lie_in_any_plane(stable: bool) -> None:
    """Where nothing but the clamps tells the plane, the rods' own directions do not matter."""
    clamp = Clamp((1, 2, 3), tangent=X, normal=Z)
    frame = frame_along(X, Z)
    more: list[list[Any]] = [
        [],
        [Clamp((1.8, 2, 3), frame, at="end")],
        [Hinge((1.8, 2, 3), at="end")],
        [Slider(X, position=(1.8, 2, 3))],
    ]
    for supports in more:
        assert pyrod.is_planar(Scene(FLAT_ROD, [clamp, *supports], Force(-2 * Z + X, at=0.5)))
        results = [
            solve(Scene(FLAT_ROD, [c, *s], Force(f, at=0.5), "planar"), stable=stable)
            for c, s, f in (
                (clamp, supports, -2 * Z + X),
                (Clamp(), [local(s) for s in supports], -2 * X + Z),
            )
        ]
        assert results[0].positions[:, 1] == pytest.approx(np.full(17, 2.0), abs=1e-14)
        there, here = results[0].positions - [1, 2, 3], results[1].positions
        assert there == pytest.approx(here[:, [2, 1, 0]], abs=1e-9)


def test_a_joint_to_a_clamped_rod_may_lie_in_any_plane() -> None:
    """At rest the first rod leaves the plane, to which its clamp brings it."""
    second = FLAT_ROD.placed(Y, tangent=Y, normal=X)
    joint = Joint(((0, "end"), (1, "start")), aligned=True)
    rods, clamp = [FLAT_ROD, second], Clamp(tangent=Y, normal=X)
    result = solve(Scene(rods, clamp, Force(X, at=(1, "end")), "planar", joint))
    long = solve(Scene(Rod.straight(2.0, 32, FLAT), clamp, Force(X), "planar"))
    assert np.abs(result.rods[1].positions - long.positions[16:]).max() < 0.01
    assert np.abs(result.rods[1].positions[:, 2]).max() < 1e-14


def test_a_clamped_column_buckles_in_any_plane() -> None:
    column = Scene(FLAT_ROD, Clamp(tangent=X, normal=Z), Force(-5 * X), "planar")
    assert solve(column).stable
    assert solve(column, stable=False).index == 1


def local(support: Any) -> Any:
    if isinstance(support, Clamp):
        return Clamp((0, 0, 0.8), at="end")
    if isinstance(support, Slider):
        return Slider(Z, position=(0, 0, 0.8))
    return Hinge((0, 0, 0.8), at="end")
