"""Exudyn: beam finite elements with the static solver, load steps and full Newton.

In the plane cables in absolute nodal coordinates (they stretch) and geometrically exact beams of
three nodes (they shear too); in space geometrically exact beams of two nodes.
"""

from __future__ import annotations

from itertools import pairwise

import exudyn
import numpy as np
from exudyn import itemInterface as items

from peers.measure import Cannot, Plan, Setting, Shape, clock, grids, thinned
from peers.problem import Problem, product
from peers.solvers.loading import blended, planar_loads

ABOUT = (
    f"Exudyn {exudyn.__version__}, static solver, full Newton, increments below 1e-7, EigenSparse; "
    "ANCF: `ANCFCable2D`; exact: `BeamGeometricallyExact2D` with 3 nodes, in space "
    "`BeamGeometricallyExact` on Euler parameters"
)
NAMES = ["Exudyn ANCF", "Exudyn exact"]
STEPS = (1, 2, 4, 8, 16, 32, 64, 128)
CYCLE = np.array([0.5, -0.5, -0.5, -0.5])
"""From (a1, a2, a3) to Exudyn's axes of a cross-section, (a3, a1, a2)."""


def plan(case: str, name: str) -> Plan:
    if case == "ring":
        raise Cannot("not tried: no closed rods; an end would have to be led around")
    if case == "model-cost":
        raise Cannot("one model an element")
    if name == "Exudyn ANCF":
        if case in ("bend", "precurved", "clamped"):
            raise Cannot("its cables in space do not twist")
        sizes = [100, 1000, 10_000] if case == "scaling" else [4, 8, 16, 32, 64, 128, 256]
        return Plan(["extensible"], grids(sizes, STEPS))
    if case == "scaling":
        raise Cannot("see Exudyn ANCF, which is faster")
    return Plan(["cosserat"], grids([4, 8, 16, 32, 64, 128, 256, 512], STEPS))


def solve(problem: Problem, name: str, setting: Setting) -> list[Shape]:
    began, n = clock(), setting["n"]
    system = exudyn.SystemContainer().AddSystem()
    build = {"Exudyn ANCF": _cables, "Exudyn exact": _beams}[name]
    if not problem.planar:
        build = _spatial
    nodes = build(system, problem, n, setting["steps"])
    system.Assemble()
    settings = _settings(setting["steps"])
    built = clock()
    try:
        good = bool(system.SolveStatic(settings))
    except Exception:
        good = False
    done = clock()
    s = np.linspace(0, problem.L, len(nodes))
    some = thinned(len(nodes) - 1)
    position = exudyn.OutputVariableType.Position
    r = np.array([system.GetNodeOutput(i, position) for i in nodes[some]])
    if problem.planar:  # X along a3 and Y along a1
        r = np.stack([r[:, 1], 0 * r[:, 0], r[:, 0]], axis=1)
    return [Shape(done - built, built - began, s[some], r, good)]


def _settings(steps: int) -> exudyn.SimulationSettings:
    settings = exudyn.SimulationSettings()
    settings.solutionSettings.writeSolutionToFile = False
    settings.displayGlobalTimers = False
    settings.linearSolverType = exudyn.LinearSolverType.EigenSparse
    static = settings.staticSolver
    static.numberOfLoadSteps, static.adaptiveStep, static.verboseMode = steps, False, 0
    newton = static.newton
    newton.residualMode = 1  # tests increments: with residuals a solve ends early or never
    newton.relativeTolerance, newton.absoluteTolerance = 1e-7, 1e-7
    newton.useModifiedNewton, newton.maxIterations = False, 50
    return settings


def _cables(system: exudyn.MainSystem, problem: Problem, n: int, steps: int) -> list[int]:
    k, h = problem.stiffness, problem.L / n
    nodes = [
        system.AddNode(items.NodePoint2DSlope1(referenceCoordinates=[i * h, 0, 1, 0]))
        for i in range(n + 1)
    ]
    for pair in pairwise(nodes):
        cable = items.ObjectANCFCable2D(
            nodeNumbers=list(pair),
            length=h,
            massPerLength=1.0,
            bendingStiffness=k["EI2"],
            axialStiffness=k["EA"],
        )
        system.AddObject(cable)
    _hold(system, nodes[0], (0, 1, 3))
    _load_plane(system, problem, nodes[-1])
    return nodes


