"""Critical loads of columns and strips against closed forms and the reference data."""

from __future__ import annotations

import pickle
import re
from typing import Any

import numpy as np
import pytest
from support import COLUMNS, EULER, FLAT, SPACES, X, Y, Z, table, within

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
)
from pyrod.stability.path import Path


def column(ends: str = "clamped-free", n: int | None = 32, **more: Any) -> Scene:
    """Under a dead force 1 at its end."""
    return Scene(Rod.straight(1.0, n, FLAT), COLUMNS[ends], Force(-Z), **more)


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
    """The third does: they end at 1/16, 1.5/16, 2.25/16 of the load of a hinged column."""
    n, end = 16, 2.25 / 16 * np.pi**2
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
        r"Critical\(bifurcation, factor 2\.46740\d+ ± \d?e-0[89], then index 1\)", repr(found)
    )
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
        patch.setattr("pyrod.stability.path._goes_on", lambda *_: False)
        with pytest.raises(RuntimeError, match="could be followed up to a factor of 0 only"):
            critical_load(column(n=8))
    with monkeypatch.context() as patch:
        patch.setattr("pyrod.stability.path.SMALL", 0.0)
        with pytest.raises(RuntimeError, match=r"at a factor of 2\.4\d+ the equilibria jump"):
            critical_load(column(n=8))


def test_the_largest_factor_may_lie_between_those_of_the_grids() -> None:
    coarse, fine = (critical_load(column(n=n)).grid_factor for n in (4, 8))
    found = critical_load(column(n=4), (coarse + fine) / 2)
    assert (found.kind, found.grid_factor) == ("bifurcation", pytest.approx(coarse, rel=1e-7))
    within(found, EULER["clamped-free"], 1e-4)


def test_grids_that_differ_are_told(monkeypatch: pytest.MonkeyPatch) -> None:
    loss = Path.loss

    def other_on_eight(path: Path, *more: Any) -> Any:
        found = loss(path, *more)
        return found._replace(kind="limit point") if path.edges == 8 else found

    monkeypatch.setattr(Path, "loss", other_on_eight)
    told = "bifurcation at a factor of 2.4.*; limit point at .*; bifurcation at .*; give rods more"
    with pytest.raises(RuntimeError, match=told):
        critical_load(column(n=4))
