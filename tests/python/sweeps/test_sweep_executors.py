"""Sweeps on threads, processes, dask and MPI: the bits are those of a sweep in this process."""

from __future__ import annotations

import os
import pickle
import shutil
import subprocess
import sys
from collections.abc import Iterator
from concurrent.futures import Executor, Future, ThreadPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from pathlib import Path
from threading import get_ident
from time import sleep
from typing import Any

import pytest
import sweeps
from dask.distributed import Client, LocalCluster
from support import same_sweep
from sweeps import GRID, cantilever, dying, pool, shape

import pyrod
from pyrod import sweep

SCRIPT = str(Path(sweeps.__file__))
BIN = Path(sys.executable).parent
MPIEXEC = shutil.which("mpiexec", path=f"{BIN}{os.pathsep}{os.environ['PATH']}")

pytestmark = [
    pytest.mark.outside,
    pytest.mark.filterwarnings("ignore:This process .* is multi-threaded:DeprecationWarning"),
]


@pytest.fixture(scope="module")
def here() -> pyrod.Sweep:
    return sweep(cantilever, GRID, measure=shape, progress=False)


@pytest.fixture(scope="module")
def client() -> Iterator[Client]:
    """Two workers, processes of their own."""
    with (
        LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster,
        Client(cluster) as client,
    ):
        yield client


def spread(executor: Any, **more: Any) -> pyrod.Sweep:
    return sweep(cantilever, GRID, measure=shape, executor=executor, progress=False, **more)


def test_threads(here: pyrod.Sweep) -> None:
    with ThreadPoolExecutor(3) as threads:
        same_sweep(spread(threads), here)


@pytest.mark.parametrize("kind", ["spawn", "fork"])
def test_processes(here: pyrod.Sweep, kind: str) -> None:
    with pool(kind) as processes:
        same_sweep(spread(processes), here)


def test_dask(here: pyrod.Sweep, client: Client) -> None:
    same_sweep(spread(client), here)
    same_sweep(spread(client.get_executor()), here)


def test_mpi(here: pyrod.Sweep, tmp_path: Path) -> None:
    if MPIEXEC is None:
        pytest.skip("mpiexec is missing")
    path = tmp_path / "sweep"
    command = [MPIEXEC, "-n", "3", sys.executable, "-m", "mpi4py.futures", SCRIPT, "mpi", path]
    subprocess.run(command, check=True, timeout=60)
    same_sweep(pickle.loads(path.read_bytes()), here)


def test_functions_of_the_main_module(here: pyrod.Sweep, tmp_path: Path) -> None:
    path = tmp_path / "sweep"
    subprocess.run([sys.executable, SCRIPT, "spawn", path], check=True, timeout=60)
    same_sweep(pickle.loads(path.read_bytes()), here)


def test_lines_that_follow_one_another_are_not_torn() -> None:
    first = spread(None, start="previous")
    with ThreadPoolExecutor(3) as threads:
        same_sweep(spread(threads, start="previous"), first)


def test_equilibria_come_back_from_processes(client: Client) -> None:
    kept = [spread(executor, keep_results=True).results for executor in (None, client)]
    assert all(a == b for a, b in zip(*kept, strict=True))


# Functions that are sent --------------------------------------------------------------------------


@pytest.mark.parametrize("which", ["scene", "measure"])
def test_functions_that_cannot_be_sent_are_refused(which: str) -> None:
    functions = {"scene": cantilever, "measure": shape, which: lambda **_: {}}
    with (
        pool("spawn") as processes,
        pytest.raises(TypeError, match=r"executor: .* but .*lambda.*; write them with def at"),
    ):
        sweep(parameters=GRID, executor=processes, **functions)


def test_dask_sends_any_function(client: Client, here: pyrod.Sweep) -> None:
    def local(load: float, angle: float) -> pyrod.Scene:
        return cantilever(load, angle)

    same_sweep(sweep(local, GRID, measure=shape, executor=client, progress=False), here)


def test_a_worker_that_dies_is_told_of() -> None:
    with pool("spawn") as processes, pytest.raises(BrokenProcessPool) as caught:
        sweep(dying, {"load": [1.0]}, executor=processes, progress=False)
    assert "if __name__ == '__main__':" in caught.value.__notes__[0]


# Chunks -------------------------------------------------------------------------------------------


class Watched(ThreadPoolExecutor):
    """Counts the chunks, and those that are under way at the same time."""

    def __init__(self, workers: int) -> None:
        super().__init__(workers)
        self.futures: list[Future[Any]] = []
        self.most = 0

    def submit(self, *args: Any, **more: Any) -> Future[Any]:
        self.futures.append(super().submit(*args, **more))
        self.most = max(self.most, sum(not future.done() for future in self.futures))
        return self.futures[-1]


def test_cases_are_sent_together() -> None:
    with Watched(2) as threads:
        done = sweep(quick, {"load": list(range(1000))}, executor=threads, progress=False)
    assert list(done["load"]) == list(range(1000))
    assert len({tuple(t) for t in done["tip"]}) == 1000
    assert 12 <= len(threads.futures) < 200
    assert threads.most <= 4


def quick(load: float) -> pyrod.Scene:
    return cantilever(load / 1e3, 1.0, 4)


class Unknown(Executor):
    """Does not say how many workers it has, and solves at once."""

    def submit(self, function: Any, /, *args: Any, **more: Any) -> Future[Any]:
        future: Future[Any] = Future()
        future.set_result(function(*args, **more))
        return future


def test_any_executor_will_do(here: pyrod.Sweep) -> None:
    same_sweep(spread(Unknown()), here)


def test_what_has_not_begun_is_called_off_by_ctrl_c() -> None:
    def press(done: int, total: int) -> None:
        raise KeyboardInterrupt

    with Watched(3) as threads, pytest.raises(KeyboardInterrupt):
        sweep(slow, {"seconds": [0.01] + [0.2] * 20}, executor=threads, progress=press)
    assert any(future.cancelled() for future in threads.futures)


def slow(seconds: float) -> pyrod.Scene:
    sleep(seconds)
    return cantilever(1.0, 1.0)


def test_threads_solve_at_the_same_time() -> None:
    threads_seen = set()

    def noting(load: float) -> pyrod.Scene:
        threads_seen.add(get_ident())
        return cantilever(load, 1.0, 2000)

    with ThreadPoolExecutor(2) as threads:
        sweep(noting, {"load": [1.0, 2.0, 3.0, 4.0]}, executor=threads, progress=False)
    assert len(threads_seen) == 2
    assert get_ident() not in threads_seen
