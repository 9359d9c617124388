"""Paths: families of all kinds, what branches tell, how they end, and what is refused."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from frames_that_snap import DEEP, DOWN, arch, column
from support import FLAT, X, Y, Z, angle_between

import pyrod
from pyrod import Clamp, Force, Hinge, Moment, Rod, Scene, Section, Slider, Spring, follow, solve
from pyrod.scene.changes import changed

SOFT = Section(EI1=1.0, EI2=1.3, GJ=0.8, GA1=60.0, GA2=80.0, EA=150.0)


def with_force(scene: Scene, force: Any) -> Scene:
    (load,) = scene.loads
    return replace(scene, loads=(replace(load, force=np.asarray(force)),))


def bow(space: str = "planar", section: Section = FLAT) -> Scene:
    """Clamped at one end, its other end held aside; a force in between."""
    rod = Rod.straight(1.0, 24, section)
    ends = [Clamp(), Hinge((0.3, 0, 0.7), at="end")]
    return Scene(rod, ends, [Force((0, 0, -1.0), at=0.5)], space)


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


# Ends, and refusals -------------------------------------------------------------------------------


def test_special_values_to_a_tolerance() -> None:
    branch = follow((arch(16), "loads.0.force", X), 0.0, 12.0, tol=1e-9)
    fold, _ = branch.special
    assert abs(fold.value - 8.97308996972) < 2e-9
    assert abs(fold.value - 8.97308996972) <= fold.error + 1e-11
    assert fold.error < 1e-8
    assert fold.grid_value != fold.value
    assert max(fold.equilibrium.balance) < 1e-9


def test_progress_is_told_and_may_raise() -> None:
    def stop(points: int, most: int) -> None:
        raise RuntimeError(f"{points} of {most}")

    def slow(value: float) -> Scene:
        __import__("time").sleep(0.03)
        return with_force(arch(16), value * X)

    with pytest.raises(RuntimeError, match="of 9"):
        follow(slow, 0.0, 12.0, max_points=9, progress=stop)


def test_ctrl_c_keeps_what_was_found() -> None:
    import _thread

    count = 0

    def family(value: float) -> Scene:
        nonlocal count
        count += 1
        if count == 40:
            _thread.interrupt_main()
        __import__("time").sleep(0.001)
        return with_force(arch(16), value * X)

    branch = follow(family, 0.0, 12.0)
    assert branch.ended == "interrupted"
    assert len(branch) >= 1
    assert repr(branch).endswith(", interrupted)")


def test_scenes_that_are_refused_end_a_path_with_a_reason() -> None:
    def family(x: float) -> Scene:
        if x > 5:
            raise ValueError("more than the machine can do")
        return with_force(arch(16), x * X)

    branch = follow(family, 0.0, 12.0)
    assert branch.ended == "lost"
    assert branch.values[-1] == pytest.approx(5.0, abs=0.02)  # slopes look so far ahead
    assert branch.reason == "more than the machine can do"
    assert repr(branch).endswith(", lost: more than the machine can do)")


def test_what_is_no_family_is_refused() -> None:
    scene = bow()
    for family, words in (
        ((scene, "loads.0.force", (0, 0, 0)), "direction: is zero"),
        ((scene, "loads.0.force", (1, 0)), "direction: expected shape"),
        ((scene, "loads.3.force", X), "is no entry"),
        ((scene, "loads.0.forces", X), "is no entry"),
        ((scene, "loads.0.force.3", 1.0), "is no entry"),
        ((scene, "supports.0.position", X), "is not told"),
    ):
        with pytest.raises(ValueError, match=words):
            follow(family, 0.0, 1.0)
    with pytest.raises(TypeError, match="family: expected"):
        follow(scene, 0.0, 1.0)
    with pytest.raises(ValueError, match="stop: must be finite and differ"):
        follow((scene, "loads.0.force", X), 1.0, 1.0)

    with pytest.raises(ValueError, match="must have the same rods"):
        follow(lambda x: Scene(Rod.straight(1.0, 24 if x == 0 else 25, FLAT), Clamp()), 0.0, 1.0)


def test_a_start_may_be_given() -> None:
    """The unstable equilibrium of a column beyond its load."""
    scene = with_force(column(16), 12 * -Z)
    straight = solve(scene, stable=False)
    assert straight.index == 1
    branch = follow((scene, "loads.0.force", -Z), 0.0, 8.0, equilibrium=straight)
    assert set(branch.indices) == {1}
    stable = follow((scene, "loads.0.force", -Z), 0.0, 8.0)
    assert set(stable.indices) == {0}
    with pytest.raises(ValueError, match="start"):
        follow((column(20), "loads.0.force", -Z), 0.0, 8.0, equilibrium=straight)


def test_a_diagram_has_all_branches_once() -> None:
    found = pyrod.diagram((column(16), "loads.0.force", -Z), 0.0, 45.0)
    assert len(found) == 5  # straight, and two sides of two modes
    assert len(pyrod.diagram((column(16), "loads.0.force", -Z), 0.0, 20.0, depth=3)) == 3
    assert repr(found).startswith("Diagram(5 branches:\n  Branch(")
    assert [set(branch.indices[:3]) for branch in found.branches[1:]] == [{0}, {0}, {1}, {1}]


def test_the_gradient_of_a_fold_is_that_of_its_value() -> None:
    """Against differences of folds; and stiffer rods snap at loads that are as much larger."""
    scene = replace(arch(16), loads=[Force((0, 0, 0), at=DEEP / 2), Force((0.1, 0, 0.2), at=1.0)])

    def fold(changed_scene: Scene) -> pyrod.SpecialPoint:
        return follow((changed_scene, "loads.0.force", X), 0.0, 9.2).special[0]

    point = fold(scene)
    paths = ["loads.1.force", "supports.1.position.2", "rods.0.bending", "rods.0.K0"]
    scene = changed(scene, {"supports.1.position": point.equilibrium.tip})[0]
    point = fold(scene)
    found = point.gradient(paths)
    for path, change in (
        ("loads.1.force", 1e-3 * X),
        ("supports.1.position", 1e-4 * Z),
        ("rods.0.K0", 1e-3 * np.ones((17, 1)) * Y),
        ("rods.0.bending", 1e-3 * np.linspace(0, 1, 17)[:, None] * Y),
    ):
        kind, number, entry = path.split(".")
        old = getattr(getattr(scene, kind)[int(number)], entry)
        more, less = (fold(changed(scene, {path: old + s * change})[0]).value for s in (1, -1))
        gradient = found[path] if path in found else found[f"{path}.2"] * Z
        assert (more - less) / 2 == pytest.approx(float(np.nansum(gradient * change)), rel=1e-4)
    in_plane = found["rods.0.bending"][:, 1] * scene.rods[0].bending[:, 1]
    homogeneous = in_plane.sum() + np.nansum(found["loads.1.force"] * scene.loads[1].force)
    assert homogeneous == pytest.approx(point.value, rel=1e-9)
    trivial = follow((column(8), "loads.0.force", -Z), 0.0, 12.0)
    with pytest.raises(ValueError, match="derivative: of folds"):
        trivial.special[0].gradient("rods.0.bending")


def test_a_round_rod_between_clamps_on_one_axis_may_turn_about_it() -> None:
    """All along the path it is neutral, and no bifurcation; it does what it does in a plane."""
    round_one = Section(EI1=1.0, EI2=1.0, GJ=0.7)

    def bow_between(space: str) -> Scene:
        rod = Rod.straight(1.0, 24, round_one)
        return Scene(rod, [Clamp(), Clamp((0, 0, 0.9), at="end")], (), space)

    start = solve(bow_between("spatial"))
    assert (start.index, start.neutral) == (0, True)
    entry = "supports.1.position", (0, 0, -1.0)
    inside = follow((bow_between("spatial"), *entry), 0.0, 0.4, equilibrium=start)
    plane = follow((bow_between("planar"), *entry), 0.0, 0.4)
    assert inside.ended == plane.ended == "reached"
    assert inside.special == plane.special == ()
    assert set(inside.indices) == {0}
    for point in inside.points[1::3]:
        there = follow((bow_between("planar"), *entry), 0.0, point.value).points[-1]
        assert point.equilibrium.energy == pytest.approx(there.equilibrium.energy, rel=1e-9)
        assert point.equilibrium.reactions[1].force[2] == pytest.approx(
            there.equilibrium.reactions[1].force[2], rel=1e-8
        )
