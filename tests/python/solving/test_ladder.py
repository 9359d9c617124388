"""Solving to a tolerance: grids, limits, starts, threads, pickles. (Accuracy: test_accuracy.py.)"""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from support import ROUND, SOFT, differences

import pyrod
from pyrod import (
    Clamp,
    Force,
    Moment,
    NotConverged,
    Options,
    Rod,
    Scene,
    rotation,
)

BENT = (Force((2, -3, -1)), Force((1, 0, 4), at=0.3141))


def bent(edges: int | None = None, **more: object) -> Scene:
    """A cantilever of everything: shearable, anisotropic, precurved, under two point loads."""
    rod = Rod.precurved(1.0, edges, SOFT, lambda s: (0.5, np.sin(3 * s), 1 - s))
    return Scene(rod, Clamp(), BENT, **more)


def arch(edges: int | None = None) -> Scene:
    """Held at both ends."""
    end = Clamp((0.1, 0.05, 0.7), rotation.exp((0.2, 0.4, 0.3)), at="end")
    return Scene(Rod.straight(1.0, edges, SOFT), [Clamp(), end], Force((0, 1, 0.5), at=0.4))


def same(a: pyrod.Equilibrium, b: pyrod.Equilibrium) -> bool:
    names = ("positions", "frames", "K", "Gamma", "force", "moment", "vertex_force", "load")
    equal = all(np.array_equal(getattr(a, name), getattr(b, name)) for name in names)
    return equal and a.energy == b.energy and a.accuracy == b.accuracy


# Grids --------------------------------------------------------------------------------------------


@pytest.mark.parametrize("h", [np.full(24, 1 / 24), np.linspace(1, 3, 24) / 48])
def test_edges_that_are_given_stay(h: np.ndarray) -> None:
    scene = Scene(Rod.precurved(h, None, SOFT, (0, 1, 0)), Clamp(), Force((1, 2, 3)))
    result = pyrod.solve(scene, tol=1e-8)
    assert result.scene == scene
    assert np.array_equal(result.scene.rod.edge_lengths, h)
    assert len(result.frames) == 24
    assert len(result.positions) == 25


def test_edges_that_are_not_given_are_few_and_equal() -> None:
    rod = Rod.straight(2.0, None, ROUND)
    assert rod.edges == 16
    assert np.allclose(rod.edge_lengths, 0.125, rtol=1e-15)
    assert repr(rod) == "Rod(inextensible, straight, length=2, edges=None)"
    assert rod == Rod.straight(2.0, None, ROUND)
    assert rod != Rod.straight(2.0, 16, ROUND)


@pytest.mark.parametrize("turns", [1, 5, 40])
def test_a_coil_at_rest_gets_edges_that_turn_little(turns: int) -> None:
    K = 2 * np.pi * turns
    rod = Rod.precurved(1.0, None, ROUND, (0.0, K, 0.1 * K))
    assert (rod.cell_lengths * np.linalg.norm(rod.K0, axis=1)).max() <= 0.4
    assert rod.edges <= max(16, 2 * np.pi * turns * 1.01 / 0.4 + 2)
    load = Force((0, turns, 0))
    result = pyrod.solve(Scene(rod, Clamp(), load), tol=1e-8)
    assert result.accuracy.reached <= 1e-8
    finer_rod = Rod.precurved(1.0, 2 * rod.edges, ROUND, (0.0, K, 0.1 * K))
    finer = pyrod.solve(Scene(finer_rod, Clamp(), load), tol=1e-8)
    assert np.abs(result.positions - finer.positions[::2]).max() <= 2e-8


def test_breaks_are_vertices_with_two_edges_between_them_at_least() -> None:
    rod = Rod.straight(1.0, None, ROUND).with_vertices([0.5, 0.01, 0.7])
    s = rod.arc_lengths
    for at in (0.01, 0.5, 0.7):
        assert np.abs(s - at).min() < 1e-15
    for a, b in pairwise([0, 0.01, 0.5, 0.7, 1]):
        h = rod.edge_lengths[(s[:-1] > a - 1e-12) & (s[1:] < b + 1e-12)]
        assert len(h) >= 2
        assert np.ptp(h) < 1e-15
    assert rod.with_vertices(0.7) is rod
    assert rod.with_vertices([0.0, 1.0]) is rod
    assert rod.with_vertices(0.7) == Rod.straight(1.0, None, ROUND).with_vertices([0.7, 0.01, 0.5])
    assert rod.with_vertices(0.3).edges <= rod.edges + 2
    assert repr(rod).endswith("edges=None)")


@pytest.mark.parametrize("load", [Force((0, 0, 1), at=0.3141), Moment((1, 0, 0), at=0.3141)])
def test_point_loads_get_vertices_where_the_solver_chooses(load: Force | Moment) -> None:
    scene = Scene(Rod.straight(1.0, None, ROUND), Clamp(), load)
    assert np.abs(scene.rod.arc_lengths - 0.3141).min() < 1e-15
    given = Scene(Rod.straight(1.0, 16, ROUND), Clamp(), load)
    assert np.array_equal(given.rod.arc_lengths, np.arange(17) / 16)


def test_without_edges_there_is_a_tolerance() -> None:
    result = pyrod.solve(bent())
    assert result.accuracy.tol == 1e-6
    assert result.accuracy.reached <= 1e-6
    assert pyrod.solve(bent(16)).accuracy is None


