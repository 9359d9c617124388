"""
An arch that is pushed through
==============================

An arch, its mirror image, and the saddle between them. Right: the force on the middle that is
pushed down. At the circle the symmetric shape becomes unstable and slants.
"""

import json
from typing import Any

import numpy as np
from gallery.exact import REFERENCE
from gallery.style import BLUE, GREEN, GREY, ORANGE, RED, plt

from pyrod import Clamp, Equilibrium, Rod, Scene, Section, Slider, solve

EPS = 0.1
STRIP = Section(EI1=4.0, EI2=1.0, GJ=2.0)


def clamps() -> list[Clamp]:
    return [Clamp(), Clamp((0, 0, 1 - EPS), at="end")]


def pushed(height: float, start: Equilibrium, stable: bool = True) -> Equilibrium:
    """The middle of the arch held at a height, free to move along z."""
    slider = Slider((0, 0, 1), position=(height, 0, 0), at=0.5)
    rod = Rod.straight(1.0, 128, STRIP)
    return solve(Scene(rod, [*clamps(), slider], (), "planar"), start=start.frames, stable=stable)


def branch(start: Equilibrium, heights: np.ndarray, stable: bool) -> list[float]:
    """The force that pushes the middle down at each of the heights."""
    force = []
    for height in heights:
        start = pushed(height, start, stable)
        force.append(-start.reactions[2].force[0])
    return force


def free_shapes() -> tuple[Equilibrium, Equilibrium]:
    """Without a force: the arch, and the S between it and its mirror image, a saddle."""
    scene = Scene(Rod.straight(1.0, 128, STRIP), clamps(), (), "planar")
    s = (np.arange(128) + 0.5) / 128
    angle = 0.9 * (np.cos(2 * np.pi * s) - np.cos(4 * np.pi * s))
    frames = np.stack([np.cos(angle / 2), 0 * s, np.sin(angle / 2), 0 * s], axis=1)
    return solve(scene), solve(scene, start=frames, stable=False)


def draw_shapes(ax: Any, arch: Equilibrium, saddle: Equilibrium, top: float) -> None:
    for result, sign, style in ((arch, 1, "-"), (arch, -1, "-"), (saddle, 1, "--")):
        r = result.positions
        what = "stable" if result.index == 0 else f"index {result.index}"
        label = f"{what}, energy {result.energy:.2f} EI/L" if sign > 0 else None
        colour = BLUE if result is arch else RED
        ax.plot(r[:, 2], sign * r[:, 0], style, color=colour, label=label)
    for height in np.linspace(top, 0, 6)[1:-1]:
        r = pushed(height, saddle).positions
        ax.plot(r[:, 2], r[:, 0], color=GREY, lw=0.8, zorder=0)
    ax.plot([], [], color=GREY, lw=0.8, label="pushed from the one to the other")
    ax.set(aspect="equal", xlabel="z / L", ylabel="x / L", title="Shapes without a force")
    ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.22))


up, saddle = free_shapes()
rows = json.loads((REFERENCE / "S5_arch_midload.json").read_text())["rows"]
exact = next(row["bif"] for row in rows if float(row["eps"]) == EPS)
top, turn = up.positions[64, 0], float(exact["h_mid"])
figure = plt.figure(figsize=(10.4, 3.9))
draw_shapes(figure.add_subplot(1, 2, 1), up, saddle, top)
ax = figure.add_subplot(1, 2, 2)
heights = np.concatenate([np.linspace(top, turn, 8), np.linspace(turn, 0.06, 18)[1:]])
force = np.array(branch(up, heights, stable=False))
slant = np.linspace(0, 0.999 * turn, 24)
other = np.array(branch(saddle, slant, stable=True))
for sign in (1, -1):
    ax.plot(sign * heights[:8], sign * force[:8], color=BLUE, label="symmetric" * (sign > 0))
    ax.plot(sign * heights[7:], sign * force[7:], "--", color=BLUE)
    ax.plot(sign * slant, sign * other, color=GREEN, label="slanting" * (sign > 0))
    ax.plot(sign * turn, sign * float(exact["F"]), "o", mfc="white", color=ORANGE,
            label="exact bifurcation" * (sign > 0))  # fmt: skip
ax.set(xlabel="height of the middle / L", ylabel="force on it, F L²/EI",
       title="Middle pushed down; dashed: unstable at that height")  # fmt: skip
ax.legend(loc="upper left")
