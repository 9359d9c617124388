"""Solve the reference cases on this machine, and compare with the exact solutions.

Each case is solved to the tolerance, and its true error may not exceed the one that is told.
"""

from __future__ import annotations

import argparse
import sys
import time
import warnings
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from fnmatch import fnmatch
from pathlib import Path

import pyrod
from pyrod import reference
from pyrod.base.progress import progress_shown
from pyrod.cli.output import Output
from pyrod.reference import Case
from pyrod.reference import _notes as notes
from pyrod.scene.scene import Space

NAME = "check"
HELP = "solve the reference cases here and print the errors"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """What the command takes."""
    parser.add_argument("cases", nargs="*", default=["*"], help="names, like 'P1*'; default: all")
    parser.add_argument("--tol", type=float, default=1e-6, help="default: 1e-6")
    parser.add_argument("--folder", type=Path, help="other cases than those of the package")
    parser.add_argument("--list", action="store_true", help="list the cases and do not solve them")


HEAD = f"{'case':34s} {'space':8s} {'edges':>6s} {'time [ms]':>9s} {'told':>9s} {'error':>9s}"


@dataclass(frozen=True)
class CheckRow:
    """One case in one space."""

    case: str
    space: str
    edges: int  #: of the finest grid
    milliseconds: float
    told: float  #: largest estimate among the quantities that are compared
    error: float  #: largest true error
    quantity: str  #: which has it
    passed: bool
    status: str

    @property
    def text(self) -> str:
        """A line of the table."""
        verdict = "" if self.passed else f"  FAILED in {self.quantity} ({self.status})"
        return (
            f"{self.case:34s} {self.space:8s} {self.edges:6d} {self.milliseconds:9.2f} "
            f"{self.told:9.1e} {self.error:9.1e}{verdict}"
        )


def run(args: argparse.Namespace, output: Output) -> int:
    """Prints the table as it grows; 1 if a case failed."""
    cases = [
        c for c in reference.load(args.folder or reference.folder()) if _is_asked(c, args.cases)
    ]
    if not cases:
        raise ValueError(f"cases: none is named {' or '.join(args.cases)}; see pyrod check --list")
    if args.list:
        for case in cases:
            output.text(f"{case!s:34s} {case.data.get('title', '')}")
        output.result({"cases": list(map(str, cases))})
        return 0
    todo = [(c, s) for c in cases if str(c) not in notes.PULSES for s in c.spaces]
    output.text(HEAD)
    began = time.perf_counter()
    rows = list(_rows(todo, args.tol, output))
    seconds = time.perf_counter() - began
    failed = [row for row in rows if not row.passed]
    worst = max(rows, key=lambda row: row.error)
    output.text(
        f"{len(rows)} solves to {args.tol:g}, {len(failed)} failed, worst error {worst.error:.1e} "
        f"({worst.case}), {seconds:.1f} s"
    )
    left_out = {str(c): notes.PULSES[str(c)] for c in cases if str(c) in notes.PULSES}
    for name, why in left_out.items():
        output.text(f"left out: {name}: {why}")
    output.result(
        {
            "tol": args.tol,
            "passed": not failed,
            "seconds": seconds,
            "rows": [asdict(row) for row in rows],
            "left_out": left_out,
        }
    )
    return int(bool(failed))


def _is_asked(case: Case, patterns: list[str]) -> bool:
    return any(fnmatch(str(case), pattern) for pattern in patterns)


def _rows(todo: list[tuple[Case, Space]], tol: float, output: Output) -> Iterator[CheckRow]:
    """On a terminal the table itself shows how far it is."""
    looks = not output.json and not sys.stdout.isatty()
    with progress_shown(looks, len(todo), "cases") as show:
        for done, (case, space) in enumerate(todo, 1):
            row = _row(case, space, tol)
            output.text(row.text)
            if show is not None:
                show(done)
            yield row


def _row(case: Case, space: Space, tol: float) -> CheckRow:
    """One line of the table."""
    edges = case.first_edges
    start = None if case.found_alone or edges is None else case.start(edges)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", pyrod.UnstableWarning)
        result = pyrod.solve(
            case.scene(edges, space), tol=tol, start=start, stable=start is None, strict=False
        )
    assert result.accuracy is not None
    told = result.accuracy.errors
    errors = case.nearest(result).errors(result)
    excess = {name: error / max(told[name], case.rounding) for name, error in errors.items()}
    worst = max(errors, key=lambda name: excess[name])
    return CheckRow(
        str(case),
        space,
        result.accuracy.finest_edges,
        1e3 * result.time,
        max(told[name] for name in errors),
        max(errors.values()),
        worst,
        result.converged and excess[worst] <= 1,
        result.status,
    )
