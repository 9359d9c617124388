"""Modes: the shape displaced both ways."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from pyrod.base.immutable import Array
from pyrod.pictures.displaced import Motion, shown_mode
from pyrod.plot._shape import draw_lines, new_axes
from pyrod.result.equilibrium import Equilibrium

LOOKS: tuple[dict[str, Any], ...] = (
    {"color": "0.2", "linewidth": 2},
    {"color": "C3", "linestyle": "--"},
    {"color": "C0", "linestyle": ":", "linewidth": 2},
)


def draw_mode(result: Equilibrium, ax: Any, style: dict[str, Any]) -> Any:
    """The shape, and on both sides of it the displaced shapes."""
    there, back = (shown_mode(result, sign) for sign in (1, -1))
    return _draw_both_ways(result, there, back, f"lowest mode: {stability(result)}", ax, style)


def draw_motion(motion: Motion, ax: Any, style: dict[str, Any]) -> Any:
    """The same of a mode of any kind: half a period is between the two sides."""
    there, back = motion.shapes(0.0), motion.shapes(0.5)
    return _draw_both_ways(motion.result, there, back, motion.title, ax, style)


def _draw_both_ways(
    result: Equilibrium,
    there: Sequence[Array],
    back: Sequence[Array],
    title: str,
    ax: Any,
    style: dict[str, Any],
) -> Any:
    shapes = ([rod.positions for rod in result.rods], there, back)
    ax = new_axes(result) if ax is None else ax
    for shape, look in zip(shapes, LOOKS, strict=True):
        draw_lines(result, ax, shape, look, style)
    ax.set_title(title, fontsize="medium")
    return ax


def stability(result: Equilibrium) -> str:
    """Stability index and lowest eigenvalue in words."""
    index = "no potential" if result.index < 0 else f"index {result.index}"
    lowest = result.lowest_eigenvalue
    neutral = ", neutral" if result.neutral else ""
    return index + ("" if lowest is None else f", eigenvalue {lowest:.4g} N m") + neutral
