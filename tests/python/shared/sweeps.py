"""Scenes and measures of sweeps that other processes can import; run as a program, a sweep.

Usage: sweeps.py mpi|spawn FILE: writes the pickled sweep, whose functions are those of the main
module then. Started by ``mpiexec -n N python -m mpi4py.futures``, mpi spreads it over N - 1
processes.
"""

from __future__ import annotations

import multiprocessing
import os
import pickle
import sys
from concurrent.futures import Executor, ProcessPoolExecutor
from pathlib import Path
from time import sleep
from typing import Any

import numpy as np

import pyrod
from pyrod import Clamp, Force, Rod, Scene, Section

GRID = {"load": [0.5, 1.0, 2.0, 5.0, 13.0], "angle": np.linspace(0.1, 3.0, 6)}


def sweep(*args: Any, **more: Any) -> pyrod.Sweep:
    """A sweep without a bar."""
    return pyrod.sweep(*args, **{"progress": False, **more})


def cantilever(load: float, angle: float, edges: int = 24) -> Scene:
    """A strip whose tip is pulled to the side and pushed back; load 13 it does not take."""
    if load == 13:
        raise ValueError("load: 13 brings bad luck")
    force = load * np.array([np.sin(angle), 0.1, np.cos(angle)])
    return Scene(Rod.straight(1.0, edges, Section(1, 2, 0.7)), Clamp(), Force(force))


def shape(result: pyrod.Equilibrium) -> dict[str, Any]:
    """An array of two dimensions, text and a number."""
    r = result.positions
    return {"positions": r, "side": "left" if r[-1, 0] < 0.5 else "right", "energy": result.energy}


def logged(load: float, log: str) -> Scene:
    """Takes its time, and leaves a line in a file."""
    with Path(log).open("a") as file:
        file.write(f"{load}\n")
    sleep(0.005)
    return cantilever(load, 1.0)


def resumable(folder: Path) -> pyrod.Sweep:
    """A sweep that takes a while, with its store and its log in a folder."""
    parameters = {"load": np.linspace(0.1, 6.0, 60), "log": [str(folder / "log")]}
    return sweep(logged, parameters, store=folder / "store")


def dying(load: float) -> Scene:
    """Takes the process with it."""
    os._exit(1)


def pool(kind: str) -> Executor:
    """Two processes."""
    if kind == "mpi":
        from mpi4py.futures import MPIPoolExecutor

        return MPIPoolExecutor()
    return ProcessPoolExecutor(2, multiprocessing.get_context(kind))


def main() -> None:
    kind, path = sys.argv[1:]
    with pool(kind) as executor:
        done = sweep(cantilever, GRID, measure=shape, executor=executor)
    Path(path).write_bytes(pickle.dumps(done))


if __name__ == "__main__":
    main()
