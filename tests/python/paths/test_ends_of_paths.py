"""Paths: to a tolerance, how they end, what is refused, diagrams and gradients."""

from __future__ import annotations

import _thread
from dataclasses import replace
from time import sleep

import numpy as np
import pytest
from frames_that_snap import DEEP, arch, column
from interrupt import needs_ctrl_c
from loaded_bows import bow, with_force
from support import FLAT, X, Y, Z

import pyrod
from pyrod import Clamp, Force, Rod, Scene, Section, Tendon, follow, solve
from pyrod.scene.changes import changed

# Ends, and refusals -------------------------------------------------------------------------------


def test_special_values_to_a_tolerance() -> None:
    branch = follow((arch(16), "loads.0.force", X), 0.0, 12.0, tol=1e-9)
    fold, _ = branch.special
    assert abs(fold.value - 8.97308996972) < 2e-9
    assert abs(fold.value - 8.97308996972) <= fold.error + 1e-11
    assert fold.error < 1e-8
    assert fold.grid_value != fold.value
    held = sum(reaction.force for reaction in fold.equilibrium.reactions)
    assert held + fold.equilibrium.scene.loads[0].force == pytest.approx(0 * X, abs=1e-8)


def test_a_special_value_that_is_zero_has_an_error() -> None:
    """It is relative to the range: counted from Euler's load on each grid."""
    edges = 8

    def family(x: float) -> Scene:
        return with_force(column(edges), (-(np.pi**2) - x) * Z)

    (point,) = follow(family, -2.0, 2.0, tol=1e-7).special
    assert abs(point.value) <= point.error + 1e-12
    assert 0 < point.error <= 4e-10


def test_tensions_may_change_but_tendons_must_not_become_slack() -> None:
    rod = Rod.straight(1.0, 12, Section(1, 1, 0.8))
    pulled = Scene(rod, Clamp(), Force((0, 0, -1.0)), "planar", actuators=Tendon((0.05, 0), 1.0))
    branch = follow((pulled, "actuators.0.tension", 1.0), 0.0, 4.0)
    again = solve(changed(pulled, {"actuators.0.tension": 5.0})[0])
    assert np.abs(branch.points[-1].equilibrium.positions - again.positions).max() < 1e-13
    assert branch["tendons.0.tension"][[0, -1]] == pytest.approx([1.0, 5.0])
    held = replace(pulled, actuators=Tendon((0.05, 0), length=1.0))
    with pytest.raises(ValueError, match="may become slack"):
        follow((held, "loads.0.force", X), 0.0, 1.0)


def test_progress_is_told_and_may_raise() -> None:
    def stop(points: int, most: int) -> None:
        raise RuntimeError(f"{points} of {most}")

    def slow(value: float) -> Scene:
        __import__("time").sleep(0.03)
        return with_force(arch(16), value * X)

    with pytest.raises(RuntimeError, match="of 9"):
        follow(slow, 0.0, 12.0, max_points=9, progress=stop)


@needs_ctrl_c
def test_ctrl_c_keeps_what_was_found() -> None:
    count = 0

    def family(value: float) -> Scene:
        nonlocal count
        count += 1
        if count == 40:
            _thread.interrupt_main()
        sleep(0.001)
        return with_force(arch(16), value * X)

    branch = follow(family, 0.0, 12.0)
    assert branch.ended == "interrupted"
    assert len(branch) >= 1
    assert repr(branch).endswith(", interrupted)")


@needs_ctrl_c
def test_ctrl_c_keeps_the_branches_of_a_diagram() -> None:
    scenes = column(16)
    count, last = 0, 10**9

    def family(value: float) -> Scene:
        nonlocal count
        count += 1
        if count == last:
            _thread.interrupt_main()
        sleep(0.0001)
        return with_force(scenes, -value * Z)

    whole = pyrod.diagram(family, 0.0, 45.0)
    calls, count = count, 0
    last = calls // 2
    some = pyrod.diagram(family, 0.0, 45.0)
    assert 1 < len(some) < len(whole)
    *ended, broken = some.branches
    assert broken.ended == "interrupted"
    for one, same in zip(ended, whole.branches, strict=False):
        np.testing.assert_array_equal(one.values, same.values)


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
    quarters = [branch.points[3].equilibrium.positions[4, 0] for branch in found.branches[1:]]
    assert quarters[0] == pytest.approx(-quarters[1], rel=1e-8)  # to either side
    assert quarters[2] == pytest.approx(-quarters[3], rel=1e-8)


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
