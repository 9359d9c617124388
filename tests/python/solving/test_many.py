"""Many scenes at once: the same results as one by one, and nothing lost."""

from __future__ import annotations

import re
from collections.abc import Callable

import numpy as np
import pytest
from support import ROUND, SOFT

import pyrod
from pyrod import Clamp, Force, Hinge, NotConverged, Options, Rod, Scene

RNG = np.random.default_rng(5)
FORCES = RNG.normal(scale=4, size=(9, 3))


def cantilever(force: object, edges: int | None = 12) -> Scene:
    return Scene(Rod.precurved(1.0, edges, SOFT, (0.5, 0.2, 1)), Clamp(), Force(force))


def column(force: object, edges: int | None = 12) -> Scene:
    ends = [Clamp(), Clamp((0.1, 0.2, 0.7), at="end")]
    return Scene(Rod.straight(1.0, edges, SOFT), ends, Force(force, at=0.5))


def same(a: pyrod.Equilibrium, b: pyrod.Equilibrium) -> bool:
    names = ("positions", "frames", "moment", "vertex_force")
    return a.energy == b.energy and all(
        np.array_equal(getattr(x, name), getattr(y, name))
        for x, y in zip(a.rods, b.rods, strict=True)
        for name in names
    )


@pytest.mark.parametrize("make", [cantilever, column])
@pytest.mark.parametrize("tol", [None, 1e-7])
@pytest.mark.parametrize("threads", [0, 1, 2, 5])
def test_the_bits_are_those_of_one_by_one(
    make: Callable[..., Scene], tol: float | None, threads: int
) -> None:
    scenes = [make(f) for f in FORCES]
    together = pyrod.solve_many(scenes, tol=tol, threads=threads)
    alone = [pyrod.solve(make(f), tol=tol) for f in FORCES]
    assert len(together) == len(alone) == len(FORCES)
    assert all(map(same, together, alone))
    assert all(a.index == b.index for a, b in zip(together, alone, strict=True))


def test_saddles_are_left_as_they_are_alone() -> None:
    """Pushed straight beyond Euler's load: the straight rod is an equilibrium, but not stable."""
    scenes = [
        Scene(Rod.straight(1.0, 24, ROUND), Clamp(), Force((0, 0, -f))) for f in (1.0, 5.0, 2.0)
    ]
    results = pyrod.solve_many(scenes)
    assert [r.index for r in results] == [0, 0, 0]
    assert [r.descents > 0 for r in results] == [False, True, False]
    assert same(results[1], pyrod.solve(scenes[1]))


def test_starts_belong_to_their_scenes() -> None:
    scenes = [cantilever(f) for f in FORCES]
    first = pyrod.solve_many(scenes)
    second = pyrod.solve_many(scenes, starts=first)
    assert all(r.iterations == 1 for r in second)
    with pytest.raises(ValueError, match="starts: expected 9, one per scene, got 8"):
        pyrod.solve_many(scenes, starts=first[:-1])
    with pytest.raises(ValueError, match="scene 3: start"):
        pyrod.solve_many(scenes, starts=[*first[:3], np.zeros((12, 4)), *first[4:]])


def test_nothing_is_lost_where_some_fail() -> None:
    scenes = [cantilever(f) for f in (FORCES[0] / 1e3, FORCES[1], FORCES[2] / 1e3)]
    few = Options(max_iterations=3)
    results = pyrod.solve_many(scenes, few, strict=False)
    assert [r.converged for r in results] == [True, False, True]
    with pytest.raises(NotConverged, match="1 of 3 scenes failed; scene 1: out_of_iter") as caught:
        pyrod.solve_many(scenes, few)
    assert all(map(same, caught.value.results, results))
    assert same(caught.value.result, results[1])


def test_what_is_refused_is_named() -> None:
    """Out of the plane: seen by the compiled solver only."""
    leaving = Scene(Rod.straight(1.0, 8, SOFT), Clamp(), Force((0, 1, 0)), "planar")
    scenes = [cantilever(FORCES[0]), cantilever(FORCES[1]), leaving]
    with pytest.raises(ValueError, match=r"scene 2: loads: a force .* leaves the plane"):
        pyrod.solve_many(scenes, threads=2)


def test_progress_is_shown(capsys: pytest.CaptureFixture[str]) -> None:
    seen: list[tuple[int, int]] = []
    scenes = [cantilever(f) for f in FORCES]
    pyrod.solve_many(scenes, progress=lambda done, total: seen.append((done, total)))
    assert seen[-1] == (9, 9)
    assert [done for done, _ in seen] == sorted(done for done, _ in seen)
    pyrod.solve_many(scenes, progress=True)
    bar = capsys.readouterr()
    assert re.search(r"100%\|█+\| 9/9 \[.* scenes/s\]\n$", bar.err)
    assert bar.out == ""


def test_none_at_all() -> None:
    assert pyrod.solve_many([]) == []


def test_one_scene_many_times() -> None:
    """Climbs of one scene wait for each other."""
    scene = Scene(Rod.straight(1.0, None, ROUND), [Clamp(), Hinge((0, 0.3, 0.8), at="end")])
    results = pyrod.solve_many([scene] * 6, tol=1e-6, threads=3)
    assert all(same(r, results[0]) for r in results)
