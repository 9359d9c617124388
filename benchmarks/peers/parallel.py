"""Many rods at once: threads of one process, wall clock. The solver works without Python's lock."""

from __future__ import annotations

import os
import time
from concurrent.futures import ThreadPoolExecutor
from statistics import median
from typing import Any

import pyrod
from peers.cases import CASES
from peers.problem import from_reference

RODS = 512
EDGES = 256


def rows(repeats: int = 7) -> list[dict[str, Any]]:
    """Seconds per rod with one thread and with one for each core; runs take turns."""
    from peers.solvers.ours import scene

    problem = from_reference(CASES["bend"].models["cosserat"].data())
    scenes = [scene(problem, "pyrod", EDGES) for _ in range(RODS)]
    cores = len(os.sched_getaffinity(0))
    load = os.getloadavg()[0]  # of others: without idle cores nothing gets faster
    times: dict[int, list[float]] = {1: [], cores: []}
    for _ in range(repeats):
        for threads, taken in times.items():
            with ThreadPoolExecutor(threads) as pool:
                began = time.perf_counter()
                list(pool.map(pyrod.solve, scenes, chunksize=8))
                taken.append((time.perf_counter() - began) / RODS)
    return [
        {
            "case": "parallel",
            "solver": "pyrod",
            "model": "cosserat",
            "setting": f"{RODS} bends, n={EDGES}, {threads} threads",
            "time_s": median(taken),
            "error": None,
            "converged": True,
            "note": f"wall clock; load {load:.1f}",
        }
        for threads, taken in times.items()
    ]
