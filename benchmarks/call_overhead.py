"""What a Python call costs beside the same call in C++: n = 64, all of it, medians of one run.

Usage: call_overhead.py PROGRAM, with PROGRAM the compiled call.cpp (``make bench`` does both).
"""

from __future__ import annotations

import subprocess
import sys
import time
from collections.abc import Callable
from statistics import median

import pyrod


def seconds(call: Callable[[], object], repeats: int = 300) -> float:
    times = []
    for _ in range(repeats):
        began = time.perf_counter()
        call()
        times.append(time.perf_counter() - began)
    return median(times)


def scene(space: str) -> pyrod.Scene:
    section = pyrod.Section(1, 1, 0.7, 4e3, 4e3, 1e4)
    rod = pyrod.Rod.straight(1.0, 64, section)
    return pyrod.Scene(rod, pyrod.Clamp(), [pyrod.Force((10, 0, 0))], space)


def main() -> None:
    cpp = [float(t) for t in subprocess.check_output([sys.argv[1]]).split()]
    print("n = 64, ms            C++   solve()   rod + scene + solve()   Python more than C++")
    for space, alone in zip(("planar", "spatial"), cpp, strict=True):
        ready = scene(space)
        solve = seconds(lambda ready=ready: pyrod.solve(ready))
        everything = seconds(lambda space=space: pyrod.solve(scene(space)))
        numbers = [1e3 * t for t in (alone, solve, everything, everything - alone)]
        print("{:14s} {:10.3f} {:9.3f} {:23.3f} {:22.3f}".format(space, *numbers))


if __name__ == "__main__":
    main()
