"""What a Python call costs beside the same call in C++: n = 64, all of it, medians of one run.

Usage: call_overhead.py PROGRAM, with PROGRAM the compiled call.cpp (``make bench`` does both).
"""

from __future__ import annotations

import itertools
import subprocess
import sys
import time
from collections.abc import Callable
from math import sin
from statistics import median

import numpy as np

import pyrod

COUNT = itertools.count()


def seconds(call: Callable[[], object], repeats: int = 300) -> float:
    times = []
    for _ in range(repeats):
        began = time.perf_counter()
        call()
        times.append(time.perf_counter() - began)
    return median(times)


def scene(space: str, edges: int | None = 64) -> pyrod.Scene:
    section = pyrod.Section(1, 1, 0.7, 4e3, 4e3, 1e4)
    rod = pyrod.Rod.straight(1.0, edges, section)
    return pyrod.Scene(rod, pyrod.Clamp(), [pyrod.Force((10, 0, 0))], space)


def main() -> None:
    lines = subprocess.check_output([sys.argv[1]], text=True).splitlines()
    names = (
        "Newton",
        "C++ call",
        "with tip",
        "C++ Solver",
        "with tip",
        "solve()",
        "rod + scene + solve()",
        "with tip",
        "Solver",
        "with tip",
    )
    widths = [max(len(name), 9) for name in names]
    print(f"{'n = 64, us':12}", *map(str.rjust, names, widths), " error of tip")
    for space, line in zip(("planar", "spatial"), lines, strict=True):
        times = [*map(float, line.split()), *python_times(space)]
        exact = pyrod.solve(scene(space, None), tol=1e-9).tip
        error = np.abs(pyrod.solve(scene(space)).tip - exact).max()
        cells = (f"{1e6 * t:{width}.1f}" for t, width in zip(times, widths, strict=True))
        print(f"{space:12}", *cells, f" {error:.1e}")


def python_times(space: str) -> list[float]:
    ready = scene(space)
    solver = pyrod.Solver(ready)

    def again() -> pyrod.Equilibrium:
        return solver.solve({"loads.0.force.0": 10 + 0.01 * sin(next(COUNT))})

    return [
        seconds(lambda: pyrod.solve(ready)),
        seconds(lambda: pyrod.solve(scene(space))),
        seconds(lambda: pyrod.solve(scene(space)).tip),
        seconds(again),
        seconds(lambda: again().tip),
    ]


if __name__ == "__main__":
    main()
