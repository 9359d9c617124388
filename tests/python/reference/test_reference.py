"""Every case of the reference folder: the error against the exact solution is of order two.

The environment variable PYROD_REFERENCE names another folder of the same form.
"""

from __future__ import annotations

import os
from collections.abc import Callable

import numpy as np
import pytest
from cases import CASES, FOLDER, parameters, start

import pyrod
from pyrod import Equilibrium
from pyrod.reference import Case
from pyrod.reference import _notes as notes

CELLS = (4, 8, 16)  # edges in a sample interval
FINE_CELLS = (64, 128, 256)
ROUNDING = 1e-11

# An index counts the directions in space; what it is in the plane, if less:
INDEX_IN_THE_PLANE = {"P3_clamp_m2_d90": 1}


def cells(case: Case) -> tuple[int, ...]:
    """Edges in a sample interval.

    The critical load of n edges is that of the rod times 1 - (mode pi/n)^2/12: next to it, the
    amplitude needs n such that this is little compared with the distance from it.
    """
    return FINE_CELLS if str(case).startswith("P3_pin") and "1.0001" in str(case) else CELLS


def rounding(case: Case, quantity: str, errors: dict[str, float]) -> float:
    """What rounding may leave: forces across ends that meet have the error of these as a lever."""
    if quantity == "forces" and str(case).endswith("_meet"):
        return ROUNDING + 1e-13 / errors["positions"]
    return ROUNDING


def is_unloaded(result: Equilibrium) -> bool:
    """At rest: forces and moments are rounding themselves."""
    return max(np.abs(result.force).max(), np.abs(result.moment).max()) < 1e-12


def check(case: Case, space: str, solve: Callable[[int], Equilibrium]) -> None:
    """Order, index and balance of the results on a sequence of grids."""
    results = [solve(n * case.intervals) for n in cells(case)]
    errors = [case.nearest(result).errors(result) for result in results]
    for quantity in errors[0]:
        e = [level[quantity] for level in errors]
        assert e[-1] < 4e-3, f"{quantity}: {e}"
        for i in range(1, len(e)):
            least = rounding(case, quantity, errors[i])
            assert e[i] < least or e[i - 1] / e[i] > 3.4, f"{quantity}: {e}"
    index = case.data["values"].get("stability_index")
    if space == "planar":
        index = INDEX_IN_THE_PLANE.get(str(case), index)
    for result in results:
        assert max(result.balance) < 1e-12 or is_unloaded(result)
        assert index in (None, result.index)


@pytest.mark.parametrize(("case", "space"), parameters([c for c in CASES if c.found_alone]))
def test_is_found_from_the_scene_alone(case: Case, space: str) -> None:
    check(case, space, lambda n: pyrod.solve(case.scene(n, space)))


@pytest.mark.parametrize(("case", "space"), parameters(CASES))
def test_is_an_equilibrium_near_its_samples(case: Case, space: str) -> None:
    def solve(n: int) -> Equilibrium:
        return pyrod.solve(case.scene(n, space), start=start(case, n), stable=False)

    check(case, space, solve)


@pytest.mark.parametrize("tol", [1e-4, 1e-10])
@pytest.mark.parametrize(
    "case",
    [
        c
        for c in CASES
        if str(c).startswith(
            ("P5_heavy_w100", "S1_intrinsic", "S3_cosserat", "S4_generic_cosserat")
        )
    ],
    ids=str,
)
def test_constant_curvatures_and_loads_may_be_functions(case: Case, tol: float) -> None:
    """Scenes of cases are given vectors; functions that do not vary are sampled to the same."""
    scene = case.scene(None)
    rod, section = scene.rod, case.section()
    K0, f, l = (case.along(key) for key in ("K0", "f", "l"))  # noqa: E741
    sampled = pyrod.Rod.precurved(rod.length, None, section, K0, rod.model)
    loads = [pyrod.DistributedForce(f), pyrod.DistributedMoment(l), *scene.loads[2:]]
    same = pyrod.Scene(sampled, scene.supports, loads, scene.space)
    a, b = pyrod.solve(scene, tol=tol), pyrod.solve(same, tol=tol)
    assert a.accuracy.finest_edges == b.accuracy.finest_edges
    np.testing.assert_allclose(a.positions, b.positions, rtol=0, atol=1e-12)
    np.testing.assert_allclose(a.moment, b.moment, rtol=0, atol=1e-11 * np.abs(a.moment).max())


# What the table of the folder promises ------------------------------------------------------------


@pytest.mark.skipif("PYROD_REFERENCE" in os.environ, reason="another folder")
def test_exceptions_name_cases_of_the_folder() -> None:
    names = [str(case) for case in CASES]
    assert len(names) >= 60
    for name in (*notes.OTHERS_NEARBY, *notes.CIRCLES, *INDEX_IN_THE_PLANE, *notes.PULSES):
        assert any(n.startswith(name) for n in names), name


def test_the_folder_holds_cases() -> None:
    assert CASES, f"no cases in {FOLDER}"
