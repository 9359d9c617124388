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
from pyrod.scene.scene import Scene
from pyrod.solving.job import How
from pyrod.solving.run import doubts
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
        return [record for line in lines for record in self._line(line)]

    def _line(self, line: Sequence[Numbered]) -> list[Record]:
        records = []
        before: Equilibrium | None = None
        for case, arguments in line:
            record, result = self._case(case, arguments, before)
            records.append(record)
            before = result or before
        return records

    def _case(
        self, case: int, arguments: dict[str, Any], start: Equilibrium | None
    ) -> tuple[Record, Equilibrium | None]:
        began = perf_counter()
        result, values, told, error = None, None, "", ""
        try:
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
