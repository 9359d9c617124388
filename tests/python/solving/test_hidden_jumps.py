"""Jumps inside edges that fall between the same samples on all grids: they are found."""

from __future__ import annotations

import warnings

import numpy as np

import pyrod
from pyrod import Clamp, DistributedForce, Rod, Scene, Section

AT = 0.4321  # grids of 16, 32 and 64 edges see a step here at 0.4375
ROUND = Section(EI1=1.0, EI2=1.0, GJ=0.7)


def step(s: float) -> tuple[float, float, float]:
    return (5.0 if s > AT else 0.0, 0.0, 0.0)


def test_a_jump_that_grids_miss_has_a_vertex() -> None:
    scene = Scene(Rod.straight(1.0, None, ROUND), Clamp(), DistributedForce(step))
    result = pyrod.solve(scene, tol=1e-4)
    assert result.accuracy.regular
    assert np.abs(result.rod.arc_lengths - AT).min() < 1e-12


def test_sections_and_curvatures_that_jump_have_a_vertex() -> None:
    def section(s: float) -> Section:
        return ROUND if s < AT else Section(EI1=2.0, EI2=2.0, GJ=1.0)

    def curvature(s: float) -> tuple[float, float, float]:
        return (0.0, 1.0 if s < AT else 0.0, 0.0)

    for rod in (Rod.straight(1.0, 16, section), Rod.precurved(1.0, 16, ROUND, curvature)):
        scene = Scene(rod, Clamp(), pyrod.Force((1, 0, 0)))
        found = scene._climbing.rod
        assert found.edges == 17
        assert np.abs(found.arc_lengths - AT).min() < 1e-12
        assert found._compiled.jumps[0] == [np.abs(found.arc_lengths - AT).argmin()]


def test_vertices_and_steep_functions_are_no_jumps() -> None:
    at_vertex = Rod.straight(1.0, None, ROUND).with_vertices([AT])
    steep = DistributedForce(lambda s: (np.tanh((s - AT) / 2e-3), 0, 0))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        pyrod.solve(Scene(at_vertex, Clamp(), DistributedForce(step)), tol=1e-4)
    scene = Scene(Rod.straight(1.0, None, ROUND), Clamp(), steep)
    assert scene._climbing is scene
