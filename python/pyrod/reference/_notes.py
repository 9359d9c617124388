"""What a solver must be told of some reference cases, and why: their names begin with the keys."""

from __future__ import annotations

from math import gcd

import numpy as np

from pyrod.base.immutable import Array
from pyrod.result.equilibrium import Equilibrium
from pyrod.rotation import conjugate, multiply, rotate

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
"""Not the shape that a solve without a start finds, though no saddle of the reference data."""

CIRCLES = {
    "S4_twist_X0.8_t0.5_iso": "round, and clamped with one axis",
    "S4_twist_X0.8_t1_iso": "the same",
    "S4_twist_X0.8_t2_iso": "the same",
    "S7_ring": "round, closed",
}
"""May turn about the first tangent, the cross-sections turning back."""

PULSES = {
    "S6_soliton_a": "tails of 1e-7 hold the pulse: between samples a cubic is not exact enough",
    "S6_soliton_mild": "twists by more than pi between samples",
}
"""To be started from the solution itself, not from its samples."""

FIRST_EDGES = {
    "P3_pin_m1_1.0001": (128, "next to the critical load, whose error (mode pi/n)^2/12 must be "),
    "P3_pin_m2_1.0001": (256, "little beside the distance of 1e-4: coarser grids find the "),
    "P3_pin_m3_1.0001": (256, "straight rod, or the mirror image"),
    "S1_cosserat_a": (128, "a saddle among several equilibria"),
    "S6_soliton_a": (128, "a pulse in a twentieth of the rod"),
    "S6_soliton_mild": (128, "a pulse that twists by many turns"),
    "S6_soliton_soft": (128, "on 16 edges another branch is found"),
}
"""Grids that a rod without edges does not get by itself."""

MAGNIFIED = {
    "P3_pin_m1_1.0001": (2e-10, "amplitudes by the distance from the critical load"),
    "P3_pin_m2_1.0001": (2e-10, "the same"),
    "P3_pin_m3_1.0001": (2e-10, "the same"),
    "P5_chain_w1e4": (1e-10, "forces of 1e4 EI/L^2 make moments a hundredth of F L"),
    "P3_pin_m1_meet": (1e-9, "forces by ends that meet: their lever is the error of the positions"),
    "P3_pin_m3_meet": (1e-9, "the same"),
    "S6_soliton_a": (2e-6, "the place of the pulse, which only tails of 1e-7 hold"),
    "S6_soliton_mild": (1e-9, "the same, with longer tails"),
    "S7_figure_eight": (1e-6, "it may glide through its clamp, along itself"),
}
"""Rounding that is magnified, and by what: the largest errors seen beyond the estimates."""

ROUNDING = 1e-12


def found_alone(name: str, stability_index: int | None) -> bool:
    """Whether a solve finds the case from its scene, without a start."""
    return not stability_index and not name.startswith(tuple(OTHERS_NEARBY))


def first_edges(name: str, alone: bool) -> int | None:
    """Edges to begin with; None: those that the solver chooses."""
    for key, (edges, _) in FIRST_EDGES.items():
        if name.startswith(key):
            return edges
    return None if alone else 64


def rounding(name: str) -> float:
    """Errors below this are rounding."""
    return max([ROUNDING] + [size for key, (size, _) in MAGNIFIED.items() if name.startswith(key)])


def turned_to(sampled: dict[str, Array], result: Equilibrium) -> dict[str, Array]:
    """r, q, n and m of a circle's solution that is nearest to the result."""
    r, q = sampled["r"], sampled["q"]
    edges, intervals = result.scene.rod.edges, len(r) - 1
    common = gcd(edges, intervals)
    points = r[:: intervals // common], result.positions[:: edges // common]
    exact, found = (
        local[:, 0] + 1j * local[:, 1]
        for local in (rotate(conjugate(q[:1]), x - r[0]) for x in points)
    )
    turn = _about_a3(np.angle(np.vdot(exact, found)))
    whole = multiply(multiply(q[:1], turn), conjugate(q[:1]))
    return {
        "r": r[0] + rotate(whole, r - r[0]),
        "q": multiply(multiply(whole, q), conjugate(turn)),
        "n": rotate(whole, sampled["n"]),
        "m": rotate(whole, sampled["m"]),
    }


def _about_a3(angle: float) -> Array:
    return np.array([[np.cos(angle / 2), 0.0, 0.0, np.sin(angle / 2)]])
