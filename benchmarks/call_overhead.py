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
    names = ("Newton", "C++ call", "solve()", "rod + scene + solve()", "C++ Solver", "Solver")
    print(
        f"{'n = 64, us':12}", *(f"{name:>{max(len(name), 9)}}" for name in names), " error of tip"
    )
    for space, line in zip(("planar", "spatial"), lines, strict=True):
        newton, call, following = map(float, line.split())
        ready = scene(space)
        solver = pyrod.Solver(ready)
        solve = seconds(lambda ready=ready: pyrod.solve(ready))
        everything = seconds(lambda space=space: pyrod.solve(scene(space)))
        again = seconds(
            lambda solver=solver: solver.solve({"loads.0.force.0": 10 + 0.01 * sin(next(COUNT))})
        )
        exact = pyrod.solve(scene(space, None), tol=1e-9).tip
        error = np.abs(pyrod.solve(ready).tip - exact).max()
        times = (newton, call, solve, everything, following, again)
        cells = (f"{1e6 * t:{max(len(n), 9)}.1f}" for n, t in zip(names, times, strict=True))
        print(f"{space:12}", *cells, f" {error:.1e}")


if __name__ == "__main__":
    main()