def _beams(system: exudyn.MainSystem, problem: Problem, n: int, steps: int) -> list[int]:
    k, h = problem.stiffness, problem.L / n
    nodes = [
        system.AddNode(items.NodeRigidBody2D(referenceCoordinates=[i * h / 2, 0, 0]))
        for i in range(2 * n + 1)
    ]
    for i in range(n):
        beam = items.ObjectBeamGeometricallyExact2D(
            nodeNumbers=nodes[2 * i : 2 * i + 3],
            length=h,
            massPerLength=1.0,
            crossSectionInertia=1.0,
            bendingStiffness=k["EI2"],
            axialStiffness=k["EA"],
            shearStiffness=k["GA1"],
        )
        system.AddObject(beam)
    _hold(system, nodes[0], (0, 1, 2))
    _load_plane(system, problem, nodes[-1])
    return nodes


def _spatial(system: exudyn.MainSystem, problem: Problem, n: int, steps: int) -> list[int]:
    k = problem.stiffness
    section = exudyn.BeamSection()
    section.massPerLength, section.inertia = 1.0, np.eye(3)
    order = ("EA", "GA1", "GA2", "GJ", "EI1", "EI2")
    section.stiffnessMatrix = np.diag([k[name] for name in order])
    r, q = problem.rest(np.linspace(0, problem.L, n + 1))
    nodes = []
    for x, frame in zip(r, product(q, CYCLE), strict=True):
        parameters = [*x, *frame]
        nodes.append(system.AddNode(items.NodeRigidBodyEP(referenceCoordinates=parameters)))
    for pair in pairwise(nodes):
        beam = items.ObjectBeamGeometricallyExact(
            nodeNumbers=list(pair), length=problem.L / n, sectionData=section
        )
        system.AddObject(beam)
    told = 3 + int(np.argmax(np.abs(product(q[0], CYCLE))))  # by the others
    _hold(system, nodes[0], tuple(i for i in range(7) if i != told))
    if problem.pose is not None:
        _move(system, problem, nodes[-1], steps)
        return nodes
    tip = system.AddMarker(items.MarkerNodeRigid(nodeNumber=nodes[-1]))
    system.AddLoad(items.LoadForceVector(markerNumber=tip, loadVector=list(problem.force)))
    if problem.moment.any():
        system.AddLoad(items.LoadTorqueVector(markerNumber=tip, loadVector=list(problem.moment)))
    return nodes


def _hold(system: exudyn.MainSystem, node: int, coordinates: tuple[int, ...]) -> None:
    ground = system.AddNode(items.NodePointGround())
    fixed = system.AddMarker(items.MarkerNodeCoordinate(nodeNumber=ground, coordinate=0))
    for i in coordinates:
        marker = system.AddMarker(items.MarkerNodeCoordinate(nodeNumber=node, coordinate=i))
        system.AddObject(items.ObjectConnectorCoordinate(markerNumbers=[fixed, marker]))


def _move(system: exudyn.MainSystem, problem: Problem, node: int, steps: int) -> None:
    """The held end on its way, as prescribed coordinates; the largest Euler parameter follows."""
    rest = problem.rest(np.array([problem.L]))
    start = np.array([*rest[0][0], *product(rest[1][0], CYCLE)])
    poses = [blended(problem, k / steps).pose for k in range(steps + 1)]
    along = np.array([[*r, *product(q, CYCLE)] for r, q in poses])
    told = 3 + int(np.argmax(np.abs(along[:, 3:]).min(axis=0)))
    ground = system.AddNode(items.NodePointGround())
    fixed = system.AddMarker(items.MarkerNodeCoordinate(nodeNumber=ground, coordinate=0))
    for i in (i for i in range(7) if i != told):
        way = (along[:, i] - start[i]).tolist()
        marker = system.AddMarker(items.MarkerNodeCoordinate(nodeNumber=node, coordinate=i))
        connector = items.ObjectConnectorCoordinate(
            markerNumbers=[fixed, marker],
            offsetUserFunction=lambda mbs, t, item, offset, way=way: way[round(t * steps)],
        )
        system.AddObject(connector)


def _load_plane(system: exudyn.MainSystem, problem: Problem, node: int) -> None:
    (fx, fy), moment = planar_loads(problem)
    if fx or fy:
        tip = system.AddMarker(items.MarkerNodePosition(nodeNumber=node))
        system.AddLoad(items.LoadForceVector(markerNumber=tip, loadVector=[fx, fy, 0.0]))
    if moment:
        tip = system.AddMarker(items.MarkerNodeRigid(nodeNumber=node))
        system.AddLoad(items.LoadTorqueVector(markerNumber=tip, loadVector=[0.0, 0.0, moment]))
