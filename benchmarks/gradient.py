"""The gradient of a tip's place in all rest curvatures of a strip: `vjp` beside differences of
solves, and beside the same discrete strip in JAX where that is installed.

Usage: gradient.py [edges] [runs]. Medians; times are of the whole call, from the equilibrium on.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from importlib.util import find_spec
from statistics import median
from time import perf_counter
from typing import NamedTuple

import numpy as np

import pyrod

FORCE = np.array([3.0, 0.0, -1.0])
WEIGHTS = np.array([1.0, 0.0, 0.3])  # of the place of the tip
STEP = 1e-4


class Row(NamedTuple):
    name: str
    seconds: float
    gradient: np.ndarray


def curvatures(edges: int) -> np.ndarray:
    return 1 + 2 * np.sin(5 * np.linspace(0, 1, edges + 1))


def strip(K2: np.ndarray) -> pyrod.Scene:
    """Clamped, bent at rest, pulled at its end; in the plane, and inextensible."""
    section = pyrod.Section(EI1=1.0, EI2=1.0, GJ=0.8)
    rod = pyrod.Rod.precurved(1.0, len(K2) - 1, section, np.stack([0 * K2, K2, 0 * K2], 1))
    return pyrod.Scene(rod, pyrod.Clamp(frame=(1, 0, 0, 0)), pyrod.Force(FORCE), space="planar")


def tip(K2: np.ndarray, near: pyrod.Equilibrium) -> float:
    return float(WEIGHTS @ pyrod.solve(strip(K2), start=near).tip)


def by_adjoint(K2: np.ndarray, result: pyrod.Equilibrium) -> np.ndarray:
    """One solve of a linear system."""
    return pyrod.linearised(result).vjp({"tip": WEIGHTS}, "rods.0.K0")["rods.0.K0"][:, 1]


def by_differences(K2: np.ndarray, result: pyrod.Equilibrium) -> np.ndarray:
    """Two solves for each curvature, started from the equilibrium."""
    units = STEP * np.eye(len(K2))
    ahead = np.array([tip(K2 + unit, result) for unit in units])
    behind = np.array([tip(K2 - unit, result) for unit in units])
    return (ahead - behind) / (2 * STEP)


def jax_gradient(K2: np.ndarray, result: pyrod.Equilibrium) -> Callable[[], np.ndarray]:
    """The same energy, its Hessian by JAX and dense, and the adjoint equation; compiled."""
    import jax

    jax.config.update("jax_enable_x64", True)
    import jax.numpy as jnp

    n = len(K2) - 1
    h = 1 / n
    spaces = jnp.full(n, h).at[0].set(h / 2)  # of the cells: the first is half of one

    def place(angles: jax.Array) -> jax.Array:
        return h * jnp.stack([jnp.sin(angles).sum(), 0.0, jnp.cos(angles).sum()])

    def energy(angles: jax.Array, K: jax.Array) -> jax.Array:
        turns = jnp.diff(angles, prepend=0.0)
        return ((turns / spaces - K[:-1]) ** 2 * spaces).sum() / 2 - FORCE @ place(angles)

    def gradient(angles: jax.Array, K: jax.Array) -> jax.Array:
        hessian = jax.hessian(energy)(angles, K)
        adjoint = jnp.linalg.solve(hessian, jax.grad(lambda a: WEIGHTS @ place(a))(angles))
        return -jax.grad(lambda k: adjoint @ jax.grad(energy)(angles, k))(K)

    x, _, z = np.diff(result.positions, axis=0).T
    angles, compiled = np.unwrap(np.arctan2(x, z)), jax.jit(gradient)
    return lambda: np.asarray(compiled(angles, K2))


def measured(edges: int, runs: int) -> list[Row]:
    K2 = curvatures(edges)
    result = pyrod.solve(strip(K2))
    ways = {
        "vjp": lambda: by_adjoint(K2, result),
        "differences of solves": lambda: by_differences(K2, result),
    }
    if find_spec("jax"):
        ways["JAX, dense"] = jax_gradient(K2, result)
    rows = []
    for name, way in ways.items():
        gradient, times = way(), []
        for _ in range(runs):
            start = perf_counter()
            way()
            times.append(perf_counter() - start)
        rows.append(Row(name, median(times), gradient))
    return rows


def main() -> None:
    edges, runs = map(int, (sys.argv[1:] + ["199", "5"][len(sys.argv) - 1 :])[:2])
    rows = measured(edges, runs)
    best = rows[0]
    size = np.abs(best.gradient).max()
    print(f"{edges + 1} curvatures\n\n{'':24}{'time':>11}{'over vjp':>10}  off by")
    for row in rows:
        off = np.abs(row.gradient - best.gradient).max() / size
        ratio = row.seconds / best.seconds
        print(f"{row.name:24}{1e3 * row.seconds:8.2f} ms{ratio:10.1f}  {off:.1e}")
    print("\nSoRoMoX, in JAX, has dynamics and no statics: nothing to compare with.")


if __name__ == "__main__":
    main()
