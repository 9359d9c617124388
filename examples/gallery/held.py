"""Pictures of one rod held at both ends, or joined to a ring."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from gallery.style import GREY, fit, plt, ribbon, space
from pyrod import Clamp, Equilibrium, Joint, Rod, Scene, Section, solve
from pyrod.reference import Case, load
from pyrod.rotation import exp, rotate

REFERENCE = Path(__file__).parents[2] / "tests" / "reference"
SHORTENED = (1, 5, 10, 25, 50, 75, 90, 99)  # per cent
STRIP = Section(EI1=4.0, EI2=1.0, GJ=2.0)
WIRE = Section(EI1=1.0, EI2=1.0, GJ=0.75)


# A strip between two clamps that come nearer ------------------------------------------------------


def exact(shortening: int) -> Case | None:
    path = REFERENCE / f"P3_clamp_m1_d{shortening}.json"
    return load(path)[0] if path.exists() else None


def shortened(part: float) -> Equilibrium:
    """A strip of unit length between clamps that stand on one line."""
    rod = Rod.straight(1.0, 128, STRIP)
    clamps = [Clamp(), Clamp(position=(0, 0, 1 - part), at="end")]
    return solve(Scene(rod, clamps, space="planar"))


def draw_shortened(ax: Any, results: dict[int, Equilibrium]) -> None:
    colours = plt.get_cmap("viridis")(np.linspace(0.0, 0.85, len(results)))
    for (percent, result), colour in zip(results.items(), colours, strict=True):
        r = result.positions
        ax.plot(r[:, 2], r[:, 0], color=colour, label=f"{percent} %")
        if case := exact(percent):
            dots = case.sampled("r")[::2]
            ax.plot(dots[:, 2], dots[:, 0], "o", color=colour, ms=3.5, mfc="white")
    ax.set(xlabel="z / L", ylabel="x / L", title="Lines: computed; dots: exact", aspect="equal")
    ax.legend(title="shortened by", loc="upper right", ncols=2)


def draw_thrust(ax: Any, results: dict[int, Equilibrium]) -> None:
    part = np.array(list(results)) / 100
    thrust = [result.reactions[0].force[2] for result in results.values()]
    ax.plot(part, thrust, "o-", ms=4)
    cases = [case for p in SHORTENED if (case := exact(p))]
    ax.plot(
        [case.data["params"]["shortening"] for case in cases],
        [case.data["values"]["P"] for case in cases],
        "s", ms=9, mfc="none", color=GREY, label="exact",
    )  # fmt: skip
    ax.axhline(4 * np.pi**2, color=GREY, ls="--", lw=1)
    ax.annotate("4π²: the straight strip buckles", (0.35, 4 * np.pi**2), (0, -11),
                textcoords="offset points", color=GREY, fontsize=8)  # fmt: skip
    ax.set(xlabel="shortening / L", ylabel="thrust P L²/EI", title="What the clamps bear")
    ax.set_ylim(35, 90)
    ax.legend(loc="upper left")


def elastica() -> Figure:
    results = {percent: shortened(percent / 100) for percent in SHORTENED}
    figure = plt.figure(figsize=(10.4, 4.2))
    grid = figure.add_gridspec(1, 2, width_ratios=(1.5, 1))
    draw_shortened(figure.add_subplot(grid[0]), results)
    draw_thrust(figure.add_subplot(grid[1]), results)
    return figure


# A rod with slack that is twisted -----------------------------------------------------------------


@cache
def twisted(turns: float) -> Equilibrium:
    """Between clamps at 0.8 of its length, of which one was turned about the line between them."""
    rod = Rod.straight(1.0, 256, Section(EI1=1.0, EI2=1.5, GJ=0.8))
    whole = int(turns)
    end = Clamp((0, 0, 0.8), exp((0, 0, 2 * np.pi * (turns - whole))), at="end", turns=whole)
    return solve(Scene(rod, [Clamp(), end]))


def draw_ribbon(ax: Any, result: Equilibrium, width: float = 0.05, zoom: float = 1.3) -> None:
    """Turned so that the line between the clamps lies flat."""
    r = result.positions[:, [2, 0, 1]]
    across = rotate(result.vertex_frames, np.array([1.0, 0.0, 0.0]))[:, [2, 0, 1]]
    ribbon(ax, r, across, width)
    fit(ax, np.vstack([r + width / 2 * across, r - width / 2 * across]), zoom=zoom)
    ax.collections[-1].set_clip_on(False)


def twist() -> Figure:
    figure = plt.figure(figsize=(10.4, 4.2))
    for k, turns in enumerate((0.5, 1, 2, 4)):
        result = twisted(turns)
        ax = space(figure, 2, 2, k + 1, elev=18, azim=-70)
        draw_ribbon(ax, result, 0.05, zoom=2.1)
        name = "½ a turn" if turns == 0.5 else f"{turns} turn{'s' * (turns > 1)}"
        ax.set_title(f"{name}: energy {result.energy:.1f} EI/L, index {result.index}", y=0.98)
    return figure


# A ring with twist in it --------------------------------------------------------------------------


def joined(turns: int, stable: bool = True) -> Equilibrium:
    """The ends of a straight rod brought together, after that many turns of one of them."""
    rod = Rod.straight(1.0, 256, WIRE)
    return solve(Scene(rod, joints=Joint(("start", "end"), turns=turns)), stable=stable)


def ring() -> Figure:
    figure = plt.figure(figsize=(10.4, 3.3))
    shapes = [(1, True), (2, True), (3, False), (3, True)]
    for k, (turns, stable) in enumerate(shapes):
        result = joined(turns, stable)
        ax = space(figure, 1, len(shapes), k + 1, elev=35, azim=-60)
        draw_ribbon(ax, result, 0.03, zoom=1.2)
        what = "stable" if result.index == 0 else f"unstable, index {result.index}"
        if turns == 3 and stable:
            what = "let go"
        ax.set_title(
            f"{turns} turn{'s' * (turns > 1)}, {what}\nenergy {result.energy:.1f} EI/L", y=0.88
        )
    return figure
