"""Docstrings as the package writes them, for napoleon.

The package writes ``name : description`` where NumPy's style has a type, leaves out the headline of
a list that stands alone, and uses bars for absolute values.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

FIELD = re.compile(r"(?P<names>\w+(, \w+| and \w+| or \w+)*( and \w+)*) : (?P<text>.+)")
UNDERLINE = re.compile("-{3,}")


def as_numpy_has_it(lines: list[str]) -> Iterator[str]:
    """The lines with every description on lines of its own, below the names."""
    in_list = False
    for before, line, behind in zip(["", *lines], lines, [*lines[1:], ""], strict=False):
        found = FIELD.fullmatch(line)
        if found and not in_list and not UNDERLINE.fullmatch(before):
            yield from ("Parameters", "----------")
        if in_list and not found and line[:1] not in ("", " ") and not UNDERLINE.fullmatch(behind):
            yield ""  # the second empty line, which ends the list
        if found:
            yield found["names"]
            yield f"    {found['text']}"
        else:
            yield line
        in_list = bool(found) or (in_list and line[:1] in ("", " "))


def rewrite(app: Any, what: str, name: str, thing: Any, options: Any, lines: list[str]) -> None:
    """Called for every docstring, before napoleon is."""
    lines[:] = [line.replace("|", r"\|") for line in as_numpy_has_it(lines)]
    if what in ("attribute", "property"):
        lines.insert(0, r"\ ")  # or napoleon takes what is before a colon for a type


def without_private(
    app: Any, what: str, name: str, thing: Any, options: Any, signature: str, result: str
) -> tuple[str, str] | None:
    """Called for every signature: parameters with an underscore are nobody's business."""
    return (re.sub(r", _\w+(=[^,)]+)?", "", signature), result) if signature else None


def setup(app: Any) -> dict[str, bool]:
    """Registers what is rewritten."""
    app.setup_extension("sphinx.ext.autodoc")
    app.connect("autodoc-process-docstring", rewrite, priority=400)
    app.connect("autodoc-process-signature", without_private)
    return {"parallel_read_safe": True}
