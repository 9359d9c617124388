"""A scene that is solved again and again with other numbers."""

from __future__ import annotations

import pickle
import threading
from typing import Any

import numpy as np
import pytest
from going import catheter, strut
from support import ROUND, SOFT

import pyrod
from pyrod import (
    Clamp,
    DistributedForce,
    Force,
    Hinge,
    Joint,
    Rod,
    Scene,
    Slider,
    Solver,
)
from pyrod.rotation import exp

CHANGES = [
    {"loads.0.force": (1.1, -2, 1.2)},
    {"loads.0.force.1": -2.1, "loads.1.moment.1": 0.21},
    {"supports.0.position.2": 0.1, "supports.0.frame": exp([0.02, 0.01, 0.05])},
    {"rods.0.K0": np.tile((0.5, 1.01, 0.01), (25, 1))},
    {"rods.0.bending": np.tile((1.01, 1.51, 0.71), (25, 1))},
]


@pytest.mark.parametrize("changes", CHANGES, ids=lambda c: ", ".join(c))
def test_the_shape_is_that_of_the_changed_scene(changes: dict[str, Any]) -> None:
    solver = Solver(catheter())
    solver.solve()
    again = solver.solve(changes)
    afresh = pyrod.solve(again.scene)
    assert again.scene == solver.scene != catheter()
    assert again.positions == pytest.approx(afresh.positions, abs=1e-11)
    assert again.moment == pytest.approx(afresh.moment, abs=1e-9)
    assert again.iterations < afresh.iterations


def test_changes_stay_and_add_up() -> None:
    solver = Solver(strut())
    for height in (0.9, 0.89, 0.88):
        result = solver.solve({"supports.1.position.2": height})
        assert result.tip == pytest.approx((0.1, 0, height), abs=1e-12)
    result = solver.solve({"loads.0.force": (0, 1.2, 0)})
    assert result.tip == pytest.approx((0.1, 0, 0.88), abs=1e-12)
    assert result.positions == pytest.approx(pyrod.solve(result.scene).positions, abs=1e-9)


def test_without_changes_a_step_confirms_what_was_found() -> None:
    solver = Solver(catheter())
    first = solver.solve()
    assert solver.solve().iterations <= 2
    assert np.array_equal(first.positions, pyrod.solve(catheter()).positions)


@pytest.mark.parametrize("tol", [None, 1e-7])
def test_places_may_move(tol: float | None) -> None:
    """Then the rod gets its vertices elsewhere, as in a scene that is made so."""
    solver = Solver(strut(), tol=tol)
    solver.solve()
    moved = solver.solve({"loads.0.at": 0.37, "supports.1.at": 0.93})
    ends = [Clamp((0, 0, 0), (1, 0, 0, 0)), Hinge((0.1, 0, 0.9), at=0.93)]
    other = Scene(moved.scene.rods[0], ends, Force((0, 1, 0), at=0.37))
    expected = pyrod.solve(other, tol=tol)
    assert len(moved.positions) == len(expected.positions)
    assert moved.positions == pytest.approx(expected.positions, abs=1e-8 if tol else 1e-10)


def test_another_scene_may_be_given_as_a_whole() -> None:
    solver = Solver(catheter())
    solver.solve()
    assert solver.solve(strut()).positions == pytest.approx(
        pyrod.solve(strut()).positions, abs=1e-10
    )
    assert solver.scene == strut()


def test_what_one_part_gets_it_gets_at_once() -> None:
    ends = [Clamp((0, 0, 0), (1, 0, 0, 0)), Slider((1, 0, 0), at="end")]
    solver = Solver(Scene(Rod.straight(1.0, 12, SOFT), ends, Force((0.5, 0.5, 0))))
    solver.solve()
    found = solver.solve({"supports.1.along": None, "supports.1.normal": (0, 0, 1)})
    assert found.tip == pytest.approx(pyrod.solve(found.scene).tip, abs=1e-10)
    found = solver.solve({"loads.0.force": (1, 2, 3), "loads.0.force.1": 0.1})
    assert found.scene.loads[0].force.tolist() == [1, 0.1, 3]


@pytest.mark.parametrize("tol", [None, 1e-6])
@pytest.mark.parametrize("path", ["supports.1.turns", "joints.0.turns"], ids=["clamp", "ring"])
def test_full_turns_are_put_in(path: str, tol: float | None) -> None:
    """No equation tells how many there are: the last shape would keep its own."""
    rod = Rod.straight(1.0, 24, SOFT)
    ends = [Clamp((0, 0, 0), (1, 0, 0, 0)), Clamp((0, 0, 0.9), (1, 0, 0, 0), at="end")]
    if path.startswith("joints"):
        scene = Scene(rod, Clamp(), joints=Joint(["start", "end"]))
    else:
        scene = Scene(rod, ends, Force((0.3, 0.1, 0), at=0.5))
    solver = Solver(scene, tol=tol)
    before = solver.solve()
    twisted = solver.solve({path: 1})
    assert twisted.energy == pytest.approx(pyrod.solve(twisted.scene, tol=tol).energy, rel=1e-5)
    assert twisted.energy > before.energy + 1
    assert solver.solve({path: 0}).energy == pytest.approx(before.energy, rel=1e-5)


