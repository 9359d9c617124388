"""Stability of planar equilibria out of their plane."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.optimize import brentq
from support import FLAT, REFERENCE, X, Z, extrapolated, table

import pyrod
from pyrod import Clamp, Force, Hinge, Rod, Scene, Section, solve
from pyrod.reference import Case, load

CASES = [case for case in load(REFERENCE) if "planar" in case.spaces]
FLAT_ROD = Rod.straight(1.0, 16, FLAT)


@pytest.mark.parametrize("case", CASES, ids=str)
def test_indices_in_and_out_of_the_plane_add_up(case: Case) -> None:
    """To that of the exact solution in space, where it is known."""
    n = 4 * case.intervals
    planar = solve(case.scene(n, "planar"), start=case.start(n), stable=False)
    across = pyrod.out_of_plane_index(planar)
    exact = case.data["values"].get("stability_index")
    if exact is not None:
        assert planar.index + across == exact
    no_potential = str(case).startswith(("P2", "P6"))  # moments fixed in space, a follower
    assert (across is None) == no_potential


MICHELL = table("S5_prandtl_michell")


def strip(P: float, n: int, ratio: float, GJ: float) -> pyrod.Equilibrium:
    rod = Rod.straight(1.0, n, Section(1.0, 1 / ratio, GJ))
    return solve(Scene(rod, Clamp(), Force(P * X), "planar"))


def lateral_load(n: int, ratio: float, GJ: float, near: float) -> float:
    """Where the index out of the plane becomes 1."""

    def lowest(P: float) -> float:
        planar = strip(P, n, ratio, GJ)
        space = Scene(planar.scene.rods, planar.scene.supports, planar.scene.loads)
        return solve(space, start=planar, stable=False, eigenvalue=True).lowest_eigenvalue

    found = brentq(lowest, 0.95 * near, 1.05 * near, xtol=1e-11)
    assert [pyrod.out_of_plane_index(strip(f * found, n, ratio, GJ)) for f in (0.999, 1.001)] == [
        0,
        1,
    ]
    return found


@pytest.mark.parametrize("row", MICHELL["rows"][:4], ids=lambda r: r["EI1_over_EI2"])
def test_a_strip_buckles_sideways(row: Any) -> None:
    ratio, GJ, exact = float(row["EI1_over_EI2"]), float(row["GJ_over_EI1"]), float(row["P"])
    found = [lateral_load(n, ratio, GJ, exact) for n in (8, 16, 32, 64)]
    assert extrapolated(found) == pytest.approx(exact, rel=2e-6)


def test_prandtls_strip() -> None:
    """P L^2 = 4.0126 sqrt(EI GJ) where the strong side is rigid: the limit in EI_weak/EI_strong."""
    limit = float(MICHELL["prandtl_limit"]["P_L2_over_sqrt(EI1 GJ)"])
    size = limit * np.sqrt(0.5)
    at = [
        extrapolated([lateral_load(n, ratio, 0.5, size) for n in (8, 16, 32, 64)])
        for ratio in (2e-3, 1e-3)
    ]
    assert 2 * at[1] - at[0] == pytest.approx(size, rel=1e-5)


@pytest.mark.parametrize("row", table("S5_clamped_out_of_plane")["rows"], ids=lambda r: r["GJ/EI"])
def test_an_elastica_leaves_its_plane(row: Any) -> None:
    above, _, below = row["GJ/EI"].partition("/")
    GJ, critical = float(above) / float(below or 1), float(row["critical_shortening"])
    rod = Rod.straight(1.0, 64, Section(1, 1, GJ))
    for by, index in ((critical - 0.01, 0), (critical + 0.01, 1)):
        ends = [Clamp(), Clamp((0, 0, 1 - by), at="end")]
        planar = solve(Scene(rod, ends, space="planar"))
        assert planar.stable
        assert pyrod.out_of_plane_index(planar) == index


def test_a_column_that_is_weak_out_of_its_plane() -> None:
    """EI1 = EI2/4: out of the plane it buckles at a quarter of the load."""
    rod = Rod.straight(1.0, 32, Section(1, 4, 1))
    critical = np.pi**2 / 4
    for P, index in ((0.9 * critical, 0), (1.1 * critical, 1), (9.5 * critical, 2)):
        column = Scene(rod, Clamp(), Force(-P * Z), "planar")
        assert pyrod.out_of_plane_index(solve(column, stable=False)) == index


def test_what_spins_freely_is_not_unstable() -> None:
    """Between ball joints a rod may turn about its chord."""
    ends = [Hinge((0, 0, 0)), Hinge((0, 0, 0.8), at="end")]
    planar = solve(Scene(FLAT_ROD, ends, Force(X, at=0.5), "planar"))
    assert pyrod.out_of_plane_index(planar) == 0


def test_index_out_of_the_plane_is_for_planar_scenes() -> None:
    with pytest.raises(ValueError, match="spatial already"):
        pyrod.out_of_plane_index(solve(Scene(FLAT_ROD, Clamp(), Force(X))))
