"""Every case of the reference folder to a tolerance: errors are estimated, and the estimates hold.

A result may not be farther from the exact solution than it says, and should not say that it is a
hundred times as far as it is. Below 1e-12 nothing is compared: this is rounding.
"""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache

import numpy as np
import pytest
from cases import CASES, parameters, start

import pyrod
from pyrod import AccuracyWarning, Equilibrium, UnstableWarning
from pyrod.reference import Case
from pyrod.reference import _notes as notes

TOLERANCES = (1e-4, 1e-6, 1e-8, 1e-10)

# Estimates that are far above errors that happen to vanish:
LOOSE = {
    ("S3_taper_kirchhoff", "forces"): "exact at vertices; the estimate is that of `load`",
    ("P3_pin_m1_1.0001", "energy"): "next to the critical load the energy is all but nothing",
    ("P3_pin_m2_1.0001", "energy"): "the same",
    ("P3_pin_m3_1.0001", "energy"): "the same",
    ("P3_pin_m1_1.01", "energy"): "the same",
    ("P3_pin_m2_1.01", "energy"): "the same",
    ("P3_pin_m3_1.01", "energy"): "the same",
    ("P3_clamp_m2_d90", "energy"): "crosses zero between the grids",
}


def solved(case: Case, space: str, tol: float) -> Equilibrium:
    edges = case.first_edges
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UnstableWarning)
        if edges is None:
            return pyrod.solve(case.scene(None, space), tol=tol, strict=False)
        how = {"start": start(case, edges), "stable": False, "strict": False}
        return pyrod.solve(case.scene(edges, space), tol=tol, **how)


@dataclass(frozen=True)
class Level:
    """What is told of a result that was solved to a tolerance, and what is true of it."""

    tol: float
    told: Mapping[str, float]
    errors: Mapping[str, float]
    nearest: Mapping[str, float]  #: errors against the nearest one of a circle of solutions
    reached: float
    converged: bool
    regular: bool


@cache
def levels(name: str, space: str) -> list[Level]:
    """One for each tolerance: solved once for all tests."""
    (case,) = (case for case in CASES if str(case) == name)
    return [level(case, solved(case, space, tol), tol) for tol in TOLERANCES]


def level(case: Case, result: Equilibrium, tol: float) -> Level:
    accuracy = result.accuracy
    errors, nearest = case.errors(result), case.nearest(result).errors(result)
    told = accuracy.errors
    return Level(tol, told, errors, nearest, accuracy.reached, result.converged, accuracy.regular)


def is_neutral(case: Case) -> bool:
    """Which of a circle of equilibria is found is chance, to within rounding over 1e-6."""
    return str(case).startswith((*notes.CIRCLES, "S7", "S6")) or str(case).endswith("_meet")


@pytest.mark.parametrize(("case", "space"), parameters(CASES))
def test_estimates_hold(case: Case, space: str) -> None:
    for level in levels(str(case), space):
        for quantity, error in level.nearest.items():
            told = level.told[quantity]
            message = f"{quantity} at {level.tol}: {error}, told {told}"
            assert error <= max(told, case.rounding), message


@pytest.mark.parametrize(
    ("case", "space"), parameters([case for case in CASES if not is_neutral(case)])
)
def test_estimates_are_tight_and_tolerances_reached(case: Case, space: str) -> None:
    for level in levels(str(case), space):
        assert level.converged
        assert level.regular
        assert level.reached <= level.tol
        for quantity, error in level.errors.items():
            told = level.told[quantity]
            if (str(case), quantity) not in LOOSE:
                message = f"{quantity} at {level.tol}: {error}, {told}"
                assert told <= 100 * max(error, notes.ROUNDING), message


@pytest.mark.parametrize(
    ("case", "space"), parameters([case for case in CASES if is_neutral(case)])
)
def test_neutral_equilibria_reach_what_chance_allows(case: Case, space: str) -> None:
    (level,) = (level for level in levels(str(case), space) if level.tol == 1e-6)
    assert level.converged
    assert level.reached <= 1e-6


# Cantilevers that need 256 edges or fewer for 1e-12; of more, rounding is larger.
SMOOTH = [case for case in CASES if str(case).startswith(("P1_F1_", "P1_F0.1_", "P4_thick"))]


@pytest.mark.parametrize(("case", "space"), parameters(SMOOTH))
def test_smooth_cases_reach_a_millionth_of_a_millionth(case: Case, space: str) -> None:
    result = solved(case, space, 1e-12)
    assert result.converged
    assert result.accuracy.reached <= 1e-12
    assert max(case.errors(result).values()) < 2e-12


@pytest.mark.parametrize(
    "name", ["P1_F10_a90", "S3_cosserat", "S4_generic_cosserat", "P5_heavy_w1"]
)
@pytest.mark.parametrize("tol", [1e-6, 1e-9])
def test_errors_of_all_other_quantities_hold(name: str, tol: float) -> None:
    """Against a result on twice the edges and to 1e-11, whose vertices are these centres, too."""
    case = next(case for case in CASES if str(case) == name)
    result = pyrod.solve(case.scene(16), tol=tol)
    exact = pyrod.solve(case.scene(32), tol=1e-11)
    told = result.accuracy.errors

    def error(computed: np.ndarray, at: np.ndarray, scale: float | None = None) -> float:
        size = np.linalg.norm(at, axis=-1).max() if scale is None else scale
        return float(np.linalg.norm(computed - at, axis=-1).max() / size)

    centres = exact.vertex_frames[1::2]
    signs = np.sign(np.sum(result.frames * centres, axis=1, keepdims=True))
    checks = {
        "curvatures": error(result.K, exact.K[::2]),
        "reactions": max(
            error(r.force, x.force, np.linalg.norm(exact.vertex_force, axis=1).max() or 1.0)
            for r, x in zip(result.reactions, exact.reactions, strict=True)
        ),
        "edge_frames": error(result.frames * signs, centres, 0.5),
        "edge_forces": error(result.force, exact.vertex_force[1::2]),
    }
    for quantity, found in checks.items():
        assert found <= max(told[quantity], 3e-11), quantity


def test_a_rough_case_is_not_believed_too_early() -> None:
    """Boundary layers of a fiftieth of the length: on the first grids they are not resolved."""
    case = next(case for case in CASES if str(case) == "P5_chain_w1e4_span0.8")
    with pytest.warns(AccuracyWarning):
        result = pyrod.solve(case.scene(None), pyrod.Options(max_edges=256), tol=0.1)
    assert not result.accuracy.regular
    assert max(case.errors(result).values()) <= result.accuracy.reached


def test_exceptions_name_cases_of_the_folder() -> None:
    names = [str(case) for case in CASES]
    for name in (*notes.FIRST_EDGES, *notes.MAGNIFIED, *(name for name, _ in LOOSE)):
        assert any(n.startswith(name) for n in names), name
