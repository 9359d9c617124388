"""The largest curvature, force and moment are those of the rod, not of its vertices."""

from __future__ import annotations

import numpy as np
import pytest

import pyrod
from pyrod import Clamp, DistributedForce, Force, Hinge, Moment, Rod, Scene, Section

UNIT = Section(EI1=1, EI2=1, GJ=1)
SIDEWAYS = {"tangent": (1, 0, 0), "normal": (0, 0, 1)}


def arch(edges: int | None = None) -> Scene:
    rod = Rod.straight(1.0, edges, UNIT, "inextensible")
    ends = [Clamp(**SIDEWAYS), Clamp((0.4, 0, 0.1333), at="end", **SIDEWAYS)]
    return Scene(rod, ends, space="planar")


@pytest.mark.parametrize("tol", [1e-4, 1e-6, 1e-9, 1e-11])
def test_an_arch_bends_most_between_vertices(tol: float) -> None:
    """M² + 2 EI (n - n_x) is the same all along an elastica: where it bends most n has no arm."""
    result = pyrod.solve(arch(), tol=tol)
    exact = pyrod.solve(arch(64), tol=1e-10)
    force, moment = exact.reactions[0]
    right = np.sqrt(moment[1] ** 2 + 2 * (np.linalg.norm(force) - abs(force[0])))
    assert right == pytest.approx(10.935168, abs=1e-6)
    error = abs(result.largest_K / right - 1)
    assert error <= result.errors["extremes"] <= max(100 * tol, 1e-10)
    assert abs(result.largest_moment / right - 1) <= result.errors["extremes"]
    assert np.linalg.norm(result.K, axis=1).max() < 0.98 * right  # at 16 edges
    assert result.rods[0].largest_K == result.largest_K


def test_without_a_tolerance_the_error_is_that_of_the_grid() -> None:
    errors = [abs(pyrod.solve(arch(n)).largest_K / 10.93516771 - 1) for n in (64, 128, 256)]
    assert errors[0] < 1e-3  # at the vertices alone 0.7 %, at 2.5 edges from the top
    assert errors[1] == pytest.approx(errors[0] / 4, rel=0.1)
    assert errors[2] == pytest.approx(errors[1] / 4, rel=0.1)


def clamped(seed: int, edges: int | None = None) -> Scene:
    """A rod between two clamps at random."""
    rng = np.random.default_rng(seed)
    section = Section(*rng.uniform(0.5, 2, 3))
    rod = Rod.straight(1.0, edges, section, "inextensible")
    far = Clamp(
        rng.normal(size=3) * 0.2 + (0, 0, 0.4), pyrod.rotation.exp(rng.normal(size=3)), at="end"
    )
    loads = [Force(rng.normal(size=3) * 5, at=0.5), DistributedForce(rng.normal(size=3) * 5)]
    return Scene(rod, [Clamp(), far], loads[: seed % 3])


@pytest.mark.parametrize("seed", range(12))
def test_errors_told_of_extremes_hold(seed: int) -> None:
    exact = pyrod.solve(clamped(seed, 128), tol=1e-10)
    for tol in (1e-4, 1e-6, 1e-8):
        result = pyrod.solve(clamped(seed), tol=tol)
        if abs(result.energy / exact.energy - 1) > 1e-2:
            pytest.skip("another equilibrium")
        for name in ("largest_K", "largest_force", "largest_moment"):
            error = abs(getattr(result, name) / getattr(exact, name) - 1)
            told = result.errors["extremes"] + exact.errors["extremes"]
            assert error <= told, f"{name} at {tol}: {error:.2e}, told {told:.2e}"


def test_extremes_beside_jumps() -> None:
    """Moments of 3 before and -1 behind the middle: neither mean nor the side behind."""
    loads = [Moment((0, 4, 0), at=0.5), Moment((0, -1, 0))]
    for how in ({}, {"tol": 1e-9}):
        result = pyrod.solve(Scene(Rod.straight(1.0, 16, UNIT), Clamp(), loads), **how)
        assert result.largest_moment == pytest.approx(3, abs=1e-12)
        assert result.largest_K == pytest.approx(3, abs=1e-12)


def test_extremes_at_a_support_between_the_ends() -> None:
    held = [Clamp(), Hinge((0.1, 0, 0.45), at=0.5), Clamp((0, 0, 0.9), at="end")]
    result = pyrod.solve(Scene(Rod.straight(1.0, None, UNIT), held, space="planar"), tol=1e-9)
    assert result.largest_moment >= np.linalg.norm(result.moment, axis=1).max()
    behind, before = result.vertex_force, result.vertex_force_before
    most = max(np.linalg.norm(n, axis=1).max() for n in (behind, before))
    assert result.largest_force == pytest.approx(most, rel=1e-9)


def test_of_many_rods_the_largest() -> None:
    section = Section(EI1=1, EI2=1, GJ=1)
    rods = [Rod.straight(1.0, 16, section), Rod.straight(1.0, 16, section).placed((1, 0, 0))]
    held = [Clamp(at=(i, "start")) for i in (0, 1)]
    loads = [Force((f, 0, 0), at=(i, "end")) for i, f in enumerate((1.0, 3.0))]
    result = pyrod.solve(Scene(rods, held, loads), tol=1e-8)
    assert result.largest_force == pytest.approx(3, rel=1e-9)
    assert result.largest_moment == max(rod.largest_moment for rod in result.rods)
    assert result.rods[0].largest_force == pytest.approx(1, rel=1e-9)


def test_all_who_tell_the_largest_tell_the_same() -> None:
    from pyrod.cli.summary import in_numbers as summary

    result = pyrod.solve(arch(), tol=1e-6)
    assert summary(result)["largest_curvature"] == [result.largest_K]
    done = pyrod.sweep(lambda tol: arch(), {"tol": [1e-6]}, tol=1e-6)
    assert done["largest_K"][0] == pytest.approx(result.largest_K, rel=1e-12)
    assert done["largest_moment"][0] == pytest.approx(result.largest_moment, rel=1e-12)
