"""Solves of all kinds at the same time, of many scenes and of one, disturb nothing."""

from __future__ import annotations

import subprocess
import sys
import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
import pytest
from support import ROUND, SOFT

import pyrod
from pyrod import Clamp, Equilibrium, Force, Gravity, Hinge, Joint, Rod, Scene, Section

THREADS = 6
STRIP = Section(4.0, 1.0, 2.0, mass_per_length=0.5)


def cantilever() -> Equilibrium:
    return pyrod.solve(Scene(Rod.straight(1.0, 40, SOFT), Clamp(), Force((3, 2, -1))))


def span() -> Equilibrium:
    ends = [Clamp(), Clamp((0.1, 0.2, 0.7), at="end")]
    return pyrod.solve(Scene(Rod.straight(1.0, 40, STRIP), ends), eigenvalue=True)


def column() -> Equilibrium:
    """Leaves a saddle."""
    return pyrod.solve(Scene(Rod.straight(1.0, 24, ROUND), Clamp(), Force((0, 0, -5))))


def ring() -> Equilibrium:
    return pyrod.solve(Scene(Rod.straight(1.0, 48, STRIP), joints=Joint(("start", "end"), turns=1)))


def frame() -> Equilibrium:
    rods = [
        Rod.straight(1.0, 12, STRIP),
        Rod.straight(1.0, 12, STRIP).placed((0, 0, 1), tangent=(1, 0, 0), normal=(0, 0, 1)),
    ]
    held = [Clamp(at=(0, "start")), Hinge(at=(1, "end"))]
    return pyrod.solve(Scene(rods, held, Gravity(), joints=Joint(((0, "end"), (1, "start")))))


def follower() -> Equilibrium:
    scene = Scene(Rod.straight(1.0, 30, STRIP), Clamp(), Force((4, 0, 0), follower=True))
    return pyrod.solve(scene)


def to_a_tolerance() -> Equilibrium:
    return pyrod.solve(Scene(Rod.straight(1.0, None, SOFT), Clamp(), Force((3, 2, -1))), tol=1e-7)


def smallest() -> Equilibrium:
    scene = Scene(Rod.straight(1.0, None, SOFT), Clamp(), Force((0.3, 0, -0.1)))
    return pyrod.solve(scene, tol=1e-4, model="auto")


def refused() -> str:
    with pytest.raises(pyrod.NotConverged) as failure:
        pyrod.solve(
            Scene(Rod.straight(1.0, 24, ROUND), Clamp(), Force((90, 5, -9))),
            pyrod.Options(max_iterations=2),
        )
    return str(failure.value)


KINDS: list[Callable[[], Any]] = [
    cantilever, span, column, ring, frame, follower, to_a_tolerance, smallest, refused
]  # fmt: skip


def together(tasks: list[Callable[[], Any]]) -> list[Any]:
    """All at once: each thread begins when all are there."""
    begin = threading.Barrier(THREADS)

    def work(first: int) -> dict[int, Any]:
        begin.wait()
        return {i: tasks[i]() for i in range(first, len(tasks), THREADS)}

    with ThreadPoolExecutor(THREADS) as pool:
        parts = list(pool.map(work, range(THREADS)))
    merged = {i: result for part in parts for i, result in part.items()}
    return [merged[i] for i in range(len(tasks))]


def test_kinds_of_scenes_at_the_same_time() -> None:
    alone = [kind() for kind in KINDS]
    rng = np.random.default_rng(2)
    order = np.concatenate([rng.permutation(len(KINDS)) for _ in range(12)])
    for kind, result in zip(order, together([KINDS[i] for i in order]), strict=True):
        assert result == alone[kind], KINDS[kind].__name__


@pytest.mark.parametrize("edges", [40, None])
@pytest.mark.parametrize("held", ["cantilever", "span"])
def test_one_scene_by_many_threads_to_a_tolerance(edges: int | None, held: str) -> None:
    """They share the ladder of its grids."""
    ends = [Clamp(), *([Clamp((0.1, 0.2, 0.7), at="end")] if held == "span" else [])]

    def scene() -> Scene:
        return Scene(Rod.straight(1.0, edges, SOFT), ends, Force((3, 2, -1), at=0.7))

    expected, shared = pyrod.solve(scene(), tol=1e-7), scene()
    results = together([lambda: pyrod.solve(shared, tol=1e-7)] * (3 * THREADS))
    assert all(result == expected for result in results)


def test_results_are_looked_at_by_many_threads() -> None:
    """Arrays are made when they are first asked for."""
    result = span()
    seen = together([lambda: result.moment] * (4 * THREADS))
    assert all(np.array_equal(moment, span().moment) for moment in seen)


WAITING = """
import threading, time
import numpy as np, pyrod
from pyrod import Clamp, Force, Rod, Scene, Section

def section(s):
    time.sleep(1e-4)  # another thread has the lock of Python meanwhile
    return Section(1.0, 1.0 + abs(s - 0.377), 1.0)

scene = Scene(Rod.straight(1.0, 16, section), Clamp(), Force((1, 0, 0), at=0.7))
start = pyrod.solve(Scene(Rod.straight(1.0, 17, Section(1, 1, 1)), Clamp(), Force((1, 0, 0))))
refused = []

def look():  # for the edges with a tolerance, which the other thread is finding
    time.sleep(5e-3)
    try:
        pyrod.solve(scene, tol=1e-4, start=start)
    except ValueError as error:
        refused.append(str(error))

others = [threading.Thread(target=look) for _ in range(2)]
for other in others:
    other.start()
result = pyrod.solve(scene, tol=1e-4)
for other in others:
    other.join()
assert len(refused) == 2 and result.converged, refused
"""


@pytest.mark.outside
def test_who_waits_for_a_function_does_not_hold_the_lock_of_python() -> None:
    """Else nobody goes on, so that only another program can tell."""
    subprocess.run([sys.executable, "-c", WAITING], check=True, timeout=60)
