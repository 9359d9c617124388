"""Loads that turn with the rod: they have no potential, and Newton's method is quadratic still."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from support import (
    FLAT,
    SOFT,
    SPACES,
    X,
    Y,
    Z,
    differences,
    extrapolated,
    orders,
    solved,
    table,
)

import pyrod
from pyrod import (
    Clamp,
    DistributedForce,
    DistributedMoment,
    Force,
    Joint,
    Moment,
    Rod,
    Scene,
    solve,
)
from pyrod.rotation import rotate

N = 24
FOLLOWERS = [
    Force((3.0, 1.0, -2.0), follower=True),
    Moment((1.0, -2.0, 0.5), follower=True),
    Force((2.0, 0.0, 1.0), at=0.37, follower=True),
    Moment((1.0, 1.0, 1.0), at=0.6, follower=True),
    DistributedForce((2.0, 3.0, 0.0), follower=True),
    DistributedForce(lambda s: (4 * s, 0.0, -s), follower=True),
    DistributedMoment((1.0, 0.5, -0.5), follower=True),
]
NAMES = [f"{type(f).__name__}-{i}" for i, f in enumerate(FOLLOWERS)]


def spatial(load: Any, **more: Any) -> pyrod.Equilibrium:
    return solved(Rod.straight(1.0, N, SOFT), load, **more)


def quadratic(result: pyrod.Equilibrium) -> bool:
    """Whether the last steps before rounding are each below a multiple of the square before."""
    steps = [s for s in result.record["step"] if s > 1e-7]
    last = result.record["step"][len(steps)]
    return last < 3 * steps[-1] ** 2 + 1e-12


def test_the_follower_at_a_tip() -> None:
    """F L^2/EI = 10 across the tip, Jacobi's functions: of second order to all its digits."""
    exact = table("P6_follower_F10_a90")["values"]
    found = []
    for n in (32, 64, 128, 256):
        r = solved(Rod.straight(1.0, n, FLAT), Force(10 * X, follower=True))
        found.append([r.tip[2], r.tip[0], r.moment[0][1]])
    values = np.array([exact["X_tip"], exact["Y_tip"], exact["root_moment"]])
    errors = np.abs(np.array(found) - values).max(axis=1)
    assert np.abs(orders(errors) - 2).max() < 0.05
    assert np.abs(extrapolated(found) - values).max() < 1e-6


@pytest.mark.parametrize("load", FOLLOWERS, ids=NAMES)
def test_followers_have_no_potential(load: Any) -> None:
    r = spatial(load)
    assert r.index == -1
    assert r.stable is None
    assert "no potential" in repr(r)
    assert max(r.balance) < 1e-13


@pytest.mark.parametrize("load", FOLLOWERS, ids=NAMES)
def test_steps_are_quadratic(load: Any) -> None:
    assert quadratic(spatial(load))


ON_EDGES = [load for load in FOLLOWERS if getattr(load, "at", "end") == "end"]


@pytest.mark.parametrize("load", ON_EDGES, ids=lambda load: type(load).__name__)
def test_frozen_followers_hold_the_same_shape(load: Any) -> None:
    """The forces that followers have become, put on as dead loads, need no step."""
    r = spatial(load)
    rod, frames = r.scene.rod, r.frames
    name = next(name for name in vars(load) if name not in ("at", "rod", "follower"))
    own = getattr(load, name)
    if isinstance(load, (DistributedForce, DistributedMoment)):
        centres = (rod.arc_lengths[1:] + rod.arc_lengths[:-1]) / 2
        own = [own(s) for s in centres] if callable(own) else np.tile(own, (rod.edges, 1))
        dead = type(load)(rotate(frames, np.array(own)))
    else:
        dead = type(load)(rotate(r.tip_frame, own))
    again = solve(Scene(rod, Clamp(), dead), start=frames, stable=False)
    assert differences(again.positions, r.positions) < 1e-8


def test_a_follower_in_the_middle_has_the_components_of_the_frame_there() -> None:
    """What the rod carries before and behind the point differs by the force, turned."""
    force = np.array([2.0, 0.0, 1.0])
    r = spatial(Force(force, at=0.375, follower=True))  # vertex 9
    assert np.abs(r.force[9:]).max() < 1e-14
    assert np.isclose(np.linalg.norm(r.force[0]), np.linalg.norm(force), rtol=1e-12)
    turned = rotate(r.vertex_frames[9], force)
    assert np.linalg.norm(r.force[0] - turned) < 0.1  # half an edge away at the most


