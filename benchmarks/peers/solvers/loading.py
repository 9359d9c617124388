"""What several solver modules share: loads in parts, and where shapes are compared."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from peers.problem import Array, Problem, conjugate, product, rotation_vector, turned


def stations() -> Array:
    """Nine arc lengths of a rod of unit length."""
    return np.linspace(0, 1, 9)


def planar_loads(problem: Problem) -> tuple[tuple[float, float], float]:
    """Force along a3 and a1 of the clamp, and the moment about a2."""
    return (float(problem.force[2]), float(problem.force[0])), float(problem.moment[1])


def blended(problem: Problem, part: float) -> Problem:
    """A part of the loads; of a held end, a part of the way from its place at rest."""
    now = replace(problem, force=part * problem.force, moment=part * problem.moment)
    if problem.pose is None:
        return now
    r, q = (x[0] for x in problem.rest(np.array([problem.L])))
    turn = product(conjugate(q), problem.pose[1])
    way = rotation_vector(turn if turn[0] > 0 else -turn)  # the shorter way
    pose = (r + part * (problem.pose[0] - r), turned(q, part * way))
    return replace(now, pose=pose)


def end_motion(problem: Problem, steps: int) -> Array:
    """(steps + 1, 6) displacement of the held end from its place at rest, and its spins added up.

    Solvers whose rotations are increments in space are moved by such spins.
    """
    rest = problem.rest(np.array([problem.L]))
    r, q = rest[0][0], rest[1][0]
    motion = np.zeros((steps + 1, 6))
    for k in range(1, steps + 1):
        place, frame = blended(problem, k / steps).pose or (r, q)
        spin = rotation_vector(product(frame, conjugate(q)))
        motion[k] = [*(place - r), *(motion[k - 1, 3:] + spin)]
        q = frame
    return motion
