"""Changes that are refused, or fail, and what a solver has afterwards."""

from __future__ import annotations

import re
from typing import Any

import numpy as np
import pytest
from going import catheter
from support import ROUND, SOFT

import pyrod
from pyrod import (
    Clamp,
    DistributedForce,
    Force,
    NotConverged,
    Options,
    Rod,
    Scene,
    Slider,
    Solver,
)

REFUSED = {
    "loads.2.force": "'loads.2.force': is no entry; of loads there are 0, 1",
    "load.0": "'load.0': is no entry; a scene has rods, supports, joints, loads",
    "loads": "'loads': is no entry; of loads there are 0, 1",
    "joints.0.turns": "'joints.0.turns': is no entry; of joints there are none",
    "loads.0.forces": "'loads.0.forces': is no entry; a Force has force, at, follower",
    "loads.0.force.3": "'loads.0.force.3': is no entry; its components are 0 to 2",
    "loads.0.force.0.0": "'loads.0.force.0.0': is no entry; a Force has force, at, follower",
    "loads.0.at.0": "'loads.0.at.0': has no components; give it as a whole",
    "loads.0.force": "force: expected 3 numbers, got shape (4,)",
    "loads.0": "loads: ",
}


@pytest.mark.parametrize("path", REFUSED)
def test_what_is_no_entry_is_refused_and_nothing_has_changed(path: str) -> None:
    solver = Solver(catheter())
    before = solver.solve()
    with pytest.raises((ValueError, TypeError), match=re.escape(REFUSED[path])):
        solver.solve({"supports.0.position": (0, 0, 1), path: (1, 2, 3, 4)})
    assert solver.scene == catheter()
    assert np.abs(solver.solve().positions - before.positions).max() < 1e-12


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ("loads.0", "expected new values by their paths, or a Scene, got 'loads.0'"),
        (np.zeros(3), "expected new values by their paths, or a Scene"),
        ({3: 1.0}, "paths are strings, got 3"),
        ({"loads.0.": 1.0}, "'loads.0.': is no entry"),
        ({"loads.0": 5}, "loads: "),
        ({"loads.0.force.0": "x"}, "'?loads.0.force.0"),
    ],
    ids=str,
)
def test_what_are_no_changes_is_said(changes: Any, words: str) -> None:
    with pytest.raises((ValueError, TypeError), match=words):
        Solver(catheter()).solve(changes)


def test_what_would_not_change_is_said() -> None:
    """A slider whose frame is given holds it."""
    slider = Slider((0, 0, 1), frame=(1, 0, 0, 0), at="end")
    solver = Solver(Scene(Rod.straight(1.0, 8, SOFT), [Clamp(), slider], Force((1, 0, 0), at=0.5)))
    with pytest.raises(ValueError, match="clamped: stays True"):
        solver.solve({"supports.1.clamped": False})
    assert solver.solve({"supports.1.clamped": False, "supports.1.frame": None}).converged


def test_what_is_thrown_meanwhile_changes_nothing() -> None:
    calls = 0

    def across(s: float) -> tuple[float, float, float]:
        nonlocal calls
        calls += 1
        if calls == 13:
            raise RuntimeError("no more")
        return (0.0, s, 0.0)

    rod = Rod.precurved(1.0, 8, SOFT, (0.5, 1, 0))
    scene = Scene(rod, Clamp(), [Force((1, 0, 0)), DistributedForce((0, 0, 0))])
    solver = Solver(scene, tol=1e-6)
    solver.solve()
    with pytest.raises(RuntimeError, match="no more"):
        solver.solve({"loads.0.force.0": 3.0, "loads.1.force_per_length": across})
    after = solver.solve({"loads.1.force_per_length": (0, 0.1, 0)})
    assert after.scene.loads[0].force[0] == 1.0
    assert after.tip == pytest.approx(pyrod.solve(after.scene, tol=1e-6).tip, abs=1e-5)


def test_it_is_not_asked_while_it_solves() -> None:
    solvers: list[Solver] = []

    def across(s: float) -> tuple[float, float, float]:
        return (solvers[0].solve().energy if solvers else 0.0, 0.0, 0.0)

    scene = Scene(Rod.straight(1.0, 8, SOFT), Clamp(), DistributedForce(across))
    solvers.append(Solver(scene))
    with pytest.raises(RuntimeError, match="solving already"):
        solvers[0].solve()


def test_what_the_compiled_solver_refuses_changes_nothing_either() -> None:
    flat = Scene(Rod.straight(1.0, 8, ROUND), Clamp(), Force((1, 0, 0)), "planar")
    solver = Solver(flat)
    with pytest.raises(ValueError, match="plane"):
        solver.solve({"loads.0.force.1": 1.0})
    assert solver.solve().tip == pytest.approx(pyrod.solve(flat).tip, abs=1e-13)


def test_what_does_not_converge_is_told() -> None:
    solver = Solver(catheter(), Options(max_iterations=1))
    with pytest.raises(NotConverged):
        solver.solve()
    assert not Solver(catheter(), Options(max_iterations=1), strict=False).solve().converged


def test_a_start_that_leads_nowhere_is_forgotten() -> None:
    """From the last shape few iterations do not do; from the shape at rest they do."""
    options = Options(max_iterations=12)
    slender = Scene(Rod.straight(1.0, 24, ROUND), Clamp(), Force((0, 0, 0)))
    solver = Solver(slender, options)
    solver.solve({"loads.0.force": (300, 0, 0)})
    away = solver.solve({"loads.0.force": (-300, 0, -300)})
    assert away.converged
