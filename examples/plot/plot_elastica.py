"""
A strip between clamps that come nearer
=======================================

The lines are computed, the dots are Euler's elastica, in elliptic integrals.
"""

from typing import Any

import numpy as np
from gallery.exact import case
from gallery.style import GREY, plt

from pyrod import Clamp, Equilibrium, Rod, Scene, Section, solve

SHORTENED = (1, 5, 10, 25, 50, 75, 90, 99)  # per cent
EXACT = {p: case(f"P3_clamp_m1_d{p}") for p in (1, 10, 50, 90)}


def shortened(part: float) -> Equilibrium:
    """A strip of unit length between clamps that stand on one line."""
    rod = Rod.straight(1.0, 128, Section(EI1=4.0, EI2=1.0, GJ=2.0))
    clamps = [Clamp(), Clamp(position=(0, 0, 1 - part), at="end")]
    return solve(Scene(rod, clamps, space="planar"))


def draw_shortened(ax: Any, results: dict[int, Equilibrium]) -> None:
    colours = plt.get_cmap("viridis")(np.linspace(0.0, 0.85, len(results)))
    for (percent, result), colour in zip(results.items(), colours, strict=True):
        r = result.positions
        ax.plot(r[:, 2], r[:, 0], color=colour, label=f"{percent} %")
        if percent in EXACT:
            dots = EXACT[percent].sampled("r")[::2]
            ax.plot(dots[:, 2], dots[:, 0], "o", color=colour, ms=3.5, mfc="white")
    ax.set(xlabel="z / L", ylabel="x / L", title="Lines: computed; dots: exact", aspect="equal")
    ax.legend(title="shortened by", loc="upper right", ncols=2)


def draw_thrust(ax: Any, results: dict[int, Equilibrium]) -> None:
    part = np.array(list(results)) / 100
    thrust = [result.reactions[0].force[2] for result in results.values()]
    ax.plot(part, thrust, "o-", ms=4)
    ax.plot(
        [case.data["params"]["shortening"] for case in EXACT.values()],
        [case.data["values"]["P"] for case in EXACT.values()],
        "s", ms=9, mfc="none", color=GREY, label="exact",
    )  # fmt: skip
    ax.axhline(4 * np.pi**2, color=GREY, ls="--", lw=1)
    ax.annotate("4π²: the straight strip buckles", (0.35, 4 * np.pi**2), (0, -11),
                textcoords="offset points", color=GREY, fontsize=8)  # fmt: skip
    ax.set(xlabel="shortening / L", ylabel="thrust P L²/EI", title="What the clamps bear")
    ax.set_ylim(35, 90)
    ax.legend(loc="upper left")


results = {percent: shortened(percent / 100) for percent in SHORTENED}
figure = plt.figure(figsize=(10.4, 4.2))
grid = figure.add_gridspec(1, 2, width_ratios=(1.5, 1))
draw_shortened(figure.add_subplot(grid[0]), results)
draw_thrust(figure.add_subplot(grid[1]), results)
