"""What is wrong with a document, collected while it is read, and where."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from difflib import get_close_matches
from typing import Any, NamedTuple

from pyrod.document.errors import MOST_TOLD, SceneFileProblem

KeyPath = tuple[str | int, ...]
"""Keys and numbers that lead to a value: ("rods", 0, "length")."""


class Problem(NamedTuple):
    """What is wrong at one place."""

    path: KeyPath
    what: str


class Refused(Exception):
    """A document that cannot be read; ``problems`` are all that were found."""

    def __init__(self, problems: list[Problem]) -> None:
        super().__init__(problems)
        self.problems = problems

    def told(
        self, line_of: Callable[[KeyPath], int | None] = lambda path: None
    ) -> tuple[SceneFileProblem, ...]:
        """The problems as errors tell them; ``line_of``: where a value is told in a file."""
        told_once = dict.fromkeys(self.problems)
        lines = {path: line_of(path) for path, _ in [*told_once][:MOST_TOLD]}
        return tuple(
            SceneFileProblem(lines.get(path), told(path), what) for path, what in told_once
        )


class Found:
    """The problems of a document so far, and the names that it gives to its parts."""

    def __init__(self, document: dict[str, Any]) -> None:
        self.problems: list[Problem] = []
        self.names = {kind: _names_in(document, kind) for kind in ("materials", "sections")}
        rods = document.get("rods")
        self.rods = [
            rod.get("name") if isinstance(rod, dict) else None
            for rod in (rods if isinstance(rods, list) else [])
        ]

    def stop(self) -> None:
        """Ends the reading if there are problems."""
        if self.problems:
            raise Refused(self.problems)

    @contextmanager
    def blamed(self, *path: str | int) -> Iterator[None]:
        """Takes what a class refuses as a problem of its table; "E: ..." is one of its key E."""
        try:
            yield
        except MemoryError:
            self.problems.append(Problem(path, "too large for the memory of this machine"))
        except (ValueError, TypeError, ArithmeticError) as error:
            name, what = re.fullmatch(r"(?:(\w+): )?(.*)", str(error), re.DOTALL).groups()  # type: ignore[union-attr]
            self.problems.append(Problem((*path, name) if name else path, what))


def _names_in(document: dict[str, Any], kind: str) -> list[str]:
    tables = document.get(kind)
    return list(tables) if isinstance(tables, dict) else []


class Here(NamedTuple):
    """A place in a document that is being read."""

    path: KeyPath
    found: Found

    def __truediv__(self, key: str | int) -> Here:
        return Here((*self.path, key), self.found)

    def wrong(self, what: str) -> None:
        """Notes a problem; the value is None, then."""
        self.found.problems.append(Problem(self.path, what))


def told(path: KeyPath) -> str:
    """The path as it is written in Python: ``rods[0].length``."""
    text = "".join(f"[{key}]" if isinstance(key, int) else f".{key}" for key in path)
    return text.removeprefix(".")


def a(name: str) -> str:
    """With the indefinite article."""
    return f"an {name}" if name[0] in "aeiou" else f"a {name}"


def instead(name: object, names: Iterable[str]) -> str:
    """The name in quotes, and what may have been meant."""
    known = list(names)
    near = get_close_matches(str(name), known, 1)
    if near:
        return f'"{name}": did you mean "{near[0]}"?'
    return f'"{name}"; there is ' + (", ".join(known) or "none")


def shown(value: Any) -> str:
    """A value in an error, cut if it is long."""
    if isinstance(value, dict):
        return f"a table with {', '.join(map(str, value)) or 'nothing'}"[:80]
    text = f'"{value}"' if isinstance(value, str) else repr(value)
    return text if len(text) <= 60 else f"{text[:56]} ..."
