"""The sweep itself."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import closing
from os import PathLike
from time import perf_counter
from typing import Any, Literal, get_args

from pyrod._core import Options
from pyrod.base.calls import spelled
from pyrod.base.progress import Progress, progress_shown
from pyrod.base.words import shortly
from pyrod.result.accuracy import checked_tolerance
from pyrod.rod.section import Model
from pyrod.solving.job import How
from pyrod.sweeps.build import Source, builder_of
from pyrod.sweeps.cases import Cases, Parameters, cases_of
from pyrod.sweeps.measures import Measuring, summary
from pyrod.sweeps.spread import done
from pyrod.sweeps.store import Store, identity
from pyrod.sweeps.table import Sweep, sweep_of
from pyrod.sweeps.work import Numbered, Record, Work


@spelled
def sweep(
    scene: Source,
    parameters: Parameters,
    *,
    measure: Measuring | None = None,
    executor: Any = None,
    options: Options | None = None,
    tol: float | None = None,
    model: Literal["auto"] | Model | None = None,
    stable: bool = True,
    eigenvalue: bool = False,
    start: Literal["previous"] | None = None,
    keep_results: bool = False,
    progress: bool | Progress = True,
    store: str | PathLike[str] | None = None,
    retry_failed: bool = False,
) -> Sweep:
    """Equilibria of a scene for many values of its parameters.

    A case that fails does not end the sweep: its numbers are NaN, and ``error`` says why. Results
    are the same to the bit whatever the executor.

    Parameters
    ----------
    scene : function, `Scene`, str, Path or dict
        A function of the parameters that returns a `Scene`; or a scene, the path of a scene file
        (.toml, .json) or its content as a dict, whose entries the parameters name by their paths:
        ``"loads.0.force.2"``.
    parameters : dict of sequences, sequence of dicts, or DataFrame
        Values by name, of which all combinations are solved: {"load": [1, 2], ...}; or a sequence
        of cases {"load": 1, ...}, or a DataFrame with a row per case.
    measure : function
        A function of the `Equilibrium` that returns a dict of numbers, text or arrays; default:
        status, iterations, energy, index, tip (3,) of the last rod, lengths of the largest
        curvature, section force and moment (largest_K, largest_force, largest_moment), and
        lowest_eigenvalue and estimated_error if they are known.
    executor : None, Executor or Client
        Where to solve: None (default), here, one by one; an executor of ``concurrent.futures``
        (threads or processes), of mpi4py, loky or dask, or a ``dask.distributed.Client``. Cases are
        sent together, as many as take a tenth of a second.
    options, tol, model, stable, eigenvalue : see `solve`
    start : "previous" or None
        Along the last parameter of a grid, or down a list, each case starts from the equilibrium of
        the one before, or (default) none does.
    keep_results : bool
        Keep the equilibria as well, in ``.results``.
    progress : bool or function
        True (default): a bar on standard error; or a function of the numbers of cases that are done
        and of all.
    store : str or Path
        A file (JSON, a line per case) to which what is done is added at once, and from which the
        same sweep goes on if it was stopped. Functions are known by their names: delete the file
        when they have changed.
    retry_failed : bool
        Solve what failed before once more; default: it stays failed.

    Raises
    ------
    ValueError, TypeError
        Parameters that the scene does not have, a store of another sweep, functions that cannot be
        sent to other processes.
    KeyboardInterrupt
        Ctrl-C; what is done is in the store.
    """
    if start not in (None, "previous"):
        raise ValueError(f"start: expected 'previous' or None, got {shortly(start)}")
    if store is not None and keep_results:
        raise ValueError("keep_results: a store holds no equilibria; leave out one of the two")
    if model not in (None, "auto", *get_args(Model)):
        raise ValueError(
            f"model: expected 'auto', {', '.join(get_args(Model))}, got {shortly(model)}"
        )
    if model == "auto" and tol is None:
        raise ValueError("model: 'auto' needs tol, the error that is allowed")
    began = perf_counter()
    cases = cases_of(parameters)
    build = builder_of(scene, cases.arguments(0))
    how = How(options or Options(), stable, eigenvalue, checked_tolerance(tol))
    work = Work(build, measure or summary, how, model, keep_results)
    kept = None if store is None else Store(store, identity(cases, work, start))
    records = _standing(kept, retry_failed)
    failed = sum(bool(record.error) for record in records.values())
    lines = _missing_lines(cases, records, follow=start is not None)
    with (
        progress_shown(progress, len(cases.rows), "cases", len(records)) as show,
        closing(done(work, lines, executor)) as chunks,
    ):
        for chunk in chunks:
            if kept is not None:
                kept.add(chunk)
            records.update((record.case, record) for record in chunk)
            failed += sum(bool(record.error) for record in chunk)
            if show is not None:
                show(len(records), failed)
    return sweep_of(cases, records, keep_results, perf_counter() - began)


def _standing(store: Store | None, retry_failed: bool) -> dict[int, Record]:
    """What is done already."""
    if store is None:
        return {}
    return {
        case: record
        for case, record in store.records.items()
        if not (record.error and retry_failed)
    }


def _missing_lines(cases: Cases, known: Mapping[int, Record], follow: bool) -> list[list[Numbered]]:
    """What is to be done: cases that follow one another, whole lines of them."""
    length = cases.line if follow else 1
    starts = range(0, len(cases.rows), length)
    lines = [range(first, first + length) for first in starts]
    missing = [line for line in lines if any(case not in known for case in line)]
    return [[(case, cases.arguments(case)) for case in line] for line in missing]
