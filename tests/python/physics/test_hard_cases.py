"""Hard cases: the intended equilibrium, to rounding, in few iterations, with its index."""

from __future__ import annotations

from math import inf, pi

import numpy as np
import pytest
from hard import CASES
from hard.case import Hard, reference
from support import IDENTITY, ROUND, solved

import pyrod
from pyrod import Clamp, Moment, NotConverged, Options, Rod, Scene, Section, StrainWarning

EPSILON = float(np.finfo(float).eps)


def parameter(case: Hard) -> object:
    marks = []
    if case.long:
        marks.append(pytest.mark.long)
    if case.beyond:
        marks.append(pytest.mark.xfail(reason=case.beyond, raises=(AssertionError, NotConverged)))
    return pytest.param(case, id=case.name, marks=marks)


@pytest.mark.parametrize("case", [parameter(case) for case in CASES])
def test_hard_case(case: Hard) -> None:
    result = case.solve()
    assert result.converged
    assert result.iterations <= case.iterations
    # Turns are rounded to an ulp, and the cells make moments of that: EI/h times so much.
    assert result.residual <= case.unit * max(1e-10, 4 * EPSILON * case.n)
    assert max(result.balance) < 1e-12
    assert case.index in (None, result.index)
    check_error(case, result)
    case.also(result)


def check_error(case: Hard, result: pyrod.Equilibrium) -> None:
    """At rounding, or small and of second order."""
    error = case.error(result)
    if case.on_every_grid:
        assert error <= case.on_every_grid
        return
    assert error < 4e-3
    finer = case.error(case.solve(2 * case.n))
    assert finer < case.floor or error / finer > 3.4


def test_there_are_many_and_most_take_few_iterations() -> None:
    reached = [case for case in CASES if not case.beyond and not case.long]
    assert len(reached) >= 40
    assert len({case.name for case in CASES}) == len(CASES)
    few = sum(case.solve().iterations < 15 for case in reached if case.n < 1e5)
    assert few >= 0.8 * len(reached)


# Axial stiffness does not matter ------------------------------------------------------------------


@pytest.mark.parametrize("EA", [1e2, 1e3, 1e4, 1e6, 1e8, 1e12, inf])
def test_a_cantilever_takes_as_many_iterations_whatever_its_axial_stiffness(EA: float) -> None:
    rod = Rod.straight(1.0, 128, Section(1.5, 1.0, 0.8, EA=EA), "extensible")
    assert solved(rod, pyrod.Force((10.0, 0.0, 0.0))).iterations == 5


def test_so_does_a_rod_between_two_clamps() -> None:
    data = reference("S4_generic_iso_stableC").data
    ends = [Clamp(data["r"][0], data["q"][0]), Clamp(data["r"][-1], data["q"][-1], at="end")]

    def iterations(EA: float) -> int:
        rod = Rod.straight(1.0, 128, Section(1.0, 1.0, 0.8, EA=EA), "extensible")
        return pyrod.solve(Scene(rod, ends)).iterations

    # EA = 100 stretches by a tenth: another shape, and another number
    counts = [iterations(EA) for EA in (1e4, 1e5, 1e6, 1e8, 1e12, inf)]
    assert max(counts) - min(counts) <= 1


# At a bifurcation, and on circles of solutions ----------------------------------------------------


def test_at_the_critical_load_the_lowest_eigenvalue_vanishes() -> None:
    n = 128
    critical = (2 * n * np.sin(pi / (4 * n))) ** 2
    rod = Rod.straight(1.0, n, Section(1.5, 1.0, 0.8))
    # of the mode sin(pi s/2): the critical load less the load
    for share, expected in ((1.0, 0.0), (0.9, 0.1 * critical), (1.1, -0.1 * critical)):
        scene = Scene(rod, Clamp(), [pyrod.Force((0.0, 0.0, -share * critical))])
        result = pyrod.solve(scene, stable=False, eigenvalue=True)
        assert result.lowest_eigenvalue == pytest.approx(expected, abs=1e-9)
        np.testing.assert_allclose(result.tip, (0, 0, 1), atol=1e-12)


@pytest.mark.parametrize("n", [64, 128, 256, 512, 1024])
@pytest.mark.parametrize("shortening", [1e-3, 1e-2, 0.1, 0.5])
def test_a_neutral_direction_is_not_taken_for_an_unstable_one(shortening: float, n: int) -> None:
    ends = [Clamp(), Clamp((0, 0, 1 - shortening), IDENTITY, at="end")]
    result = pyrod.solve(Scene(Rod.straight(1.0, n, ROUND), ends), eigenvalue=True)
    assert result.index == 0
    assert abs(result.lowest_eigenvalue) < 1e-8


# Turns of nearly pi from edge to edge, and more ---------------------------------------------------


@pytest.mark.parametrize("turn", [0.9, 0.99])
def test_up_to_half_a_turn_from_edge_to_edge_there_is_no_doubt(turn: float) -> None:
    n, K = 8, turn * pi * 8
    result = solved(Rod.straight(1.0, n, ROUND), Moment((0.0, K, 0.0)))
    np.testing.assert_allclose(result.K, np.tile((0, K, 0), (n + 1, 1)), atol=1e-11)


@pytest.mark.parametrize("turn", [1.01, 1.5, 1.9])
def test_beyond_half_a_turn_from_edge_to_edge_there_is_a_warning(turn: float) -> None:
    with pytest.warns(StrainWarning, match="more edges are needed"):
        result = solved(Rod.straight(1.0, 8, ROUND), Moment((0.0, turn * pi * 8, 0.0)))
    assert result.iterations == 1


def test_beyond_a_whole_turn_from_edge_to_edge_there_is_an_error() -> None:
    with pytest.raises(NotConverged, match="more edges"):
        solved(Rod.straight(1.0, 8, ROUND), Moment((0.0, 2.1 * pi * 8, 0.0)))


def test_at_rest_half_a_turn_from_edge_to_edge_is_refused() -> None:
    with pytest.raises(ValueError, match="turns"):
        Rod.precurved(1.0, 8, ROUND, (0.0, 1.01 * pi * 8, 0.0))


# Failing politely ---------------------------------------------------------------------------------


def test_what_is_out_of_reach_says_so() -> None:
    scene = next(case for case in CASES if case.beyond).scene(128)
    with pytest.raises(NotConverged, match="max_iterations") as caught:
        pyrod.solve(scene, Options(max_iterations=5))
    assert not caught.value.result.converged
