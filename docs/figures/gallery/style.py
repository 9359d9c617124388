"""What the pictures share: colours that colour-blind readers can tell, axes, ribbons."""

from __future__ import annotations

from io import BytesIO
from pathlib import Path
from runpy import run_path
from typing import Any

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from mpl_toolkits.mplot3d.art3d import Poly3DCollection
from PIL import Image  # which matplotlib brings with it

from pyrod import Equilibrium
from pyrod.rotation import rotate

Array = np.ndarray
PROGRAMS = Path(__file__).parents[3] / "examples" / "plot"
# Okabe and Ito
BLUE, ORANGE, GREEN, RED, PURPLE, SKY = (
    "#0072B2", "#E69F00", "#009E73", "#D55E00", "#CC79A7", "#56B4E9",
)  # fmt: skip
GREY = "0.45"
LIGHT = np.array([0.35, -0.55, 0.76])  # direction to the lamp

plt.rcParams.update(
    {
        "font.size": 9,
        "axes.titlesize": 10,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "axes.grid": True,
        "grid.alpha": 0.25,
        "grid.linewidth": 0.6,
        "lines.linewidth": 1.6,
        "legend.frameon": False,
        "legend.fontsize": 8,
        "figure.constrained_layout.use": True,
    }
)


def space(figure: Figure, *place: Any, elev: float = 30, azim: float = -60) -> Any:
    """Axes in space without a box."""
    ax = figure.add_subplot(*place, projection="3d", computed_zorder=False)
    ax.set_axis_off()
    ax.view_init(elev, azim)
    ax.set_proj_type("persp", focal_length=1.4)
    return ax


def fit(ax: Any, points: Array, zoom: float = 1.3) -> None:
    """Equal scales, and the points as large as they fit."""
    low, high = points.min(axis=0), points.max(axis=0)
    size = high - low
    flat = size < 1e-3 * size.max()
    low, high = low - flat * size.max() / 2000, high + flat * size.max() / 2000
    ax.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=(low[2], high[2]))
    ax.set_box_aspect(np.maximum(size, 1e-9), zoom=zoom)


def shaded(corners: Array, front: str, back: str, eye: Array) -> Array:
    """A colour for each quadrilateral: of the side that is seen, darker away from the lamp."""
    normal = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    seen = normal @ eye > 0
    base = np.where(seen[:, None], to_rgb(front), to_rgb(back))
    return base * (0.66 + 0.34 * np.abs(normal @ LIGHT))[:, None]


def strip(r: Array, across: Array, left: float, right: float) -> Array:
    """Quadrilaterals between two curves beside r."""
    a, b = r + left * across, r + right * across
    return np.stack([a[:-1], b[:-1], b[1:], a[1:]], axis=1)


def ribbon(
    ax: Any, r: Array, across: Array, width: float, front: str = BLUE, back: str = ORANGE
) -> None:
    """A strip along the points r, spanned by the vectors ``across``, with dark rims."""
    elev, azim = np.radians(ax.elev), np.radians(ax.azim)
    eye = np.array([np.cos(elev) * np.cos(azim), np.cos(elev) * np.sin(azim), np.sin(elev)])
    rim = 0.44 * width
    parts = [strip(r, across, *at) for at in ((-rim, rim), (-width / 2, -rim), (rim, width / 2))]
    colours = [shaded(parts[0], front, back, eye)]
    colours += [0.45 * shaded(part, front, back, eye) for part in parts[1:]]
    faces = Poly3DCollection(np.concatenate(parts), facecolors=np.concatenate(colours))
    faces.set(edgecolors=np.concatenate(colours), linewidth=0.3)
    ax.add_collection3d(faces)


def draw_ribbon(ax: Any, result: Equilibrium, width: float = 0.05, zoom: float = 1.3) -> None:
    """Turned so that the line between the clamps lies flat."""
    r = result.positions[:, [2, 0, 1]]
    across = rotate(result.vertex_frames, np.array([1.0, 0.0, 0.0]))[:, [2, 0, 1]]
    ribbon(ax, r, across, width)
    fit(ax, np.vstack([r + width / 2 * across, r - width / 2 * across]), zoom=zoom)
    ax.collections[-1].set_clip_on(False)


def order_line(ax: Any, n: Array, at: float, p: int, label_at: int = -1) -> None:
    """A dashed line that falls like n^-p from the value ``at``."""
    n = np.asarray(n, dtype=float)
    y = at * (n / n[0]) ** -p
    ax.loglog(n, y, "--", color="0.6", lw=1)
    ax.annotate(
        f"$n^{{-{p}}}$", (n[label_at], y[label_at]), (3, 2), textcoords="offset points",
        color=GREY, fontsize=8,
    )  # fmt: skip


def drawn(script: str) -> Figure:
    """The picture of a program of the folder ``examples/plot``."""
    run_path(str(PROGRAMS / f"plot_{script}.py"))
    return plt.gcf()


def save(figure: Figure, path: Path) -> None:
    """With 256 colours: a third of the bytes, and no difference to the eye."""
    buffer = BytesIO()
    figure.savefig(buffer, dpi=110)
    plt.close(figure)
    Image.open(buffer).convert("RGB").quantize(256).save(path, optimize=True)
    print(path)
