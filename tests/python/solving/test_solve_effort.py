"""Solving: how many iterations it takes, and from which starts."""

from __future__ import annotations

import warnings

import numpy as np
import pytest
from support import IDENTITY, MODELS, ROUND, SOFT, SPACES, differences, solved, unit, work
from test_solve import EULER

import pyrod
from pyrod import Clamp, Force, Moment, Rod, Scene, Section, rotation

# Effort -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("space", SPACES)
@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize("EA", [1e2, 1e4, 1e6, 1e8])
@pytest.mark.parametrize("load", [1, 10, 100, 1000])
def test_iterations_from_the_straight_start(load: float, EA: float, model: str, space: str) -> None:
    section = Section(1, 1, 1, EA / 2.6, EA / 2.6, EA)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", pyrod.StrainWarning)  # EA = 100 under 1000
        result = solved(Rod.straight(1.0, 64, section, model), Force((load, 0, 0)), space=space)
    assert result.iterations <= 8
    assert result.stable


def forces_within(angle: float, count: int, seed: int) -> np.ndarray:
    """Forces from 1 to 1000 whose directions are within an angle [degrees] of e3."""
    rng = np.random.default_rng(seed)
    directions = unit(rng.normal(size=(4 * count, 3)))
    directions = directions[directions[:, 2] > np.cos(np.radians(angle))][:count]
    return directions * 10 ** rng.uniform(0, 3, (count, 1))


def test_iterations_of_an_anisotropic_precurved_rod_in_space() -> None:
    rod = Rod.precurved(1.0, 64, Section(1, 2.5, 0.8), (0.6, 1.2, 0.9))
    forces = forces_within(120, 100, seed=0)
    assert len(forces) == 100
    counts = [solved(rod, Force(force)).iterations for force in forces]
    assert max(counts) <= 12
    assert np.median(counts) <= 7


@pytest.mark.parametrize("space", SPACES)
def test_a_hundred_thousand_edges(space: str) -> None:
    result = solved(Rod.straight(1.0, 100_000, ROUND), Force((10, 0, 0)), space=space)
    assert work(result) <= 3
    coarse = [
        solved(Rod.straight(1.0, n, ROUND), Force((10, 0, 0)), space=space).tip for n in (500, 1000)
    ]
    limit = (4 * coarse[1] - coarse[0]) / 3
    np.testing.assert_allclose(result.tip, limit, rtol=0, atol=1e-9)


@pytest.mark.parametrize("moment", [(0, 2, 0), (1, 2, 0.5), (2, -3, 4)])
def test_dead_moments_in_space_converge_quadratically(moment) -> None:
    """The tangent is not symmetric; with all of it each step is of the order of the last one's
    square, here at most four times that."""
    result = solved(Rod.straight(1.0, 64, Section(1, 2, 0.7)), Force((1, 2, 3)), Moment(moment))
    steps = result.record["step"]
    assert result.record["exact"][-3:].all()
    assert steps[-1] < 1e-8
    near = steps < 0.2
    assert near.sum() >= 3
    for before, after in zip(steps[near], steps[near][1:], strict=False):
        assert after < 4 * before**2


# Starts -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("space", SPACES)
def test_a_start_near_the_solution_saves_iterations(space: str) -> None:
    rod = Rod.straight(1.0, 64, SOFT)
    before = solved(rod, Force((10, 0, 1)), space=space)
    scene = Scene(rod, Clamp(), Force((10.5, 0, 1)), space)
    cold, warm = pyrod.solve(scene), pyrod.solve(scene, start=before)
    assert warm.iterations < cold.iterations
    assert differences(warm.positions, cold.positions) < 1e-12
    assert pyrod.solve(scene, start=cold).iterations == 1


@pytest.mark.parametrize("as_matrices", [False, True])
@pytest.mark.parametrize("space", SPACES)
def test_frames_may_start_a_solve(space: str, as_matrices: bool) -> None:
    clamp = Clamp(tangent=(1, 1, 0), normal=(0, 0, 1))
    scene = Scene(Rod.straight(1.0, 32, ROUND), clamp, Force((0, 0, 5)), space)
    solution = pyrod.solve(scene)
    signs = np.random.default_rng(1).choice([-1, 1], (32, 1))
    start = rotation.to_matrix(solution.frames) if as_matrices else signs * solution.frames
    again = pyrod.solve(scene, start=start)
    assert again.iterations == 1
    assert differences(again.frames, solution.frames) < 1e-13  # signs are those of the clamp


def test_a_start_decides_between_equilibria() -> None:
    scene = Scene(Rod.straight(1.0, 64, ROUND), Clamp(), Force((0, 0, -1.3 * EULER)), "planar")
    arcs = [Rod.precurved(1.0, 64, ROUND, (0, K, 0)).at_rest()[1] for K in (2, -2)]
    left, right = (pyrod.solve(scene, start=arc) for arc in arcs)
    assert left.stable
    assert right.stable
    assert left.tip[0] > 0.5
    assert differences(right.positions * [-1, 1, 1], left.positions) < 1e-12


@pytest.mark.parametrize(
    ("start", "message"),
    [
        (np.tile(IDENTITY, (9, 1)), "start: expected 8 rows"),
        (np.zeros((8, 3)), "start: expected quaternions"),
        (np.zeros((8, 4)), "expected a unit quaternion"),
        (np.full((8, 4), np.nan), "expected finite numbers|expected a unit quaternion"),
    ],
)
def test_starts_that_do_not_fit_are_refused(start, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        solved(Rod.straight(1.0, 8, ROUND), start=start)


def test_an_equilibrium_of_another_grid_is_refused_as_a_start() -> None:
    with pytest.raises(ValueError, match="start: expected 8 rows"):
        solved(Rod.straight(1.0, 8, ROUND), start=solved(Rod.straight(1.0, 9, ROUND)))
