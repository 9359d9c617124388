"""The table of docs/hard_cases.md: every hard case that the tests solve, default options.

Times are medians of nine solves, without making the scene. `--long` adds those that take longer.
"""

from __future__ import annotations

import sys
import warnings
from pathlib import Path
from statistics import median
from time import perf_counter

import pyrod

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "python" / "shared"))

from hard import CASES
from hard.case import Hard

HEADER = [
    "case",
    "n",
    "iterations",
    "descents",
    "time [ms]",
    "error",
    "against",
    "residual",
    "index",
]


def median_time(case: Hard) -> float:
    scene = case.scene(case.n)
    start = case.start(case.n) if case.start else None
    times = []
    while len(times) < (1 if case.long or case.n > 1e5 else 9):
        began = perf_counter()
        pyrod.solve(scene, start=start, stable=case.stable, strict=False)
        times.append(perf_counter() - began)
    return 1e3 * median(times)


def row(case: Hard) -> list[str]:
    result = case.solve()
    return [
        case.name + (" (*)" if case.beyond else ""),
        f"{case.n}",
        f"{result.iterations}",
        f"{result.descents}",
        f"{median_time(case):.2g}",
        f"{case.error(result):.1e}",
        case.known,
        f"{result.residual / case.unit:.0e}",
        "-" if result.index < 0 else f"{result.index}",
    ]


def main() -> None:
    warnings.simplefilter("ignore")
    print("| " + " | ".join(HEADER) + " |")
    print("|---" * len(HEADER) + "|")
    for case in CASES:
        if not case.long or "--long" in sys.argv:
            print("| " + " | ".join(row(case)) + " |", flush=True)


if __name__ == "__main__":
    main()
