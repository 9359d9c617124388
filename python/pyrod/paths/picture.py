"""Paths drawn with matplotlib."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np

from pyrod.base.immutable import Array
from pyrod.base.optional import need


def draw_path(
    x: Array,
    y: Array,
    stable: np.ndarray,
    marks: list[tuple[float, float, str]],
    ax: Any,
    style: dict[str, Any],
) -> Any:
    """A line, solid where stable, else dashed, with circles at marks and words beside them."""
    if ax is None:
        _, ax = need("matplotlib.pyplot", "plot").subplots(layout="constrained")
    colour = style.pop("color", None) or ax.plot([], [])[0].get_color()
    for first, last, solid in _stretches(stable):
        look = {"linestyle": "-" if solid else "--", "color": colour, **style}
        ax.plot(x[first:last], y[first:last], **look)
    for across, up, words in marks:
        ax.plot(across, up, marker="o", color=colour, fillstyle="none", linestyle="none")
        offset = {"textcoords": "offset points", "xytext": (5, 5)}
        ax.annotate(words, (across, up), fontsize="small", **offset)
    return ax


def _stretches(stable: np.ndarray) -> list[tuple[int, int, bool]]:
    """Parts of one kind, each up to the first point of the next."""
    cuts = [0, *(np.flatnonzero(np.diff(stable)) + 1), len(stable)]
    return [(int(a), min(int(b) + 1, len(stable)), bool(stable[a])) for a, b in pairwise(cuts)]
