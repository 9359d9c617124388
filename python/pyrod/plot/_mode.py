"""The lowest mode: the shape displaced both ways."""

from __future__ import annotations

from typing import Any

from pyrod.pictures.displaced import shown_mode
from pyrod.plot._shape import draw_lines, new_axes
from pyrod.result.equilibrium import Equilibrium


def draw_mode(result: Equilibrium, ax: Any, style: dict[str, Any]) -> Any:
    """The shape, and on both sides of it the displaced shapes."""
    shapes = {sign: shown_mode(result, sign) for sign in (0, 1, -1)}
    ax = new_axes(result) if ax is None else ax
    looks: list[tuple[int, dict[str, Any]]] = [
        (0, {"color": "0.2", "linewidth": 2}),
        (1, {"color": "C3", "linestyle": "--"}),
        (-1, {"color": "C0", "linestyle": ":", "linewidth": 2}),
    ]
    for sign, look in looks:
        draw_lines(result, ax, shapes[sign], look, style)
    ax.set_title(f"lowest mode: {stability(result)}", fontsize="medium")
    return ax


def stability(result: Equilibrium) -> str:
    """Stability index and lowest eigenvalue in words."""
    index = "no potential" if result.index < 0 else f"index {result.index}"
    lowest = result.lowest_eigenvalue
    neutral = ", neutral" if result.neutral else ""
    return index + ("" if lowest is None else f", eigenvalue {lowest:.4g} N m") + neutral
