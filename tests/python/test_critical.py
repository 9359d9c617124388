"""Critical loads against closed forms, the exact thresholds of the reference data, and limit loads
found with the displacement prescribed instead of the force."""

from __future__ import annotations

import pickle
import re
from typing import Any

import numpy as np
import pytest
from scipy.optimize import minimize_scalar
from support import COLUMNS, EULER, FLAT, SPACES, X, Y, Z, about_y, extrapolated, table

import pyrod
from pyrod import (
    Clamp,
    DistributedForce,
    Force,
    Gravity,
    Hinge,
    Moment,
    Rod,
    Scene,
    Section,
    Slider,
    critical_load,
    solve,
)


def column(ends: str = "clamped-free", n: int | None = 32, **more: Any) -> Scene:
    """Under a dead force 1 at its end."""
    return Scene(Rod.straight(1.0, n, FLAT), COLUMNS[ends], Force(-Z), **more)


def within(found: pyrod.Critical, exact: float, relative: float) -> None:
    """The error is less than it is told to be, and than it should be."""
    assert abs(found.factor - exact) <= found.error + relative * exact
    assert abs(found.factor / exact - 1) < relative
    assert found.error < 2e-3 * exact


# Bifurcations -------------------------------------------------------------------------------------


@pytest.mark.parametrize("space", SPACES)
@pytest.mark.parametrize("ends", COLUMNS)
def test_eulers_columns(ends: str, space: str) -> None:
    found = critical_load(column(ends, space=space))
    within(found, EULER[ends], 2e-6)
    assert (found.kind, found.index_after) == ("bifurcation", 1)


@pytest.mark.parametrize("n", [4, 9, 64])
def test_the_load_of_the_grid_is_exact(n: int) -> None:
    """Frames that turn as cos(k s) solve the difference equation: P = (2 n sin(pi/4n))^2."""
    found = critical_load(column(n=n))
    assert found.grid_factor == pytest.approx((2 * n * np.sin(np.pi / 4 / n)) ** 2, rel=2e-8)
    assert abs(found.equilibrium.lowest_eigenvalue) < 1e-7
    s = (np.arange(n) + 0.5) / n
    mode = np.sin(np.pi / 2 * s) / np.sin(np.pi / 2 * s[-1])
    assert found.mode is not None
    np.testing.assert_allclose(np.abs(found.mode), np.outer(mode, Y), atol=1e-6)


def test_edges_may_be_left_to_the_solver() -> None:
    found = critical_load(column(n=None))
    within(found, EULER["clamped-free"], 1e-5)


def test_the_heavy_column() -> None:
    (row,) = table("S5_heavy_column")["rows"]
    section = Section(4, 1, 2, mass_per_length=0.5)
    scene = Scene(Rod.straight(1.0, 32, section), Clamp(), Gravity((0, 0, -1)))
    within(critical_load(scene), float(row["wL3/EI"]) / 0.5, 1e-6)
    spread = Scene(Rod.straight(1.0, 32, FLAT), Clamp(), DistributedForce(lambda s: -Z))
    within(critical_load(spread), float(row["wL3/EI"]), 1e-6)


STRIPS = table("S5_prandtl_michell")["rows"]


@pytest.mark.parametrize("row", [STRIPS[0], STRIPS[3], STRIPS[8]], ids=lambda r: r["P"][:5])
def test_a_strip_tilts_to_the_side(row: Any) -> None:
    """A cantilever loaded in its stiff plane, in which it bends before it buckles out of it."""
    GJ = 20 / 13 if "/" in row["GJ_over_EI1"] else float(row["GJ_over_EI1"])
    section = Section(1.0, 1 / float(row["EI1_over_EI2"]), GJ)
    found = critical_load(Scene(Rod.straight(1.0, 32, section), Clamp(), Force(X)))
    within(found, float(row["P"]), 2e-5)
    assert found.index_after == 1


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


@pytest.mark.parametrize("ratio", [4.5, 4.02, 4.001, 3.9])
def test_a_column_that_shortens(ratio: float) -> None:
    """P (1 - P/EA) = P_E: unstable between two loads that may be near each other."""
    euler = EULER["clamped-free"]
    rod = Rod.straight(1.0, 32, Section(4, 1, 2, EA=ratio * euler))
    found = critical_load(Scene(rod, Clamp(), Force(-Z)), 0.9 * ratio * euler)
    if ratio < 4:
        assert found.kind == "none"
    else:
        within(found, ratio * euler * (1 - np.sqrt(1 - 4 / ratio)) / 2, 3e-4)


