"""The rod as a boundary value problem: y = (r, q, m), with the dead section force n a constant.

    r' = R Γ,  q' = q (0, K)/2,  m' = n × r',   Γ = e3 + S Rᵀn,  K = K0 + C⁻¹ Rᵀm

Written out by components and for many points at once, as the boundary value solver wants it.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from peers.problem import Array, Problem, conjugate, matrix, product

Derivative = Callable[[Array, Array, Array], Array]


def directors(q: Array) -> tuple[Array, ...]:
    """Entries of R, row by row, of unit quaternions (4, m)."""
    w, x, y, z = q
    xx, yy, zz = 2 * x * x, 2 * y * y, 2 * z * z
    xy, xz, yz = 2 * x * y, 2 * x * z, 2 * y * z
    wx, wy, wz = 2 * w * x, 2 * w * y, 2 * w * z
    return (
        1 - yy - zz,
        xy - wz,
        xz + wy,
        xy + wz,
        1 - xx - zz,
        yz - wx,
        xz - wy,
        yz + wx,
        1 - xx - yy,
    )


def derivative(problem: Problem) -> Derivative:
    """(s, y (10,) or (10, m), n (3,)) -> dy/ds."""
    K1, K2, K3 = problem.K0
    c1, c2, c3 = 1 / problem.bending
    s1, s2, s3 = 1 / problem.stretching
    strains = bool(s1 or s2 or s3)

    def f(s: Array, y: Array, n: Array) -> Array:
        R11, R12, R13, R21, R22, R23, R31, R32, R33 = directors(y[3:7])
        w, x, y_, z = y[3:7]
        mx, my, mz = y[7:10]
        nx, ny, nz = n
        k1 = K1 + c1 * (R11 * mx + R21 * my + R31 * mz)
        k2 = K2 + c2 * (R12 * mx + R22 * my + R32 * mz)
        k3 = K3 + c3 * (R13 * mx + R23 * my + R33 * mz)
        dx, dy, dz = R13, R23, R33
        if strains:
            g1 = s1 * (R11 * nx + R21 * ny + R31 * nz)
            g2 = s2 * (R12 * nx + R22 * ny + R32 * nz)
            g3 = 1 + s3 * (R13 * nx + R23 * ny + R33 * nz)
            dx = R11 * g1 + R12 * g2 + R13 * g3
            dy = R21 * g1 + R22 * g2 + R23 * g3
            dz = R31 * g1 + R32 * g2 + R33 * g3
        return np.array(
            [
                dx,
                dy,
                dz,
                (-x * k1 - y_ * k2 - z * k3) / 2,
                (w * k1 + y_ * k3 - z * k2) / 2,
                (w * k2 + z * k1 - x * k3) / 2,
                (w * k3 + x * k2 - y_ * k1) / 2,
                ny * dz - nz * dy,
                nz * dx - nx * dz,
                nx * dy - ny * dx,
            ]
        )

    return f


def closing(pose: tuple[Array, Array], y: Array) -> Array:
    """The six conditions of a clamped end: position, and the vector part of the turn left."""
    return np.concatenate([y[:3] - pose[0], product(conjugate(pose[1]), y[3:7])[1:]])


def energy(problem: Problem, y: Array, n: Array) -> Array:
    """Energy per length at states (10, m)."""
    R = matrix(y[3:7].T / np.linalg.norm(y[3:7], axis=0)[:, None])
    M = np.einsum("mji,jm->mi", R, y[7:10])
    N = np.einsum("mji,j->mi", R, n)
    return (M**2 / problem.bending + N**2 / problem.stretching).sum(axis=1) / 2
