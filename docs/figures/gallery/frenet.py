"""Pictures of curvature and torsion: inflections, torsion by its sine, measures of turns."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.figure import Figure

from gallery.known import HELIX, TREFOIL, Known
from gallery.style import BLUE, GREEN, GREY, ORANGE, RED, SKY, fit, order_line, plt, ribbon, space
from pyrod.curve import FramedCurve, Polyline
from pyrod.rotation import rotate

MEASURES = {"log": (BLUE, "o", 7), "chord": (GREEN, "s", 5), "cayley": (RED, "^", 3)}
NAMES = {"log": "log: θ", "chord": "chord: 2 sin(θ/2)", "cayley": "cayley: 2 tan(θ/2)"}


# An inflection ------------------------------------------------------------------------------------


def bent_both_ways() -> Polyline:
    """Through (1.3 t, t³, t⁴/2), whose curvature is zero at t = 0."""
    t = np.linspace(-1, 1, 122)
    return Polyline(np.stack([1.3 * t, t**3, t**4 / 2], axis=1))


def draw_framing(ax: Any, framed: FramedCurve, title: str) -> None:
    p = framed.polyline
    a1 = rotate(framed.frames, np.array([1.0, 0.0, 0.0]))
    ribbon(ax, p.centres, a1, 0.4)
    fit(ax, np.vstack([p.centres + 0.2 * a1, p.centres - 0.2 * a1]), zoom=1.02)
    ax.set_title(title)


def draw_numbers(ax: Any, p: Polyline, bishop: FramedCurve) -> None:
    """The curvatures on the left scale, the dihedral angles on the right."""
    s = p.arc_lengths[1:-1]
    ax.plot(s, p.curvature()[1:-1], color="k", lw=1.1, label="κ, with a kink")
    ax.plot(s, bishop.K[1:-1, 0], color=SKY, label="K¹ in Bishop frames")
    ax.plot(s, bishop.K[1:-1, 1], color=BLUE, label="K² in Bishop frames")
    ax.set(xlabel="arc length ς", ylabel="curvature", title="Through the inflection")
    other = ax.twinx()
    other.spines["right"].set_visible(True)
    other.grid(False)
    alpha = np.degrees(p.dihedral_angles)
    other.plot(p.centre_arc_lengths, alpha, color=RED, lw=1.1)
    ax.plot([], [], color=RED, lw=1.1, label="α of an edge")
    other.set_ylabel("dihedral angle α [°]", color=RED)
    other.tick_params(axis="y", colors=RED)
    ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.18), ncols=2)


def inflection() -> Figure:
    p = bent_both_ways()
    figure = plt.figure(figsize=(10.4, 3.8))
    grid = figure.add_gridspec(1, 3, width_ratios=(1, 1, 1.2))
    frenet = p.frenet()
    bishop = p.bishop(frame=frenet.frames[0], angles=0.8)
    for k, framed, title in ((0, frenet, "Frenet flips"), (1, bishop, "Bishop stays calm")):
        draw_framing(space(figure, grid[k], elev=66, azim=-84), framed, title)
    draw_numbers(figure.add_subplot(grid[2]), p, bishop)
    return figure


# Torsion by the dihedral angle and by its sine ----------------------------------------------------


def draw_angle(ax: Any) -> None:
    alpha = np.linspace(-np.pi, np.pi, 401)[1:-1]
    for y, colour, style, label in (
        (alpha, BLUE, "-", "α"),
        (np.sin(alpha), ORANGE, "-", "sin α (Sauer)"),
        (2 * np.tan(alpha / 2), RED, "--", "2 tan(α/2)"),
    ):
        ax.plot(alpha, y, color=colour, ls=style, label=label)
    ticks = np.pi * np.array([-1, -0.5, 0, 0.5, 1])
    ax.set_xticks(ticks, ["−π", "−π/2", "0", "π/2", "π"])
    ax.set(ylim=(-5, 5), xlabel="dihedral angle α", ylabel="ℓ τ", title="What the edge tells")
    ax.legend(loc="upper left")


def draw_coarse_helix(ax: Any, pitch: float = 3.0) -> None:
    """A steep helix with few edges in a turn: they need not be a whole number."""
    per_turn = np.linspace(2.02, 10, 120)
    exact = pitch / (1 + pitch**2)
    found: dict[str, list[float]] = {"log": [], "sauer": []}
    for n in per_turn:
        t = 2 * np.pi / n * np.arange(6)
        p = Polyline(np.stack([np.cos(t), np.sin(t), pitch * t], axis=1))
        for measure, values in found.items():
            values.append(p.torsion(measure)[2] / exact)
    ax.plot(per_turn, found["log"], color=BLUE, label="α/ℓ")
    ax.plot(per_turn, found["sauer"], color=ORANGE, label="sin α/ℓ")
    ax.axhline(1, color="k", lw=0.8)
    ax.axvline(4, color=GREY, lw=0.8, ls=":")
    ax.text(4.1, 0.1, "α near π/2", color=GREY)
    ax.set(
        xlabel="edges in a turn", ylabel="τ / exact τ", title="A steep, coarse helix", ylim=(0, 1.2)
    )
    ax.legend(loc="lower right")


def draw_coarse_knot(ax: Any, n: int = 24) -> None:
    t = TREFOIL.parameters(n)
    p = TREFOIL.polyline(t)
    fine = np.linspace(0, 2 * np.pi, 600)
    ax.plot(fine, TREFOIL.torsion(fine), color="k", lw=1, label="exact")
    centre = (t[1:] + t[:-1]) / 2
    for measure, colour, marker in (("log", BLUE, "o"), ("sauer", ORANGE, "s")):
        ax.plot(centre, p.torsion(measure), marker, color=colour, ms=5,
                label={"log": "α/ℓ", "sauer": "sin α/ℓ"}[measure])  # fmt: skip
    ax.set_xticks([0, np.pi, 2 * np.pi], ["0", "π", "2π"])
    ax.set(xlabel="parameter t", ylabel="τ", title=f"A trefoil of {n} edges")
    ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.17), ncols=3)


def torsion() -> Figure:
    figure, axes = plt.subplots(1, 3, figsize=(10, 3.3))
    draw_angle(axes[0])
    draw_coarse_helix(axes[1])
    draw_coarse_knot(axes[2])
    return figure


# Measures of a turn -------------------------------------------------------------------------------


def draw_sizes(ax: Any) -> None:
    theta = np.linspace(0, np.pi, 400)[:-1]
    sizes = {"log": theta, "chord": 2 * np.sin(theta / 2), "cayley": 2 * np.tan(theta / 2)}
    for name, y in sizes.items():
        ax.plot(theta, y, color=MEASURES[name][0], label=NAMES[name])
    ax.set_xticks(np.pi * np.array([0, 0.25, 0.5, 0.75, 1]), ["0", "π/4", "π/2", "3π/4", "π"])
    ax.set(ylim=(0, 6), xlabel="turn θ", ylabel="size", title="Three sizes of a turn")
    ax.legend(loc="upper left")


def draw_measure_errors(ax: Any, known: Known, note: str) -> None:
    edges = 2 ** np.arange(4, 12)
    for name, (colour, marker, size) in MEASURES.items():
        errors = []
        for n in edges:
            t = known.parameters(n)
            exact = known.curvature(t[1:-1])
            found = known.polyline(t).curvature(name)[1:n]
            errors.append(np.abs(found - exact).max() / exact.max())
        ax.loglog(edges, errors, marker + "-", ms=size, lw=1, color=colour, label=name)
    order_line(ax, edges, 8, 2)
    ax.set(xlabel="edges n", ylabel="error of κ / max κ", title=f"κ of the {known.name}, {note}")
    ax.legend(loc="lower left")


def measures() -> Figure:
    figure, axes = plt.subplots(1, 3, figsize=(10, 3.3))
    draw_sizes(axes[0])
    draw_measure_errors(axes[1], HELIX, "constant")
    draw_measure_errors(axes[2], TREFOIL, "varying")
    return figure
