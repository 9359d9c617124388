"""SciPy's `solve_bvp`: collocation of the rod's equations on a mesh that it refines itself.

In the plane four states and an exact Jacobian, in space ten states (positions, quaternion, moment)
with the section force as a parameter where both ends are held.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import scipy
from scipy.integrate import solve_bvp

from peers.measure import Cannot, Plan, Setting, Shape, clock
from peers.problem import Array, Problem, product
from peers.rod_equations import closing, derivative
from peers.solvers.loading import blended, planar_loads, stations

ABOUT = (
    f"SciPy {scipy.__version__}; mesh of 11 points from the rest shape, load steps with "
    "tol = 1e-3 and the last with `tol` as stated; planar: 4 states, exact Jacobian; else "
    "10 states, quaternion, section force as parameter if both ends are held; ring: "
    "from a circle with twisted frames"
)
NAMES = ["SciPy solve_bvp"]
STEPS = (1, 2, 4, 8, 16, 32, 64)
ROUGH = 1e-3


def plan(case: str, name: str) -> Plan:
    if case in ("scaling", "model-cost"):
        raise Cannot("refines its own mesh")
    models = {"bend": ["cosserat"], "precurved": ["cosserat"], "clamped": ["cosserat"]}
    steps = (1,) if case == "ring" else STEPS
    groups = [[{"tol": 10.0**-k, "steps": n} for n in steps] for k in range(2, 11)]
    return Plan(models.get(case, ["inextensible"]), groups)


def solve(problem: Problem, name: str, setting: Setting) -> list[Shape]:
    run = _planar if problem.planar else _spatial
    return [run(problem.scaled(), problem, setting)]


def _planar(scaled: Problem, problem: Problem, setting: Setting) -> Shape:
    """y = (X, Y, θ, m), X along a3 and Y along a1 of the clamp."""
    (Fx, Fy), M = planar_loads(scaled)
    x = np.linspace(0, 1, 11)
    y = np.zeros((4, x.size))
    y[0] = x
    iterations, good, began = 0, True, clock()
    for part in np.linspace(0, 1, setting["steps"] + 1)[1:]:
        fx, fy, end = part * Fx, part * Fy, part * M

        def rates(s: Array, y: Array, fx: float = fx, fy: float = fy) -> Array:
            c, n = np.cos(y[2]), np.sin(y[2])
            return np.array([c, n, y[3], fx * n - fy * c])

        def slopes(s: Array, y: Array, fx: float = fx, fy: float = fy) -> Array:
            c, n = np.cos(y[2]), np.sin(y[2])
            D = np.zeros((4, 4, y.shape[1]))
            D[0, 2], D[1, 2], D[2, 3], D[3, 2] = -n, c, 1.0, fx * c + fy * n
            return D

        def ends(a: Array, b: Array, end: float = end) -> Array:
            return np.array([a[0], a[1], a[2], b[3] - end])

        tol, most = _accuracy(setting, part)
        found = solve_bvp(rates, ends, x, y, fun_jac=slopes, tol=tol, max_nodes=most)
        x, y, good = found.x, found.y, found.status == 0
        iterations += found.niter
        if not good:
            break
    seconds = clock() - began
    s = stations()
    X, Y = found.sol(s)[:2]
    r = np.stack([Y, 0 * s, X], axis=1)
    return Shape(seconds, 0.0, s * problem.L, r * problem.L, good, iterations)


def _spatial(scaled: Problem, problem: Problem, setting: Setting) -> Shape:
    f, held = derivative(scaled), scaled.pose is not None
    x, iterations, good, began = np.linspace(0, 1, 11), 0, True, clock()
    p = np.zeros(3) if held else None
    y = None
    for part in np.linspace(0, 1, setting["steps"] + 1)[1:]:
        now = scaled if scaled.ring else blended(scaled, part)
        if y is None:
            y = _guess(now, x)

        def ends(a: Array, b: Array, *p: Array, now: Problem = now) -> Array:
            start = np.concatenate([a[:3] - now.start[0], a[3:7] - now.start[1]])
            return np.concatenate([start, closing(now.pose, b) if held else b[7:] - now.moment])

        def rates(s: Array, y: Array, *p: Array, n: Array = now.force) -> Array:
            return f(s, y, p[0] if held else n)

        tol, most = _accuracy(setting, part)
        found = solve_bvp(rates, ends, x, y, p=p, tol=tol, max_nodes=most)
        x, y, p, good = found.x, found.y, found.p, found.status == 0
        iterations += found.niter
        if not good:
            break
    seconds = clock() - began
    s = stations()
    r = found.sol(s)[:3].T * problem.L
    more = {}
    if held:
        more["force"] = list(p * problem.stiffness["EI2"] / problem.L**2)
    return Shape(seconds, 0.0, s * problem.L, r, good, iterations, more=more)


def _accuracy(setting: Setting, part: float) -> tuple[float, int]:
    """Tolerance and largest mesh of a load step; meshes that grow beyond are going astray."""
    if part == 1:
        return setting["tol"], 5000
    return max(ROUGH, setting["tol"]), 1000


def _guess(problem: Problem, x: Array) -> Array:
    """The rest shape; for a ring a circle with frames that turn once about a3; no moments."""
    y = np.zeros((10, x.size))
    if problem.ring:
        problem = replace(problem, K0=np.array([0.0, 2 * np.pi, 0.0]))
    r, q = problem.rest(x)
    if problem.ring:
        turn = np.pi * x[:, None] * np.array([0.0, 0.0, 0.0, 1.0])
        q = product(q, np.hstack([np.cos(np.pi * x)[:, None], np.sin(turn[:, 1:])]))
    y[:3], y[3:7] = r.T, q.T
    return y
