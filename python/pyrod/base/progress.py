"""How far a long computation is: a bar on standard error, or a function that is told."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from math import isfinite
from typing import Any

Progress = Callable[[int, int], Any]
"""A function of how many are done and how many there are."""


@contextmanager
def progress_shown(
    progress: bool | Progress, total: int, unit: str, done: int = 0
) -> Iterator[Callable[..., Any] | None]:
    """A function of the numbers that are done, and that failed, of a total; None: nobody looks.

    ``done`` : those that were done before.
    """
    if callable(progress):
        yield lambda done, failed=0: progress(done, total)
    elif not progress:
        yield None
    else:
        from tqdm import tqdm

        with tqdm(total=total, initial=done, unit=f" {unit}", file=sys.stderr) as bar:

            def show(done: int, failed: int = 0) -> None:
                if failed:
                    bar.set_postfix(failed=failed, refresh=False)
                bar.update(done - bar.n)

            yield show


@contextmanager
def iterations() -> Iterator[Watch]:
    """What is told of each iteration of a solve; seen if it takes half a second."""
    from tqdm import tqdm

    with tqdm(unit=" iterations", delay=0.5, leave=False, file=sys.stderr) as bar:
        yield Watch(bar)


class Watch:
    """Shows the iterations of a solve, and how far its climb to a tolerance is."""

    def __init__(self, bar: Any) -> None:
        self._bar = bar
        self._climb: dict[str, str] = {}

    def reached(self, grids: int, edges: int, error: float) -> None:
        """A grid is done: how many are, the edges of the finest, the largest error."""
        told = f"{error:.1e}" if isfinite(error) else "?"
        self._climb = {"grids": f"{grids}", "edges": f"{edges}", "error": told}

    def __call__(self, energy: float, residual: float, *_: float) -> None:
        shown = {"residual": f"{residual:.1e}"} | self._climb
        self._bar.set_postfix(shown, refresh=False)
        self._bar.update()
