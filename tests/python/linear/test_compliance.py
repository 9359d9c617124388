"""Compliance against what scenes make of unit loads."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from test_derivatives import SCENES

import pyrod
from pyrod import Force, Moment, Scene
from pyrod.base.immutable import Array


def by_scenes(result: pyrod.Equilibrium, rod: int, vertex: int) -> Array:
    """With one load more; NaN where that leaves the plane."""
    grid = pyrod.linearised(result)._grid
    scene = grid.scene
    at = (rod, float(scene.rods[rod].arc_lengths[vertex]))
    out = np.full((6, 6), np.nan)
    for j in range(6):
        load = (Force, Moment)[j // 3](np.eye(3)[j % 3], at)
        try:
            loads = (*scene.loads, load)
            more = Scene(scene.rods, scene.supports, loads, scene.space, scene.joints)
            change = grid.numbers(more) - grid.numbers(scene)
        except ValueError:
            assert scene.space == "planar"
            continue
        told = grid.push(change)
        out[:3, j] = told[f"rods.{rod}.positions"][vertex]
        out[3:, j] = told[f"rods.{rod}.rotations"][vertex]
    return out


@pytest.mark.parametrize("make", SCENES, ids=lambda make: make.__name__)
def test_it_is_that_under_unit_loads(make: Callable[[], Scene]) -> None:
    result = pyrod.solve(make())
    linear = pyrod.linearised(result)
    for i, rod in enumerate(linear.scene.rods):
        for vertex in (0, 1, rod.edges // 2, rod.edges - 1, rod.edges):
            C = linear.compliance((i, float(rod.arc_lengths[vertex])))
            expected = by_scenes(result, i, vertex)
            size = np.nanmax(np.abs(expected)) or 1.0
            assert pytest.approx(expected, abs=1e-13 * size, nan_ok=True) == C, vertex
            assert np.isfinite(C).any()
