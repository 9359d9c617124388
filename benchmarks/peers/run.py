"""Runs pyrod and its peers on the same cases, and writes the report.

Usage, from benchmarks: python -m peers.run [--cases A,B] [--solvers A,B] [--quick] [--docs]
"""

from __future__ import annotations

import argparse
import json
import time
from pathlib import Path
from typing import Any

from peers import figure, parallel, report
from peers.cases import CASES
from peers.client import Worker
from peers.errors import errors
from peers.exact import exact
from peers.venvs import PEERS, python

Row = dict[str, Any]
ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"

COMPILING = 300
"""Seconds for the first answer: some compile when they are imported for the first time."""


class Driver:
    """Rows of one run. `seconds` of the processor for a solver, a case and a model;
    `limit` for one answer, wall clock."""

    def __init__(self, out: Path, seconds: float, limit: float, repeats: float) -> None:
        self.rows: list[Row] = []
        self.about: dict[str, str] = {}
        self._spent = 0.0
        self._out, self._seconds, self._limit, self._repeats = out, seconds, limit, repeats

    def run(self, case: str, name: str) -> None:
        peer, found = PEERS[name], python(name, self._out / "venvs")
        if isinstance(found, str) or peer.module is None:
            why = found if isinstance(found, str) else "installed, but there is no module for it"
            self._fail(case, name, why)
            return
        with Worker(found, peer.module, self._out) as worker:
            about = worker.ask(COMPILING, do="about")
            if "failed" in about:
                self._fail(case, name, about["failed"])
                return
            for solver in about["names"]:
                self.about[solver] = about["about"]
                self._solver(worker, case, solver)

    def _solver(self, worker: Worker, case: str, solver: str) -> None:
        plan = worker.ask(self._limit, do="plan", case=case, name=solver)
        why = plan.get("cannot") or plan.get("failed")
        if why:
            self._fail(case, solver, why)
            return
        for model in plan["models"]:
            before = len(self.rows)
            self._model(worker, plan, case=case, name=solver, model=model)
            self._say(case, solver, model, self.rows[before:])

    def _model(self, worker: Worker, plan: dict[str, Any], **what: str) -> None:
        exact(what["case"], what["model"])  # made once, and not in the time of the first solver
        first, failures = 0, 0
        self._spent = 0.0
        for group, labels in zip(plan["groups"], plan["labels"], strict=True):
            if self._spent > self._seconds or failures == 2:
                break
            best, rows, why = self._best(worker, group[first:], what)
            if best is None:
                failures += 1
                tried = f"{why}, and so with the settings before" if len(group) > 1 else why
                self._fail(what["case"], what["name"], tried, what["model"], labels[-1])
            else:
                first += max(best - 1, 0)
                failures = 0
                self.rows += rows

    def _best(
        self, worker: Worker, group: list[Any], what: dict[str, str]
    ) -> tuple[int | None, list[Row], str]:
        """The fastest of a group: the first that works, and those after it while they gain."""
        best, kept, why = None, [], "no time left"
        for i, setting in enumerate(group):
            if i and self._spent > self._seconds:
                break
            rows, said = self._solve(worker, setting, 0.0, what)
            good = bool(rows) and report.right(rows[-1])
            if good and (best is None or rows[-1]["time_s"] < kept[-1]["time_s"]):
                best, kept = i, rows
            elif best is not None:
                break
            else:
                why = said or ("another shape" if rows and rows[-1]["converged"] else "diverges")
        if best is not None and kept[-1]["time_s"] < self._repeats:
            again, _ = self._solve(worker, group[best], self._repeats, what)
            kept = again or kept
        return best, kept, why

    def _solve(
        self, worker: Worker, setting: Any, repeats: float, what: dict[str, str]
    ) -> tuple[list[Row], str]:
        answer = worker.ask(self._limit, do="solve", setting=setting, seconds=repeats, **what)
        self._spent += answer.get("spent_s", self._limit if "failed" in answer else 0.0)
        if "rows" not in answer:
            return [], answer.get("failed") or answer.get("cannot", "")
        truth = exact(what["case"], what["model"])
        return [
            {
                "case": what["case"],
                "solver": what["name"],
                "model": what["model"],
                "setting": row["label"],
                "time_s": row["time_s"],
                "build_s": row["build_s"],
                "converged": row["converged"],
                "iterations": row["iterations"],
                **errors(truth, row),
            }
            for row in answer["rows"]
        ], ""

    def _fail(
        self, case: str, solver: str, why: str, model: str | None = None, setting: str = ""
    ) -> None:
        row = {"case": case, "solver": solver, "model": model, "setting": setting, "note": why}
        self.rows.append(row | {"time_s": None, "error": None, "converged": False})
        if model is None:
            print(f"{case:13s} {solver:20s} {why[:80]}", flush=True)

    @staticmethod
    def _say(case: str, solver: str, model: str, rows: list[Row]) -> None:
        good = [row for row in rows if report.right(row)]
        text = "nothing that works"
        if good:
            best = min(good, key=lambda row: row["error"])
            text = f"{best['error']:.1e} in {1e3 * best['time_s']:.3g} ms ({best['setting']})"
        print(f"{case:13s} {solver:20s} {model:12s} {len(rows):3d} rows, best {text}", flush=True)


def write(driver: Driver, page: Path, picture: Path) -> None:
    """The report, and the figure that it links."""
    link = picture.relative_to(page.parent)
    page.write_text(report.page(driver.rows, driver.about, str(link)))
    figure.draw(driver.rows, picture)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--cases", default=",".join(CASES))
    parser.add_argument("--solvers", default=",".join(PEERS))
    parser.add_argument("--quick", action="store_true", help="a few seconds for each solver")
    parser.add_argument("--out", type=Path, default=ROOT / "build" / "bench")
    parser.add_argument("--docs", action="store_true", help="write docs/benchmarks.md as well")
    chosen = parser.parse_args()
    out = chosen.out.resolve()  # workers have other folders
    out.mkdir(parents=True, exist_ok=True)
    driver = Driver(out, *((2, 20, 0.05) if chosen.quick else (15, 60, 0.25)))
    began = time.monotonic()
    for case in chosen.cases.split(","):
        for name in chosen.solvers.split(","):
            driver.run(case, name)
        (out / "report.json").write_text(json.dumps(driver.rows, indent=1))
    if "scaling" in chosen.cases and "pyrod" in chosen.solvers:
        driver.rows += parallel.rows()
    (out / "report.json").write_text(json.dumps(driver.rows, indent=1))
    write(driver, out / "report.md", out / "error_time.png")
    if chosen.docs:
        write(driver, DOCS / "benchmarks.md", DOCS / "img" / "error_time.png")
    print(f"{(time.monotonic() - began) / 60:.1f} minutes; report.md in {out}")


if __name__ == "__main__":
    main()
