"""A table with a picture, as HTML."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape
from typing import Any, NamedTuple

import numpy as np

MOST_ROWS = 8
MOST_TEXT = 200


class Row(NamedTuple):
    """One quantity."""

    what: str
    value: Any  #: a number, an array of a few, or text
    unit: str = ""


def cell_text(value: Any) -> str:
    """Text as it is, if it is not long; numbers with six digits."""
    if isinstance(value, str):
        return value if len(value) <= MOST_TEXT else f"{value[:MOST_TEXT]}…"
    if isinstance(value, (bool, np.bool_)):
        return "yes" if value else "no"
    made = np.asarray(value)
    if made.dtype.kind not in "iuf":
        return cell_text(str(value))
    if made.ndim == 0:
        return f"{made.item() + 0.0:.6g}" if made.dtype.kind == "f" else f"{made.item()}"
    if made.size > 4:
        return f"array {made.shape}"
    return f"({', '.join(cell_text(x) for x in made.ravel())})"


def page(title: str, rows: Sequence[Row], picture: str = "", note: str = "") -> str:
    """A table of what, value and unit, beside a picture."""
    body = "".join(f"<tr>{_cell(r.what, 'th')}{_cell(r.value)}{_cell(r.unit)}</tr>" for r in rows)
    return framed(title, f"<table>{body}</table>", picture, note)


def column_table(names: Sequence[str], rows: Iterable[Sequence[Any]]) -> str:
    """A table with a headline and a row for each case."""
    head = "".join(_cell(name, "th") for name in names)
    body = "".join(f"<tr>{''.join(_cell(value) for value in row)}</tr>" for row in rows)
    return f"<table><tr>{head}</tr>{body}</table>"


def framed(title: str, table: str, picture: str = "", note: str = "") -> str:
    """The table and the picture side by side, or one below the other where there is no room."""
    below = f"<div><small>{escape(note)}</small></div>" if note else ""
    return (
        f"<div><strong>{escape(title)}</strong>"
        '<div style="display: flex; flex-wrap: wrap; gap: 1em; align-items: center">'
        f"<div>{table}</div><div>{picture}</div></div>{below}</div>"
    )


def several(what: str, values: Sequence[Row]) -> list[Row]:
    """Rows of many of one kind: the first of them, and how many more there are."""
    kept = list(values[:MOST_ROWS])
    left = len(values) - len(kept)
    return [*kept, Row("…", f"{left} more {what}")] if left else kept


def _cell(value: Any, tag: str = "td") -> str:
    look = "" if isinstance(value, str) else ' style="white-space: nowrap"'
    return f"<{tag}{look}>{escape(cell_text(value))}</{tag}>"
