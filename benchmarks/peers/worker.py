"""One process per solver: reads requests line by line, answers one line each.

Usage: python -m peers.worker MODULE, in the solver's own environment. Its output of other sorts
goes to stderr.
"""

from __future__ import annotations

import importlib
import json
import os
import sys
import traceback
import warnings
from dataclasses import asdict
from types import ModuleType
from typing import Any, TextIO

from peers.cases import CASES
from peers.measure import Cannot, clock, label, repeated


def main() -> None:
    answers = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)
    os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})
    warnings.simplefilter("ignore")
    module = importlib.import_module(f"peers.solvers.{sys.argv[1]}")
    getattr(module, "warm_up", lambda: None)()
    for line in sys.stdin:
        _say(answers, _answer(module, json.loads(line)))


def _say(answers: TextIO, answer: dict[str, Any]) -> None:
    answers.write(json.dumps(answer) + "\n")
    answers.flush()


def _answer(module: ModuleType, request: dict[str, Any]) -> dict[str, Any]:
    began = clock()
    try:
        do = {"about": _about, "plan": _plan, "solve": _solve}[request.pop("do")]
        answer = do(module, **request)
        return answer | {"spent_s": clock() - began}
    except Cannot as no:
        return {"cannot": str(no)}
    except Exception as error:  # whatever a solver throws costs one row
        traceback.print_exc()
        text = f"{type(error).__name__}: {error}".splitlines()[0][:120]
        return {"failed": text, "spent_s": clock() - began}


def _about(module: ModuleType) -> dict[str, Any]:
    return {"about": module.ABOUT, "names": module.NAMES}


def _plan(module: ModuleType, case: str, name: str) -> dict[str, Any]:
    plan = asdict(module.plan(case, name))
    plan["labels"] = [[label(setting) for setting in group] for group in plan["groups"]]
    return plan


def _solve(
    module: ModuleType, case: str, name: str, model: str, setting: dict[str, Any], seconds: float
) -> dict[str, Any]:
    problem = CASES[case].problem(model)
    shapes = repeated(lambda: module.solve(problem, name, setting), seconds)
    rows = []
    for shape in shapes:
        row = asdict(shape)
        row["label"] = shape.label or label(setting)
        row["s"], row["r"] = shape.s.tolist(), shape.r.tolist()
        rows.append(row)
    return {"rows": rows}


if __name__ == "__main__":
    main()
