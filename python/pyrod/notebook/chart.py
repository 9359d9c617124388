"""A small chart as SVG: one quantity over another, a line for each row."""

from __future__ import annotations

from html import escape

import numpy as np

from pyrod.base.immutable import Array
from pyrod.notebook.sketch import HEIGHT, MOST_POINTS, WIDTH, opened, spread

LEFT, TOP = 40, 24  # the room for words
MOST_LINES = 12


def chart(x: Array, y: Array, over: str, name: str) -> str:
    """(lines, points) each; nothing if there are no two points that differ."""
    good = np.isfinite(x) & np.isfinite(y)
    if not good.any() or np.ptp(x[good]) == 0:
        return ""
    ranges = [(v[good].min(), v[good].max()) for v in (x, y)]
    most = MOST_POINTS // min(len(x), MOST_LINES)
    drawn = ""
    for line in spread(len(x), MOST_LINES):
        kept = np.flatnonzero(good[line])
        xy = [
            f"{_at(x[line, k], *ranges[0], LEFT, WIDTH - LEFT):.1f} "
            f"{_at(y[line, k], *ranges[1], HEIGHT - TOP, TOP):.1f}"
            for k in kept[spread(len(kept), most)]
        ]
        drawn += f"M{'L'.join(xy)}" if xy else ""
    return (
        f"{opened()}"
        f'<path opacity="0.4" d="M{LEFT} {TOP}V{HEIGHT - TOP}H{WIDTH - LEFT}"/>'
        f'<path stroke-width="1.5" d="{drawn}"/>'
        f"{_svg_text(LEFT, TOP - 8, 'start', f'{name}, {ranges[1][0]:.3g} to {ranges[1][1]:.3g}')}"
        f"{_svg_text(WIDTH - LEFT, HEIGHT - 8, 'end', over)}"
        f"{_svg_text(LEFT, HEIGHT - 8, 'middle', f'{ranges[0][0]:.3g}')}"
        f"{_svg_text(WIDTH - LEFT, HEIGHT - TOP - 4, 'start', f'{ranges[0][1]:.3g}')}</svg>"
    )


def _at(value: float, low: float, high: float, first: float, last: float) -> float:
    part = 0.5 if high == low else (value - low) / (high - low)
    return first + part * (last - first)


def _svg_text(x: float, y: float, anchor: str, words: str) -> str:
    look = f'text-anchor="{anchor}" fill="currentColor" stroke="none"'
    return f'<text x="{x}" y="{y}" {look}>{escape(words[:60])}</text>'
