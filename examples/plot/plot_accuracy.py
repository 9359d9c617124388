"""
Errors asked for, told and true
===============================

A tolerance is asked for; the result tells an estimate of its error. Here the exact solution is
known, so both can be compared with the truth.
"""

from timeit import repeat

import numpy as np
from gallery.exact import case
from gallery.style import BLUE, GREEN, GREY, ORANGE, plt

import pyrod

exact = case("S2_bathe_P600_Jpolar_kirchhoff")


def point(edges: int, tol: float | None) -> tuple[float, float]:
    """Time [ms] of a first solve, and its true error."""
    scenes = [exact.scene(edges) for _ in range(9)]
    best = min(repeat(lambda: pyrod.solve(scenes.pop(), tol=tol), number=1, repeat=8))
    return 1e3 * best, exact.errors(pyrod.solve(scenes.pop(), tol=tol))["positions"]


tols = 10.0 ** -np.arange(2, 12)
told = [pyrod.solve(exact.scene(16), tol=tol).errors["positions"] for tol in tols]
to_tol = np.array([point(16, tol) for tol in tols])

# The same on plain grids, whose error falls like n⁻².

on_grids = np.array([point(edges, None) for edges in (16, 32, 64, 128, 256, 512, 1024)])

figure = plt.figure(figsize=(10.4, 3.9))
left, right = figure.subplots(1, 2)
left.loglog(tols, tols, "--", color=GREY, label="asked for")
left.loglog(tols, told, "o-", color=ORANGE, ms=4, label="told")
left.loglog(tols, to_tol[:, 1], "s-", color=BLUE, ms=4, label="true")
left.set(xlabel="tol", ylabel="error of positions / L", title="45° bend, P = 600")
left.legend()
right.loglog(*on_grids.T, "o-", color=GREEN, ms=4, label="plain grids")
right.loglog(*to_tol.T, "s", color=BLUE, ms=4, label="to a tolerance")
right.set(xlabel="time of one solve [ms]", ylabel="true error", title="What an error costs")
right.legend()
