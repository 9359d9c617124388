"""When tendons make a rod unstable: the index beside the potential."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from tendon_robots import LENGTH, WIRE, converging, helix, robot

import pyrod
from pyrod import Force, Tendon
from pyrod.rotation import exp, log, multiply, rotate


def potential(frames, tension, offset, edges, force):
    """Bending and twisting, the work of one tendon and of a force along z at the tip."""
    h = LENGTH / edges
    clamp = np.array([1.0, 0, 0, 0])
    total = 0.0
    for j in range(edges):
        a = clamp if j == 0 else frames[j - 1]
        u = log(multiply(a * [1, -1, -1, -1], frames[j]))
        ds, start = (h / 2, 0.0) if j == 0 else (h, (j - 0.5) * h)
        stiffness = np.array([WIRE.EI1, WIRE.EI2, WIRE.GJ])
        total += (stiffness * u**2).sum() / (2 * ds)
        before, middle, behind = (
            np.array([*offset(start + part * ds), 0.0]) for part in (0, 0.5, 1)
        )
        v = np.array([0, 0, ds]) + behind - before + np.cross(u, middle)
        total += tension * np.linalg.norm(v)
        total -= force * h * rotate(frames[j], [0.0, 0, 1])[2]
    return total


def second_variation(result, tension, offset, force, step=2e-4):
    """The Hessian in rotation vectors of the edges, by differences of the potential."""
    frames = result.frames
    size = frames.size // 4 * 3

    def turned(x):
        return multiply(frames, exp(x.reshape(-1, 3)))

    def at(x):
        return potential(turned(x), tension, offset, len(frames), force)

    units = step * np.eye(size)
    there = [[at(s * a) for a in units] for s in (1, -1)]
    here = at(np.zeros(size))
    out = np.diag([(p - 2 * here + m) / step**2 for p, m in zip(*there, strict=True)])
    for i in range(size):
        for k in range(i):
            corners = [s * t * at(s * units[i] + t * units[k]) for s in (1, -1) for t in (1, -1)]
            out[i, k] = out[k, i] = sum(corners) / (4 * step**2)
    return out


@pytest.mark.parametrize(
    ("tension", "force"),
    [(5.0, 0.0), (25.0, 0.0), (2.0, -1.0), (0.5, -2.5), (1.0, -4.0)],
)
def test_the_index_counts_the_falling_directions_of_the_potential(tension, force):
    """A robot that is bent by its tendon and pressed at its tip falls out of the plane."""
    edges = 6
    loads = Force((0, 0, force))
    scene = robot(Tendon(converging, tension), loads, edges=edges)
    result = pyrod.solve(replace(scene, space="planar"), stable=False)
    result = pyrod.solve(scene, start=result, stable=False, eigenvalue=True, strict=False)
    assert result.converged
    H = second_variation(result, tension, converging, force)
    eigenvalues = np.linalg.eigvalsh(H)
    assert result.index == (eigenvalues < 0).sum()
    assert (result.index > 0) == (force < -2)
    # of K v = lambda M v, M the share of each edge in the length
    assert result.lowest_eigenvalue == pytest.approx(eigenvalues[0] * edges, rel=1e-4)


def test_what_would_fall_out_of_the_plane_settles_there():
    scene = robot(Tendon(converging, 2.0), Force((0, 0, -0.5)), edges=12)
    result = pyrod.solve(scene)
    assert result.index == 0
    assert max(result.balance) < 1e-12


@pytest.mark.parametrize("tension", [5.0, 20.0])
def test_tendons_alone_never_make_a_clamped_rod_unstable(tension):
    """Lengths of tendons are convex in the turns of the cells, which are free."""
    result = pyrod.solve(robot([Tendon(helix, tension), Tendon(converging, tension)]))
    assert result.index == 0
    assert result.descents == 0
