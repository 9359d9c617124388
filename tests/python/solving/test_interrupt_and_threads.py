"""Long computations can be stopped, leave other threads running, and do not disturb each other."""

from __future__ import annotations

import os
import signal
import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from time import sleep

import numpy as np
import pytest
from interrupt import ctrl_c_after, needs_ctrl_c
from support import HELIX, IDENTITY, MODELS, ROUND, SOFT, SPACES

import pyrod
from pyrod import Clamp, Force, Rod, Scene
from pyrod.curve import Polyline


def large(n: int) -> Scene:
    """Seven iterations."""
    return Scene(Rod.straight(1.0, n, ROUND), Clamp(), Force((3, 2, -10)))


@needs_ctrl_c
def test_ctrl_c_stops_a_solve_within_an_iteration(monkeypatch: pytest.MonkeyPatch) -> None:
    """Pressed after the first line is printed, while the second iteration is under way."""
    scene = large(200_000)
    on_all = np.tile(IDENTITY, (200_000, 1))  # from the first line on
    with ctrl_c_after(1, monkeypatch) as lines:
        pyrod.solve(scene, start=on_all, verbose=True)
    assert 1 <= len(lines) <= 2  # of seven
    assert pyrod.solve(large(100)) == pyrod.solve(large(100))  # as if nothing had happened


def coil(n: int) -> Polyline:
    """An arc that does not meet itself."""
    return HELIX.polyline(HELIX.even(n))


ENDLESS = {
    "writhe": lambda arc: arc.writhe(2),
    "approach": lambda arc: arc.approach(coil(len(arc.positions)), 2),
}


@needs_ctrl_c
@pytest.mark.parametrize("ask", ENDLESS.values(), ids=ENDLESS)
def test_ctrl_c_stops_sums_over_pairs_of_edges(ask: Callable[[Polyline], object]) -> None:
    """Ten thousand million pairs would take minutes; the limit on the time of a test says if they
    are gone through."""
    arc = coil(100_000)

    def press() -> None:
        sleep(0.05)
        os.kill(os.getpid(), signal.SIGINT)

    thread = threading.Thread(target=press)
    with pytest.raises(KeyboardInterrupt):  # noqa: PT012
        thread.start()
        ask(arc)
    thread.join()
    assert coil(100).writhe() == coil(100).writhe()


def test_other_threads_run_during_a_sum_over_pairs_of_edges() -> None:
    arc, done, wakes = coil(2500), threading.Event(), 0

    def count() -> None:
        nonlocal wakes
        while not done.is_set():
            sleep(1e-3)
            wakes += 1

    thread = threading.Thread(target=count)
    thread.start()
    before = wakes
    arc.writhe(1)
    during = wakes - before
    done.set()
    thread.join()
    assert during > 10


def test_an_error_while_printing_stops_the_solve(monkeypatch: pytest.MonkeyPatch) -> None:
    def full_disk(*_: object, **__: object) -> None:
        raise OSError("disk full")

    monkeypatch.setattr("builtins.print", full_disk)
    with pytest.raises(OSError, match="disk full"):
        pyrod.solve(large(10), verbose=True)


def test_other_threads_run_during_a_solve() -> None:
    """A thread that wakes every millisecond would wake a few times only if the solve held the
    interpreter's lock between its iterations."""
    wakes, done = 0, threading.Event()

    def count() -> None:
        nonlocal wakes
        while not done.is_set():
            sleep(1e-3)
            wakes += 1

    thread = threading.Thread(target=count)
    scene = large(100_000)
    thread.start()
    before = wakes
    result = pyrod.solve(scene)
    during = wakes - before
    done.set()
    thread.join()
    assert during > 10 * result.iterations


def scenes() -> list[Scene]:
    rng = np.random.default_rng(1)
    out = []
    for model in MODELS:
        for space in SPACES:
            for n in (10, 300, 3000):
                force = rng.normal(size=3) * [5, space == "spatial", 2]
                moment = (0, 0.3, 0.2 * (space == "spatial"))
                loads = [Force(force), pyrod.Moment(moment)]
                out.append(Scene(Rod.straight(1.0, n, SOFT, model), Clamp(), loads, space))
    return out


def test_solves_in_threads_are_the_serial_ones_to_the_bit() -> None:
    serial = [pyrod.solve(scene) for scene in scenes()]
    with ThreadPoolExecutor(4) as pool:
        for _ in range(3):
            parallel = list(pool.map(pyrod.solve, scenes()))
            assert parallel == serial


def test_one_scene_may_be_solved_by_many_threads() -> None:
    scene = large(1000)
    expected = pyrod.solve(scene)
    with ThreadPoolExecutor(4) as pool:
        assert all(result == expected for result in pool.map(pyrod.solve, [scene] * 12))
