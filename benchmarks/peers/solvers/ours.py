"""pyrod: as many grids as an accuracy asks for (`tol`), or one grid (`n`)."""

from __future__ import annotations

from typing import Any

import numpy as np

import pyrod
from peers.cases import CASES
from peers.measure import Plan, Setting, Shape, clock, thinned
from peers.problem import Problem

ABOUT = (
    f"pyrod {pyrod.__version__}; one call `solve(scene)`, or `solve(scene, tol=tol)`, with default "
    "options and no start; every time that of the first call on a new scene"
)
NAMES = ["pyrod", "pyrod grid", "pyrod spatial"]
"""In space planar cases are solved by the last."""


def plan(case: str, name: str) -> Plan:
    models = list(CASES[case].models)
    grids: list[list[Setting]] = [[{"n": 2**k}] for k in range(3, 11)]
    ladder: list[list[Setting]] = [[{"tol": 10.0**-k}] for k in range(2, 13)]
    if name == "pyrod grid" and case in ("model-cost", "scaling"):
        return Plan([], [])  # pyrod has the grids there
    if case == "model-cost":
        models = ["inextensible", "extensible", "cosserat"]
        return Plan(models, [[{"n": 64}], [{"n": 1024}], [{"tol": 1e-6}]])
    if case == "scaling":
        return Plan(["cosserat"], [[{"n": 10**k}] for k in range(2, 7)])
    if name == "pyrod spatial":
        if not CASES[case].problem(models[0]).planar:
            return Plan([], [])  # as pyrod
        return Plan(models[:1], ladder)
    return Plan(models, ladder if name == "pyrod" else grids)


def solve(problem: Problem, name: str, setting: Setting) -> list[Shape]:
    began = clock()
    ready = scene(problem, name, setting.get("n"))
    built = clock()
    result = pyrod.solve(ready, tol=setting.get("tol"))
    positions = np.asarray(result.positions)  # worked out when they are asked for
    done = clock()
    some = thinned(len(positions) - 1)
    more: dict[str, Any] = {"energy": float(result.energy)}
    if problem.pose is not None and not problem.ring:
        more["force"] = [float(x) for x in result.force[0]]
    s, r = np.asarray(result.s)[some], positions[some]
    return [Shape(done - built, built - began, s, r, True, result.iterations, more=more)]


def scene(problem: Problem, name: str, n: int | None) -> pyrod.Scene:
    section = pyrod.Section(**problem.stiffness)
    if problem.K0.any():
        rod = pyrod.Rod.precurved(problem.L, n, section, problem.K0)
    else:
        rod = pyrod.Rod.straight(problem.L, n, section)
    if problem.ring:
        return pyrod.Scene(rod, joints=pyrod.Joint(("start", "end"), turns=1))
    supports = [pyrod.Clamp(*problem.start)]
    if problem.pose is not None:
        supports.append(pyrod.Clamp(*problem.pose, at="end"))
    loads: list[Any] = []
    if problem.force.any():
        loads.append(pyrod.Force(problem.force))
    if problem.moment.any():
        loads.append(pyrod.Moment(problem.moment))
    planar = problem.planar and name != "pyrod spatial"
    return pyrod.Scene(rod, supports, loads, "planar" if planar else "spatial")
