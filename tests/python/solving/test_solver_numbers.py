"""A solver that changes numbers of loads and supports makes no parts and no scenes for it."""

from __future__ import annotations

import gc
import pickle
from typing import Any

import numpy as np
import pytest
from going import catheter, strut

import pyrod
from pyrod import Force, Moment, Scene, Solver


def afresh(result: pyrod.Equilibrium) -> pyrod.Equilibrium:
    return pyrod.solve(result.scene)


@pytest.mark.parametrize(
    "changes",
    [
        {"loads.0.force": (1, -2, 1)},
        {"loads.0.force": [1, -2.5, 1]},
        {"loads.0.force": np.array([1.0, -2, 1.5])},
        {"loads.0.force.0": 2},
        {"loads.0.force": (1, 2, 3), "loads.0.force.1": -1.0},
        {"supports.0.position.2": 0.2, "loads.1.moment.1": 0.1},
        {},
    ],
    ids=repr,
)
def test_the_result_belongs_to_the_changed_scene(changes: dict[str, Any]) -> None:
    solver = Solver(catheter())
    solver.solve()
    result = solver.solve(changes)
    assert result.positions == pytest.approx(afresh(result).positions, abs=1e-11)
    assert result.reaction.moment == pytest.approx(afresh(result).reaction.moment, abs=1e-9)
    assert result.scene == solver.scene


def test_the_last_value_counts_whatever_the_order_of_paths() -> None:
    solver = Solver(catheter())
    solver.solve({"loads.0.force.1": -2.2})
    solver.solve({"loads.0.force": (1, -2, 1)})
    assert solver.scene.loads[0].acting == pytest.approx((1, -2, 1))
    solver.solve({"loads.0.force.1": -2.2})
    assert solver.scene.loads[0].acting == pytest.approx((1, -2.2, 1))
    solver.solve({"loads.0.force": (1, -2, 1), "loads.0.force.2": 1.5})
    assert solver.scene.loads[0].acting == pytest.approx((1, -2, 1.5))


def test_results_keep_their_own_scenes_and_shapes() -> None:
    solver = Solver(strut())
    forces = (1.0, 1.2, 1.4, 1.1)
    results = [solver.solve({"loads.0.force.1": F}) for F in forces]
    for F, result in zip(forces, results, strict=True):
        assert result.scene.loads[0].acting[1] == F
        assert result.positions == pytest.approx(afresh(result).positions, abs=1e-9)


def test_an_array_that_changes_later_changes_nothing() -> None:
    solver, force = Solver(catheter()), np.array([1.0, -2, 1])
    result = solver.solve({"loads.0.force": force})
    force[:] = 100
    assert result.scene.loads[0].acting == pytest.approx((1, -2, 1))
    assert solver.scene.loads[0].acting == pytest.approx((1, -2, 1))


def test_results_are_pickled_and_compared_with_their_scenes() -> None:
    solver = Solver(catheter())
    result = solver.solve({"loads.0.force.0": 1.25})
    again = pickle.loads(pickle.dumps(result))
    assert again == result
    assert again.scene.loads[0].acting[0] == 1.25
    assert {"scene", "rods", "positions"} <= set(dir(result))


@pytest.mark.parametrize(
    ("changes", "error", "words"),
    [
        ({"loads.0.force.0": float("nan")}, ValueError, "finite"),
        ({"loads.0.force": (1, 2)}, ValueError, "3 numbers"),
        ({"loads.0.force.3": 1.0}, ValueError, "components are 0 to 2"),
        ({"loads.0.forces": (1, 2, 3)}, ValueError, "no entry"),
        ({"loads.0.force.0": "1"}, (TypeError, ValueError), "number"),
        ({"supports.0.position": (0, float("inf"), 0)}, ValueError, "finite"),
    ],
    ids=repr,
)
def test_what_is_refused_is_named_and_changes_nothing(
    changes: dict[str, Any], error: Any, words: str
) -> None:
    solver = Solver(catheter())
    before = solver.solve()
    with pytest.raises(error, match=words):
        solver.solve(changes)
    assert solver.scene == catheter()
    assert solver.solve().positions == pytest.approx(before.positions, abs=1e-12)


