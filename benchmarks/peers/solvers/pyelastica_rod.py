"""PyElastica: explicit dynamics of a Cosserat rod, damped until it rests.

With EA L²/EI = 1e4 (`soft`), as its time step falls with the stiffness. Its bending moments are
divided by the cube of the stretch, so that errors level off near N/EA. The first element is
centred on the clamp (a rod longer by half an element), which makes the clamp of second order.
"""

from __future__ import annotations

from importlib.metadata import version

import elastica
import numpy as np
from elastica.timestepper.symplectic_steppers import PositionVerlet

from peers.cases import CASES
from peers.measure import Cannot, Plan, Setting, Shape, clock, thinned
from peers.problem import Array, Problem, matrix

ABOUT = (
    f"PyElastica {version('pyelastica')}, PositionVerlet; half an element before the clamp; "
    "uniform damping and a larger rotational inertia (which statics does not notice), both the "
    "best found; steps at 0.8 of the linear limit; it "
    "divides bending moments by the cube of the stretch, so that errors level off near N/EA"
)
NAMES = ["PyElastica"]
INERTIA = 30.0
RADIUS = 0.02


class _Simulator(
    elastica.BaseSystemCollection, elastica.Constraints, elastica.Forcing, elastica.Damping
):
    pass


class _EndLoad(elastica.NoForces):
    """Force on the last node and moment on the last element, both fixed in space."""

    def __init__(self, force: Array, moment: Array) -> None:
        super().__init__()
        self.force, self.moment = force, moment

    def apply_forces(self, system: elastica.CosseratRod, time: float = 0.0) -> None:
        system.external_forces[:, -1] += self.force

    def apply_torques(self, system: elastica.CosseratRod, time: float = 0.0) -> None:
        system.external_torques[:, -1] += system.director_collection[..., -1] @ self.moment


def warm_up() -> None:
    _relaxed(CASES["elastica-1"].problem("soft"), 4, 5.0, [3])


def plan(case: str, name: str) -> Plan:
    reasons = {
        "clamped": "not tried: a clamp would have to be moved as part of the motion",
        "ring": "not tried: it has rings, but no turn of one end against the other",
        "model-cost": "one model only",
        "scaling": "explicit dynamics: steps grow with n",
    }
    if case in reasons:
        raise Cannot(reasons[case])
    models = ["soft"] if "soft" in CASES[case].models else ["cosserat"]
    if case in (
        "elastica-10",
        "elastica-100",
    ):  # where the stretch of `soft` is seen in the bending
        models.append("cosserat")
    dampings = {"elastica-1": (6.0, 10.0), "elastica-100": (20.0, 40.0)}.get(case, (9.0, 15.0))
    sizes = (8, 16, 32, 64, 128)
    return Plan(models, [[{"n": n, "damping": c} for c in dampings] for n in sizes])


def solve(problem: Problem, name: str, setting: Setting) -> list[Shape]:
    counts = [int(1000 * 2 ** (k / 2)) for k in range(20)]
    shapes = _relaxed(problem.scaled(), setting["n"], setting["damping"], counts)
    for shape in shapes:
        shape.s, shape.r = shape.s * problem.L, shape.r * problem.L
        shape.label = f"n={setting['n']}, damping={setting['damping']:g}, {shape.label}"
    return shapes


def _relaxed(problem: Problem, n: int, damping: float, counts: list[int]) -> list[Shape]:
    began = clock()
    h = 1 / (n - 0.5)
    dt = np.float64(0.8 * _limit(problem, h))
    simulator, rod = _simulator(problem, n, h, damping, dt)
    stepper, built = PositionVerlet(), clock()
    spent, done, time, shapes = 0.0, 0, np.float64(0), []
    for target in counts:
        start = clock()
        for _ in range(target - done):
            time = stepper.step(simulator, time, dt)
        spent, done = spent + clock() - start, target
        r = rod.position_collection.T[1:].copy()
        if not np.isfinite(r).all() or np.abs(r).max() > 10:
            raise ArithmeticError("the motion blows up")
        speed = float(np.abs(rod.velocity_collection).max())
        s = (np.arange(n) + 0.5) * h
        some = thinned(n - 1, 17)
        shapes.append(
            Shape(spent, built - began, s[some], r[some], speed < 0.05, done, f"{done} steps")
        )
        if speed < 1e-7 or spent > 6:
            break
    return shapes


def _limit(problem: Problem, h: float) -> float:
    """Of the linear modes of shear, stretch and bending, with unit mass per length."""
    stiff, inertia = float(problem.stretching.max()), INERTIA * RADIUS**2 / 4
    turning = (stiff + 4 * float(problem.bending.max()) / h**2) / inertia
    return 2 / np.sqrt(turning + 4 * stiff / h**2)


def _simulator(
    problem: Problem, n: int, h: float, damping: float, dt: float
) -> tuple[_Simulator, elastica.CosseratRod]:
    simulator = _Simulator()
    rod = _rod(problem, n, h)
    simulator.append(rod)
    simulator.constrain(rod).using(
        elastica.OneEndFixedBC, constrained_position_idx=(0,), constrained_director_idx=(0,)
    )
    simulator.add_forcing_to(rod).using(_EndLoad, problem.force, problem.moment)
    simulator.dampen(rod).using(
        elastica.AnalyticalLinearDamper, uniform_damping_constant=damping, time_step=dt
    )
    simulator.finalize()
    return simulator, rod


def _rod(problem: Problem, n: int, h: float) -> elastica.CosseratRod:
    """Its directors are the rows (a1, a2, a3), with a3 along the chord."""
    at = (np.arange(n + 1) - 0.5) * h
    r, _ = problem.rest(at)
    _, q = problem.rest(np.arange(n) * h)
    a3 = np.diff(r, axis=0) / np.linalg.norm(np.diff(r, axis=0), axis=1)[:, None]
    a2 = np.cross(a3, matrix(q)[:, :, 0])
    a2 /= np.linalg.norm(a2, axis=1)[:, None]
    directors = np.stack([np.cross(a2, a3).T, a2.T, a3.T])
    rod = elastica.CosseratRod.straight_rod(
        n, r[0], np.array([0.0, 0.0, 1.0]), np.array([1.0, 0.0, 0.0]), n * h, RADIUS,
        1 / (np.pi * RADIUS**2), youngs_modulus=1.0, shear_modulus=1.0, position=r.T.copy(),
        directors=directors,
    )  # fmt: skip
    rod.shear_matrix[:] = np.diag(problem.stretching)[..., None]
    rod.bend_matrix[:] = np.diag(problem.bending)[..., None]
    rod.mass_second_moment_of_inertia *= INERTIA
    rod.inv_mass_second_moment_of_inertia /= INERTIA
    rod.compute_internal_forces_and_torques(0.0)
    rod.rest_kappa[:] = rod.kappa
    rod.rest_sigma[:] = rod.sigma
    return rod
