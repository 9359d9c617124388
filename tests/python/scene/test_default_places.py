"""Supports without a place hold where the first clamp puts the rod."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from arguments import ROD

import pyrod
from pyrod import Rod, Scene, Section, rotation

ALONG_X = pyrod.Clamp(tangent=(1, 0, 0), normal=(0, 0, 1))
SHEARED = Section(1.0, 1.3, 0.8, 600.0, 800.0, 1500.0)
SUPPORTS = [
    pyrod.Clamp(at="end"),
    pyrod.Hinge(at="end"),
    pyrod.Slider(along=(1, 0, 0), at="end"),
    pyrod.Pivot((0, 1, 0), at="end"),
    pyrod.Sleeve(at="end"),
    pyrod.Spring(3.0, 2.0),
    pyrod.Slider(along=(1, 0, 0), clamped=True, at="end"),
]


@pytest.mark.parametrize("space", ["planar", "spatial"])
@pytest.mark.parametrize("support", SUPPORTS, ids=lambda s: type(s).__name__)
@pytest.mark.parametrize("curved", [False, True])
def test_default_places_follow_the_first_clamp(support: Any, space: Any, curved: bool) -> None:
    """Without loads, the rod is at rest where the clamp takes it."""
    rod = Rod.precurved(1.0, 16, SHEARED, (0, 0.7, 0) if curved else (0, 0, 0))
    result = pyrod.solve(Scene(rod, [ALONG_X, support], space=space))
    expected = rod.at_rest((0, 0, 0), ALONG_X.frame)
    np.testing.assert_allclose(result.positions, expected[0], atol=1e-12)
    np.testing.assert_allclose(rotation.to_matrix(result.frames), rotation.to_matrix(expected[1]),
                               atol=1e-12)  # fmt: skip
    assert result.energy < 1e-20


def test_the_place_of_a_clamp_inside() -> None:
    """It carries the rod by its point, and a turned frame at rest stays part of the shape."""
    rod = Rod.precurved(1.0, 16, SHEARED, (0.3, 0.7, 0.2)).placed((1, 2, 3), tangent=(0, 1, 0))
    clamp = pyrod.Clamp((4, 0, 0), tangent=(1, 0, 0), normal=(0, 0, 1), at=0.25)
    scene = Scene(rod, [clamp, pyrod.Clamp(at="end")])
    result = pyrod.solve(scene)
    assert result.energy < 1e-20
    np.testing.assert_allclose(result.positions[4], (4, 0, 0), atol=1e-12)


def test_the_reactions_of_a_beam_that_is_clamped_along_x() -> None:
    """Clamped at both ends, a force in the middle: half of it each, F L/8."""
    rod = Rod.straight(1.0, 64, Section(1.0, 1.0, 1.0, 1e9, 1e9, 1e9))
    load = pyrod.Force((0, 0, -1e-3), at=0.5)
    result = pyrod.solve(Scene(rod, [ALONG_X, pyrod.Clamp(at="end")], load))
    for reaction in result.reactions:
        assert reaction.force[1:] == pytest.approx([0, 0.5e-3], rel=1e-6, abs=1e-12)
        assert np.abs(reaction.moment) == pytest.approx([0, 1e-3 / 8, 0], rel=2e-3, abs=1e-12)


@pytest.mark.parametrize("order", [1, -1])
def test_a_default_start_stays_where_it_is(order: int) -> None:
    """Buckled between the start at rest and an end that was moved, in whatever order."""
    rod = Rod.straight(1.0, 16, Section(1.0, 1.3, 0.8))
    supports = [pyrod.Clamp(), pyrod.Clamp((0, 0, 0.9), at="end")][::order]
    result = pyrod.solve(Scene(rod, supports))
    assert result.positions[0] == pytest.approx([0, 0, 0], abs=1e-14)
    assert result.energy > 1


def test_a_hinge_without_a_place_before_the_clamp_stays() -> None:
    rod = Rod.straight(1.0, 16, SHEARED)
    scene = Scene(rod, [pyrod.Hinge(), pyrod.Clamp((0, 0, 0.95), at="end")])
    assert scene._compiled.held(0)[0] == pytest.approx([0, 0, 0])
    assert scene._compiled.held(1)[1] == pytest.approx([1, 0, 0, 0])


def test_other_rods_stay_where_they_are() -> None:
    rods = [ROD, ROD.placed((1, 0, 0))]
    clamps = [ALONG_X, pyrod.Clamp(at=(1, "start")), pyrod.Hinge(at=(1, "end"))]
    scene = Scene(rods, clamps)
    assert scene._compiled.held(1)[0] == pytest.approx([1, 0, 0])
    assert scene._compiled.held(2)[0] == pytest.approx([1, 0, 1])
