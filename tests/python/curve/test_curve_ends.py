"""Ends of open curves, inflections: where values are not defined."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from test_curve_precision import HELIX

from pyrod.curve import Polyline

# Ends of open curves ------------------------------------------------------------------------------


def test_the_torsion_of_a_helix_is_the_same_at_every_point() -> None:
    """Smooth: 0.3/1.09 = 0.2752; what edges of 0.1 make of it is within 2e-3."""
    at_vertices = HELIX.at_vertices(HELIX.torsion())
    np.testing.assert_allclose(at_vertices, 0.3 / 1.09, rtol=2e-3)
    np.testing.assert_allclose(np.ptp(at_vertices), 0, atol=1e-12)
    np.testing.assert_allclose(HELIX.torsion(ends="continued"), at_vertices[0], rtol=1e-11)


def test_the_curvature_of_a_helix_is_the_same_at_every_point() -> None:
    np.testing.assert_allclose(HELIX.curvature(ends="continued"), 1 / 1.09, rtol=1e-3)
    assert HELIX.curvature()[0] == HELIX.curvature()[-1] == 0  # free ends do not turn


@pytest.mark.parametrize("measure", ["log", "chord", "cayley", "sauer"])
def test_torsion_at_vertices_in_every_measure(measure: str) -> None:
    tau = HELIX.torsion(measure)  # type: ignore[arg-type]
    np.testing.assert_allclose(tau[[0, -1]], 0, atol=1e-13)
    np.testing.assert_allclose(HELIX.at_vertices(tau), tau[1], rtol=1e-11)


def test_other_values_that_vanish_at_the_ends_are_not_touched() -> None:
    values = HELIX.torsion() * 2
    assert HELIX.at_vertices(values)[0] == pytest.approx(-values[1] / 2)
    continued = HELIX.at_vertices(values, ends="continued")
    np.testing.assert_allclose(continued, values[1], rtol=1e-11)


def test_an_end_that_is_held_has_its_own_value() -> None:
    held = Polyline(HELIX.positions, start_tangent=[0, 1, 0.3])
    kappa = held.curvature(ends="continued")
    assert kappa[0] == held.curvature()[0] != kappa[1]
    assert kappa[-1] == kappa[-2]
    tau = held.torsion(ends="continued")
    assert tau[0] == held.torsion()[0] != tau[1]
    assert tau[-1] == tau[-2] != 0


@pytest.mark.parametrize("points", [2, 3, 4])
def test_short_curves_have_what_they_can(points: int) -> None:
    short = Polyline(HELIX.positions[:points])
    kappa, tau = short.curvature(ends="continued"), short.torsion(ends="continued")
    assert (kappa > 0.9).all() if points > 2 else not kappa.any()
    assert (tau > 0.27).all() if points > 3 else np.abs(tau).max() < 1e-12


def test_ends_is_one_of_two() -> None:
    for ask in (HELIX.curvature, HELIX.torsion):
        with pytest.raises(ValueError, match="ends: expected 'free' or 'continued', got 'open'"):
            ask(ends="open")  # type: ignore[arg-type]


# Inflections --------------------------------------------------------------------------------------


@pytest.mark.parametrize("n", [10, 300])
def test_a_plane_curve_with_inflections_has_no_frenet_link(n: int) -> None:
    t = 2 * np.pi * np.arange(n) / n
    r = 1 + 0.6 * np.cos(2 * t + 0.1)
    bean = np.column_stack([r * np.cos(t), r * np.sin(t), 0 * t])
    for seed in range(12):
        turned = bean @ Rotation.random(rng=seed).as_matrix().T
        arc = Polyline(turned, closed=True)
        with pytest.raises(ValueError, match=r"frenet_link: on the edges \d+, \d+, \d+, \d+ the"):
            arc.frenet_link()
        assert arc.closed_ribbon(2).link() == 2


def test_a_curve_in_space_keeps_its_frenet_link() -> None:
    t = 2 * np.pi * np.arange(256) / 256
    r = 2 + np.cos(3 * t)
    trefoil = np.column_stack([r * np.cos(2 * t), r * np.sin(2 * t), np.sin(3 * t)])
    for seed in range(5):
        turned = trefoil @ Rotation.random(rng=seed).as_matrix().T
        assert Polyline(turned, closed=True).frenet_link() == -6
