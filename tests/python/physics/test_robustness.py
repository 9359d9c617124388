"""Garbage in: an error that is documented, or a result that is finite. Never a crash or a NaN.

And scenes without an equilibrium are refused, or reported in words.
"""

from __future__ import annotations

import inspect
import warnings
from collections.abc import Callable
from math import inf, nan
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from support import ROUND, SOFT, SPACES, X, Y, Z

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
    NotConverged,
    Pivot,
    Rod,
    Scene,
    Section,
    Sleeve,
    Slider,
    Spring,
    solve,
)

DOCUMENTED = (ValueError, TypeError)
ROD = Rod.straight(1.0, 8, SOFT)
STIFF = Rod.straight(1.0, 8, ROUND)

number: Any = st.one_of(
    st.sampled_from([0, 1, -1, 0.5, -0.0, nan, inf, -inf, 1e300, -1e300, 1e-300, 5e-324, 2**70]),
    st.floats(),
    st.integers(-5, 5),
)
junk: Any = st.one_of(st.none(), st.text(max_size=3), st.booleans(), st.just(1j), st.just(object()))
array: Any = st.one_of(
    st.tuples(number, number, number),
    st.tuples(number, number, number, number),
    st.lists(number, max_size=5),
    st.lists(st.tuples(number, number, number), max_size=9),
)
anything: Any = st.one_of(number, array, junk)
place: Any = st.one_of(
    st.sampled_from(["start", "end", 0.3, (0, "end"), (0, 0.7), (1, "end")]),
    anything,
    st.tuples(anything, anything),
)


def outcome(call: Callable[[], Any], errors: Any = (ValueError, NotConverged)) -> Any:
    """What a call returns; None if it raises what it may raise, in words."""
    try:
        return call()
    except errors as reason:
        told = str(reason)
    assert len(told) > 10
    return None


def names(make: Callable[..., Any]) -> list[str]:
    return [p for p in inspect.signature(make).parameters if p != "self"]


CONSTRUCTORS = [
    pyrod.Material,
    Section,
    Rod,
    Rod.straight,
    Rod.precurved,
    Rod.from_curve,
    Clamp,
    Hinge,
    Slider,
    Sleeve,
    Pivot,
    Spring,
    Joint,
    Force,
    Moment,
    DistributedForce,
    DistributedMoment,
    Gravity,
]


@pytest.mark.parametrize("make", CONSTRUCTORS, ids=lambda make: make.__qualname__)
@settings(max_examples=25)
@given(data=st.data())
def test_constructors_refuse_garbage_in_words(make: Callable[..., Any], data: Any) -> None:
    """Or take it: then all numbers in what they made are finite, or stiffnesses without bound."""
    arguments = {n: data.draw(place if n == "at" else anything, label=n) for n in names(make)}
    if isinstance(arguments.get("edges"), (int, float)) and 1e3 < arguments["edges"] < 1e9:
        return  # possible, but of no use here
    outcome(lambda: make(**arguments), DOCUMENTED)


VECTOR: Any = st.tuples(*[st.floats(-30, 30)] * 3)
DIRECTION: Any = VECTOR.filter(lambda v: np.linalg.norm(v) > 1e-3)
AT: Any = st.one_of(st.sampled_from(["start", "end"]), st.floats(0, 1))
SUPPORT: Any = st.one_of(
    st.builds(Clamp, st.one_of(st.none(), VECTOR), at=AT, turns=st.integers(-3, 3)),
    st.builds(Clamp, tangent=DIRECTION, at=AT),
    st.builds(Hinge, st.one_of(st.none(), VECTOR), at=AT),
    st.builds(Slider, DIRECTION, at=AT, clamped=st.booleans()),
    st.builds(Slider, normal=DIRECTION, at=AT),
    st.builds(Sleeve, at=AT),
    st.builds(Pivot, DIRECTION, at=AT),
    st.builds(Spring, st.floats(0, 1e6), st.floats(0, 1e6), at=AT),
)
LOAD: Any = st.one_of(
    st.builds(Force, VECTOR, AT, st.booleans()),
    st.builds(Moment, VECTOR, AT, st.booleans()),
    st.builds(DistributedForce, VECTOR, st.just(0), st.booleans()),
    st.builds(DistributedMoment, VECTOR, st.just(0), st.booleans()),
)
SCENE: Any = {
    "edges": st.integers(1, 12),
    "section": st.sampled_from([SOFT, ROUND, Section(1, 2, 3, EA=40.0)]),
    "supports": st.lists(SUPPORT, max_size=3),
    "loads": st.lists(LOAD, max_size=3),
    "joints": st.one_of(st.just(()), st.just((Joint(("start", "end")),))),
    "space": st.sampled_from(SPACES),
}


def finite(result: pyrod.Equilibrium) -> bool:
    values = [
        getattr(rod, name) for rod in result.rods for name in ("positions", "frames", "force")
    ]
    values += [x for reaction in result.reactions for x in reaction]
    return all(np.isfinite(v).all() for v in [*values, [result.energy, result.residual]])


@settings(max_examples=80)
@given(**SCENE)
def test_random_scenes_are_solved_or_refused_in_words(
    edges: int, section: Section, supports: Any, loads: Any, joints: Any, space: Any
) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # doubts are welcome here
        rod = Rod.straight(1.0, edges, section)
        result = outcome(lambda: solve(Scene(rod, supports, loads, space, joints)))
    if result is None:
        return
    assert finite(result)
    assert max(result.balance) < 1e-9
    assert result.residual < 1e-6 * (1 + sum(np.abs(rod.moment).max() for rod in result.rods))


EXTREME: Any = st.sampled_from([0.0, 1e-320, 1e-150, 1e-9, 1.0, 1e9, 1e150, 1e308, -1e308])


