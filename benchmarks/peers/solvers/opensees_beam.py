"""OpenSeesPy: corotational frame elements, load control, Newton.

Bernoulli beams that stretch. In the plane `elasticBeamColumn` in the 2D model, which fails where
the rod turns by more than π; in space the same in the 3D model, chords of the rest shape with the
axes of their middle.
"""

from __future__ import annotations

import numpy as np
import openseespy.opensees as ops

from peers.measure import Cannot, Plan, Setting, Shape, clock, grids, thinned
from peers.problem import Problem, matrix
from peers.solvers.loading import end_motion, planar_loads

ABOUT = (
    "OpenSeesPy 3.7.1.2; `elasticBeamColumn`, corotational; in the plane the 2D model but for the "
    "roll-up; load control, Newton, BandGeneral, increments below 1e-9; RCM"
)
NAMES = ["OpenSeesPy"]
STEPS = (1, 2, 4, 8, 16, 32, 64, 128)


def plan(case: str, name: str) -> Plan:
    if case == "ring":
        raise Cannot("not tried: no closed rods; an end would have to be led around")
    if case == "model-cost":
        raise Cannot("one model only")
    if case == "clamped":
        return Plan(["extensible"], grids([8, 16, 32, 64, 128], (64, 128, 256, 512, 1024)))
    if case == "scaling":
        return Plan(["extensible"], grids([100, 1000, 10_000, 100_000], STEPS))
    return Plan(["extensible"], grids([8, 16, 32, 64, 128, 256, 512, 1024], STEPS))


def solve(problem: Problem, name: str, setting: Setting) -> list[Shape]:
    began, n, steps = clock(), setting["n"], setting["steps"]
    turns = abs(problem.moment[1]) > 3
    flat = problem.planar and not turns
    _planar(problem, n) if flat else _spatial(problem, n)
    if problem.pose is not None:
        _move(problem, n, steps)
    ops.constraints("Plain" if problem.pose is None else "Transformation")
    ops.numberer("RCM")
    ops.system("BandGeneral")
    ops.test("NormDispIncr", 1e-9 * problem.L, 50)
    ops.algorithm("Newton")
    ops.integrator("LoadControl", 1.0 / steps)
    ops.analysis("Static")
    built = clock()
    iterations, good = 0, True
    for _ in range(steps):
        good = ops.analyze(1) == 0
        if not good:
            break
        iterations += ops.testIter()
    done = clock()
    nodes = range(n + 1)[thinned(n)]
    axes = (1, 2) if flat else (1, 2, 3)
    x = np.array([[ops.nodeCoord(i + 1, k) + ops.nodeDisp(i + 1, k) for k in axes] for i in nodes])
    r = np.stack([x[:, 1], 0 * x[:, 0], x[:, 0]], axis=1) if flat else x
    s = np.array(nodes) * problem.L / n
    return [Shape(done - built, built - began, s, r, good, iterations)]


def _planar(problem: Problem, n: int) -> None:
    """X along a3 and Y along a1 of the clamp."""
    (fx, fy), moment = planar_loads(problem)
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    for i in range(n + 1):
        ops.node(i + 1, problem.L * i / n, 0.0)
    ops.fix(1, 1, 1, 1)
    ops.geomTransf("Corotational", 1)
    for i in range(1, n + 1):
        stiffness = problem.stiffness["EA"], 1.0, problem.stiffness["EI2"]
        ops.element("elasticBeamColumn", i, i, i + 1, *stiffness, 1)
    _load(n, fx, fy, moment)


def _spatial(problem: Problem, n: int) -> None:
    """Local axes of an element: x along the chord, xz the plane of the chord and a2."""
    r, _ = problem.rest(np.linspace(0, problem.L, n + 1))
    _, q = problem.rest((np.arange(n) + 0.5) * problem.L / n)
    normals = matrix(q)[:, :, 1]
    k = problem.stiffness
    ops.wipe()
    ops.model("basic", "-ndm", 3, "-ndf", 6)
    for i, x in enumerate(r):
        ops.node(i + 1, *map(float, x))
    ops.fix(1, 1, 1, 1, 1, 1, 1)
    for i in range(1, n + 1):
        ops.geomTransf("Corotational", i, *map(float, normals[i - 1]))
        # A, E, G, J, Iy, Iz: bending about the local z = a2 is EI2
        section = k["EA"], 1.0, 1.0, k["GJ"], k["EI1"], k["EI2"]
        ops.element("elasticBeamColumn", i, i, i + 1, *section, i)
    if problem.pose is None:
        _load(n, *map(float, problem.force), *map(float, problem.moment))


def _move(problem: Problem, n: int, steps: int) -> None:
    """The held end, by displacements and spins."""
    for i, values in enumerate(end_motion(problem, steps).T, start=1):
        times = [k / steps for k in range(steps + 1)] + [2.0]
        path = [*map(float, values), float(values[-1])]
        ops.timeSeries("Path", i, "-time", *times, "-values", *path)
        ops.pattern("Plain", i, i)
        ops.sp(n + 1, i, 1.0)


def _load(n: int, *components: float) -> None:
    ops.timeSeries("Linear", 1)
    ops.pattern("Plain", 1, 1)
    ops.load(n + 1, *components)
