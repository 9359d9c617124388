"""Scenes and measures of sweeps that other processes can import; run as a program, a sweep.

Usage: sweeps.py FILE [STORE]: writes the pickled sweep. Started by ``mpiexec -n N python -m
mpi4py.futures`` it is spread over N - 1 processes.
"""

from __future__ import annotations

import pickle
import sys
from pathlib import Path
from typing import Any

import numpy as np

import pyrod
from pyrod import Clamp, Force, Rod, Scene, Section

GRID = {"load": [0.5, 1.0, 2.0, 5.0, 13.0], "angle": np.linspace(0.1, 3.0, 6)}


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


def main() -> None:
    from mpi4py.futures import MPIPoolExecutor

    with MPIPoolExecutor() as pool:
        done = pyrod.sweep(cantilever, GRID, measure=shape, executor=pool, progress=False)
    Path(sys.argv[1]).write_bytes(pickle.dumps(done))


if __name__ == "__main__":
    main()