def test_loads_that_leave_the_plane_are_refused_in_words() -> None:
    solver = Solver(
        Scene(
            pyrod.Rod.straight(1, 16, pyrod.Section(1, 1, 1)),
            pyrod.Clamp(),
            Force((1, 0, 0)),
            "planar",
        )
    )
    solver.solve()
    for _ in range(2):
        with pytest.raises(ValueError, match="leaves the plane"):
            solver.solve({"loads.0.force.1": 1.0})
        assert solver.solve({"loads.0.force.0": 1.1}).converged


def test_other_parts_take_their_numbers_afterwards() -> None:
    solver = Solver(catheter())
    solver.solve({"loads.0.force.0": 1.0})
    solver.solve({"loads.0": Moment((0, 0.1, 0))})
    result = solver.solve({"loads.0.moment.1": 0.2})
    assert isinstance(result.scene.loads[0], Moment)
    with pytest.raises(ValueError, match="no entry"):
        solver.solve({"loads.0.force.0": 1.0})
    assert result.positions == pytest.approx(afresh(result).positions, abs=1e-9)


def test_a_solver_that_forgets_starts_afresh_to_the_same_bits() -> None:
    solver = Solver(strut())
    first = solver.solve({"loads.0.force.1": 1.3})
    solver.solve({"loads.0.force.1": -2.0})
    solver.forget()
    again = solver.solve({"loads.0.force.1": 1.3})
    assert again.iterations == first.iterations == afresh(first).iterations
    assert np.array_equal(again.positions, first.positions)
    assert np.array_equal(again.positions, afresh(first).positions)


def test_no_scene_is_made_unless_it_is_asked_for() -> None:
    solver = Solver(catheter())
    solver.solve()
    gc.collect()
    before = sum(isinstance(x, Scene) for x in gc.get_objects())
    results = [solver.solve({"loads.0.force.0": 1 + 0.01 * k}) for k in range(20)]
    assert all(result.tip[2] < 2 for result in results)
    assert sum(isinstance(x, Scene) for x in gc.get_objects()) == before
    assert results[3].scene.loads[0].acting[0] == 1.03


def test_ctrl_c_parts_no_result_from_its_scene(monkeypatch: pytest.MonkeyPatch) -> None:
    """Between the compiled solve and the note that Python takes of it."""

    def interrupted(*args: Any) -> None:
        raise KeyboardInterrupt

    for changes in ({"loads.0.force.0": 5.0}, {"loads.0": Force((5, 0, 0))}):
        solver = Solver(catheter())
        solver.solve()
        with monkeypatch.context() as patched:
            patched.setattr("pyrod.scene.numbers.NewNumbers.with_these", interrupted)
            patched.setattr("pyrod.scene.numbers.NewNumbers.__init__", interrupted)
            with pytest.raises(KeyboardInterrupt):
                solver.solve(changes)
        result = solver.solve({"loads.0.force.1": -2.5})
        assert result.scene.loads[0].acting[0] == 1
        assert result.positions == pytest.approx(afresh(result).positions, abs=1e-9)


def test_a_solver_that_is_solving_cannot_forget() -> None:
    solver: list[Solver] = []

    def load(s: float) -> tuple[float, float, float]:
        if solver:
            solver[0].forget()
        return (0, 1, 0)

    scene = catheter()
    along = pyrod.DistributedForce(load)
    solver.append(Solver(Scene(scene.rods, scene.supports, [*scene.loads])))
    with pytest.raises(RuntimeError, match="forget"):
        solver[0].solve(Scene(scene.rods, scene.supports, [*scene.loads, along]))


@pytest.mark.parametrize("number", [10**400, -(10**400)])
def test_numbers_beyond_all_measure_are_refused(number: int) -> None:
    with pytest.raises((ValueError, OverflowError)) as refused:
        Solver(catheter()).solve({"loads.0.force.0": number})
    with pytest.raises(type(refused.value)):
        Solver(catheter()).solve({"loads.0.force": (number, 0, 0)})
