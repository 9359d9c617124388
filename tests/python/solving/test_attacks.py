"""Inputs that were made to break it, and the right values; those of grids and starts have their own
files."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import pyrod
from pyrod import (
    Clamp,
    DistributedForce,
    Force,
    Gravity,
    Hinge,
    Joint,
    Material,
    Moment,
    NotConverged,
    Rod,
    Scene,
    Section,
    Slider,
    Spring,
    solve,
)

STEP = DistributedForce(lambda s: (0, 0, 0) if s < 0.6 else (5.0, 0, 0))


@pytest.mark.parametrize("at", [0.3, 0.7, 0.77, 0.93])
def test_places_beside_a_load_that_jumps(at: float) -> None:
    rod = Rod.straight(1.0, None, Section(1, 1, 1))
    scene = Scene(rod, [Clamp(), Spring(70.0, 1.5, at=at)], STEP)
    result = solve(scene, tol=1e-6)
    finer = solve(scene, tol=1e-9)
    assert np.abs(result.tip - finer.tip).max() <= result.errors["positions"] + 1e-9


def test_a_hinge_beside_a_load_that_jumps() -> None:
    rod = Rod.straight(1.0, None, Section(1, 1, 1))
    assert solve(Scene(rod, [Clamp(), Hinge((0.1, 0, 0.63), at=0.7)], STEP), tol=1e-6).converged


def test_followers_over_springs_and_sliders_are_answered_or_refused() -> None:
    """Once it wrote past the end of a list."""
    rod = Rod.straight(1.0, None, Section(1.3, 0.8, 1, EA=100.0))
    loads = [
        Force((0.163, 0.638, -1.898), at=0.4234658589667165, follower=True),
        DistributedForce(lambda s: np.array([1.0, np.sin(2 * s), 1 + s]), follower=True),
    ]
    slide = Slider(along=(0.034, -0.895, 0.445), position=(0.366, 0.539, 0.085))
    spring = Spring(74.53, 1.5, (0.178, 0.262, 0.041), at=0.5016407467813933)
    options = pyrod.Options(max_edges=2**9)
    result = solve(Scene(rod, [Clamp(), slide, spring], loads), options, tol=1e-6, strict=False)
    assert result.converged or result.advice


@pytest.mark.parametrize("space", ["planar", "spatial"])
@pytest.mark.parametrize("EA", [np.inf, 1e3])
@pytest.mark.parametrize("apart", [1e-3, 1e-6])
def test_hinges_that_nearly_coincide_are_a_clamp(apart: float, EA: float, space: str) -> None:
    rod = Rod.straight(1.0, 16, Section(1, 1, 0.7, EA=EA))
    pair = [Hinge((0, 0, 0.5), at=0.5), Hinge((0, 0, 0.5 + apart), at=0.5 + apart)]
    found = solve(Scene(rod, [Clamp(), *pair], Force((1, 0, 0)), space))
    limit = solve(Scene(rod, [Clamp(), Clamp((0, 0, 0.5), at=0.5)], Force((1, 0, 0)), space))
    assert found.index == 0
    assert found.iterations <= 10
    assert np.abs(found.tip - limit.tip).max() < apart


@pytest.mark.parametrize("edges", [64, 128, 256, 1024])
@pytest.mark.parametrize("space", ["planar", "spatial"])
def test_a_taut_wire_has_no_loop_in_an_edge(space: str, edges: int) -> None:
    """10 m of 0.2 mm wire under its weight: the elastic catenary pulls with 0.53508 N."""
    wire = Section.circle(0.1e-3, Material(E=200e9, density=7850))
    rod = Rod.straight(10.0, edges, wire).placed(tangent=(1, 0, 0), normal=(0, 0, 1))
    result = solve(Scene(rod, [Hinge(), Hinge(at="end")], Gravity(), space))
    assert result.index == 0
    assert result.reactions[1].force[0] == pytest.approx(0.53508, rel=0.7 / edges**2 + 2e-5)


def four_bar(M: float, n: int) -> Scene:
    def bar(p: Any, q: Any) -> Rod:
        p, q = np.array(p, float), np.array(q, float)
        along = q - p
        return Rod.straight(float(np.linalg.norm(along)), n, Section(5, 5, 5)).placed(
            p, tangent=along, normal=np.cross((0, 1, 0), along)
        )

    A, B, C, D = (0, 0, 0), (0.02, 0, 0.10), (0.12, 0, 0.12), (0.10, 0, 0)
    joints = [
        Joint(((0, "end"), (1, "start")), "ball"),
        Joint(((1, "end"), (2, "end")), "ball"),
    ]
    held = [
        Hinge(at=(0, "start")),
        Hinge(at=(2, "start")),
        Spring(200.0, position=B, at=(0, "end")),
    ]
    load = Moment((0, M, 0), at=(0, "start"))
    return Scene([bar(A, B), bar(B, C), bar(D, C)], held, load, "planar", joints)


@pytest.mark.parametrize("n", [1, 2, 8])
def test_a_mechanism_on_a_spring_is_stable(n: int) -> None:
    for M in (*np.linspace(-0.6, 0.6, 24), -0.0018, -0.0019165663376066162):
        result = solve(four_bar(float(M), n), eigenvalue=True)
        assert result.index == 0
        assert result.lowest_eigenvalue > 0


@pytest.mark.parametrize("tol", [None, 1e-6])
def test_what_is_exactly_taut_is_told_so(tol: float | None) -> None:
    rod = Rod.straight(1.0, None if tol else 32, Section(1, 1, 1))
    with pytest.raises(NotConverged, match="as far apart as the rod between them is long"):
        solve(Scene(rod, [Hinge(), Hinge(at="end")], Force((1, 0, 0), at=0.5)), tol=tol)


def test_a_start_with_more_supports() -> None:
    rod = Rod.straight(1.0, 64, Section(1, 1, 0.7))
    ends = [Clamp(), Hinge((0, 0, 0.95), at="end")]
    props = [Spring(5.0, at=i / 64) for i in range(1, 64)]  # that are taken away
    load = Force((1, 0, 0), at=0.3)
    propped = solve(Scene(rod, ends + props, load))
    plain = solve(Scene(rod, ends, load))
    for _ in range(5):
        result = solve(Scene(rod, ends, load), start=propped)
        assert result.energy == pytest.approx(plain.energy, rel=1e-9)
