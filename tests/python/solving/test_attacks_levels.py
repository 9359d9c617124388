"""A place is the same vertex, by number, on every level of a climb."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np
import pytest

import pyrod
from pyrod import (
    Clamp,
    DistributedForce,
    DistributedMoment,
    Force,
    Hinge,
    Joint,
    Moment,
    Options,
    Rod,
    Scene,
    Section,
    Slider,
    Spring,
)

SOFT = Section(1.3, 0.8, 1, EA=100.0)
ROUND = Section(1, 1, 1)
PLACES = (0.1, 0.3, 0.7, 0.77, 0.93, 1 / 3, 0.4234658589667165, 0.5016407467813933)


def follows(s: float) -> np.ndarray:
    return np.array([1.0, np.sin(2 * s), 1 + s])


def test_a_place_that_was_looked_up_again() -> None:
    """Memory was written past its end; valgrind told."""
    rod = Rod.straight(1.0, None, SOFT)
    loads = [
        Force((0.163, 0.638, -1.898), at=0.4234658589667165, follower=True),
        DistributedForce(follows, follower=True),
    ]
    slide = Slider(along=(0.034, -0.895, 0.445), position=(0.366, 0.539, 0.085))
    spring = Spring(74.53, 1.5, (0.178, 0.262, 0.041), at=0.5016407467813933)
    scene = Scene(rod, [Clamp(), slide, spring], loads)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        result = pyrod.solve(scene, Options(max_edges=2**12), tol=1e-6, strict=False)
    assert result.status in ("converged", "not_accurate", "stalled")  # an answer, or a refusal
    assert np.isfinite(result.positions).all()
    check_levels(scene, 10)


@pytest.mark.parametrize("at", [0.3, 0.7, 0.77, 0.93])
def test_a_spring_beside_a_load_that_jumps(at: float) -> None:
    """It was refused: "start: expected 32769 rows, got 32768"."""
    rod = Rod.straight(1.0, None, ROUND)
    load = DistributedForce(lambda s: (0, 0, 0) if s < 0.6 else (5.0, 0, 0))
    result = pyrod.solve(Scene(rod, [Clamp(), Spring(70.0, at=at)], load), tol=1e-6)
    assert result.accuracy.regular
    held = Scene(rod, [Clamp(), Hinge((0.1, 0, 0.9 * at), at=at)], load)
    options = Options(max_edges=2**15)
    assert np.isfinite(pyrod.solve(held, options, tol=1e-6, strict=False).tip).all()


def check_levels(scene: Scene, deepest: int) -> None:
    """Every level has the edges of level 0, cut, and its nodes on the same vertices."""
    edges, attached, _ = scene._compiled.level(0)
    assert edges == [rod.edges for rod in scene._climbing.rods]
    for level in range(1, deepest + 1):
        finer, there, _ = scene._compiled.level(level)
        assert finer == [count << level for count in edges]
        assert there == [(rod, vertex << level) for rod, vertex in attached]


@pytest.mark.parametrize("n", [7, 16, None])
def test_point_loads_are_on_one_vertex_of_every_level(n: int | None) -> None:
    """Also where their arc length is not that of the vertex, to the last bit."""
    for at in PLACES:
        loads = [Force((1, 2, 3), at=at), Moment((0, 1, 0), at=at)]
        scene = Scene(Rod.straight(1.0, n, ROUND), Clamp(), loads)
        vertex = int(np.abs(scene._climbing.rod.arc_lengths - at).argmin())
        for level in (0, 1, 5, 12):
            force, moment, *_ = scene._compiled.level(level)[2][0]
            assert np.flatnonzero(force.any(axis=1)).tolist() == [vertex << level]
            assert np.array_equal(force[vertex << level], (1, 2, 3))
            beside = np.flatnonzero(moment.any(axis=1)).tolist()
            assert beside == [(vertex << level) - 1, vertex << level]
            assert np.allclose(moment[beside].sum(axis=0), (0, 1, 0), rtol=0, atol=1e-15)
            assert (moment[beside, 1] > 0.01).all()


def test_loads_without_functions_are_the_same_by_either_way() -> None:
    """Levels that ask a function of Python, and those that do not."""
    loads: list[Any] = [
        Force((1, 0.5, -1), at=0.7),
        Moment((0.1, 0.2, 0), at=0.3),
        Force((0.3, 0, 0), at=0.77, follower=True),
        Moment((0, 0.2, 0.1), at=0.93, follower=True),
        DistributedForce((0.5, 0, -1)),
    ]
    rod = Rod.straight(1.0, 10, SOFT)
    asked = [*loads, DistributedForce(lambda s: (0.0, 0.0, 0.0))]
    for held in ([Clamp()], [Clamp(), Spring(9.0, at=0.45)]):
        plain, other = (Scene(rod, held, acting) for acting in (loads, asked))
        options = Options(max_edges=2**11)
        a, b = (pyrod.solve(x, options, tol=1e-9, strict=False) for x in (plain, other))
        assert a.accuracy.grids == b.accuracy.grids
        assert np.abs(a.positions - b.positions).max() < 1e-11


# Random scenes ------------------------------------------------------------------------------------


def random_load(rng: np.random.Generator) -> Any:
    at = float(rng.choice([rng.uniform(0.02, 0.98), rng.choice(PLACES)]))
    v = rng.normal(size=3)
    step = rng.uniform(0.1, 0.9)
    kinds = (
        lambda: Force(v, at=at, follower=bool(rng.integers(2))),
        lambda: Force(v, follower=bool(rng.integers(2))),
        lambda: DistributedForce(lambda s: v * np.sin(3 * s), follower=bool(rng.integers(2))),
        lambda: DistributedForce(lambda s: v * (s < step)),
        lambda: DistributedForce(lambda s: v * abs(s - step), follower=True),
        lambda: DistributedMoment(lambda s: 0.3 * v * (s > step)),
        lambda: DistributedForce(v),
    )
    return kinds[rng.integers(len(kinds))]()


def random_scene(rng: np.random.Generator, n: int | None) -> Scene:
    section = (SOFT, ROUND, Section(1.0, 1.3, 0.8, 60, 80, 150))[rng.integers(3)]
    rods = [Rod.straight(1.0, n, section)]
    supports: list[Any] = [Clamp()]
    for at in rng.choice(PLACES, 2, replace=False):
        kind = rng.integers(3)
        r = np.array([0, 0, at]) + 0.02 * rng.normal(size=3)
        if kind == 0:
            supports.append(Spring(float(rng.uniform(5, 50)), position=tuple(r), at=float(at)))
        elif kind == 1:
            along = np.array([0.3, 0.2, 1])
            supports.append(Slider(tuple(along), position=tuple(r), at=float(at)))
    joints = []
    if rng.integers(3) == 0:
        at = float(rng.uniform(0.1, 0.9))
        branch = Rod.straight(0.4, n, section).placed((0, 0, at), tangent=(1, 0, 0))
        rods.append(branch)
        joints.append(Joint(((0, at), (1, "start")), "ball" if rng.integers(2) else "rigid"))
        supports.append(Spring(20.0, at=(1, "end")))
    loads = [random_load(rng) for _ in range(rng.integers(1, 4))]
    return Scene(rods, supports, loads, joints=joints)


def check_random(number: int) -> bool:
    """Whether both climbs, from other edges, converge; then they agree within what they tell."""
    results = []
    for n in (None, 7):
        scene = random_scene(np.random.default_rng(number), n)
        check_levels(scene, 4)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            options = Options(max_edges=2**12)
            results.append(pyrod.solve(scene, options, tol=1e-5, strict=False))
    a, b = results
    if not (a.converged and b.converged and a.index == b.index):
        return False
    told = a.errors["positions"] + b.errors["positions"]
    near = np.linalg.norm(a.rods[0].tip - b.rods[0].tip)
    assert near <= told or near > 1e-2, (number, near, told)  # else another equilibrium
    return True


def test_random_places_levels_and_loads() -> None:
    assert sum(check_random(number) for number in range(12)) >= 6


@pytest.mark.long
@pytest.mark.parametrize("number", range(100, 500))
def test_many_random_places_levels_and_loads(number: int) -> None:
    check_random(number)
