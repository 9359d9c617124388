"""Shooting with SciPy: `solve_ivp` (DOP853) inside `root` (hybr), from the clamp to the other end.

In the plane four states and one unknown, the moment at the clamp; in space ten states and the
moment, and where both ends are held the section force as well.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import scipy
from scipy.integrate import solve_ivp
from scipy.optimize import root

from peers.measure import Cannot, Plan, Setting, Shape, clock
from peers.problem import Array, Problem
from peers.rod_equations import closing, derivative
from peers.solvers.loading import blended, planar_loads, stations

ABOUT = (
    f"SciPy {scipy.__version__}; DOP853 with rtol = `tol`, atol = tol/100; `root` (hybr) with "
    "xtol = tol; "
    "load steps with tol = 1e-6 but for the last, "
    "those of cantilevers each from a line through the two before; "
    "planar: 4 states and 1 unknown; else 10 states"
)
NAMES = ["SciPy shooting"]
STEPS = (1, 2, 4, 8, 16, 32, 64, 128)
ROUGH = 1e-6
Residual = Callable[[Array], Array]
Shot = Callable[..., Any]


def plan(case: str, name: str) -> Plan:
    if case in ("scaling", "model-cost"):
        raise Cannot("no grid to refine")
    if case == "ring":
        raise Cannot("not tried: no closed rods; an end would have to be led around")
    models = {"bend": ["cosserat"], "precurved": ["cosserat"], "clamped": ["cosserat"]}
    groups = [[{"tol": 10.0**-k, "steps": n} for n in STEPS] for k in range(3, 13)]
    return Plan(models.get(case, ["inextensible"]), groups)


def solve(problem: Problem, name: str, setting: Setting) -> list[Shape]:
    scaled, tol = problem.scaled(), setting["tol"]
    setup = _planar if problem.planar else _spatial
    began = clock()
    unknowns, good, parts = None, True, np.linspace(0, 1, setting["steps"] + 1)[1:]
    for part in parts:
        now = tol if part == 1 else max(tol, ROUGH)
        shot, left, start = setup(blended(scaled, part), now)
        if unknowns is None:
            before = unknowns = start

        def missed(x: Array, shot: Shot = shot, left: Residual = left) -> Array:
            return left(shot(x).y[:, -1])

        near = unknowns if problem.pose is not None else 2 * unknowns - before
        found = root(missed, near, options={"xtol": now})
        before, unknowns = unknowns, found.x
        size = 1 + float(np.abs(unknowns).max())
        good = found.success or float(np.abs(found.fun).max()) < 100 * now * size
        if not good:
            break
    run = shot(unknowns, stations())
    seconds = clock() - began
    r = run.y[:3].T
    if problem.planar:
        r = np.stack([run.y[1], 0 * run.t, run.y[0]], axis=1)
    more = {}
    if problem.pose is not None:
        more["force"] = list(unknowns[3:] * problem.stiffness["EI2"] / problem.L**2)
    return [Shape(seconds, 0.0, run.t * problem.L, r * problem.L, good, found.nfev, more=more)]


def _planar(problem: Problem, tol: float) -> tuple[Shot, Residual, Array]:
    (fx, fy), end = planar_loads(problem)

    def rates(s: float, y: Array) -> list[float]:
        c, n = np.cos(y[2]), np.sin(y[2])
        return [c, n, y[3], fx * n - fy * c]

    def shot(m: Array, at: Array | None = None):
        return solve_ivp(rates, (0, 1), [0, 0, 0, m[0]], "DOP853", at, rtol=tol, atol=tol / 100)

    return shot, lambda y: y[3:4] - end, np.zeros(1)


def _spatial(problem: Problem, tol: float) -> tuple[Shot, Residual, Array]:
    f, held = derivative(problem), problem.pose is not None

    def shot(x: Array, at: Array | None = None):
        n = x[3:] if held else problem.force
        y = np.concatenate([*problem.start, x[:3]])
        return solve_ivp(lambda s, y: f(s, y, n), (0, 1), y, "DOP853", at, rtol=tol, atol=tol / 100)

    if held:
        return shot, lambda y: closing(problem.pose, y), np.zeros(6)
    return shot, lambda y: y[7:] - problem.moment, np.zeros(3)
