"""Sweeps in this process: their cases, what is kept of them, and those that fail."""

from __future__ import annotations

import re
from collections.abc import Callable
from itertools import product
from typing import Any

import numpy as np
import pandas as pd
import pytest
from support import ROUND
from sweeps import GRID, cantilever, shape, sweep

from pyrod import Clamp, Force, Options, Rod, Scene, Section, Slider, solve


def column(load: float) -> Scene:
    """A column that buckles in its plane at pi^2/4, pushed a little to the side."""
    return Scene(Rod.straight(1.0, 16, ROUND), Clamp(), Force((1e-3, 0, -load)), "planar")


# Cases --------------------------------------------------------------------------------------------


def test_a_grid_is_solved_in_all_combinations() -> None:
    done = sweep(cantilever, GRID)
    assert len(done) == 30
    assert done.shape == done["energy"].shape == done["load"].shape == (5, 6)
    assert done["tip"].shape == (5, 6, 3)
    for (i, load), (j, angle) in product(enumerate(GRID["load"][:4]), enumerate(GRID["angle"])):
        alone = solve(cantilever(load, angle))
        np.testing.assert_array_equal(done["tip"][i, j], alone.tip)
        assert done["energy"][i, j] == alone.energy
        assert (done["load"][i, j], done["angle"][i, j]) == (load, angle)
        assert done.case(6 * i + j) == {"load": load, "angle": angle}


LIST = [{"load": 1.0, "angle": 0.3}, {"angle": 2.0, "load": 0.1}, {"load": 1.0, "angle": 0.3}]


@pytest.mark.parametrize("listed", [LIST, tuple(LIST), pd.DataFrame(LIST)], ids=["l", "t", "df"])
def test_a_list_of_cases_is_solved_in_its_order(listed: Any) -> None:
    done = sweep(cantilever, listed)
    assert done.shape == (3,)
    assert [done.case(i) for i in range(3)] == LIST
    expected = [solve(cantilever(**case)).energy for case in LIST]
    assert list(done["energy"]) == expected


def test_functions_get_numbers_of_python() -> None:
    got: list[Any] = []

    def noting(a: Any, b: Any) -> Scene:
        got.append((type(a), type(b)))
        return column(1.0)

    sweep(noting, {"a": np.arange(2), "b": np.linspace(0, 1, 1)})
    assert got == [(int, float)] * 2


REFUSED: list[tuple[Any, type[Exception], str]] = [
    ({}, ValueError, "there is none"),
    ({"load": []}, ValueError, "'load' has no values"),
    ({"load": 3.0}, TypeError, "'load' needs a list of values, got 3.0"),
    ({"load": "abc"}, TypeError, "'load' needs a list of values, got 'abc'"),
    ({3: [1.0]}, TypeError, "names are strings, got 3"),
    ({"time": [1.0]}, ValueError, "'time' is a column of every sweep"),
    ({"weight": [1.0]}, TypeError, r"column\(weight\) cannot be called .*: 'load'"),
    ([], ValueError, "there are no cases"),
    (3, TypeError, "expected lists of values by name, a list of cases or a DataFrame, got a int"),
    ("load", TypeError, "got a str"),
    ([{"load": 1}, 2], TypeError, "case 1 needs values by name, got a int"),
    ([{"load": 1}, {"lood": 1}], ValueError, r"case 1 has \['lood'\], but case 0 \['load'\]"),
]


@pytest.mark.parametrize(("parameters", "kind", "message"), REFUSED)
def test_parameters_that_mean_nothing_are_refused(
    parameters: Any, kind: type[Exception], message: str
) -> None:
    with pytest.raises(kind, match=message):
        sweep(column, parameters)


@pytest.mark.parametrize(
    ("more", "kind", "message"),
    [
        ({"tol": -1.0}, ValueError, "tol: must be a number"),
        ({"model": "stiff"}, ValueError, "model: expected 'auto', cosserat"),
        ({"model": "auto"}, ValueError, "model: 'auto' needs tol"),
        ({"start": "next"}, ValueError, "start: expected 'previous'"),
        ({"executor": 4}, TypeError, "executor: expected None, .* got a int"),
        ({"store": "x", "keep_results": True}, ValueError, "keep_results: a store holds no"),
    ],
)
def test_bad_settings_are_refused(more: Any, kind: type[Exception], message: str) -> None:
    with pytest.raises(kind, match=message):
        sweep(column, {"load": [1.0]}, **more)


