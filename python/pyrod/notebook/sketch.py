"""Small pictures as SVG: lines, marks and arrows in space, seen from one side.

They are drawn in the colour of the text around them, so that they can be read on light and on dark
pages, and hold no scripts.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pyrod.base.immutable import Array

WIDTH, HEIGHT, MARGIN = 320, 240, 24
MOST_LINES, MOST_POINTS, MOST_MARKS, MOST_ARROWS = 200, 500, 30, 30
ARROW = 0.18  # length of the longest, over the extent of the picture
ISOMETRIC = np.array([[-1.0, 1.0, 0.0], [-1.0, -1.0, 2.0]]) / np.sqrt([[2.0], [6.0]])
"""Rows: what is to the right and what is up, seen along (-1, -1, -1) as `Equilibrium.show` does."""
LOAD = "#e0433a"


class Mark(NamedTuple):
    """A point that is held or joined."""

    at: Array  #: (3,)
    shape: str  #: "square", "circle" or "diamond"
    told: str  #: shown where the pointer is


class Arrow(NamedTuple):
    """A force, or a moment, whose arrow has two heads."""

    at: Array  #: (3,) where it acts
    along: Array  #: (3,) the longest of each kind have one length
    told: str
    kind: str = "force"

    @property
    def heads(self) -> int:
        """Of the arrow."""
        return 2 if "moment" in self.kind else 1


class Sketch(NamedTuple):
    """What is drawn."""

    lines: Sequence[Array]  #: (points, 3) each
    faint: Sequence[Array] = ()  #: the same, dashed
    marks: Sequence[Mark] = ()
    arrows: Sequence[Arrow] = ()
    view: Array = ISOMETRIC  #: (2, 3)

    @property
    def left_out(self) -> str:
        """What is too much for a small picture, in words."""
        kinds = [
            ("lines", max(len(self.lines), len(self.faint)), MOST_LINES),
            ("supports and joints", len(self.marks), MOST_MARKS),
            ("loads", len(self.arrows), MOST_ARROWS),
        ]
        return ", ".join(f"{most} of {n} {what} drawn" for what, n, most in kinds if n > most)


def svg(sketch: Sketch) -> str:
    """The picture; nothing if there is nothing that has a size."""
    lines, faint = (_thinned(some) for some in (sketch.lines, sketch.faint))
    there = [r for r in (*lines, *faint) if len(r)]
    if not there:
        return ""
    points = np.vstack(there)
    extent = np.ptp(points, axis=0).max()
    if not 1e-250 < extent < 1e250:  # none, or squares would be none or infinite
        return ""
    arrows = _arrows(sketch.arrows, extent)
    marks = [mark for mark in sketch.marks[:MOST_MARKS] if np.isfinite(mark.at).all()]
    ends = [end for tail, head, _ in arrows for end in (tail, head)]
    seen = np.vstack([points, *ends, *(mark.at for mark in marks)]) @ sketch.view.T
    place = _Place(sketch.view, seen)
    return "".join(
        (
            opened(),
            _path(faint, place, 'opacity="0.45" stroke-dasharray="4 3"'),
            _path(lines, place, 'stroke-width="2" stroke-linejoin="round"'),
            '<g fill="gray" fill-opacity="0.5">',
            *(_mark(mark, place) for mark in marks),
            f'</g><g stroke="{LOAD}" stroke-width="1.5">',
            *(_arrow(*arrow, place) for arrow in arrows),
            "</g>",
            _axes(sketch.view),
            "</svg>",
        )
    )


def opened() -> str:
    """The tag that begins a picture."""
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" '
        f'width="{WIDTH}" height="{HEIGHT}" fill="none" stroke="currentColor" '
        'font-family="sans-serif" font-size="10" role="img">'
    )


class _Place:
    """From space into the picture."""

    def __init__(self, view: Array, seen: Array) -> None:
        low, high = seen.min(axis=0), seen.max(axis=0)
        room = np.array([WIDTH, HEIGHT]) - 2 * MARGIN
        size = high - low
        self.view, self.middle = view, low + size / 2
        self.scale = float((room / np.maximum(size, 1e-9 * size.max())).min())

    def __call__(self, r: Array) -> Array:
        """(..., 2) pixels from the left and from above."""
        right_up = (r @ self.view.T - self.middle) * self.scale
        return np.array([WIDTH / 2, HEIGHT / 2]) + right_up * [1.0, -1.0]


def _thinned(lines: Sequence[Array]) -> list[Array]:
    """As many lines, and points of each, as a small picture can show; finite points only."""
    some = lines[:MOST_LINES]
    most = max(2, MOST_POINTS // max(1, len(some)))
    chosen = [r[spread(len(r), most)] for r in some]
    return [r[np.isfinite(r).all(axis=1)] for r in chosen]


def spread(count: int, most: int) -> NDArray[np.int64]:
    """Numbers below a count, evenly, not more than most."""
    return np.linspace(0, count - 1, min(count, most)).round().astype(np.int64)


def _arrows(arrows: Sequence[Arrow], extent: float) -> list[tuple[Array, Array, Arrow]]:
    """Tails and heads: an arrow ends where it acts; those of each kind have one scale."""
    there = [a for a in arrows[:MOST_ARROWS] if np.isfinite([*a.at, *a.along]).all()]
    found = []
    for kind in dict.fromkeys(a.kind for a in there):
        some = [a for a in there if a.kind == kind and np.abs(a.along).max() > 0]
        longest = max((_length(a.along) for a in some), default=1.0)
        for a in some:
            step = ARROW * extent * (a.along / longest)
            found.append((a.at - step, a.at, a))
    return found


def _length(vector: Array) -> float:
    """Of vectors whose squares would be too large, too."""
    largest = float(np.abs(vector).max())
    return largest * float(np.linalg.norm(vector / largest))


def _path(lines: Iterable[Array], place: _Place, look: str) -> str:
    drawn = "".join("M" + "L".join(_labelled(xy) for xy in place(r)) for r in lines if len(r) > 1)
    return f'<path {look} d="{drawn}"/>' if drawn else ""


def _labelled(xy: Array) -> str:
    return f"{xy[0]:.1f} {xy[1]:.1f}"


def _mark(mark: Mark, place: _Place) -> str:
    x, y = place(mark.at)
    shapes = {
        "square": f"M{x - 5:.1f} {y - 5:.1f}h10v10h-10z",
        "circle": f"M{x - 5:.1f} {y:.1f}a5 5 0 1 0 10 0a5 5 0 1 0 -10 0z",
        "diamond": f"M{x:.1f} {y - 5:.1f}l5 5l-5 5l-5 -5z",
    }
    return f'<path d="{shapes[mark.shape]}">{_caption(mark.told)}</path>'


def _arrow(tail: Array, head: Array, arrow: Arrow, place: _Place) -> str:
    a, b = place(tail), place(head)
    drawn = f"M{_labelled(a)}L{_labelled(b)}"
    size = float(np.linalg.norm(b - a))
    if size > 1:  # else it points at the eye
        back = (a - b) / size
        side = np.array([-back[1], back[0]])
        for k in range(arrow.heads):
            tip = b + 4 * k * back
            ends = [_labelled(tip + 7 * back + sign * 3 * side) for sign in (1, -1)]
            drawn += f"M{ends[0]}L{_labelled(tip)}L{ends[1]}"
    return f'<path d="{drawn}">{_caption(arrow.told)}</path>'


def _caption(text: str) -> str:
    return f"<title>{escape(text[:60])}</title>"


def _axes(view: Array) -> str:
    """x, y and z in the corner, but for one that points at the eye."""
    origin = np.array([22.0, HEIGHT - 22.0])
    drawn, names = "", ""
    for name, axis in zip("xyz", view.T, strict=True):
        if np.abs(axis).max() > 0.1:
            end = origin + 14 * axis * [1.0, -1.0]
            drawn += f"M{_labelled(origin)}L{_labelled(end)}"
            x, y = end + 6 * axis * [1.0, -1.0] + [-3.0, 3.0]
            names += (
                f'<text x="{x:.1f}" y="{y:.1f}" fill="currentColor" stroke="none">{name}</text>'
            )
    return f'<g opacity="0.6"><path d="{drawn}"/>{names}</g>'