@pytest.mark.parametrize("space", SPACES)
def test_in_the_plane_a_follower_moment_is_a_dead_one(space: str) -> None:
    rod = Rod.straight(1.0, N, FLAT)
    dead = solved(rod, Moment(2 * Y), Force(3 * X), space=space)
    follower = solved(rod, Moment(2 * Y, follower=True), Force(3 * X), space=space)
    assert differences(follower.positions, dead.positions) < 1e-9
    assert np.isclose(follower.energy, dead.energy, rtol=1e-9)


def test_an_end_moment_that_follows_makes_a_helix() -> None:
    """EI = GJ: constant K = M/EI in the frames, exact at any n."""
    section = pyrod.Section(2.0, 2.0, 2.0)
    M = np.array([1.0, -2.0, 3.0])
    r = solved(Rod.straight(1.0, 7, section), Moment(M, follower=True))
    assert np.abs(r.K - M / 2).max() < 1e-9
    assert np.isclose(r.energy, M @ M / 4, rtol=1e-9)
    dead = solved(Rod.straight(1.0, 7, section), Moment(rotate(r.tip_frame, M)))
    assert differences(dead.positions, r.positions) < 1e-8


@pytest.mark.parametrize("space", SPACES)
def test_pressure_on_a_ring(space: str) -> None:
    """The ring stays a polygon; its edges carry p h/(2 tan(pi/n)) each."""
    n, p = 24, 5.0
    joint = Joint(("start", "end"))
    free = solve(Scene(Rod.straight(1.0, n, FLAT), space=space, joints=joint))
    inwards = -np.sign(
        rotate(free.frames[0], X) @ (free.positions[0] - free.positions.mean(axis=0))
    )
    scene = Scene(
        Rod.straight(1.0, n, FLAT),
        loads=DistributedForce(inwards * p * X, follower=True),
        space=space,
        joints=joint,
    )
    r = solve(scene, start=free)
    assert np.isclose(r.energy, 2 * np.pi**2, rtol=1e-9)
    assert np.allclose(r.material_force, -p / n / 2 / np.tan(np.pi / n) * Z, rtol=0, atol=1e-8)
    assert r.index == -1


def test_pressure_on_a_cantilever_turns_with_it() -> None:
    """Small: w L^4/8 EI. Large: the rod is bent beyond what a dead load can bend it to."""
    small = [
        solved(Rod.straight(1.0, n, FLAT), DistributedForce(1e-5 * X, follower=True)).tip[0]
        for n in (8, 16, 32, 64)
    ]
    assert abs(extrapolated(small) / 1e-5 - 1 / 8) < 1e-8
    rod = Rod.straight(1.0, 64, FLAT)
    r = solved(rod, DistributedForce(30 * X, follower=True))
    dead = solved(rod, DistributedForce(30 * X))
    assert rotate(dead.tip_frame, Z)[2] > 0 > rotate(r.tip_frame, Z)[2]


CURVED = {"end": [Clamp()], "start": [Clamp((0.0, 0.0, 0.0), at="end")]}
PULL = (2.0, 1.0, -3.0)


def curved(at: str, n: int | None, **more: Any) -> pyrod.Equilibrium:
    """A rod that is curved and twisted at rest, pulled in the frame of its free end."""
    rod = Rod.precurved(1.0, n, SOFT, lambda s: (0.5, 2.0 - s, 1.0 + s))
    return solve(Scene(rod, CURVED[at], Force(PULL, at=at, follower=True)), **more)


@pytest.mark.parametrize("at", CURVED)
def test_at_an_end_it_has_the_components_of_the_frame_of_the_end(at: str) -> None:
    result = curved(at, 16)
    end, sign = (-1, 1) if at == "end" else (0, -1)
    expected = rotate(result.vertex_frames[end], np.array(PULL))
    np.testing.assert_allclose(sign * result.force[end], expected, atol=1e-12)


@pytest.mark.parametrize("at", CURVED)
def test_at_the_end_of_a_curved_rod_it_converges_with_order_two(at: str) -> None:
    exact = curved(at, None, tol=1e-9)
    assert exact.accuracy is not None
    assert exact.accuracy.regular
    free = -1 if at == "end" else 0
    errors = [
        np.linalg.norm(curved(at, n).positions[free] - exact.positions[free]) for n in (32, 64, 128)
    ]
    assert (np.abs(orders(errors) - 2) < 0.1).all(), errors
