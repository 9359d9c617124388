"""Handing out work to an executor, and taking in what it returns."""

from __future__ import annotations

import os
import pickle
from collections import deque
from collections.abc import Callable, Generator, Sequence
from concurrent.futures import FIRST_COMPLETED, Executor, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from time import perf_counter
from typing import Any

AT_ONCE = 0.1
"""Seconds of work that are sent together, so that sending does not count."""

Function = Callable[[Sequence[Any]], list[Any]]


def done(
    function: Function, items: Sequence[Any], executor: Any
) -> Generator[list[Any], None, None]:
    """What a function of some items returns, chunk by chunk, in the order in which they end.

    ``executor`` : None: here, one by one; else as for `sweep`. What has not begun is called off
    when the generator is closed, or on an exception.
    """
    if executor is None:
        yield from (function([item]) for item in items)
        return
    pool = _pool(executor)
    _refuse_what_cannot_be_sent(function, pool)
    workers = _workers(pool)
    left, pace = deque(items), _Pace()
    pending: set[Future[Any]] = set()
    try:
        while left or pending:
            while left and len(pending) < 2 * workers:
                size = pace.chunk(fair=len(left) // (2 * workers))
                chunk = [left.popleft() for _ in range(min(size, len(left)))]
                pending.add(pool.submit(_timed, function, chunk))
            ended, pending = wait(pending, return_when=FIRST_COMPLETED)
            for future in ended:
                count, seconds, records = future.result()
                pace.note(count, seconds)
                yield records
    except BrokenProcessPool as error:
        error.add_note(
            "A worker died. A script that makes a pool of processes needs "
            "`if __name__ == '__main__':` around what it runs, and functions that a pool is to "
            "run must be there when the pool is made."
        )
        raise
    finally:
        for future in pending:
            future.cancel()


class _Pace:
    """How many items make a chunk."""

    def __init__(self) -> None:
        self._count, self._seconds = 0, 0.0

    def note(self, count: int, seconds: float) -> None:
        self._count += count
        self._seconds += seconds

    def chunk(self, fair: int) -> int:
        """As many as take a while, but no more than leaves as much to every worker."""
        if not self._count:
            return 1
        wanted = AT_ONCE * self._count / max(self._seconds, 1e-9)
        return max(1, min(int(wanted), fair))


def _timed(function: Function, items: Sequence[Any]) -> tuple[int, float, list[Any]]:
    began = perf_counter()
    records = function(items)
    return len(items), perf_counter() - began, records


def _pool(executor: Any) -> Executor:
    """The executor; that of a client of dask, where a chunk is not done once for all."""
    if hasattr(executor, "get_executor"):
        return executor.get_executor(pure=False)
    if not callable(getattr(executor, "submit", None)):
        raise TypeError(
            "executor: expected None, an executor of concurrent.futures or its like, or a "
            f"dask.distributed.Client, got a {type(executor).__name__}"
        )
    return executor


def _workers(pool: Any) -> int:
    """How many chunks an executor works on at a time."""
    client = getattr(pool, "_client", None)
    if client is not None:
        count = sum(client.nthreads().values())
    else:
        count = getattr(pool, "_max_workers", None)
    return count or os.cpu_count() or 1


def _refuse_what_cannot_be_sent(function: Function, pool: Executor) -> None:
    """Executors of dask and loky send any function; those with Python's pickle do not."""
    if not isinstance(pool, ProcessPoolExecutor) and "mpi4py" not in type(pool).__module__:
        return
    try:
        pickle.dumps(function)
    except (pickle.PicklingError, AttributeError, TypeError) as error:
        raise TypeError(
            f"executor: scene and measure must be sent to other processes, but {error}; write "
            "them with def at the top of a module, or use a ThreadPoolExecutor"
        ) from None
