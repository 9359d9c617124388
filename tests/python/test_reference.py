"""Every case of the reference folder: the error against the exact solution is of order two.

The environment variable PYROD_REFERENCE names another folder of the same form.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import pyrod
from pyrod import Equilibrium
from pyrod.reference import Case, load
from pyrod.rotation import conjugate, multiply, rotate

FOLDER = Path(os.environ.get("PYROD_REFERENCE", Path(__file__).parents[1] / "reference"))
CASES = load(FOLDER)

CELLS = (4, 8, 16)  # edges in a sample interval
FINE_CELLS = (64, 128, 256)
ROUNDING = 1e-11

# Not the shape that a solve without a start finds, though no saddle of the reference data:
OTHERS_NEARBY = {
    "S1_cosserat_a": "several equilibria with these clamps; this is a saddle",
    "S1_love_c": "several stable helices with these clamps",
    "P3_pin_m1_5": "a dead load pulls the roller through to the other side",
    "P3_pin_m1_meet": "the same, and the rod may turn freely about its meeting ends",
    "P3_pin_m2": "higher mode: a saddle",
    "P3_pin_m3": "higher mode: a saddle",
    "S6_soliton_mild": "the pulse is one of several, and its place is all but free",
    "S7_figure_eight": "a circle has less energy",
}
# Round rods that may turn about the first tangent, their cross-sections turning back:
CIRCLES = (
    "S4_twist_X0.8_t0.5_iso",
    "S4_twist_X0.8_t1_iso",
    "S4_twist_X0.8_t2_iso",
    "S7_ring",
)
# An index counts the directions in space; what it is in the plane, if less:
INDEX_IN_THE_PLANE = {"P3_clamp_m2_d90": 1}


def is_found_from_the_scene_alone(case: Case) -> bool:
    saddle = (case.data["values"].get("stability_index") or 0) > 0
    return not saddle and not str(case).startswith(tuple(OTHERS_NEARBY))


def parameters(cases: list[Case]) -> list[object]:
    return [pytest.param(c, s, id=f"{c}-{s}") for c in cases for s in c.spaces]


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


def nearest(case: Case, result: Equilibrium) -> Case:
    """The case, or of a circle of solutions the one that is nearest to the result."""
    if not str(case).startswith(CIRCLES):
        return case
    r, q = case.sampled("r"), case.sampled("q")
    step = result.scene.rod.edges // case.intervals
    local = [rotate(conjugate(q[:1]), x - r[0]) for x in (r, result.positions[::step])]
    exact, found = (x[:, 0] + 1j * x[:, 1] for x in local)
    turn = about(3, np.angle([np.vdot(exact, found)]))
    whole = multiply(multiply(q[:1], turn), conjugate(q[:1]))
    moved = {key: rotate(whole, case.sampled(key)) for key in ("n", "m")}
    moved["r"] = r[0] + rotate(whole, r - r[0])
    moved["q"] = multiply(multiply(whole, q), conjugate(turn))
    return Case({**case.data, **moved})


def check(case: Case, space: str, solve: Callable[[int], Equilibrium]) -> None:
    """Order, index and balance of the results on a sequence of grids."""
    results = [solve(n * case.intervals) for n in cells(case)]
    errors = [nearest(case, result).errors(result) for result in results]
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


@pytest.mark.parametrize(
    ("case", "space"), parameters([c for c in CASES if is_found_from_the_scene_alone(c)])
)
def test_is_found_from_the_scene_alone(case: Case, space: str) -> None:
    check(case, space, lambda n: pyrod.solve(case.scene(n, space)))


@pytest.mark.parametrize(("case", "space"), parameters(CASES))
def test_is_an_equilibrium_near_its_samples(case: Case, space: str) -> None:
    start = pulse if str(case) in PULSES else Case.start

    def solve(n: int) -> Equilibrium:
        return pyrod.solve(case.scene(n, space), start=start(case, n), stable=False)

    check(case, space, solve)


# Two pulses are held in their place by nothing but their tails, of 1e-7 and less. To interpolate
# the samples is not exact enough a start; and one of them twists by more than pi between samples.
PULSES = ("S6_soliton_a", "S6_soliton_mild")


def pulse(case: Case, edges: int) -> np.ndarray:
    """Frames Rz(psi) Ry(theta) Rz(phi) of the homoclinic solution, at the centres of the edges."""
    T, M = case.data["values"]["T"], case.data["values"]["M"]
    B, GJ = case.data["stiffness"]["EI1"], case.data["stiffness"]["GJ"]
    x = case.data["L"] * ((np.arange(edges) + 0.5) / edges - 0.5)
    g = np.sqrt(1 - M**2 / (4 * B * T))
    a = g * np.sqrt(T / B)
    theta = 2 * np.arcsin(g / np.cosh(a * x))
    swing = np.arctan(g / np.sqrt(1 - g**2) * np.tanh(a * x))
    psi, phi = M * x / (2 * B) + swing, M * x * (1 / GJ - 1 / (2 * B)) + swing
    return multiply(multiply(about(3, psi), about(2, theta)), about(3, phi))


def about(axis: int, angle: np.ndarray) -> np.ndarray:
    q = np.zeros((len(angle), 4))
    q[:, 0], q[:, axis] = np.cos(angle / 2), np.sin(angle / 2)
    return q


# What the table of the folder promises ------------------------------------------------------------


@pytest.mark.skipif("PYROD_REFERENCE" in os.environ, reason="another folder")
def test_exceptions_name_cases_of_the_folder() -> None:
    names = [str(case) for case in CASES]
    assert len(names) >= 60
    for name in (*OTHERS_NEARBY, *INDEX_IN_THE_PLANE, *PULSES):
        assert any(n.startswith(name) for n in names), name


def test_the_folder_holds_cases() -> None:
    assert CASES, f"no cases in {FOLDER}"
