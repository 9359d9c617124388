"""Paths: families of all kinds, and what branches tell."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from frames_that_snap import DOWN, arch, column
from loaded_bows import bow
from support import FLAT, X, Y, Z, angle_between

import pyrod
from pyrod import Clamp, Force, Hinge, Moment, Rod, Scene, Section, Slider, Spring, follow, solve
from pyrod.scene.changes import changed

SOFT = Section(EI1=1.0, EI2=1.3, GJ=0.8, GA1=60.0, GA2=80.0, EA=150.0)


# Families -----------------------------------------------------------------------------------------

FAMILIES = {
    "dead force": (bow(), "loads.0.force", X),
    "in space": (bow("spatial", SOFT), "loads.0.force", 0.3 * X + Y),
    "one component": (bow("spatial", SOFT), "loads.0.force.1", -2.0),
    "moved support": (bow("spatial", SOFT), "supports.1.position", (0.2, 0.1, -0.2)),
    "moved in the plane": (bow(), "supports.1.position.0", -0.6),
    "follower": (
        Scene(Rod.straight(1.0, 24, SOFT), Clamp(), Force((0.2, 0.1, 0), follower=True)),
        "loads.0.force",
        (1.0, 0.0, -1.0),
    ),
    "moment": (
        Scene(Rod.straight(1.0, 24, FLAT), Clamp(), Moment((0, 0.1, 0), at=0.4), "planar"),
        "loads.0.moment",
        3 * Y,
    ),
    "moment in space": (
        Scene(Rod.straight(1.0, 24, SOFT), Clamp(), Moment((0, 0.1, 0), at=0.4)),
        "loads.0.moment",
        (0.5, 1.0, 0.7),
    ),
    "sliding": (
        Scene(
            Rod.straight(1.0, 24, SOFT),
            [Clamp(), Slider(Z, position=(0.2, 0, 0.8), at="end")],
            Force((0, 0.1, -0.3)),
            "spatial",
        ),
        "supports.1.position",
        (0.1, 0.2, 0.4),
    ),
}


@pytest.mark.parametrize("name", FAMILIES)
def test_what_is_named_is_what_a_function_makes(name: str) -> None:
    """And each point is what a solve finds there."""
    scene, path, direction = FAMILIES[name]
    named = follow((scene, path, direction), 0.0, 1.0)
    kind, number, entry, *component = path.split(".")

    def made(value: float) -> Scene:
        vector = np.array(getattr(getattr(scene, kind)[int(number)], entry), dtype=float)
        if component:
            vector[int(component[0])] += value * direction
        else:
            vector = vector + value * np.asarray(direction)
        return changed(scene, {f"{kind}.{number}.{entry}": vector})[0]

    function = follow(made, 0.0, 1.0)
    assert named.ended == function.ended == "reached"
    assert named.values == pytest.approx(function.values, abs=1e-9)
    assert list(named.indices) == list(function.indices)
    for k in (0, len(named) // 2, len(named) - 1):
        a, b = named.points[k].equilibrium, function.points[k].equilibrium
        assert np.abs(a.positions - b.positions).max() < 1e-9
        assert angle_between(a.frames, b.frames).max() < 1e-9
        again = solve(made(named.values[k]), start=a, stable=False)
        assert np.abs(a.positions - again.positions).max() < 1e-10
        for one, other in zip(a.reactions, again.reactions, strict=True):
            assert one.force == pytest.approx(other.force, abs=1e-7)
            assert one.moment == pytest.approx(other.moment, abs=1e-7)
        assert a.index == again.index
        assert max(a.balance) < 1e-9


def test_supports_turn_and_springs_move_by_functions() -> None:
    scene = Scene(
        Rod.straight(1.0, 16, SOFT), [Clamp(frame=(1, 0, 0, 0)), Hinge((0, 0.1, 0.9), at="end")]
    )
    turned = follow((scene, "supports.0.frame", (0, 0.4, 0.2)), 0.0, 1.0)
    assert turned.ended == "reached"
    frame = pyrod.rotation.exp(np.array([0, 0.4, 0.2]))
    last = turned.points[-1].equilibrium
    assert angle_between(last.vertex_frames[0], frame) < 1e-12
    again = solve(last.scene, start=last, stable=False)
    assert np.abs(again.positions - last.positions).max() < 1e-10
    spring = Scene(
        Rod.straight(1.0, 16, SOFT), [Clamp(), Spring(20.0, position=(0, 0, 1), at="end")]
    )
    drawn = follow((spring, "supports.1.position", (0.4, 0.2, -0.3)), 0.0, 1.0)
    again = solve(drawn.points[-1].equilibrium.scene)
    assert np.abs(again.positions - drawn.points[-1].equilibrium.positions).max() < 1e-9


# What branches tell -------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def snap() -> pyrod.Branch:
    return follow((arch(32), "loads.0.force", DOWN["arch"]), 0.0, 12.0)


def test_points_are_equilibria_and_near_each_other(snap: pyrod.Branch) -> None:
    assert (snap.values[0], snap.values[-1]) == (0.0, 12.0)
    for point in snap.points[1::5]:
        result = point.equilibrium
        assert max(result.balance) < 1e-10
        assert result.scene.loads[0].force == pytest.approx(point.value * X, abs=1e-12)
        assert result.index == point.index == snap.indices[snap.points.index(point)]
        assert point.stable == (point.index == 0)
        eigenvalue = point.lowest_eigenvalue
        assert eigenvalue is not None
        assert (eigenvalue < 0) == (point.index > 0)
        assert point.with_mode.mode is not None
    for a, b in zip(snap.points, snap.points[1:], strict=False):
        assert angle_between(a.equilibrium.frames, b.equilibrium.frames).max() < 0.7


def test_special_points_are_equilibria_without_stiffness(snap: pyrod.Branch) -> None:
    for point in snap.special:
        result = point.equilibrium
        assert max(result.balance) < 1e-9
        assert result.mode == pytest.approx(point.mode)
        assert np.abs(point.mode).max() == pytest.approx(1.0)
        a, b = snap.points[point.behind - 1], snap.points[point.behind]
        assert (a.index, b.index) == (point.index_before, point.index_behind)
        # along the mode the energy does not change to second order
        near = solve(result.scene, start=result, stable=False, strict=False, eigenvalue=True)
        assert near.lowest_eigenvalue == pytest.approx(0.0, abs=1e-5)
        assert not point.branches
        with pytest.raises(ValueError, match="no single branch crosses at a fold"):
            point.switch()


def test_the_derivative_of_the_load_is_that_of_linear_response(snap: pyrod.Branch) -> None:
    k = 3
    slope = pyrod.linearised(snap.points[k].equilibrium).jvp({"loads.0.force": X})["tip_frame"]
    near = follow((arch(32), "loads.0.force", X), snap.values[k], snap.values[k] + 1e-4)
    frames = [point.equilibrium.vertex_frames[-1] for point in (near.points[0], near.points[-1])]
    turn = pyrod.rotation.multiply(pyrod.rotation.conjugate(frames[0]), frames[1])
    assert 2 * turn[2] / 1e-4 == pytest.approx(slope[1], rel=1e-3)


def test_columns_and_tables(snap: pyrod.Branch) -> None:
    assert snap["value"] is snap.values
    assert snap["loads.0.force"] is snap.values
    assert snap["index"] is snap.indices
    assert snap["tip.0"][3] == snap.points[3].equilibrium.tip[0]
    assert snap["reactions.0.force"].shape == (len(snap), 3)
    table = snap.to_pandas()
    assert list(table.columns) == ["loads.0.force", "index", "tip.0", "tip.1", "tip.2", "energy"]
    assert len(table) == len(snap)
    assert list(snap.to_pandas(["energy"]).columns) == ["loads.0.force", "index", "energy"]
    with pytest.raises(ValueError, match="is no quantity of an equilibrium"):
        snap["tips"]
    told = repr(snap)
    assert told.startswith(f"Branch({len(snap)} points, loads.0.force 0 to 12, fold at 8.8")
    assert repr(snap.points[0]) == "BranchPoint(loads.0.force 0, index 0)"
    assert repr(snap.special[0]).startswith("SpecialPoint(fold at 8.8")


def test_a_picture_is_solid_where_it_is_stable(snap: pyrod.Branch) -> None:
    pytest.importorskip("matplotlib")
    ax = snap.plot("λ", "positions.16.0")
    styles = [line.get_linestyle() for line in ax.lines if len(line.get_xdata()) > 1]
    assert styles == ["-", "--", "-"]
    drawn = np.concatenate([line.get_xdata() for line in ax.lines if len(line.get_xdata()) > 1])
    assert set(drawn) == set(snap.values)
    assert [text.get_text() for text in ax.texts] == ["fold", "fold"]
    assert ax.get_xlabel() == "loads.0.force"


# Branches -----------------------------------------------------------------------------------------


def test_an_imperfect_column_bends_without_a_bifurcation() -> None:
    """However little imperfect: no branch is left for another."""
    for part in (1e-2, 1e-4):
        scene = column(24)
        loads = [Force((0, 0, 0)), Force(part * X, at=0.5)]
        branch = follow((replace(scene, loads=loads), "loads.0.force", -Z), 0.0, 20.0)
        assert branch.ended == "reached"
        assert branch.special == ()
        assert set(branch.indices) == {0}
        assert np.all(branch["positions.12.0"] > 0)
        assert branch["positions.12.0"][-1] > 0.3


def test_both_sides_mirror_each_other() -> None:
    trivial = follow((column(16), "loads.0.force", -Z), 0.0, 20.0)
    (point,) = trivial.special
    plus, minus = point.switch(1), point.switch(-1)
    assert plus.values == pytest.approx(minus.values, abs=1e-9)
    assert plus["positions"][:, :, 0] == pytest.approx(-minus["positions"][:, :, 0], abs=1e-8)
    turned = plus.points[0].equilibrium.frames[:, 2] * point.mode[:, 1]
    assert (turned >= -1e-12).all()
    shorter = point.switch(1, stop=12.0)
    assert (shorter.ended, shorter.values[-1]) == ("reached", 12.0)
    assert len(point.switch(1, max_points=3)) == 3


def test_a_round_column_buckles_in_all_directions_at_once() -> None:
    round_one = Section(EI1=1.0, EI2=1.0, GJ=1.0)
    scene = Scene(Rod.straight(1.0, 16, round_one), Clamp(), Force((0, 0, 0)))
    branch = follow((scene, "loads.0.force", -Z), 0.0, 5.0)
    (point,) = branch.special
    assert (point.kind, point.index_before, point.index_behind) == ("double", 0, 2)
    assert abs(point.value - (32 * np.sin(np.pi / 64)) ** 2) <= point.error < 1e-4
    with pytest.raises(ValueError, match="no single branch crosses at a double"):
        point.switch()


def test_followers_have_no_index_and_folds_all_the_same() -> None:
    rod = Rod.precurved(2.0, 32, FLAT, Y)
    scene = Scene(
        rod, [Clamp(), Hinge(at="end")], Force((0, 0, 0), at=1.0, follower=True), "planar"
    )
    branch = follow((scene, "loads.0.force", (-1.0, 0, 0)), 0.0, 60.0)
    assert set(branch.indices) == {-1}
    assert branch.points[0].stable is None
    assert branch.points[0].lowest_eigenvalue is None
    turns = np.flatnonzero(np.diff(np.sign(np.diff(branch.values))))
    assert len(branch.special) == len(turns)
    for point in branch.special:
        assert point.kind == "fold"