@settings(max_examples=60)
@given(st.tuples(EXTREME, EXTREME, EXTREME), st.tuples(EXTREME, EXTREME, EXTREME), EXTREME)
def test_extreme_numbers_do_no_harm(force: Any, position: Any, stiffness: float) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        supports = [Clamp(), Spring(abs(stiffness), position=position)]
        result = outcome(lambda: solve(Scene(ROD, supports, Force(force))))
    assert result is None or finite(result)


@pytest.mark.parametrize("start", [np.zeros((8, 4)), np.eye(4), np.full((8, 4), nan), "x", [[]]])
def test_starts_are_refused(start: Any) -> None:
    for supports in ([Clamp()], [Clamp(), Hinge(at="end")]):
        with pytest.raises(DOCUMENTED):
            solve(Scene(ROD, supports, Force(X, at=0.5)), start=start)


@pytest.mark.parametrize("section", ["xxx", [SOFT, SOFT, None], lambda s: 3.0, 7, None])
def test_what_is_no_section_is_refused(section: Any) -> None:
    with pytest.raises(TypeError, match=r"Section|not iterable"):
        Rod.straight(1.0, 3, section)


# Mechanisms ---------------------------------------------------------------------------------------

LINK = [STIFF, STIFF.placed(Z)]
BALL = Joint(((0, "end"), (1, "start")), "ball")


@pytest.mark.parametrize("follower", [False, True], ids=["dead", "follower"])
@pytest.mark.parametrize(
    "scene",
    [
        lambda F: Scene(ROD, Slider(Z, at="start", clamped=True), F(Z)),
        lambda F: Scene(ROD, Sleeve(), F(Z)),
        lambda F: Scene(ROD, [Sleeve(), Slider(Z)], F(Z)),
        lambda F: Scene(ROD, Slider(normal=X, at="start", clamped=True), F(Y)),
        lambda F: Scene(ROD, Spring(0.0, 1.0), F(X)),
        lambda F: Scene(ROD, loads=F(X), joints=Joint(("start", "end"))),
        lambda F: Scene(LINK, [Clamp()], F(X)),
    ],
    ids=["slider", "sleeve", "two", "plane", "no spring", "ring", "loose rod"],
)
def test_what_nothing_holds_is_refused(scene: Callable[[Any], Scene], follower: bool) -> None:
    """Of forces that turn with the rod it shows after the solve only, if that comes to an end."""
    at = (1, "end") if "LINK" in scene.__code__.co_names else 0.5
    expected = "^supports: nothing holds the rods against the force" + ("|stalled" * follower)
    with pytest.raises((ValueError, NotConverged) if follower else ValueError, match=expected):
        solve(scene(lambda v: Force(v, at=at, follower=follower)))


def test_a_refusal_says_what_to_do() -> None:
    with pytest.raises(ValueError, match="hold a point of them, or let the loads balance"):
        solve(Scene(ROD, Sleeve(), Force(Z)))
    with pytest.raises(ValueError, match="of the loads that follow them; hold a point of them"):
        solve(Scene(ROD, Sleeve(), Force(Z, follower=True)))


def test_loads_that_balance_need_no_support() -> None:
    """A ring pulled on both sides, and a slider whose line no load has a part in."""
    pulls = [Force((3, 0, 0), at=0.25), Force((-3, 0, 0), at=0.75)]
    ring = solve(Scene(ROD, loads=pulls, joints=Joint(("start", "end"))))
    assert max(ring.balance) < 1e-12
    assert ring.stable
    across = solve(Scene(ROD, Slider(Z, at="start", clamped=True), Force(X)))
    assert across.tip[0] > 0.1


@pytest.mark.parametrize(
    "scene",
    [
        lambda: Scene(STIFF, Hinge(), Moment(Y), "planar"),
        lambda: Scene(STIFF, Hinge(), Force(X, follower=True)),
        lambda: Scene(STIFF, [Hinge(), Hinge(at="end")], Moment(Z, at=0.5)),
        lambda: Scene(STIFF, [Hinge(), Hinge(at="end")], Force(X, at=0.5)),
        lambda: Scene(LINK, [Hinge(), Hinge(2 * Z, at=(1, "end"))], Force(X, at=0.5), joints=BALL),
    ],
    ids=["motor", "rocket", "spindle", "taut", "taut links"],
)
def test_what_has_no_equilibrium_is_reported(scene: Callable[[], Scene]) -> None:
    """A hinge turned by a moment for ever, or a rod that cannot reach: said in words."""
    with pytest.raises(NotConverged, match=r"after \d+ iterations: .{40}"):
        solve(scene())


@pytest.mark.parametrize("end", [Clamp((0, 0, 1.1), at="end"), Hinge((0, 3, 0), at="end")])
def test_a_rod_that_cannot_reach_is_refused(end: Any) -> None:
    with pytest.raises(ValueError, match=r"rod 0 are held \S+ apart, with 1 of a rod .* finite EA"):
        solve(Scene(STIFF, [Clamp(), end]))
    soft = Rod.straight(1.0, 8, pyrod.Section(1, 1, 1, EA=100.0))
    assert solve(Scene(soft, [Clamp(), end])).converged


@pytest.mark.parametrize("load", [X, Z, -Z, np.array([1.0, 2.0, -3.0])])
@pytest.mark.parametrize("space", SPACES)
def test_a_rod_on_one_hinge_swings_into_its_load(load: Any, space: str) -> None:
    if space == "planar":
        load = load * (X + Z)
    r = solve(Scene(STIFF, Hinge(), Force(load), space))
    if (load == -Z).all():
        assert r.index > 0 or np.abs(r.tip + Z).max() < 1e-9
    else:
        assert np.abs(r.tip - load / np.linalg.norm(load)).max() < 1e-9
