"""The cases of the reference folder, and how the tests come near to them.

The environment variable PYROD_REFERENCE names another folder of the same form.
"""

from __future__ import annotations

import os
from math import gcd
from pathlib import Path

import numpy as np
import pytest

from pyrod import Equilibrium
from pyrod.reference import Case, load
from pyrod.rotation import conjugate, multiply, rotate

FOLDER = Path(os.environ.get("PYROD_REFERENCE", Path(__file__).parents[1] / "reference"))
CASES = load(FOLDER)

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


def is_found_from_the_scene_alone(case: Case) -> bool:
    saddle = (case.data["values"].get("stability_index") or 0) > 0
    return not saddle and not str(case).startswith(tuple(OTHERS_NEARBY))


def parameters(cases: list[Case]) -> list[object]:
    return [pytest.param(c, s, id=f"{c}-{s}") for c in cases for s in c.spaces]


def nearest(case: Case, result: Equilibrium) -> Case:
    """The case, or of a circle of solutions the one that is nearest to the result."""
    if not str(case).startswith(CIRCLES):
        return case
    r, q = case.sampled("r"), case.sampled("q")
    common = gcd(result.scene.rod.edges, case.intervals)
    step, skip = result.scene.rod.edges // common, case.intervals // common
    points = r[::skip], result.positions[::step]
    local = [rotate(conjugate(q[:1]), x - r[0]) for x in points]
    exact, found = (x[:, 0] + 1j * x[:, 1] for x in local)
    turn = about(3, np.angle([np.vdot(exact, found)]))
    whole = multiply(multiply(q[:1], turn), conjugate(q[:1]))
    moved = {key: rotate(whole, case.sampled(key)) for key in ("n", "m")}
    moved["r"] = r[0] + rotate(whole, r - r[0])
    moved["q"] = multiply(multiply(whole, q), conjugate(turn))
    return Case({**case.data, **moved})


# Two pulses are held in their place by nothing but their tails, of 1e-7 and less. To interpolate
# the samples is not exact enough a start; and one of them twists by more than pi between samples.
PULSES = ("S6_soliton_a", "S6_soliton_mild")


def start(case: Case, edges: int) -> np.ndarray:
    """Frames of the exact solution, as near as the case needs."""
    return (pulse if str(case) in PULSES else Case.start)(case, edges)


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
