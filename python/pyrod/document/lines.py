"""In which line of a TOML text a value is told; the parser of the standard library forgets it."""

from __future__ import annotations

import re
import tomllib
from typing import Any

from pyrod.document.problems import KeyPath

_TOKEN = re.compile(
    r'"""(?:\\.|[^\\])*?"{3,5}|' + r"'''.*?'{3,5}|" + r'"(?:\\.|[^"\\\n])*"|' + r"'[^'\n]*'|"
    r"#[^\n]*|[\[\]{}]|\n",
    re.DOTALL,
)


def line_of(text: str, path: KeyPath) -> int | None:
    """The line, from 1, of the statement that brought the value, or the nearest table around it.

    A text that ends with a statement can be parsed, and what it tells only grows with each: the
    first such prefix with the value is found by halving.
    """
    path = _known(tomllib.loads(text), path)
    if not path:
        return None
    starts = _statements(text)
    low, high = 0, len(starts) - 1
    while high - low > 1:
        middle = (low + high) // 2
        if _known(tomllib.loads(text[: starts[middle]]), path) == path:
            high = middle
        else:
            low = middle
    begin = starts[low]
    blank = re.compile(r"(?:[ \t\r]*(?:#[^\n]*)?\n)*").match(text, begin)
    return 1 + text.count("\n", 0, blank.end() if blank else begin)


def _known(document: Any, path: KeyPath) -> KeyPath:
    """As much of the path as leads to something."""
    for depth, key in enumerate(path):
        inside = (
            key in document
            if isinstance(document, dict)
            else isinstance(document, list) and isinstance(key, int) and key < len(document)
        )
        if not inside:
            return path[:depth]
        document = document[key]
    return path


def _statements(text: str) -> list[int]:
    """Where statements end: line ends outside of brackets and texts; with both ends of the text."""
    depth, ends = 0, [0]
    for token in _TOKEN.finditer(text):
        if token[0] in ("[", "{"):
            depth += 1
        elif token[0] in ("]", "}"):
            depth -= 1
        elif token[0] == "\n" and depth == 0:
            ends.append(token.end())
    return [*ends, len(text)] if ends[-1] < len(text) else ends
