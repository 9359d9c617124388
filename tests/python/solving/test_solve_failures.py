"""What a failure tells, and what is doubted though it has converged."""

from __future__ import annotations

import pickle

import numpy as np
import pytest
from support import ROUND, SPACES, solved
from test_solve import EULER

import pyrod
from pyrod import Clamp, Force, Moment, Options, Rod, Scene, Section

# Failures -----------------------------------------------------------------------------------------

HARD = Scene(Rod.straight(1.0, 32, ROUND), Clamp(), Force((10, 0, 0)))
FEW = Options(max_iterations=2)


def test_not_converged_carries_the_last_iterate() -> None:
    with pytest.raises(
        pyrod.NotConverged, match="out_of_iterations after 2 iterations: max_iter"
    ) as caught:
        pyrod.solve(HARD, FEW)
    result = caught.value.result
    assert (result.status, result.iterations, result.converged) == ("out_of_iterations", 2, False)
    assert result.index == -1
    assert np.isfinite(result.positions).all()
    assert pyrod.solve(HARD, start=result).converged


def test_not_converged_can_be_pickled() -> None:
    with pytest.raises(pyrod.NotConverged) as caught:
        pyrod.solve(HARD, FEW)
    copy = pickle.loads(pickle.dumps(caught.value))
    assert str(copy) == str(caught.value)
    assert copy.result == caught.value.result


def test_not_strict_returns_the_last_iterate() -> None:
    result = pyrod.solve(HARD, FEW, strict=False)
    assert result.status == "out_of_iterations"
    assert "out_of_iterations" in repr(result)
    assert "allow more" in result.advice


def test_overflow_is_said_to_be_one() -> None:
    rod = Rod.straight(1e200, 8, ROUND)  # F L is more than a double can hold
    result = solved(rod, Force((1e200, 0, 0)), strict=False)
    assert result.status == "not_finite"
    assert "overflowed" in result.advice
    assert not result.converged


def test_a_converged_result_says_so() -> None:
    result = pyrod.solve(HARD)
    assert (result.status, result.converged, result.stable) == ("converged", True, True)
    assert result.advice == "the last full Newton step was below the tolerance"
    assert result.residual < 1e-12


# Stability ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("load", "section", "planar", "spatial"),
    [
        (0.99, ROUND, 0, 0),
        (1.01, ROUND, 1, 2),  # in space it may fall to all sides: two directions
        (1.01, Section(1, 1.3, 1), 0, 1),  # out of the plane
        (1.01, Section(1.3, 1, 1), 1, 1),
        (1.31, Section(1, 1.3, 1), 1, 2),
        (9.01, ROUND, 2, 4),
    ],
)
def test_index_of_a_compressed_column(
    load: float, section: Section, planar: int, spatial: int
) -> None:
    """Euler: a direction more at each of 1, 9, 25, ... times pi^2 EI/(4 L^2)."""
    for space, index in (("planar", planar), ("spatial", spatial)):
        scene = Scene(Rod.straight(1.0, 64, section), Clamp(), Force((0, 0, -load * EULER)), space)
        result = pyrod.solve(scene, stable=False)
        assert result.index == index
        assert result.stable is (index == 0)
        assert ("stable" if index == 0 else f"index {index}") in repr(result)
        left = pyrod.solve(scene)  # without a warning: warnings are errors here
        assert left.stable
        assert (left.descents > 0) is (index > 0)


@pytest.mark.parametrize("space", SPACES)
def test_a_rod_turned_inside_out_is_doubted(space: str) -> None:
    rod = Rod.straight(1.0, 8, Section(100, 100, 100, EA=1))
    with pytest.warns(pyrod.StrainWarning, match=r"turned inside out"):
        solved(rod, Force((0, 0, -1.5)), space=space)


def test_a_grid_too_coarse_for_its_turns_is_doubted() -> None:
    with pytest.warns(pyrod.StrainWarning, match="more edges are needed"):
        solved(Rod.straight(1.0, 2, ROUND), Moment((0, 7.0, 0)), space="planar")
