"""What a solver module offers to the driver, and how its runs are timed.

A module in `peers.solvers` has

    ABOUT             options given to the solver, for the report
    NAMES             its names in the report
    plan(case, name)  a `Plan` for the case, or a `Cannot` with the reason
    solve(problem, name, setting)   a list of `Shape`: one, or some along the way of a relaxation
    warm_up()         optional: what compilers do at the first call

Times are processor times of this process, which neighbours on the same machine do not change.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from statistics import median
from typing import Any

from peers.problem import Array

clock = time.process_time
Setting = dict[str, Any]


@dataclass
class Shape:
    """What came out: positions r (m, 3) at arc lengths s, and the seconds it took."""

    time_s: float
    build_s: float
    s: Array
    r: Array
    converged: bool = True
    iterations: int | None = None
    label: str = ""
    more: dict[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class Plan:
    """Models to solve, and groups of settings: of a group the fastest that works is kept.

    Groups are tried from cheap to dear, and settings of a group likewise. Settings that failed in
    one group are left out in the next, but for the last of them.
    """

    models: list[str]
    groups: list[list[Setting]]


class Cannot(Exception):
    """The solver has no way to do the case, for the reason given."""


def grids(sizes: list[int], steps: tuple[int, ...] = (1,), **more: Any) -> list[list[Setting]]:
    """Groups of settings: a grid each, with more and more load steps."""
    return [[{"n": n, "steps": k, **more} for k in steps] for n in sizes]


def label(setting: Setting) -> str:
    parts = []
    for key, value in setting.items():
        if key == "steps":
            if value > 1:
                parts.append(f"{value} steps")
        elif isinstance(value, bool):
            parts += [key] * value
        elif isinstance(value, float):
            parts.append(f"{key}={value:.0e}".replace("e-0", "e-"))
        else:
            parts.append(f"{key}={value}")
    return ", ".join(parts)


def repeated(run: Callable[[], list[Shape]], seconds: float, most: int = 30) -> list[Shape]:
    """Median times of up to `most` runs, as many as fit into `seconds`; at least one."""
    began = time.perf_counter()
    runs = [run()]
    while len(runs) < most and len(runs[0]) == len(runs[-1]):
        each = (time.perf_counter() - began) / len(runs)
        if time.perf_counter() - began + each > seconds:
            break
        runs.append(run())
    same = [shapes for shapes in runs if len(shapes) == len(runs[0])]
    return [
        replace(
            shapes[0],
            time_s=median(x.time_s for x in shapes),
            build_s=median(x.build_s for x in shapes),
        )
        for shapes in zip(*same, strict=True)
    ]


def thinned(count: int, most: int = 33) -> slice:
    """Every k-th of `count` intervals, at most `most` points and both ends, if they divide."""
    step = max(1, count // (most - 1))
    return slice(None, None, step if count % step == 0 else 1)
