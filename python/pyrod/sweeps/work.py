"""Solving cases where they are sent to: a thread, another process, another machine."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from time import perf_counter
from typing import Any, Literal, NamedTuple

from pyrod.base.words import shortly
from pyrod.models.solve import found
from pyrod.result.equilibrium import Equilibrium
from pyrod.result.errors import NotConverged
from pyrod.rod.section import Model
from pyrod.scene.numbers import NewNumbers
from pyrod.scene.scene import Scene
from pyrod.solving.job import How
from pyrod.solving.run import doubts
from pyrod.solving.solver import Solver
from pyrod.sweeps.build import Changed
from pyrod.sweeps.measures import Measuring, plain

Numbered = tuple[int, dict[str, Any]]
"""A case, and its parameters."""


class Record(NamedTuple):
    """What came of a case."""

    case: int
    values: dict[str, Any] | None  #: what the measure told; None: it failed
    warnings: str  #: one after the other, or nothing
    error: str  #: why it failed, or nothing
    time: float  #: of making the scene, solving it and measuring [s]
    result: Equilibrium | None = None  #: if it is to be kept


class OneAfterAnother:
    """Solves cases of one scene that differ in numbers, without making their scenes."""

    def __init__(self, scene: Scene, how: How) -> None:
        self._numbers = NewNumbers(scene)
        self._how = how
        self._solver: Solver | None = None
        self._names: frozenset[str] = frozenset()  # of the parameters
        self._last: Equilibrium | None = None

    def found(self, values: dict[str, Any], start: Equilibrium | None) -> Equilibrium | None:
        """What is found with these, from ``start`` or afresh; None: not by this way."""
        if (start is not None and start is not self._last) or not self._takes(values):
            return None
        if self._solver is None:
            options, stable, eigenvalue, tol = self._how
            self._solver = Solver(
                self._numbers.scene, options, tol=tol, stable=stable, eigenvalue=eigenvalue
            )
            self._names = frozenset(values)
        if start is None:
            self._solver.forget()
        self._last = None
        self._last = self._solver.unjudged(values)
        return self._last

    def _takes(self, values: dict[str, Any]) -> bool:
        """Numbers only, of the entries that all cases change."""
        if self._names and self._names != values.keys():
            return False
        return self._numbers.read(values) is not None


@dataclass(frozen=True)
class Work:
    """How cases are solved. It can be pickled if its functions can."""

    build: Callable[..., Scene]
    measure: Measuring
    how: How
    model: Literal["auto"] | Model | None
    keep: bool  #: the equilibria, too

    def __call__(self, lines: Sequence[Sequence[Numbered]]) -> list[Record]:
        """What comes of lines of cases, which start from one another."""
        solver = None
        if isinstance(self.build, Changed) and self.model is None:
            solver = OneAfterAnother(self.build.scene, self.how)
        return [record for line in lines for record in self._line(line, solver)]

    def _line(self, line: Sequence[Numbered], solver: OneAfterAnother | None) -> list[Record]:
        records = []
        before: Equilibrium | None = None
        for case, arguments in line:
            record, result = self._case(case, arguments, before, solver)
            records.append(record)
            before = result or before
        return records

    def _case(
        self,
        case: int,
        arguments: dict[str, Any],
        start: Equilibrium | None,
        solver: OneAfterAnother | None,
    ) -> tuple[Record, Equilibrium | None]:
        began = perf_counter()
        result, values, told, error = None, None, "", ""
        try:
            result = solver.found(arguments, start) if solver else None
            if result is None:
                result = found(self._scene(arguments), self.how, self.model, start)
            if not result.converged:
                raise NotConverged(result)
            told = "; ".join(f"{kind.__name__}: {x}" for kind, x in doubts(result))
            values = plain(self.measure(result), arguments)
        except Exception as failure:  # of this case only; the others go on
            error = f"{type(failure).__name__}: {failure}"
        kept = result if self.keep and not error else None
        record = Record(case, values, told, error, perf_counter() - began, kept)
        return record, result if result is not None and result.converged else None

    def _scene(self, arguments: dict[str, Any]) -> Scene:
        scene = self.build(**arguments)
        if not isinstance(scene, Scene):
            raise TypeError(f"scene: the function must return a Scene, got {shortly(scene)}")
        return scene
