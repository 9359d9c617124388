"""A sweep of 1000 cases, here and on executors with two workers: medians of some runs, and errors.

Usage: sweep.py. (It starts itself under mpiexec as ``sweep.py mpi``.)
"""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from contextlib import contextmanager
from pathlib import Path
from statistics import median
from typing import Any

import numpy as np

import pyrod

GRID = {"load": np.linspace(0.1, 10, 40), "angle": np.linspace(0.1, 3.0, 25)}
SETTINGS: dict[str, dict[str, Any]] = {"32 edges": {}, "tol 1e-6": {"tol": 1e-6}}
RUNS = 5
WORKERS = 2


def cantilever(load: float, angle: float) -> pyrod.Scene:
    """A strip pulled to one side, and a little across."""
    rod = pyrod.Rod.straight(1.0, 32, pyrod.Section(1, 2, 0.7))
    force = load * np.array([np.sin(angle), 0.1, np.cos(angle)])
    return pyrod.Scene(rod, pyrod.Clamp(), pyrod.Force(force))


def tip(result: pyrod.Equilibrium) -> dict[str, Any]:
    """What is kept, so that returning it counts."""
    return {"tip": result.tip}


def sweep(executor: Any, **settings: Any) -> pyrod.Sweep:
    return pyrod.sweep(cantilever, GRID, measure=tip, executor=executor, progress=False, **settings)


def measured(executor: Any) -> dict[str, list[Any]]:
    """Median time [s] and tips for all settings; the first run, which may start workers, is left
    out."""
    out = {}
    for name, settings in SETTINGS.items():
        done = [sweep(executor, **settings) for _ in range(RUNS + 1)][1:]
        out[name] = [median(one.elapsed for one in done), done[0]["tip"].tolist()]
    return out


@contextmanager
def dask_client() -> Iterator[Any]:
    from dask.distributed import Client, LocalCluster

    options = {"n_workers": WORKERS, "threads_per_worker": 1, "dashboard_address": None}
    with LocalCluster(**options) as cluster, Client(cluster) as client:
        yield client


def by_mpi() -> dict[str, list[Any]] | None:
    """What this program measures as one of several processes."""
    folder = Path(sys.executable).parent
    mpiexec = shutil.which("mpiexec", path=str(folder)) or shutil.which("mpiexec")
    if mpiexec is None:
        return None
    command = [mpiexec, "-n", str(WORKERS + 1), sys.executable, "-m", "mpi4py.futures", __file__]
    return json.loads(subprocess.check_output([*command, "mpi"]))


def report(found: dict[str, dict[str, list[Any]] | None]) -> None:
    print(f"{'1000 cases':12} {'executor':10} {'time [s]':>9} {'cases/s':>9}  error of the tip")
    for name in SETTINGS:
        exact = sweep(None, tol=1e-9)["tip"]
        for executor, results in found.items():
            if results is not None:
                seconds, tips = results[name]
                error = np.abs(np.array(tips) - exact).max()
                row = f"{name:12} {executor:10} {seconds:9.3f} {1000 / seconds:9.0f}"
                print(f"{row}  {error:.1e}")


def main() -> None:
    if sys.argv[1:] == ["mpi"]:
        from mpi4py.futures import MPIPoolExecutor

        with MPIPoolExecutor() as pool:
            print(json.dumps(measured(pool)))
        return
    found: dict[str, dict[str, list[Any]] | None] = {"here": measured(None)}
    with ThreadPoolExecutor(WORKERS) as threads:
        found["threads"] = measured(threads)
    with ProcessPoolExecutor(WORKERS) as processes:
        found["processes"] = measured(processes)
    with dask_client() as client:
        found["dask"] = measured(client)
    found["mpi"] = by_mpi()
    report(found)


if __name__ == "__main__":
    main()