def test_rows_belong_to_the_edges_that_the_scene_has() -> None:
    """Where the solver chooses edges, a place makes as many of them, but others."""
    loads = [Force((0, 0, 0), at=0.37), DistributedForce((0, 0, 0))]
    scene = Scene(Rod.straight(1.0, None, SOFT), Clamp(), loads)
    rows = np.zeros((scene.rods[0].edges, 3))
    rows[:6, 0] = 5
    found = Solver(scene).solve({"loads.1.force_per_length": rows})
    expected = pyrod.solve(found.scene)
    assert len(found.frames) == len(expected.frames)
    assert found.tip == pytest.approx(expected.tip, abs=1e-9)


@pytest.mark.parametrize("edges", [8, None])
def test_a_place_that_moves_on_leaves_no_vertices_behind(edges: int | None) -> None:
    ends = [Clamp((0, 0, 0), (1, 0, 0, 0)), Slider((1, 0, 0), at=0.5)]
    solver = Solver(Scene(Rod.straight(1.0, edges, SOFT), ends, Force((1, 0.5, 0))))
    for k in range(5):
        found = solver.solve({"supports.1.at": 0.5 + 0.011 * k})
    slider = Slider((1, 0, 0), at=0.544)
    afresh = Scene(Rod.straight(1.0, edges, SOFT), [ends[0], slider], Force((1, 0.5, 0)))
    assert len(found.frames) == len(pyrod.solve(afresh).frames)
    assert found.tip == pytest.approx(pyrod.solve(afresh).tip, abs=1e-7)


def test_the_space_may_change() -> None:
    rod = Rod.straight(1.0, 8, ROUND)
    flat = Scene(rod, Clamp(), Force((1, 0, 0)), "planar")
    solver = Solver(flat)
    for scene in (flat, Scene(rod, Clamp(), Force((1, 1, 0))), flat):
        assert solver.solve(scene).tip == pytest.approx(pyrod.solve(scene).tip, abs=1e-12)


@pytest.mark.parametrize("kind", ["rigid", "ball", "hinge"])
def test_networks_go_on_from_where_they_are(kind: Any) -> None:
    axis = (1, 1, 0.5) if kind == "hinge" else None
    rods = [Rod.straight(1.0, 12, SOFT), Rod.straight(0.5, 8, SOFT).placed((0, 0, 1))]
    joint = Joint([(0, "end"), (1, "start")], kind, axis=axis)
    ends = [Clamp((0, 0, 0), (1, 0, 0, 0)), Hinge((0.2, 0.1, 1.4), at=(1, "end"))]
    solver = Solver(Scene(rods, ends, Force((0.5, 0.3, 0.1), at=(0, 0.5)), joints=joint))
    first, again = solver.solve(), solver.solve()
    assert again.iterations <= 5 < first.iterations
    assert again.rods[1].positions == pytest.approx(first.rods[1].positions, abs=1e-9)


@pytest.mark.parametrize(
    "support", [Slider((0.3, 0.4, 1), at="end"), Slider((0.3, -0.4, 1), at="end")]
)
def test_a_follower_may_go_to_zero(support: Slider) -> None:
    rod = Rod.precurved(1, 8, SOFT, (0.3, 1, 0.2))
    clamp = Clamp((0.1, 0.2, 0.3), at=0.43)
    scene = Scene(rod, [clamp, support], Force((1, 1, 0), at=0.6, follower=True))
    solver = Solver(scene)
    solver.solve()
    still = solver.solve({"loads.0.force": (0, 0, 0)})
    assert still.converged
    assert pyrod.solve(still.scene).energy == pytest.approx(still.energy, abs=1e-9)


def test_pickles_and_threads() -> None:
    solver = Solver(catheter(), tol=1e-5)
    solver.solve({"loads.0.force.0": 2.0})
    again = pickle.loads(pickle.dumps(solver))
    assert again.scene == solver.scene
    assert again.solve().accuracy is not None
    tips = []
    work = [
        threading.Thread(target=lambda x=x: tips.append((x, solver.solve({"loads.0.force.0": x}))))
        for x in (1.0, 1.5, 2.0, 2.5)
    ]
    for one in work:
        one.start()
    for one in work:
        one.join()
    for x, result in tips:
        assert result.scene.loads[0].force[0] == x
        expected = pyrod.solve(result.scene, tol=1e-5)
        assert result.positions == pytest.approx(expected.positions, abs=1e-6)


def test_it_says_what_it_solves() -> None:
    assert repr(Solver(strut())).startswith("Solver(Scene(Rod(")
    with pytest.raises(TypeError, match="Scene"):
        Solver("cable.toml")  # type: ignore[arg-type]
