"""The benchmarks beside other programs: their report, on rows made up here, and their cases."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[3] / "benchmarks"))

from peers import figure, report
from peers.cases import CASES
from peers.errors import aligned, errors
from peers.exact import exact
from peers.measure import Shape, grids, label, repeated, thinned
from peers.problem import matrix
from peers.run import Driver
from peers.solvers.loading import blended, end_motion


def row(solver: str, time_s: float | None, error: float | None, **more: Any) -> dict[str, Any]:
    made = {
        "case": "elastica-10",
        "solver": solver,
        "model": "cosserat",
        "setting": "n=8",
        "time_s": time_s,
        "build_s": 0.0,
        "error": error,
        "converged": error is not None,
    }
    return made | more


ROWS = [
    row("pyrod", 1e-4, 5e-4),
    row("pyrod", 2e-4, 5e-7, setting="tol=1e-6"),
    row("pyrod", 1e-6, 1e-12, model="soft"),
    row("peer", 3e-3, 9e-4),
    row("peer", 2e-3, 8e-4, setting="n=16, 4 steps"),
    row("peer", 8e-3, 1e-7, setting="n=99"),
    row("peer", 1e-9, 1e-15, converged=False),
    row("peer", 1e-9, 0.3),
    row("other", None, None, note="blew up", setting="n=4"),
    row("absent", None, None, note="not installed: no such thing", setting=""),
]


def test_time_to_error_is_that_of_the_cheapest_setting_below_the_level() -> None:
    peer = [r for r in ROWS if r["solver"] == "peer"]
    assert report.fastest(peer, 1e-3) is ROWS[4]
    assert report.fastest(peer, 1e-6) is ROWS[5]
    assert report.fastest(peer, 1e-9) is None


def test_what_failed_or_went_elsewhere_counts_for_nothing() -> None:
    assert [report.right(r) for r in ROWS] == [True] * 6 + [False] * 4


def test_ratios_are_to_pyrod_in_the_same_model() -> None:
    assert report.ratio(ROWS, ROWS[4], 1e-3) == pytest.approx(20)
    assert report.ratio(ROWS, ROWS[5], 1e-6) == pytest.approx(40)
    assert report.ratio(ROWS, ROWS[5], 1e-9) is None


def test_summary_names_the_fastest_peer_and_the_ratio() -> None:
    line = report.summary(ROWS).splitlines()[-1]
    cells = [cell.strip() for cell in line.strip("|").split("|")]
    assert cells == [
        "planar elastica, F L²/EI = 10",
        *("0.1 ms", "peer, 2 ms", "20 x"),
        *("0.2 ms", "peer, 8 ms", "40 x"),
        *("0.001 ms", "none", "-"),
    ]


def test_page_tells_of_failures_and_of_what_is_not_there() -> None:
    page = report.page(ROWS, {"peer": "its best options"}, "picture.png")
    assert "- other: n=4: blew up" in page
    assert "- absent: not installed: no such thing" in page
    assert "- peer: its best options" in page
    assert "2 ms (n=16, 4 steps), 20 x" in page
    assert "(picture.png)" in page
    assert "{cpu}" not in page


def test_tables_of_models_sizes_and_threads() -> None:
    rows = [
        row("pyrod", 1e-4, 1e-4, case="model-cost", setting="n=64"),
        row("pyrod", 1e-2, 1e-9, case="scaling", setting="n=10000"),
        row("pyrod", 4e-4, None, case="parallel", setting="1 threads", converged=True),
        row(
            "pyrod",
            2e-4,
            None,
            case="parallel",
            setting="2 threads",
            converged=True,
            note="load 0.1",
        ),
    ]
    assert "| planar | cosserat | 0.1 ms, 1.0e-04 |" in report.model_cost(rows)
    assert "| pyrod | n=10000 | 10 ms | 1000 |" in report.scaling(rows)
    assert report.parallel(rows).endswith("| 2 threads | 0.2 ms | 2 x | load 0.1 |")


def test_figure_shows_what_nothing_cheaper_beats(tmp_path: Path) -> None:
    front = figure.front([r for r in ROWS if r["solver"] == "peer"])
    assert front == [ROWS[4], ROWS[5]]
    figure.draw(ROWS, tmp_path / "figure.png")
    assert (tmp_path / "figure.png").read_bytes().startswith(b"\x89PNG")


def test_figure_without_rows(tmp_path: Path) -> None:
    figure.draw([], tmp_path / "figure.png")
    assert (tmp_path / "figure.png").exists()


def test_settings_and_samples() -> None:
    assert [label(s) for g in grids([8, 16], (1, 4)) for s in g] == [
        "n=8",
        "n=8, 4 steps",
        "n=16",
        "n=16, 4 steps",
    ]
    assert label({"tol": 1e-6, "steps": 1}) == "tol=1e-6"
    assert len(range(1025)[thinned(1024)]) == 33
    assert len(range(101)[thinned(100)]) == 101  # no step of more than one ends at the end


def test_medians_of_repeated_runs() -> None:
    times = iter([5.0, 1.0, 3.0])

    def run() -> list[Shape]:
        return [Shape(next(times), 0.0, np.zeros(1), np.zeros((1, 3)))]

    assert repeated(run, 60.0, most=3)[0].time_s == 3.0


@pytest.mark.parametrize("case", ["bend", "precurved", "clamped"])
def test_rest_shapes_are_those_of_pyrod(case: str) -> None:
    from peers.solvers.ours import scene

    problem = CASES[case].problem("cosserat")
    rod = scene(problem, "pyrod", 64).rods[0].placed(*problem.start)
    positions, frames = rod.at_rest()
    h = problem.L / 64
    centres = problem.rest((np.arange(64) + 0.5) * h)[1]  # constant curvature: exact at any n
    np.testing.assert_allclose(matrix(frames), matrix(centres), atol=1e-13, rtol=0)
    midpoint_rule = (problem.K0 @ problem.K0) * h**2 / 24 * problem.L
    np.testing.assert_allclose(
        problem.rest(rod.arc_lengths)[0], positions, atol=midpoint_rule, rtol=0
    )


def test_errors_are_relative_to_the_length_and_exact_states_between_samples() -> None:
    truth = exact("elastica-10", "cosserat")
    s = np.linspace(0, 1, 33)
    shape = {"s": s, "r": truth.y[:3].T, "more": {"energy": truth.energy * 1.01}}
    found = errors(truth, shape)
    assert found["error"] == 0
    assert found["energy_error"] == pytest.approx(0.01)
    shape["r"] = truth.y[:3].T + np.array([0, 0, 1e-3])
    assert errors(truth, shape)["error"] == pytest.approx(1e-3)
    shape["r"] = np.full((33, 3), 1e200)
    assert errors(truth, shape)["error"] is None


def test_alignment_undoes_rigid_motions() -> None:
    rng = np.random.default_rng(3)
    shape = rng.normal(size=(9, 3))
    q = rng.normal(size=4)
    moved = shape @ matrix(q / np.linalg.norm(q)).T + rng.normal(size=3)
    np.testing.assert_allclose(aligned(moved, shape), shape, atol=1e-14, rtol=0)
    mirrored = shape * np.array([1, 1, -1])
    assert np.abs(aligned(mirrored, shape) - shape).max() > 0.1


def test_ends_are_led_from_rest_to_their_place() -> None:
    problem = CASES["clamped"].problem("cosserat")
    for part, pose in ((0.0, [x[0] for x in problem.rest(np.array([1.0]))]), (1.0, problem.pose)):
        r, q = blended(problem, part).pose
        np.testing.assert_allclose(r, pose[0], atol=1e-15, rtol=0)
        np.testing.assert_allclose(matrix(q), matrix(pose[1]), atol=1e-14, rtol=0)
    motion = end_motion(problem, 64)
    np.testing.assert_allclose(
        motion[-1, :3], problem.pose[0] - problem.rest(np.array([1.0]))[0][0]
    )


class Scripted:
    """Answers like a worker: seconds by label of the setting, None for a solve that fails."""

    def __init__(self, seconds: dict[str, float | None]) -> None:
        self.seconds, self.asked = seconds, []

    def ask(self, limit: float, /, **request: Any) -> dict[str, Any]:
        name = label(request["setting"])
        self.asked.append(name)
        if self.seconds[name] is None:
            return {"failed": "it crashed"}
        truth = exact("elastica-10", "inextensible")
        made = {"s": truth.s, "r": truth.y[:3].T, "more": {}, "label": name, "iterations": 1}
        return {"rows": [made | {"time_s": self.seconds[name], "build_s": 0.0, "converged": True}]}


def driven(seconds: dict[str, float | None], sizes: list[int], tmp_path: Path) -> Any:
    driver, worker = Driver(tmp_path, 60.0, 1.0, 0.0), Scripted(seconds)
    groups = grids(sizes, (1, 2, 4, 8))
    plan = {"groups": groups, "labels": [[label(s) for s in group] for group in groups]}
    driver._model(worker, plan, case="elastica-10", name="peer", model="inextensible")
    return driver.rows, worker.asked


def test_driver_keeps_the_fastest_number_of_load_steps(tmp_path: Path) -> None:
    times = {"n=8": None, "n=8, 2 steps": 3.0, "n=8, 4 steps": 2.0, "n=8, 8 steps": 2.5}
    next_ones = {"n=16, 2 steps": None, "n=16, 4 steps": 5.0, "n=16, 8 steps": 6.0}
    rows, asked = driven(times | next_ones, [8, 16], tmp_path)
    assert [row["setting"] for row in rows] == ["n=8, 4 steps", "n=16, 4 steps"]
    assert [row["error"] for row in rows] == [0.0, 0.0]
    assert asked == [*times, *next_ones]  # the second grid is not tried with a single step


def test_driver_reports_a_failure_and_gives_up_after_two(tmp_path: Path) -> None:
    times = {label(s): None for group in grids([8, 16, 32], (1, 2, 4, 8)) for s in group}
    rows, _ = driven(times, [8, 16, 32], tmp_path)
    assert [row["setting"] for row in rows] == ["n=8, 8 steps", "n=16, 8 steps"]
    for row in rows:
        assert (row["error"], row["time_s"], row["converged"]) == (None, None, False)
        assert "it crashed" in row["note"]
