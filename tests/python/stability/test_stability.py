"""Where equilibria lose their stability, against the exact thresholds of the reference data.

The threshold of a discrete rod is where its lowest eigenvalue passes zero; there the stability
index changes. Symmetric supports make its errors even in 1/n.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from scipy.optimize import brentq
from support import COLUMNS, EULER, FLAT, SPACES, X, Z, about_y, extrapolated, table

import pyrod
from pyrod import Clamp, Force, Rod, Scene, Section, Slider, solve
from pyrod.rotation import exp


def saddle(scene: Scene, start: Any = None) -> pyrod.Equilibrium:
    """The equilibrium that is nearest, whatever its stability."""
    return solve(scene, start=start, stable=False, eigenvalue=True)


def column(
    ends: str, n: int, P: float, space: str = "spatial", section: Section = FLAT
) -> pyrod.Equilibrium:
    """A straight column under a dead force at its end."""
    rod = Rod.straight(1.0, n, section)
    return saddle(Scene(rod, COLUMNS[ends], Force(-P * Z), space))


def threshold(
    at: Callable[[float], pyrod.Equilibrium], low: float, high: float, jump: int = 1
) -> float:
    """Where the lowest eigenvalue is zero; the index changes there, from zero by the jump."""
    found = brentq(lambda p: at(p).lowest_eigenvalue, low, high, xtol=1e-12, rtol=1e-14)
    assert at(low).index == at(found - 1e-3 * (found - low)).index == 0
    assert at(high).index == at(found + 1e-3 * (high - found)).index == jump
    return found


# Columns ------------------------------------------------------------------------------------------


@pytest.mark.parametrize("space", SPACES)
@pytest.mark.parametrize("ends", COLUMNS)
def test_eulers_columns(ends: str, space: str) -> None:
    exact = EULER[ends]
    critical = [
        threshold(lambda P, n=n: column(ends, n, P, space), 0.9 * exact, 1.05 * exact)
        for n in (8, 16, 32, 64)
    ]
    assert abs(extrapolated(critical, (2, 4, 6)) / exact - 1) < 1e-6


@pytest.mark.parametrize(
    ("ends", "waves"),
    [("clamped-free", 1 / 4), ("pinned-pinned", 1 / 2), ("clamped-clamped", 1.0)],
)
@pytest.mark.parametrize("n", [4, 9, 16])
def test_the_discrete_column_buckles_at_its_own_load(ends: str, waves: float, n: int) -> None:
    """Frames that turn as cos(k s) solve the difference equation: P = (2 n sin(k/2n))^2 EI/L^2."""
    exact = (2 * n * np.sin(np.pi * waves / n)) ** 2
    found = threshold(lambda P: column(ends, n, P), 0.8 * exact, 1.2 * exact)
    assert abs(found / exact - 1) < 1e-9


def test_the_index_counts_the_modes() -> None:
    """Between the thresholds (2k - 1)^2 pi^2/4 of a clamped column; EI1 = 4 EI2 adds its own."""
    n = 64
    modes = [(2 * n * np.sin((2 * k - 1) * np.pi / 4 / n)) ** 2 for k in (1, 2, 3, 4)]
    for P in (1.0, 5.0, 15.0, 30.0, 80.0, 130.0):
        planar = sum(mode < P for mode in modes)
        across = sum(4 * mode < P for mode in modes)
        assert column("clamped-free", n, P, "planar").index == planar
        assert column("clamped-free", n, P).index == planar + across


REISSNER = [
    row
    for row in table("S5_reissner_column")["rows"]
    if row["ends"] in COLUMNS and row["P"] and row["EA"]  # what shears stretches, too
]


@pytest.mark.parametrize("row", REISSNER, ids=lambda r: f"{r['ends']}-EA{r['EA']}-GA{r['GA']}")
def test_columns_that_shear_and_stretch(row: Any) -> None:
    exact = float(row["P"])
    EA, GA = float(row["EA"]), np.inf if row["GA"] is None else float(row["GA"])
    section = Section(4, 1, 2, GA, GA, EA)
    critical = [
        threshold(
            lambda P, n=n: column(row["ends"], n, P, section=section),
            0.9 * exact,
            1.02 * exact,
        )
        for n in (16, 32, 64)
    ]
    assert abs(extrapolated(critical, (2, 4)) / exact - 1) < 1e-6


GREENHILL = table("S5_greenhill")["rows"]


@pytest.mark.parametrize("row", GREENHILL[:6], ids=lambda r: f"T{r['T']}")
def test_a_twisted_rod_under_tension(row: Any) -> None:
    """Between clamps that turn by M L/GJ; isotropic, so that two modes go at once."""
    GJ, exact = 10.0, float(row["M_clamped_clamped"])

    def twisted(n: int, M: float) -> pyrod.Equilibrium:
        end = Slider(Z, frame=exp(M / GJ * Z))
        rod = Rod.straight(1.0, n, Section(1, 1, GJ))
        return saddle(Scene(rod, [Clamp(), end], Force(row["T"] * Z)))

    critical = [
        threshold(lambda M, n=n: twisted(n, M), 0.9 * exact, 1.05 * exact, jump=2)
        for n in (16, 32, 64)
    ]
    assert abs(extrapolated(critical, (2, 4)) / exact - 1) < 1e-4


# Elasticas ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("ends", ["pinned-pinned", "clamped-clamped"])
def test_beyond_its_load_a_column_is_left(ends: str) -> None:
    """The straight saddle is left for the bent shape, which is stable and has less energy."""
    P = 1.2 * EULER[ends]
    scene = Scene(Rod.straight(1.0, 32, FLAT), COLUMNS[ends], Force(-P * Z))
    straight, bent = saddle(scene), solve(scene)
    assert straight.index == 1
    assert np.abs(straight.positions[:, :2]).max() < 1e-12
    assert bent.stable
    assert np.abs(bent.positions[:, 0]).max() > 0.1
    potential = [r.energy + P * r.tip[2] for r in (bent, straight)]
    assert potential[0] < potential[1] - 1e-2


def shortened(n: int, GJ: float, by: float, space: str) -> pyrod.Equilibrium:
    rod = Rod.straight(1.0, n, Section(1, 1, GJ))
    return solve(Scene(rod, [Clamp(), Clamp((0, 0, 1 - by), at="end")], space=space))


@pytest.mark.parametrize("row", table("S5_clamped_out_of_plane")["rows"], ids=lambda r: r["GJ/EI"])
def test_a_shortened_elastica_leaves_its_plane(row: Any) -> None:
    """At an end shortening that depends on GJ/EI: the spatial energy falls below the planar one."""
    numbers = [float(x) for x in row["GJ/EI"].split("/")]
    GJ = numbers[0] / numbers[1] if len(numbers) == 2 else numbers[0]
    critical = float(row["critical_shortening"])
    saved = {}
    for by in (critical - 0.02, critical + 0.02):
        planar, free = shortened(64, GJ, by, "planar"), shortened(64, GJ, by, "spatial")
        assert free.stable
        saved[by < critical] = planar.energy - free.energy
    assert abs(saved[True]) < 1e-9
    assert saved[False] > 1e-3


ARCHES = [r for r in table("S5_arch_snap")["rows"] if r["kind"] == "sym" and float(r["eps"]) > 1e-3]


@pytest.mark.parametrize("row", ARCHES, ids=lambda r: f"eps{r['eps']}")
def test_an_arch_snaps_when_its_clamps_are_turned(row: Any) -> None:
    """Both clamps turn against the bow, which goes at alpha_c to the side, antisymmetrically.

    The symmetric shape comes to an end soon behind, so the threshold is sought from below, by
    interpolation of the angle over the eigenvalue.
    """
    eps, exact = float(row["eps"]), float(row["alpha_c"])
    found = []
    for n in (128, 256, 512):
        rod = Rod.straight(1.0, n, FLAT)

        def turned(angle: float, start: Any, rod: Rod = rod) -> pyrod.Equilibrium:
            ends = [Clamp(frame=about_y(-angle)), Clamp((0, 0, 1 - eps), about_y(angle), at="end")]
            return saddle(Scene(rod, ends, space="planar"), start)

        s = (np.arange(n) + 0.5) / n
        arch = turned(0.0, [about_y(x) for x in 2 * np.sqrt(eps) * np.sin(2 * np.pi * s)])
        rows = []
        for angle in exact * np.array([0.4, 0.7, 0.9, 0.94, 0.97]):
            arch = turned(angle, arch)
            rows.append((arch.lowest_eigenvalue, angle))
        for _ in range(4):
            angle = np.polyval(np.polyfit(*np.transpose(rows[-3:]), 2), 0.0)
            arch = turned(angle, arch)
            rows.append((arch.lowest_eigenvalue, angle))
        assert abs(rows[-1][0]) < 1e-6 < rows[4][0]
        assert [turned(part * angle, arch).index for part in (0.999, 1.001)] == [0, 1]
        found.append(angle)
    assert abs(extrapolated(found) / exact - 1) < 1e-6


# Eigenvalues --------------------------------------------------------------------------------------


def test_the_lowest_eigenvalue_is_that_of_the_column() -> None:
    """(P_c - P) L for a clamped column, exactly: its Hessian is the beam's less P h."""
    n = 16
    critical = (2 * n * np.sin(np.pi / 4 / n)) ** 2
    for P in (-5.0, 0.0, 2.0, 3.0):
        found = column("clamped-free", n, P, "planar").lowest_eigenvalue
        assert found == pytest.approx(critical - P, abs=1e-9)


def test_no_eigenvalue_unless_asked() -> None:
    scene = Scene(Rod.straight(1.0, 4, FLAT), COLUMNS["clamped-pinned"], Force(X, at=0.5))
    assert solve(scene).lowest_eigenvalue is None
    assert solve(scene, eigenvalue=True).lowest_eigenvalue > 0
