"""Reactions and loads balance to rounding, in random scenes of every kind."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from support import MODELS, SOFT, SPACES, X, Y, Z, about_y, random_frames, unit

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
    Pivot,
    Rod,
    Scene,
    Section,
    Sleeve,
    Slider,
    Spring,
    solve,
)
from pyrod.rotation import exp

HEAVY = Section(1.0, 1.3, 0.8, 60.0, 80.0, 150.0, mass_per_length=0.2)
Random = np.random.Generator


def draw(rng: Random, size: float, space: str = "spatial") -> np.ndarray:
    """A vector; in a planar scene in the plane x, z."""
    v = rng.normal(size=3) * size
    return v * (X + Z) if space == "planar" else v


def turn(rng: Random, size: float, space: str) -> np.ndarray:
    """A vector of turns or moments; in a planar scene about y."""
    v = rng.normal(size=3) * size
    return v * Y if space == "planar" else v


SUPPORTS: dict[str, Callable[[Random, str], Any]] = {
    "clamp": lambda g, s: Clamp(Z + draw(g, 0.05, s), exp(turn(g, 0.3, s)), at="end"),
    "hinge": lambda g, s: Hinge(at=float(g.uniform(0.3, 1.0))),
    "line": lambda g, s: Slider(unit(draw(g, 1, s)), at=float(g.uniform(0.3, 1.0))),
    "plane": lambda g, s: Slider(normal=draw(g, 1, s), clamped=True),
    "sleeve": lambda g, s: Sleeve(frame=exp(turn(g, 0.2, s)), at="end"),
    "pivot": lambda g, s: Pivot(Y if s == "planar" else draw(g, 1), at=0.61),
    "spring": lambda g, s: Spring(3.0, 2.0, Z + draw(g, 0.2, s), exp(turn(g, 0.3, s)), at=0.7),
}

LOADS: dict[str, Callable[[Random, str], Any]] = {
    "force": lambda g, s: Force(draw(g, 2, s), at=float(g.uniform(0, 1))),
    "moment": lambda g, s: Moment(turn(g, 0.5, s), at=float(g.uniform(0, 1))),
    "distributed force": lambda g, s: DistributedForce(draw(g, 2, s)),
    "distributed moment": lambda g, s: DistributedMoment(turn(g, 0.5, s)),
    "gravity": lambda g, s: Gravity(draw(g, 5, s)),
    "following force": lambda g, s: Force(draw(g, 1, s), float(g.uniform(0, 1)), True),
    "following moment": lambda g, s: Moment(turn(g, 0.5, s), "end", True),
    "pressure": lambda g, s: DistributedForce(draw(g, 1, s), follower=True),
}


def balanced(result: pyrod.Equilibrium) -> None:
    assert result.converged
    assert max(result.balance) < 1e-12


@pytest.mark.parametrize("space", SPACES)
@pytest.mark.parametrize("load", LOADS)
@pytest.mark.parametrize("support", SUPPORTS)
def test_a_rod_on_two_supports(support: str, load: str, space: str) -> None:
    seed = list(SUPPORTS).index(support) * len(LOADS) + list(LOADS).index(load)
    rng = np.random.default_rng(seed)
    K0 = turn(rng, 0.5, space)
    rod = Rod.precurved(1.0, int(rng.integers(3, 30)), HEAVY, K0 * (Y if space == "planar" else 1))
    loads = [LOADS[load](rng, space), Force(draw(rng, 0.5, space), at=0.2)]
    held = SUPPORTS[support](rng, space)
    balanced(solve(Scene(rod, [Clamp(), held], loads, space), stable=False))


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize("seed", range(6))
def test_a_tree_of_rods(seed: int, model: Any) -> None:
    """A trunk in any place, with boughs at any angle, rigid or on balls, some held again."""
    rng = np.random.default_rng(seed)
    q = random_frames(rng)
    trunk = Rod.precurved(1.0, 8, HEAVY, turn(rng, 0.5, "spatial"), model).placed(draw(rng, 3), q)
    tip = trunk.at_rest()[0][-1]
    rods = [
        trunk,
        *(Rod.straight(0.7, 6, HEAVY, model).placed(tip, f) for f in random_frames(rng, 3)),
    ]
    points = [(0, "end"), (1, "start"), (2, "start")]
    joints = [
        Joint(points),
        Joint(((1, 0.3), (3, 0.2)), "ball" if seed % 2 else "rigid", aligned=False),
    ]
    supports = [Clamp(), Spring(4.0, 1.0, at=(3, "end"))]
    if seed % 3 == 0:
        supports.append(Slider(draw(rng, 1), at=(2, "end")))
    loads = [Force(draw(rng, 0.5), at=(i, "end")) for i in range(4)]
    balanced(solve(Scene(rods, supports, [*loads, Gravity()], joints=joints), stable=False))


@pytest.mark.parametrize("space", SPACES)
def test_reactions_add_up_to_the_dead_loads(space: str) -> None:
    """By arithmetic on the arguments alone, without anything that the result says of loads."""
    rod = Rod.straight(2.0, 16, HEAVY)
    loads = [Force((1, 0, -2), at=0.77), DistributedForce((0.5, 0, 0.25)), Gravity((0, 0, -1))]
    supports = [Clamp(), Spring(3.0, at=1.3), Slider((1, 0, 1))]
    r = solve(Scene(rod, supports, loads, space))
    total = np.sum([x.force for x in r.reactions], axis=0)
    assert np.abs(total + np.array([2.0, 0.0, -1.9])).max() < 1e-13
    spring = r.reactions[1].force
    vertex = int(np.abs(r.s - 1.3).argmin())
    assert np.abs(spring + 3 * (r.positions[vertex] - 1.3 * Z)).max() < 1e-12
    slope = (X + Z) / np.sqrt(2)
    assert abs(r.reactions[2].force @ slope) < 1e-12


def test_balance_tells_what_is_missing() -> None:
    """A result whose reactions are forged is out of balance by what they were changed."""
    from dataclasses import replace

    r = solve(Scene(Rod.straight(1.0, 8, SOFT), [Clamp(), Hinge(at="end")], Force(X, at=0.5)))
    forged = replace(r, reactions=(r.reactions[0], pyrod.Reaction(0 * X, 0 * X)))
    missing = np.linalg.norm(r.reactions[1].force)
    section = np.linalg.norm(r.force, axis=1).max()
    rest = 1 + np.linalg.norm(r.reactions[0].force) + section
    assert forged.balance[0] == pytest.approx(missing / rest, rel=1e-12)
    assert forged.balance[1] > 0.1


def test_a_closed_ring_has_nothing_to_balance() -> None:
    r = solve(Scene(Rod.straight(1.0, 12, SOFT), joints=Joint(("start", "end"))))
    assert r.reactions == ()
    assert np.abs(r.force).max() < 1e-12
    assert np.ptp(np.linalg.norm(r.moment, axis=1)) < 1e-9


def test_prescribed_turns_are_balanced_too() -> None:
    scene = Scene(
        Rod.straight(1.0, 16, SOFT), [Clamp(), Clamp(0.9 * Z, about_y(1.0), at="end", turns=1)]
    )
    balanced(solve(scene))