def test_what_makes_no_scenes_is_refused() -> None:
    with pytest.raises(TypeError, match=r"scene: expected a function .* got a int"):
        sweep(3, {"load": [1.0]})


# Measures -----------------------------------------------------------------------------------------


def test_what_is_kept_unless_asked() -> None:
    done = sweep(column, {"load": [1.0, 5.0]}, tol=1e-5, eigenvalue=True)
    for i, load in enumerate((1.0, 5.0)):
        alone = solve(column(load), tol=1e-5, eigenvalue=True)
        assert done["status"][i] == "converged"
        assert done["iterations"][i] == alone.iterations
        assert done["index"][i] == 0
        assert done["lowest_eigenvalue"][i] == alone.lowest_eigenvalue
        assert done["estimated_error"][i] == alone.accuracy.reached
        assert done["largest_K"][i] == alone.largest_K
        assert done["largest_K"][i] == pytest.approx(np.abs(alone.K[:, 1]).max(), rel=1e-4)
        assert done["largest_moment"][i] == alone.largest_moment
        assert done["largest_force"][i] == pytest.approx(np.hypot(load, 1e-3), rel=1e-9)
        assert 0 < alone.time * 0.01 < done["time"][i] < 10
    assert done.results is None
    plain = sweep(column, {"load": [1.0]})
    assert not {"lowest_eigenvalue", "estimated_error"} & set(plain.quantities)


def test_a_measure_of_ones_own() -> None:
    done = sweep(cantilever, GRID, measure=shape, keep_results=True)
    assert done.quantities == ("positions", "side", "energy", "time", "warnings", "error")
    assert done["positions"].shape == (5, 6, 25, 3)
    assert done["side"].dtype.kind == "U"
    assert set(done["side"].flat) == {"left", "right", ""}  # nothing of those that failed
    assert done.results is not None
    for case, result in enumerate(done.results[:24]):
        np.testing.assert_array_equal(done.columns["positions"][case], result.positions)
    assert done.results[24:] == (None,) * 6


def test_arrays_may_differ_in_their_shapes() -> None:
    done = sweep(cantilever, {"load": [1.0], "angle": [1.0], "edges": [2, 4]}, measure=shape)
    assert [p.shape for p in done["positions"].flat] == [(3, 3), (5, 3)]
    assert isinstance(done.to_pandas()["positions"][0], np.ndarray)


@pytest.mark.parametrize(
    ("measure", "message"),
    [
        (lambda r: 3.0, "TypeError: measure: expected a dict, got a float"),
        (lambda r: {3: 1.0}, "TypeError: measure: names are strings, got 3"),
        (lambda r: {"load": 1.0}, "ValueError: measure: 'load' is another column already"),
        (lambda r: {"error": 1.0}, "ValueError: measure: 'error' is another column already"),
        (lambda r: {"z": 1j}, "TypeError: measure: 'z' must be a number, text or an array"),
        (lambda r: {"z": None}, "TypeError: measure: 'z' must be a number, text or an array"),
        (lambda r: 1 / 0, "ZeroDivisionError: division by zero"),
    ],
)
def test_what_a_measure_must_return(measure: Callable[..., Any], message: str) -> None:
    done = sweep(column, {"load": [1.0]}, measure=measure)
    assert done["error"][0].startswith(message)


# Failures -----------------------------------------------------------------------------------------


def odd(kind: str) -> Any:
    """Scenes of which some are none, some no equilibrium, and one has an unstable one."""
    if kind == "no scene":
        return 4
    if kind == "refused":
        return Scene(Rod.straight(1.0, 8, ROUND))
    if kind == "interrupted":
        raise KeyboardInterrupt
    if kind == "drifts":
        rail = Slider((0, 0, 1), at="start", clamped=True)
        return Scene(Rod.straight(1.0, 8, ROUND), rail, Force((0, 0, 1), follower=True))
    force = (20.0 if kind == "hard" else 1e-3, 0, 0)
    return Scene(Rod.straight(1.0, 24, ROUND), Clamp(), Force(force))