def test_units_do_not_matter() -> None:
    """A hair, in kilometres and in micrometres."""
    found = []
    for metre, newton in ((1e-3, 1e-9), (1e6, 1e9)):
        stiffness = np.array([4.0, 1.0, 2.0]) * newton * metre**2
        rod = Rod.precurved(metre, 32, Section(*stiffness), 0.3 * X / metre)
        loads = [Force(-newton * Z), Force(0.1 * newton * Y)]
        found.append(critical_load(Scene(rod, Clamp(), loads)))
    assert found[0].kind == found[1].kind == "bifurcation"
    assert found[0].factor == pytest.approx(found[1].factor, rel=1e-7)


@pytest.mark.parametrize("off", [0, 1e-15, 1e-14, -1e-14, 1e-13, -1e-13, 1e-12, 1e-10, -1e-10])
def test_a_step_may_end_on_the_critical_load(off: float) -> None:
    """The third does: steps are 1/16, 2/16, 4/16 of the load of a hinged column."""
    n, end = 16, 7 / 16 * np.pi**2
    other = (2 * n * np.sin(np.pi / 4 / n)) ** 2 - end * (1 + off)
    scene = Scene(Rod.straight(1.0, n, FLAT), Clamp(), [Force(-other * Z), Force(-Z)])
    found = critical_load(scene, loads=[1])
    assert found.kind == "bifurcation"
    assert found.grid_factor == pytest.approx(end, rel=1e-8)


def test_isotropic_columns_buckle_all_ways_at_once() -> None:
    scene = Scene(Rod.straight(1.0, 16, Section(1, 1, 1)), Clamp(), Force(-Z))
    assert critical_load(scene).index_after == 2


def test_some_loads_grow_and_others_stay() -> None:
    rod = Rod.straight(1.0, 32, FLAT)
    scene = Scene(rod, Clamp(), [Force(-1.5 * Z), Force(-2 * Z)])
    within(critical_load(scene, loads=[1]), (EULER["clamped-free"] - 1.5) / 2, 1e-6)
    within(critical_load(scene), EULER["clamped-free"] / 3.5, 1e-6)


# Limit points -------------------------------------------------------------------------------------


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


@pytest.mark.parametrize("flatter", [10, 28, 43, 1000])
def test_a_flat_arch_snaps_at_once(flatter: float) -> None:
    """Arches whose crowns are as high in radii of gyration snap at forces like their heights."""

    def flat(flatter: float) -> pyrod.Critical:
        angle = 0.5 / flatter
        section = Section(1, 1, 1, EA=1e3 * flatter**2)
        rod = Rod.precurved(1.0, 64, section, angle * Y).placed((0, 0, 0), about_y(-angle / 2))
        ends = [Hinge(), Hinge(at="end")]
        return critical_load(Scene(rod, ends, Force(X, at=0.5), "planar"))

    found = flat(flatter)
    assert found.kind == "limit point"
    assert found.factor * flatter == pytest.approx(flat(1).factor, rel=2e-2)


# No critical load ---------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "force", [Z, (1e-3, 0, -1), (0.5, 0, -1)], ids=["pulled", "pushed", "bent"]
)
def test_some_columns_never_buckle(force: Any) -> None:
    scene = Scene(Rod.straight(1.0, 16, FLAT), Clamp(), Force(force), "planar")
    found = critical_load(scene, 30.0)
    assert (found.kind, found.factor, found.grid_factor) == ("none", np.inf, 30.0)
    assert np.isnan(found.error)
    assert repr(found) == "Critical(none, stable up to factor 30)"
    assert found.equilibrium.stable
    with pytest.raises(ValueError, match="buckled: no critical load was found"):
        found.buckled()


def test_the_upper_factor_is_the_largest() -> None:
    exact = EULER["clamped-free"]
    assert critical_load(column(), 0.999 * exact).kind == "none"
    assert critical_load(column(), 1.001 * exact).kind == "bifurcation"
    guess = np.pi**2
    found = critical_load(Scene(Rod.straight(1.0, 8, Section(4, 1, 0.5)), Clamp(), Force(3 * Z)))
    assert found.grid_factor == pytest.approx(100 * guess / 3)


