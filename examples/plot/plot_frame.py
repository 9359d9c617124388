"""
A frame, and a force that follows
=================================

Left: a portal with a load on its beam, pushed to the right. Then: a cantilever under a force that
keeps its direction, and under one that turns with the rod.
"""

from typing import Any

import numpy as np
from gallery.style import BLUE, GREEN, GREY, ORANGE, RED, plt

from pyrod import Clamp, DistributedForce, Equilibrium, Force, Joint, Rod, Scene, Section, solve

BEAM = Section(EI1=1.0, EI2=1.0, GJ=0.8)


def portal(push: float) -> Equilibrium:
    """Two clamped columns and a beam with a load, pushed sideways at the left corner."""
    along = {"normal": (0, 1, 0)}
    rods = [
        Rod.straight(1.0, 48, BEAM).placed((0, 0, 0), tangent=(0, 0, 1), **along),
        Rod.straight(1.5, 72, BEAM).placed((0, 0, 1), tangent=(1, 0, 0), **along),
        Rod.straight(1.0, 48, BEAM).placed((1.5, 0, 0), tangent=(0, 0, 1), **along),
    ]
    corners = [Joint(((0, "end"), (1, "start"))), Joint(((1, "end"), (2, "end")))]
    loads = [DistributedForce((0, 0, -2.0), 1), Force((push, 0, 0), (1, "start"))]
    feet = [Clamp(at=(0, "start")), Clamp(at=(2, "start"))]
    return solve(Scene(rods, feet, loads, joints=corners))


def pulled(force: float, follower: bool) -> Equilibrium:
    """A cantilever along x with a force across its tip."""
    rod = Rod.straight(1.0, 64, Section(EI1=4.0, EI2=1.0, GJ=2.0))
    clamp = Clamp(tangent=(1, 0, 0), normal=(0, 0, -1))
    load = Force((force, 0, 0) if follower else (0, 0, -force), follower=follower)
    return solve(Scene(rod, clamp, load, "planar"))


def draw_pulled(ax: Any, follower: bool, title: str) -> None:
    for force, shade in ((1, 0.35), (3, 0.55), (6, 0.75), (12, 1.0)):
        result = pulled(force, follower)
        r = result.positions
        ax.plot(r[:, 0], r[:, 2], color=RED if follower else BLUE, alpha=shade)
        way = result.force[-1] / np.linalg.norm(result.force[-1])
        ax.annotate(
            "", r[-1, [0, 2]] + 0.16 * way[[0, 2]], r[-1, [0, 2]],
            arrowprops={"arrowstyle": "-|>", "color": GREY, "lw": 1},
        )  # fmt: skip
        ax.annotate(f"{force}", r[-1, [0, 2]], (4, 3), textcoords="offset points", fontsize=8)
    ax.set(title=title, aspect="equal", xlim=(-0.35, 1.15), ylim=(-1.15, 0.35), xlabel="x / L")


figure = plt.figure(figsize=(10.4, 3.8))
grid = figure.add_gridspec(1, 3, width_ratios=(1.45, 1, 1))
ax = figure.add_subplot(grid[0])
for push, colour in ((0.0, BLUE), (1.0, GREEN), (4.0, ORANGE)):
    for k, rod in enumerate(portal(push).rods):
        label = f"F L²/EI = {push:.0f}" if k == 0 else None
        ax.plot(rod.positions[:, 0], rod.positions[:, 2], color=colour, label=label)
ax.plot([0, 0, 1.5, 1.5], [0, 1, 1, 0], color="0.8", lw=1, zorder=0)
ax.set(title="Frame, 2 EI/L³ down on its beam, F to the right", aspect="equal", xlabel="x / L")
ax.legend(loc="lower center")
draw_pulled(figure.add_subplot(grid[1]), False, "Dead force F L²/EI")
draw_pulled(figure.add_subplot(grid[2]), True, "Follower")
