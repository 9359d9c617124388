"""Pictures of closed ribbons: holonomy, link, twist and writhe."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.figure import Figure

from gallery.known import ONCE, Known, torus
from gallery.style import BLUE, GREY, RED, fit, plt, ribbon, space
from pyrod.curve import Polyline
from pyrod.rotation import conjugate, multiply, rotate, to_matrix

Array = np.ndarray
KNOT = Known("trefoil", ONCE, True, torus(2, -3, 2.2))  # right-handed
EDGES = 480
WIDTH = 0.55


def knot() -> Polyline:
    return KNOT.polyline(KNOT.parameters(EDGES))


def once_around(p: Polyline) -> tuple[Array, Array]:
    """Centres of the edges, the first of them again at the end, and parallel frames there."""
    r = np.vstack([p.positions, p.positions[:2]])
    normal = np.cross(p.tangents[0], [0.0, 0.0, 1.0])
    q = Polyline(r).bishop(normal=normal).frames
    return (r[1:] + r[:-1]) / 2, q


def draw_seam(ax: Any, p: Polyline, q: Array) -> None:
    """The directors a1 and a2 before and after, seen against the tangent."""
    angle = p.holonomy()
    after = to_matrix(multiply(conjugate(q[0]), q[-1]))[:2, :2]
    for M, colour, name in ((np.eye(2), BLUE, "start"), (after, RED, "once around")):
        for k in (0, 1):
            ax.annotate(
                "", M[:, k], (0, 0),
                arrowprops={"arrowstyle": "-|>", "color": colour, "lw": 2.4 - k, "shrinkB": 0},
            )  # fmt: skip
            ax.text(*(1.13 * M[:, k]), f"$a_{k + 1}$", color=colour, ha="center", va="center")
        ax.plot([], [], color=colour, lw=2.4, label=name)
    t = np.linspace(0, angle, 60)
    ax.plot(0.42 * np.cos(t), 0.42 * np.sin(t), color=GREY, lw=1.2)
    ax.text(
        *(0.68 * np.array([np.cos(angle / 4), np.sin(angle / 4)])), f"{np.degrees(angle):.1f}°",
        color=GREY, ha="center", va="center",
    )  # fmt: skip
    ax.set(xlim=(-1.35, 1.35), ylim=(-1.35, 1.35), aspect="equal")
    ax.axis("off")
    ax.legend(loc="lower center", ncols=2, bbox_to_anchor=(0.5, -0.06))
    ax.set_title("The seam, seen against the tangent")
    ax.text(0, -1.75, f"holonomy = 2π Wr mod 2π,  Wr = {p.writhe():.4f}", ha="center", color=GREY)


def holonomy() -> Figure:
    p = knot()
    r, q = once_around(p)
    figure = plt.figure(figsize=(8.2, 4.3))
    left, right = figure.add_gridspec(1, 2, width_ratios=(1.65, 1))
    ax = space(figure, left, elev=58, azim=-12)
    a1 = rotate(q, np.array([1.0, 0.0, 0.0]))
    ribbon(ax, r, a1, WIDTH)
    for j, colour in ((0, BLUE), (-1, RED)):
        ends = r[j] + WIDTH * np.array([[-0.5], [1.1]]) * a1[j]
        ax.plot(*ends.T, color=colour, lw=2.6, zorder=10)
    fit(ax, p.positions, zoom=1.2)
    ax.set_title("Bishop ribbon of a trefoil: it does not twist, and it does not close")
    draw_seam(figure.add_subplot(right), p, q)
    return figure
