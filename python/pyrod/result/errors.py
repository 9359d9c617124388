"""What pyrod raises besides ``ValueError`` (a refused argument) and ``TypeError``."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from pyrod.result.equilibrium import Equilibrium

MOST_TOLD = 20
"""Problems of a file that one error spells out."""


class NotConverged(RuntimeError):
    """No equilibrium was reached; ``result`` holds the last iterate and its record.

    ``results``: those of all scenes, if there were many.
    """

    def __init__(self, result: Equilibrium, results: list[Equilibrium] | None = None) -> None:
        super().__init__(result, results)
        self.result = result
        self.results = results

    def __str__(self) -> str:
        r = self.result
        advice = r.advice
        if r.accuracy is not None and r.status == "not_accurate":
            advice = r.accuracy.shortfall
            if not r.accuracy.regular:
                advice += f"; {r.accuracy.reason}"
        text = f"{r.status} after {r.iterations} iterations: {advice}"
        if self.results is None:
            return text
        failed = [i for i, one in enumerate(self.results) if not one.converged]
        return f"{len(failed)} of {len(self.results)} scenes failed; scene {failed[0]}: {text}"


class UnstableWarning(UserWarning):
    """The equilibrium found is unstable: the rod would leave it."""


class StrainWarning(UserWarning):
    """The equilibrium found strains the rod beyond what the model or the edges can mean."""


class AccuracyWarning(UserWarning):
    """The error was reached without extrapolation, because the grids converge irregularly."""


class CurveWarning(UserWarning):
    """Points or frames of a curve that are probably not what was meant."""


class SceneFileProblem(NamedTuple):
    """One thing that is wrong in a file of a scene."""

    line: int | None  #: from 1; None: it is not known
    key: str  #: where, as in ``rods[0].length``; empty: the whole file
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
