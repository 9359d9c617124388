"""Kratos Multiphysics: corotational beam elements, load steps, Newton.

Bernoulli beams that stretch: `CrBeamElement3D2N` everywhere; chords of the rest shape with the
axes of their middle.
"""

from __future__ import annotations

import KratosMultiphysics as Kratos
import KratosMultiphysics.LinearSolversApplication  # registers the linear solver
import KratosMultiphysics.StructuralMechanicsApplication as Structural
import numpy as np
from KratosMultiphysics.python_linear_solver_factory import ConstructSolver

from peers.measure import Cannot, Plan, Setting, Shape, clock, grids, thinned
from peers.problem import Array, Problem, matrix
from peers.solvers.loading import end_motion

ABOUT = (
    "Kratos 10.4.4, StructuralMechanics; `CrBeamElement3D2N`; load steps, Newton, sparse_lu; "
    "relative and absolute 1e-9 in displacements and rotations, at most 50 iterations"
)
NAMES = ["Kratos"]
STEPS = (1, 2, 4, 8, 16, 32, 64, 128)
AXES = "XYZ"

Kratos.Logger.GetDefaultOutput().SetSeverity(Kratos.Logger.Severity.WARNING)


def plan(case: str, name: str) -> Plan:
    if case == "ring":
        raise Cannot("not tried: no closed rods; an end would have to be led around")
    if case == "model-cost":
        raise Cannot("one model only")
    if case == "clamped":
        return Plan(["extensible"], grids([8, 16, 32, 64, 128], (64, 128, 256, 512, 1024)))
    if case == "scaling":
        return Plan(["extensible"], grids([100, 1000, 10_000], STEPS))
    return Plan(["extensible"], grids([8, 16, 32, 64, 128, 256, 512], STEPS))


def solve(problem: Problem, name: str, setting: Setting) -> list[Shape]:
    began, n, steps = clock(), setting["n"], setting["steps"]
    model = Kratos.Model()
    part = _part(model, problem, n)
    strategy = _strategy(part)
    built = clock()
    iterations, good, tip = 0, True, part.GetNode(n + 1)
    motion = None if problem.pose is None else end_motion(problem, steps)
    for step in range(1, steps + 1):
        part.CloneTimeStep(float(step))
        part.ProcessInfo[Kratos.STEP] = step
        tip.SetSolutionStepValue(Structural.POINT_LOAD, list(problem.force * step / steps))
        tip.SetSolutionStepValue(Structural.POINT_MOMENT, list(problem.moment * step / steps))
        if motion is not None:
            tip.SetSolutionStepValue(Kratos.DISPLACEMENT, list(motion[step, :3]))
            tip.SetSolutionStepValue(Kratos.ROTATION, list(motion[step, 3:]))
        strategy.InitializeSolutionStep()
        strategy.Predict()
        good = strategy.SolveSolutionStep()
        strategy.FinalizeSolutionStep()
        iterations += part.ProcessInfo[Kratos.NL_ITERATION_NUMBER]
        if not good:
            break
    done = clock()
    some = np.arange(n + 1)[thinned(n)]
    r = np.array([_position(part.GetNode(int(i) + 1)) for i in some])
    return [Shape(done - built, built - began, some * problem.L / n, r, good, iterations)]


def _part(model: Kratos.Model, problem: Problem, n: int) -> Kratos.ModelPart:
    part = model.CreateModelPart("rod")
    part.ProcessInfo.SetValue(Kratos.DOMAIN_SIZE, 3)
    for variable in (
        Kratos.DISPLACEMENT, Kratos.REACTION, Kratos.ROTATION, Kratos.REACTION_MOMENT,
        Kratos.VOLUME_ACCELERATION, Structural.POINT_LOAD, Structural.POINT_MOMENT,
    ):  # fmt: skip
        part.AddNodalSolutionStepVariable(variable)
    part.SetBufferSize(2)
    section = _section(part, problem)
    r, _ = problem.rest(np.linspace(0, problem.L, n + 1))
    _, q = problem.rest((np.arange(n) + 0.5) * problem.L / n)
    for i, x in enumerate(r):
        part.CreateNewNode(i + 1, *map(float, x))
    for kind, reaction in (("DISPLACEMENT", "REACTION"), ("ROTATION", "REACTION_MOMENT")):
        for axis in AXES:
            dof, force = (getattr(Kratos, f"{x}_{axis}") for x in (kind, reaction))
            Kratos.VariableUtils().AddDof(dof, force, part)
            for node in (1,) if problem.pose is None else (1, n + 1):
                part.GetNode(node).Fix(dof)
    for i, normal in enumerate(matrix(q)[:, :, 0]):
        element = part.CreateNewElement("CrBeamElement3D2N", i + 1, [i + 1, i + 2], section)
        element.SetValue(Kratos.LOCAL_AXIS_2, Kratos.Array3(list(map(float, normal))))
    part.CreateNewCondition("PointLoadCondition3D1N", 1, [n + 1], section)
    part.CreateNewCondition("PointMomentCondition3D1N", 2, [n + 1], section)
    return part


def _section(part: Kratos.ModelPart, problem: Problem) -> Kratos.Properties:
    """E = 1 and ν = 0, so G = 1/2; the local axes 2, 3 are a1, a2."""
    k, section = problem.stiffness, part.GetProperties()[0]
    for variable, value in (
        (Kratos.YOUNG_MODULUS, 1.0), (Kratos.POISSON_RATIO, 0.0), (Kratos.DENSITY, 1.0),
        (Structural.CROSS_AREA, k["EA"]), (Structural.TORSIONAL_INERTIA, 2 * k["GJ"]),
        (Structural.I22, k["EI1"]), (Structural.I33, k["EI2"]),
    ):  # fmt: skip
        section.SetValue(variable, value)
    section.SetValue(Kratos.CONSTITUTIVE_LAW, Structural.BeamConstitutiveLaw())
    return section


def _strategy(part: Kratos.ModelPart) -> Kratos.ResidualBasedNewtonRaphsonStrategy:
    linear = ConstructSolver(
        Kratos.Parameters('{"solver_type": "LinearSolversApplication.sparse_lu"}')
    )
    test = Kratos.MixedGenericCriteria(
        [(Kratos.DISPLACEMENT, 1e-9, 1e-9), (Kratos.ROTATION, 1e-9, 1e-9)]
    )
    test.SetEchoLevel(0)
    strategy = Kratos.ResidualBasedNewtonRaphsonStrategy(
        part,
        Kratos.ResidualBasedIncrementalUpdateStaticScheme(),
        test,
        Kratos.ResidualBasedBlockBuilderAndSolver(linear),
        50, False, False, True,
    )  # fmt: skip
    strategy.SetEchoLevel(0)
    strategy.Initialize()
    strategy.Check()
    return strategy


def _position(node: Kratos.Node) -> Array:
    return np.array([node.X0, node.Y0, node.Z0]) + node.GetSolutionStepValue(Kratos.DISPLACEMENT)