def test_curvature_by_vertices_needs_edges() -> None:
    with pytest.raises(ValueError, match="curvature: one per vertex needs edges"):
        Rod.precurved(1.0, None, ROUND, np.zeros((17, 3)))
    with pytest.raises(ValueError, match="length: must be positive"):
        Rod.straight(-1.0, None, ROUND)
    with pytest.raises(ValueError, match="curvature: expected finite"):
        Rod.precurved(1.0, None, ROUND, (np.inf, 0, 0))


# What is told -------------------------------------------------------------------------------------


@pytest.mark.parametrize("scene", [bent, arch])
@pytest.mark.parametrize("tol", [1e-4, 1e-8])
def test_forces_balance_to_rounding_at_any_tolerance(scene: object, tol: float) -> None:
    result = pyrod.solve(scene(), tol=tol)
    assert max(result.balance) < 1e-12


def test_errors_are_told_in_words() -> None:
    result = pyrod.solve(bent(), tol=1e-8)
    accuracy = result.accuracy
    assert str(accuracy) == f"error {accuracy.reached:.1e} on {accuracy.grids} grids"
    assert str(accuracy) in repr(result)
    assert set(accuracy.errors) == {
        "positions", "frames", "curvatures", "forces", "moments", "energy", "reactions",
        "edge_frames", "edge_forces", "strains", "extremes",
    }  # fmt: skip
    apart = ("edge_frames", "edge_forces", "strains", "extremes")
    of_vertices = [error for name, error in accuracy.errors.items() if name not in apart]
    assert accuracy.reached == max(of_vertices) <= 1e-8
    assert accuracy.finest_edges == result.scene.rod.edges * 2 ** (accuracy.grids - 1)
    assert accuracy.order == pytest.approx(2, abs=0.05)


@pytest.mark.parametrize("scene", [bent, arch])
def test_units_do_not_matter(scene: object) -> None:
    """Nanometres, and kilometres."""
    one = pyrod.solve(scene(), tol=1e-8)
    for L, F in ((1e-9, 1e-12), (1e3, 1e6)):
        C = F * L * L
        section = pyrod.Section(
            SOFT.EI1 * C, SOFT.EI2 * C, SOFT.GJ * C, SOFT.GA1 * F, SOFT.GA2 * F, SOFT.EA * F
        )
        loads = [Force(load.force * F, "end" if load.at == "end" else load.at * L)
                 for load in scene().loads]  # fmt: skip
        supports = [Clamp(c.position if c.position is None else c.position * L, c.frame, at=c.at)
                    for c in scene().supports]  # fmt: skip
        K0 = lambda s, L=L: np.array((0.5, np.sin(3 * s / L), 1 - s / L)) / L  # noqa: E731
        rod = Rod.precurved(L, None, section, K0 if scene is bent else (0, 0, 0))
        other = pyrod.solve(Scene(rod, supports, loads), tol=1e-8)
        assert other.accuracy.grids == one.accuracy.grids
        assert differences(other.positions / L, one.positions) < 1e-12
        assert differences(other.moment / (F * L), one.moment) < 1e-11
        for name, error in one.accuracy.errors.items():
            assert other.accuracy.errors[name] == pytest.approx(error, rel=0.05, abs=1e-11)


def test_a_scene_that_is_moved_has_the_same_errors() -> None:
    q, r = rotation.exp((0.7, -1.1, 0.4)), np.array([1.0, -2.0, 3.0])
    loads = [Force(rotation.rotate(q, load.force), load.at) for load in BENT]
    rod = bent().rod
    moved = pyrod.solve(Scene(rod, Clamp(r, q), loads), tol=1e-8)
    still = pyrod.solve(bent(), tol=1e-8)
    assert np.abs(moved.positions - r - rotation.rotate(q, still.positions)).max() < 1e-13
    assert differences(moved.K, still.K) < 1e-11
    for name, error in still.accuracy.errors.items():
        assert moved.accuracy.errors[name] == pytest.approx(error, rel=1e-2, abs=1e-12)


# Limits -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("tol", [0, -1e-6, 0.2, np.nan, np.inf, "1e-6", True, (1e-6,)])
def test_tolerances_that_mean_nothing_are_refused(tol: object) -> None:
    with pytest.raises(ValueError, match="tol: must be a number in"):
        pyrod.solve(bent(), tol=tol)


def test_what_is_not_reached_is_told_with_what_was() -> None:
    with pytest.raises(NotConverged, match="max_edges") as caught:
        pyrod.solve(bent(), Options(max_edges=128), tol=1e-10)
    result = caught.value.result
    assert result.status == "not_accurate"
    assert 1e-10 < result.accuracy.reached < 1e-4
    assert 64 <= result.accuracy.finest_edges <= 128
    exact = pyrod.solve(bent(), tol=1e-10)
    assert np.abs(result.positions - exact.positions).max() <= result.accuracy.errors["positions"]
    again = pyrod.solve(bent(), Options(max_edges=128), tol=1e-10, strict=False)
    assert same(again, result)


def test_more_than_rounding_allows_is_not_tried_for_ever() -> None:
    result = pyrod.solve(bent(), tol=1e-15, strict=False)
    assert result.status == "not_accurate"
    assert result.accuracy.reached < 1e-10
    assert result.accuracy.grids <= 10


def test_a_level_that_fails_ends_nothing() -> None:
    """With one iteration no level is solved, and each is tried."""
    options = Options(max_iterations=1, max_edges=128)
    result = pyrod.solve(bent(), options, tol=1e-6, strict=False)
    assert result.status == "out_of_iterations"
    assert np.isinf(result.accuracy.reached)
    assert str(result.accuracy).startswith("error unknown")
