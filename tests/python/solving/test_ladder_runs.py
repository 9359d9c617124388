"""Solving to a tolerance: starts, repetitions, threads, Ctrl-C, pickles."""

from __future__ import annotations

import pickle
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from interrupt import ctrl_c_after, needs_ctrl_c
from support import ROUND, SOFT, Y, differences
from test_ladder import BENT, arch, bent, same

import pyrod
from pyrod import Clamp, DistributedForce, Moment, Rod, Scene

# Starts, repetitions, threads ---------------------------------------------------------------------


@pytest.mark.parametrize("scene", [bent, arch])
def test_a_climb_starts_from_an_equilibrium(scene: object) -> None:
    first = pyrod.solve(scene(), tol=1e-8)
    second = pyrod.solve(scene(), tol=1e-8, start=first)
    assert second.iterations < first.iterations
    assert differences(second.positions, first.positions) < 1e-8
    third = pyrod.solve(scene(), tol=1e-8, start=first.frames)
    assert differences(third.positions, first.positions) < 1e-8
    with pytest.raises(ValueError, match="start: expected"):
        pyrod.solve(scene(), tol=1e-8, start=first.frames[:-1])


@pytest.mark.parametrize("scene", [bent, arch])
def test_a_second_climb_gives_the_same_bits(scene: object) -> None:
    made = scene()
    first = pyrod.solve(made, tol=1e-8)
    assert same(pyrod.solve(made, tol=1e-8), first)
    pyrod.solve(made, tol=1e-4)
    pyrod.solve(made, tol=1e-10)
    assert same(pyrod.solve(made, tol=1e-8), first)
    assert same(pyrod.solve(scene(), tol=1e-8), first)


@pytest.mark.parametrize("scene", [bent, arch])
def test_threads_that_climb_one_scene_get_the_same_bits(scene: object) -> None:
    made = scene()
    with ThreadPoolExecutor(4) as pool:
        results = list(pool.map(lambda tol: pyrod.solve(made, tol=tol), [1e-8, 1e-6] * 8))
    for tol, result in zip([1e-8, 1e-6] * 8, results, strict=True):
        assert same(result, pyrod.solve(scene(), tol=tol))


def test_each_iteration_of_each_grid_is_printed(capsys: pytest.CaptureFixture[str]) -> None:
    result = pyrod.solve(bent(), tol=1e-8, verbose=True)
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == result.iterations + 1
    assert result.iterations == len(result.record["step"]) > result.accuracy.grids


@needs_ctrl_c
def test_ctrl_c_stops_a_climb(monkeypatch: pytest.MonkeyPatch) -> None:
    """Pressed while a grid of fifty thousand edges, or twice that, is solved."""
    scene = bent(50_000)
    with ctrl_c_after(6, monkeypatch) as lines:
        pyrod.solve(scene, tol=1e-9, verbose=True)
    assert 6 <= len(lines) <= 9
    assert same(pyrod.solve(bent(), tol=1e-8), pyrod.solve(bent(), tol=1e-8))


# Pickles ------------------------------------------------------------------------------------------


def curvature(s: float) -> tuple[float, float, float]:
    return (0.5, float(np.sin(3 * s)), 1 - s)


def test_results_and_scenes_survive_a_pickle() -> None:
    scene = Scene(Rod.precurved(1.0, None, SOFT, curvature), Clamp(), BENT)
    result = pyrod.solve(scene, tol=1e-8)
    back = pickle.loads(pickle.dumps(result))
    assert same(back, result)
    copy = pickle.loads(pickle.dumps(scene))
    assert copy == scene
    assert same(pyrod.solve(copy, tol=1e-8), result)
    assert copy.rod.with_vertices(0.7).edges == scene.rod.with_vertices(0.7).edges


def test_functions_that_cannot_be_pickled_become_tables() -> None:
    """Linear between the vertices, and no longer on edges that the solver chooses."""
    rod = Rod.precurved(1.0, None, SOFT, lambda s: curvature(s))
    copy = pickle.loads(pickle.dumps(rod))
    assert np.array_equal(copy.K0, rod.K0)
    assert repr(copy).endswith("edges=16)")
    finer = copy.with_vertices(copy.edge_lengths[0] / 2)
    assert np.allclose(finer.K0[1], (rod.K0[0] + rod.K0[1]) / 2, rtol=1e-15)
    load = DistributedForce(lambda s: (s, 0, 1))
    scene = pickle.loads(pickle.dumps(Scene(rod, Clamp(), load)))
    assert scene.loads[0].force_per_length.shape == (16, 3)


def test_turns_between_the_vertices_that_are_told_do_not_matter() -> None:
    """Ten turns on 16 edges: each turns by more than half a turn, on finer grids by less."""
    moment = 2 * np.pi * 10 * ROUND.EI2
    scene = Scene(Rod.straight(1.0, None, ROUND), Clamp(), Moment(moment * Y), "planar")
    result = pyrod.solve(scene, tol=1e-8)
    assert np.abs(result.tip).max() < 1e-8
    assert result.energy == pytest.approx(moment**2 / 2, rel=1e-8)
