"""Pictures of orders of convergence."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.figure import Figure

from gallery.convergence import EDGES, RANDOM, UNIFORM, averaged, rebuilding_errors, rebuilt
from gallery.known import CUBIC, CURVES, HELIX, TORUS_32, TREFOIL, UNKNOT, VIVIANI
from gallery.style import BLUE, GREEN, ORANGE, PURPLE, RED, SKY, fit, order_line, plt, space

STYLES = {
    HELIX.name: (BLUE, "o"),
    CUBIC.name: (ORANGE, "s"),
    TREFOIL.name: (GREEN, "^"),
    TORUS_32.name: (RED, "D"),
    UNKNOT.name: (PURPLE, "v"),
    VIVIANI.name: (SKY, "P"),
}


def draw_rebuilt(ax: Any) -> None:
    fine = TREFOIL.position(np.linspace(0, 2 * np.pi, 400))
    ax.plot(*fine.T, color="k", lw=1, label="exact")
    for n, colour in ((24, RED), (48, BLUE)):
        r = rebuilt(TREFOIL, n)[1].polyline.positions
        ax.plot(*r.T, ".-", color=colour, lw=1, ms=4, label=f"n = {n}")
    fit(ax, fine, zoom=1.25)
    ax.legend(loc="lower center", ncols=3, bbox_to_anchor=(0.5, -0.1))
    ax.set_title("A trefoil from its curvature and its start")


def reconstruction() -> Figure:
    figure = plt.figure(figsize=(10, 3.8))
    draw_rebuilt(space(figure, 1, 3, 1, elev=60, azim=-20))
    titles = ("positions / length", "frames [rad]")
    for k, title in enumerate(titles):
        ax = figure.add_subplot(1, 3, k + 2)
        for known in (HELIX, CUBIC, TREFOIL):
            colour, marker = STYLES[known.name]
            for seed, style in ((None, "-"), (1, ":")):
                e = [rebuilding_errors(known, n, seed)[k] for n in EDGES]
                ax.loglog(EDGES, e, style, color=colour, marker=marker, ms=4)
            ax.plot([], [], color=colour, marker=marker, ms=4, label=known.name)
        ax.plot([], [], "k-", label="uniform grids")
        ax.plot([], [], "k:", label="random grids")
        order_line(ax, EDGES, (2e-4, 5e-4)[k], 2)
        ax.set(xlabel="edges n", title=f"Largest error of {title}")
        ax.legend(loc="upper right")
    return figure


PANELS = {
    "length": "Length",
    "curvature": "κ at the vertex",
    "curvature, place": "κ at the mean of three vertices",
    "torsion": "τ = α/ℓ at the edge",
    "torsion, place": "α/(mean of three ℓ)",
    "Frenet": "Frenet frames [rad]",
    "Bishop": "Bishop frames [rad]",
    "holonomy": "Holonomy [rad]",
}


def convergence() -> Figure:
    figure, axes = plt.subplots(2, 4, figsize=(11, 5.6), sharex=True)
    for known in CURVES:
        colour, marker = STYLES[known.name]
        for seeds, style in ((UNIFORM, "-"), (RANDOM, ":")):
            levels = [averaged(known, n, seeds) for n in EDGES]
            for ax, key in zip(axes.flat, PANELS, strict=True):
                e = [level.get(key, np.nan) for level in levels]
                if not max(e) < 1e-14:
                    ax.loglog(EDGES, e, style, color=colour, marker=marker, ms=3.5, lw=1.2)
        axes.flat[0].plot([], [], color=colour, marker=marker, ms=4, label=known.name)
    for ax, title in zip(axes.flat, PANELS.values(), strict=True):
        ax.set_title(title)
    order_line(axes.flat[1], EDGES, 0.3, 1)
    order_line(axes.flat[0], EDGES, 2e-2, 2)
    axes.flat[0].plot([], [], "k-", label="uniform grids")
    axes.flat[0].plot([], [], "k:", label="random grids")
    for ax in axes[1]:
        ax.set_xlabel("edges n")
    for ax in axes[:, 0]:
        ax.set_ylabel("largest error")
    figure.legend(loc="outside lower center", ncols=8)
    return figure
