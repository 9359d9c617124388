"""Many scenes at once."""

from __future__ import annotations

from collections.abc import Iterable
from time import perf_counter
from typing import Any

import pyrod._core as _core
from pyrod._core import Options
from pyrod.base.arrays import whole
from pyrod.base.calls import spelled
from pyrod.base.progress import Progress, progress_shown
from pyrod.result.equilibrium import Equilibrium
from pyrod.result.errors import NotConverged
from pyrod.scene.scene import Scene, checked_scene
from pyrod.solving.job import DEFAULTS, How, equilibrium_of, start_of
from pyrod.solving.run import judge


@spelled
def solve_many(
    scenes: Iterable[Scene],
    options: Options | None = None,
    *,
    tol: float | None = None,
    starts: Iterable[Any] | None = None,
    threads: int = 0,
    strict: bool = True,
    stable: bool = True,
    eigenvalue: bool = False,
    progress: bool | Progress = False,
) -> list[Equilibrium]:
    """Equilibria of many scenes, on several threads and without Python's lock.

    The results are those of `solve`, bit for bit, whatever the number of threads.

    Parameters
    ----------
    scenes : sequence of `Scene`
        Any number. Scenes that are the same object wait for each other if ``tol`` is given.
    options, tol : see `solve`
    starts : sequence
        One start per scene, see `solve`; default: none.
    threads : int
        Default 0: as many as the machine has cores.
    strict : bool
        Raise `NotConverged` for the first that fails; all results are in ``.results``.
    stable, eigenvalue : see `solve`
    progress : bool or function
        True: a bar on standard error; or a function of the numbers of scenes that are done and of
        all.

    Raises
    ------
    ValueError
        A scene or a start that cannot be solved; its number is in the message.
    KeyboardInterrupt
        Ctrl-C is looked for between scenes.
    """
    if isinstance(scenes, Scene):
        raise TypeError("scenes: expected several, got one Scene; for one there is solve")
    scenes, threads = [checked_scene(scene) for scene in scenes], whole(threads, "threads")
    starts = [None] * len(scenes) if starts is None else list(starts)
    if len(starts) != len(scenes):
        raise ValueError(f"starts: expected {len(scenes)}, one per scene, got {len(starts)}")
    how = How(options or DEFAULTS, stable, eigenvalue, tol).checked()
    began = perf_counter()
    known = [_start(i, *pair) for i, pair in enumerate(zip(starts, scenes, strict=True))]
    with progress_shown(progress, len(scenes), "scenes") as show:
        found = _core.solve_all(
            [scene._compiled for scene in scenes],
            known,
            how.options,
            how.tol,
            stable,
            eigenvalue,
            threads,
            show,
        )
    each = (perf_counter() - began) / max(len(scenes), 1)
    pairs = zip(scenes, found, strict=True)
    results = [equilibrium_of(scene, one, how, each) for scene, one in pairs]
    for result in results:
        judge(result, strict=False)
    if strict:
        _refuse_failures(results)
    return results


def _start(number: int, start: Any, scene: Scene) -> Any:
    try:
        return start_of(start, scene)
    except (ValueError, TypeError) as error:
        raise type(error)(f"scene {number}: {error}") from None


def _refuse_failures(results: list[Equilibrium]) -> None:
    for result in results:
        if not result.converged:
            raise NotConverged(result, results)
