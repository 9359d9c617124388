"""Exact positions at any arc length, for each case and model.

Between the samples of tests/reference, and from them, the rod's equations are integrated to
rounding. A model that has no samples there is solved by SciPy's boundary value solver, to 1e-14
where it can be compared; its energy is integrated along the solution.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from scipy.integrate import solve_bvp, solve_ivp

from peers.cases import CASES
from peers.problem import Array, Problem, from_reference
from peers.rod_equations import closing, derivative, energy

SAMPLES = 33
TOLERANCE = 1e-11


@dataclass(frozen=True)
class Exact:
    """States (10, samples) at equal distances, in units of the problem."""

    problem: Problem
    s: Array
    y: Array
    n: Array
    energy: float
    source: str

    def positions(self, s: Array) -> Array:
        """(m, 3) positions at arc lengths."""
        f = derivative(self.problem)
        found = []
        for at in np.asarray(s, dtype=float):
            j = int(np.argmin(abs(self.s - at)))
            y = self.y[:, j]
            if abs(self.s[j] - at) > 1e-13 * self.problem.L:
                run = solve_ivp(
                    lambda x, y: f(x, y, self.n),
                    (self.s[j], at),
                    y,
                    "DOP853",
                    rtol=1e-13,
                    atol=1e-15 * abs(self.y).max(),
                )
                y = run.y[:, -1]
            found.append(y[:3])
        return np.array(found)


@lru_cache
def exact(case: str, model: str) -> Exact:
    data = CASES[case].models[model].data()
    problem = from_reference(data)
    if data["r"] is not None:
        return _sampled(problem, data)
    if problem.pose is None and not problem.force.any():  # nothing strains but K: as inextensible
        known = exact(case, "inextensible")
        return Exact(problem, known.s, known.y, known.n, known.energy, known.source)
    return _solved(problem, _guess(case))


def _sampled(problem: Problem, data: dict[str, Any]) -> Exact:
    y = np.hstack([np.array(data[k], dtype=float) for k in ("r", "q", "m")]).T
    n = np.array(data["n"][0], dtype=float)
    return Exact(problem, np.array(data["s"]), y, n, data["energy"], f"reference {data['id']}")


def _guess(case: str) -> Exact:
    """The sampled solution of another model."""
    for model, variant in CASES[case].models.items():
        if not variant.stiffness:
            return exact(case, model)
    raise LookupError(case)


def _solved(problem: Problem, near: Exact) -> Exact:
    """In scaled units; the section force is a parameter where the end is held."""
    scaled, size = problem.scaled(), _sizes(problem)
    f, held = derivative(scaled), scaled.pose is not None
    unit = problem.stiffness["EI2"] / problem.L**2

    def conditions(a: Array, b: Array, *p: Array) -> Array:
        start = np.concatenate([a[:3] - scaled.start[0], a[3:7] - scaled.start[1]])
        end = closing(scaled.pose, b) if held else b[7:] - scaled.moment
        return np.concatenate([start, end])

    force = (lambda p: p[0]) if held else (lambda p: scaled.force)
    solution = solve_bvp(
        lambda s, y, *p: f(s, y, force(p)),
        conditions,
        near.s / problem.L,
        near.y / size,
        p=near.n / unit if held else None,
        tol=TOLERANCE,
        max_nodes=100_000,
    )
    if solution.status:
        raise ArithmeticError(solution.message)
    n = force((solution.p,)) if held else scaled.force
    s = np.linspace(0, 1, SAMPLES)
    fine = np.linspace(0, 1, 4097)
    simpson = np.array([1.0, *np.tile([4.0, 2.0], 2047), 4.0, 1.0]) / 3 / 4096
    work = float(energy(scaled, solution.sol(fine), n) @ simpson) * unit * problem.L
    source = f"SciPy solve_bvp, tol = {TOLERANCE:g}"
    return Exact(problem, s * problem.L, solution.sol(s) * size, n * unit, work, source)


def _sizes(problem: Problem) -> Array:
    sizes = [problem.L] * 3 + [1.0] * 4 + [problem.stiffness["EI2"] / problem.L] * 3
    return np.array(sizes)[:, None]
