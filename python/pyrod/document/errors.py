"""What is raised of a scene that cannot be read."""

from __future__ import annotations

from typing import NamedTuple

MOST_TOLD = 20
"""Problems of a file that one error spells out."""


class SceneFileProblem(NamedTuple):
    """One thing that is wrong in a file of a scene."""

    line: int | None  #: from 1; None if it is not known
    key: str  #: where, as in ``rods[0].length``; empty for the whole file
    what: str  #: what is wrong, and what would be right

    def __str__(self) -> str:
        line = "" if self.line is None else f"line {self.line}"
        place = ", ".join(part for part in (line, self.key) if part)
        return f"{place}: {self.what}" if place else self.what


class SceneFileError(ValueError):
    """A scene cannot be read from a file or a document; all its ``problems`` are told at once.

    ``file`` is its name; ``line``, ``key`` and ``what`` are those of the first problem.
    """

    def __init__(self, file: str, problems: tuple[SceneFileProblem, ...]) -> None:
        super().__init__(file, problems)
        self.file = file
        self.problems = problems
        self.line, self.key, self.what = problems[0]

    def __str__(self) -> str:
        if len(self.problems) == 1:
            return f"{self.file}, {self.problems[0]}"
        told = [f"\n  {problem}" for problem in self.problems[:MOST_TOLD]]
        more = len(self.problems) - len(told)
        rest = f"\n  and {more} more" if more else ""
        return f"{self.file}: {len(self.problems)} problems{''.join(told)}{rest}"