def test_cases_that_fail_are_told_and_do_not_end_the_sweep() -> None:
    kinds = ["fine", "no scene", "refused", "hard", "fine", "drifts"]
    done = sweep(odd, {"kind": kinds}, options=Options(max_iterations=3))
    errors = list(done["error"])
    assert errors[0] == errors[4] == ""
    assert errors[1] == "TypeError: scene: the function must return a Scene, got 4"
    assert errors[2].startswith("ValueError: supports: nothing holds the rod")
    assert re.match("NotConverged: out_of_iterations after 3 iterations: ", errors[3])
    assert errors[5].startswith("ValueError: supports: nothing holds the rods against the force")
    assert np.isnan(done["energy"][[1, 2, 3, 5]]).all()
    assert np.isnan(done["tip"][1:4]).all()
    assert done["energy"][0] == done["energy"][4] > 0
    assert [f.case for f in done.failures] == [1, 2, 3, 5]
    assert done.failures[1].parameters == {"kind": "refused"}
    assert done.failures[1].error == errors[2]
    assert repr(done).startswith("Sweep(6 cases of 6 kind, 4 failed, ")


def test_all_may_fail() -> None:
    done = sweep(odd, {"kind": ["refused", "refused"]})
    assert done.quantities == ("time", "warnings", "error")
    assert len(done.failures) == len(done.to_pandas()) == done.to_xarray().sizes["kind"] == 2


def test_ctrl_c_ends_a_sweep() -> None:
    with pytest.raises(KeyboardInterrupt):
        sweep(odd, {"kind": ["fine", "interrupted", "fine"]})


def crushed(load: float) -> Scene:
    """EA 10: a load beyond it turns edges inside out."""
    section = Section(1e3, 1e3, 1e3, EA=10.0)
    return Scene(Rod.straight(1.0, 4, section), Clamp(), Force((0, 0, -load)))


def test_doubts_are_told_by_the_table_alone() -> None:
    """Warnings are errors in these tests, so none was given."""
    done = sweep(crushed, {"load": [1.0, 30.0]})
    assert done["warnings"][0] == ""
    assert re.match("StrainWarning: edge 0 is compressed to -2 of", done["warnings"][1])
    assert list(done["error"]) == ["", ""]
    assert ", 1 with warnings, " in repr(done)


# Neighbours ---------------------------------------------------------------------------------------


def pushed(side: float, load: float) -> Scene:
    return Scene(Rod.straight(1.0, 16, ROUND), Clamp(), Force((side, 0, -load)), "planar")


def test_each_case_may_start_from_the_one_before() -> None:
    """Pushed to one side beyond the critical load, then to the other: it stays where it is, until
    the force to the side makes it snap."""
    sides = [0.5, 0.0, -0.05, -20.0, -0.05]
    alone = sweep(lambda side: pushed(side, 4.0), {"side": sides})
    after = sweep(lambda side: pushed(side, 4.0), {"side": sides}, start="previous")
    assert list(np.sign(alone["tip"][:, 0])[[0, 2, 3, 4]]) == [1, -1, -1, -1]
    assert list(np.sign(after["tip"][:, 0])) == [1, 1, 1, -1, -1]
    assert after["iterations"][1] < 10


def test_lines_of_a_grid_start_anew_and_pass_failures_over() -> None:
    def scene(first: float, side: float) -> Scene:
        return pushed(first if side == 9 else side, 4.0 if side < 99 else np.nan)

    done = sweep(scene, {"first": [0.5, -0.5], "side": [9.0, 99.0, 0.0]}, start="previous")
    assert np.sign(done["tip"][0, 0, 0]) == np.sign(done["tip"][0, 2, 0]) == 1
    assert np.sign(done["tip"][1, 0, 0]) == np.sign(done["tip"][1, 2, 0]) == -1
    assert [f.case for f in done.failures] == [1, 4]
