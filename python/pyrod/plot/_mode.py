"""The lowest mode: the shape displaced both ways."""

from __future__ import annotations

from typing import Any

import numpy as np

from pyrod.pictures.displaced import mode_displacements
from pyrod.plot._shape import draw_lines, new_axes
from pyrod.result.equilibrium import Equilibrium

LARGEST = 0.1  # displacement over the extent of the rods


def draw_mode(result: Equilibrium, ax: Any, style: dict[str, Any]) -> Any:
    """The shape, and on both sides of it the displaced shapes."""
    moves = mode_displacements(result)
    ax = new_axes(result) if ax is None else ax
    shapes = [rod.positions for rod in result.rods]
    extent = np.ptp(np.vstack(shapes), axis=0).max()
    largest = np.linalg.norm(np.vstack(moves), axis=1).max()
    scale = LARGEST * extent / largest if largest > 1e-9 * extent else 0.0
    looks: list[tuple[int, dict[str, Any]]] = [
        (0, {"color": "0.2", "linewidth": 2}),
        (1, {"color": "C3", "linestyle": "--"}),
        (-1, {"color": "C0", "linestyle": ":", "linewidth": 2}),
    ]
    for sign, look in looks:
        moved = [r + sign * scale * u for r, u in zip(shapes, moves, strict=True)]
        draw_lines(result, ax, moved, look, style)
    ax.set_title(f"lowest mode: {stability(result)}", fontsize="medium")
    return ax


def stability(result: Equilibrium) -> str:
    """Stability index and lowest eigenvalue in words."""
    index = "no potential" if result.index < 0 else f"index {result.index}"
    lowest = result.lowest_eigenvalue
    neutral = ", neutral" if result.neutral else ""
    return index + ("" if lowest is None else f", eigenvalue {lowest:.4g} N m") + neutral
