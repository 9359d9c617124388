"""Pictures of several rods, of forces that follow, and of a scene with more than one shape."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from gallery.held import REFERENCE, STRIP
from gallery.style import BLUE, GREEN, GREY, ORANGE, RED, fit, plt, space
from pyrod import (
    Clamp,
    DistributedForce,
    Equilibrium,
    Force,
    Gravity,
    Hinge,
    Joint,
    Material,
    Rod,
    Scene,
    Section,
    Slider,
    solve,
)

Array = np.ndarray


# A grid of laths that is pushed up to a dome ------------------------------------------------------

LATH = Section.rectangle(0.02, 0.04, Material(E=10e9, nu=0.3, density=600))  # timber


def shell(count: int, loads: list[Any], length: float = 10.0) -> Scene:
    """Laths of 10 m, flat at rest and pinned where they cross; their ends are drawn inwards.

    Those in the middle are drawn in by 14 %, the outermost by 6 %.
    """
    places = length * np.linspace(0, 1, count + 2)[1:-1]
    rods, feet = [], []
    for along in np.eye(3)[:2]:
        for y in places:
            beside = y * (np.array([1.0, 1.0, 0.0]) - along)
            short = 0.02 + 0.12 * np.sin(np.pi * y / length)
            number = len(rods)
            rods.append(Rod.straight(length, 72, LATH, "inextensible").placed(
                beside, tangent=along, normal=(0, 0, 1)))  # fmt: skip
            for end, part in (("start", short / 2), ("end", 1 - short / 2)):
                feet.append(Hinge(beside + part * length * along, at=(number, end)))
    joints = [
        Joint(((i, x), (count + k, y)), kind="ball")
        for i, y in enumerate(places)
        for k, x in enumerate(places)
    ]
    return Scene(rods, feet, loads, joints=joints)


def draw_shell(ax: Any, result: Equilibrium, title: str) -> Any:
    """Each edge in the colour of its bending strain."""
    from mpl_toolkits.mplot3d.art3d import Line3DCollection

    for rod in result.rods:
        r = rod.positions
        kappa = np.linalg.norm(rod.K[:, :2], axis=1)
        lines = Line3DCollection(np.stack([r[:-1], r[1:]], axis=1), cmap="viridis", lw=1.8)
        lines.set(array=(kappa[1:] + kappa[:-1]) / 2, clim=(0, 0.6))
        lines.set_clip_on(False)
        ax.add_collection3d(lines)
    fit(ax, np.vstack([rod.positions for rod in result.rods]), zoom=1.25)
    ax.set_title(title)
    return lines


def dome() -> Figure:
    count = 9
    numbers = range(2 * count)
    lifted = solve(shell(count, [DistributedForce((0, 0, 1.0), i) for i in numbers]))
    standing = solve(shell(count, [Gravity()]), start=lifted)
    snow = [DistributedForce((0, 0, -60.0 if i < count // 2 else 0.0), i) for i in range(count)]
    loaded = solve(shell(count, [Gravity(), *snow]), start=standing)
    figure = plt.figure(figsize=(10.4, 3.7))
    axes = []
    shown = {"its own weight": standing, "snow on one side, 60 N/m": loaded}
    for k, (what, result) in enumerate(shown.items()):
        axes.append(space(figure, 1, 2, k + 1, elev=24, azim=-50))
        z = np.concatenate([rod.positions[:, 2] for rod in result.rods])
        heights = f"heights {round(z.min(), 2) + 0:.2f} to {z.max():.2f} m"  # no -0.00
        lines = draw_shell(axes[-1], result, f"{what}\n{heights}")
    figure.colorbar(lines, ax=axes, shrink=0.7, pad=0.04, label="curvature [1/m]")
    return figure


# A frame, and a force that follows ----------------------------------------------------------------

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
    rod = Rod.straight(1.0, 64, STRIP)
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


def frame() -> Figure:
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
    return figure


# An arch that is pushed through -------------------------------------------------------------------

EPS = 0.1


def clamps() -> list[Clamp]:
    return [Clamp(), Clamp((0, 0, 1 - EPS), at="end")]


def pushed(height: float, start: Equilibrium, stable: bool = True) -> Equilibrium:
    """The middle of the arch held at a height, free to move along z."""
    slider = Slider((0, 0, 1), position=(height, 0, 0), at=0.5)
    rod = Rod.straight(1.0, 128, STRIP)
    return solve(Scene(rod, [*clamps(), slider], (), "planar"), start=start.frames, stable=stable)


def branch(start: Equilibrium, heights: Array, stable: bool) -> list[float]:
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


def arch() -> Figure:
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
    return figure
