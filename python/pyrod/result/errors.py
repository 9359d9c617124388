"""What is raised where there is no equilibrium, and warned of where one is doubtful."""

from __future__ import annotations

from pyrod.result.equilibrium import Equilibrium


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