def test_a_shallow_arch_does_not_snap() -> None:
    """It is flattened without a largest force."""
    rod = Rod.precurved(1.0, 16, Section(1, 1, 1, EA=1e3), 0.2 * Y).placed((0, 0, 0), about_y(-0.1))
    scene = Scene(rod, [Hinge(), Hinge(at="end")], Force(X, at=0.5), "planar")
    assert critical_load(scene, 100.0).kind == "none"


# Buckled ------------------------------------------------------------------------------------------


def test_the_buckled_shape_is_to_be_had_on_both_sides() -> None:
    """Near the load, P/P_c = 1 + t^2/8 with the angle t of the end."""
    found = critical_load(column(n=64))
    shapes = [found.buckled(a, beyond=0.005) for a in (0.1, -0.1)]
    assert [shape.stable for shape in shapes] == [True, True]
    assert shapes[0].tip[0] == pytest.approx(-shapes[1].tip[0], rel=1e-9)
    direction = shapes[0].rods[0].frames[-1]
    angle = 2 * np.arcsin(abs(direction[2]))
    assert angle == pytest.approx(np.sqrt(8 * 0.005), rel=1e-2)
    assert shapes[0].scene.loads[0].force[2] == pytest.approx(-1.005 * found.grid_factor)


def test_what_is_told_and_pickled() -> None:
    found = critical_load(column())
    assert re.fullmatch(
        r"Critical\(bifurcation, factor 2\.46740\d+ ± 0\.0001, then index 1\)", repr(found)
    )
    snapped = critical_load(arch(64, 1e3, Force(X, at=0.5)))
    assert repr(snapped).endswith(", then no equilibrium)")
    back = pickle.loads(pickle.dumps(found))
    assert back == found
    assert back.buckled() == found.buckled()


# What is refused ----------------------------------------------------------------------------------

BEAM = Rod.straight(1.0, 8, FLAT)


@pytest.mark.parametrize(
    ("scene", "more", "message"),
    [
        (Scene(BEAM, Clamp(), Force(X, follower=True)), {}, "those that follow the rods have no"),
        (Scene(BEAM, Clamp(), Moment(Y)), {}, "loads: they have no potential"),
        (Scene(BEAM, Clamp()), {}, r"loads: expected numbers below 0, got \[\]"),
        (column(n=8), {"loads": [1]}, r"loads: expected numbers below 1, got \[1\]"),
        (Scene(BEAM, Clamp(), Force(0 * X)), {}, "loads: all that are to grow are zero"),
        (column(n=8), {"upper": -1.0}, "upper: must be positive and finite, got -1"),
        (column(n=8), {"upper": np.inf}, "upper: must be positive and finite, got inf"),
        (column(n=8), {"rtol": 0.0}, r"rtol: must be in \(0, 0.1\), got 0"),
        (
            Scene(BEAM, [Hinge(), Slider(Z)], Force(-Z)),
            {},
            "without the loads it can move without a change of energy .everything turns about",
        ),
        (
            Scene(BEAM, Clamp(), [Force(-3 * Z), Force(-Z)]),
            {"loads": [1]},
            r"it is unstable without the loads already \(index 1\)",
        ),
    ],
)
def test_what_has_no_answer_is_refused(scene: Scene, more: Any, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        critical_load(scene, **more)


def test_moments_have_a_potential_in_the_plane() -> None:
    scene = Scene(BEAM, Clamp(), Moment(Y), "planar")
    assert critical_load(scene, 3.0).kind == "none"


def test_paths_that_are_lost_are_told(monkeypatch: pytest.MonkeyPatch) -> None:
    with monkeypatch.context() as patch:
        patch.setattr("pyrod._path._goes_on", lambda *_: False)
        with pytest.raises(RuntimeError, match="could be followed up to a factor of 0 only"):
            critical_load(column(n=8))
    with monkeypatch.context() as patch:
        patch.setattr("pyrod._path.SMALL", 0.0)
        with pytest.raises(RuntimeError, match=r"at a factor of 2\.4\d+ the equilibria jump"):
            critical_load(column(n=8))


def test_grids_that_differ_are_told() -> None:
    """The largest factor that is tried lies between the critical ones of the two grids."""
    coarse, fine = (critical_load(column(n=n)).grid_factor for n in (4, 8))
    with pytest.raises(RuntimeError, match=r"edges there is a bif.* halved none; give rods more"):
        critical_load(column(n=4), (coarse + fine) / 2)
