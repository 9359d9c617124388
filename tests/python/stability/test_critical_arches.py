"""Arches that snap or go to the side, against limit loads found with the displacement prescribed
instead of the force, and the exact thresholds of the reference data."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
import pytest
from scipy.optimize import minimize_scalar
from support import FLAT, X, Y, about_y, extrapolated, table, within

import pyrod
from pyrod import Clamp, Force, Hinge, Rod, Scene, Section, critical_load, solve


def arch(n: int, EA: float, load: Any, more: Any = ()) -> Scene:
    """An arc of an angle 1, hinged at both ends, its chord along z, its crown towards -x."""
    rod = Rod.precurved(1.0, n, Section(1, 1, 1, EA=EA), Y).placed((0, 0, 0), about_y(-0.5))
    return Scene(rod, [Hinge(), Hinge(at="end"), *more], load, "planar")


def limit(n: int, EA: float) -> float:
    """The largest force as the crown is pushed down by prescribed ways."""
    chord = 2 * np.sin(0.5)

    def pull(x: float) -> float:
        crown = Hinge((x, 0, chord / 2), at=0.5)
        return float(solve(arch(n, EA, (), [crown]), stable=False).reactions[2].force[0])

    found = minimize_scalar(lambda x: -pull(x), bounds=(-0.12, 0.0), options={"xatol": 1e-8})
    return -found.fun


def test_an_arch_snaps_at_the_largest_force() -> None:
    EA = 1e3
    exact = extrapolated([limit(n, EA) for n in (64, 128)])
    found = critical_load(arch(64, EA, Force(X, at=0.5)))
    assert (found.kind, found.index_after) == ("limit point", None)
    within(found, exact, 1e-6)
    assert found.grid_factor == pytest.approx(limit(64, EA), rel=1e-7)
    assert repr(found).endswith(", then no equilibrium)")
    assert found.equilibrium.stable
    assert found.buckled().stable
    assert found.equilibrium.positions[32, 0] < -0.04
    assert found.buckled().positions[32, 0] > 0.1


def test_a_stiff_arch_goes_to_the_side_before() -> None:
    found = critical_load(arch(64, 1e4, Force(X, at=0.5)))
    assert (found.kind, found.index_after) == ("bifurcation", 1)
    assert found.factor < limit(64, 1e4)
    assert found.mode is not None
    np.testing.assert_allclose(found.mode[::-1], found.mode, atol=1e-5)  # antisymmetric bending


@cache
def flat_arch(flatter: float) -> pyrod.Critical:
    angle = 0.5 / flatter
    section = Section(1, 1, 1, EA=1e3 * flatter**2)
    rod = Rod.precurved(1.0, 64, section, angle * Y).placed((0, 0, 0), about_y(-angle / 2))
    ends = [Hinge(), Hinge(at="end")]
    return critical_load(Scene(rod, ends, Force(X, at=0.5), "planar"))


@pytest.mark.parametrize("flatter", [10, 28, 43, 1000])
def test_a_flat_arch_snaps_at_once(flatter: float) -> None:
    """Arches whose crowns are as high in radii of gyration snap at forces like their heights."""
    found = flat_arch(flatter)
    assert found.kind == "limit point"
    assert found.factor * flatter == pytest.approx(flat_arch(1).factor, rel=2e-2)


def test_a_shallow_arch_does_not_snap() -> None:
    """It is flattened without a largest force."""
    rod = Rod.precurved(1.0, 16, Section(1, 1, 1, EA=1e3), 0.2 * Y).placed((0, 0, 0), about_y(-0.1))
    scene = Scene(rod, [Hinge(), Hinge(at="end")], Force(X, at=0.5), "planar")
    assert critical_load(scene, 100.0).kind == "none"


def sketched(n: int, eps: float, side: int) -> list[Any]:
    """Frames of a low arch to one side."""
    s = (np.arange(n) + 0.5) / n
    return [about_y(side * x) for x in 2 * np.sqrt(eps) * np.sin(2 * np.pi * s)]


@pytest.mark.parametrize("row", table("S5_arch_midload")["rows"][1:3], ids=lambda r: r["eps"])
def test_a_buckled_arch_is_pushed_through(row: Any) -> None:
    """It goes to the side, from a start that is an arch; that at rest is straight."""
    rod, eps = Rod.straight(1.0, 64, FLAT), float(row["eps"])
    ends = [Clamp(), Clamp((0, 0, 1 - eps), at="end")]
    for side in (1, -1):
        sketch = sketched(64, eps, side)
        arch = solve(Scene(rod, ends, space="planar"), start=sketch)
        scene = Scene(rod, ends, Force(-side * X, at=0.5), "planar")
        for start in (sketch, arch):
            within(critical_load(scene, start=start), float(row["bif"]["F"]), 2e-6)
