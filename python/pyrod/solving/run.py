"""Solving a scene as it is, and what to think of the answer."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator
from time import perf_counter

from numpy.typing import ArrayLike

from pyrod._core import Options
from pyrod.base.calls import users_level
from pyrod.result.equilibrium import Equilibrium
from pyrod.result.errors import AccuracyWarning, NotConverged, StrainWarning, UnstableWarning
from pyrod.scene.scene import Scene
from pyrod.solving.job import DEFAULTS, How, equilibrium_of, start_of

DOUBTS = {"unstable": UnstableWarning, "accuracy": AccuracyWarning, "strain": StrainWarning}
"""The warnings of what a user should know before trusting an equilibrium."""


def solved(
    scene: Scene,
    options: Options | None = None,
    *,
    start: Equilibrium | ArrayLike | None = None,
    strict: bool = True,
    stable: bool = True,
) -> Equilibrium:
    """As `pyrod.solve`, which can do more."""
    result = unjudged(scene, How(options or DEFAULTS, stable, False, None), start)
    judge(result, strict)
    return result


def unjudged(
    scene: Scene,
    how: How,
    start: Equilibrium | ArrayLike | None = None,
    trace: Callable[..., None] | None = None,
    choice: str | None = None,
    began: float | None = None,
) -> Equilibrium:
    """What is found, not judged yet; ``choice`` is why in this model, ``began`` when."""
    began = perf_counter() if began is None else began
    how = how.checked()
    options, stable, eigenvalue, tol = how
    grids = getattr(trace, "reached", None)
    known = start_of(start, scene)
    source = scene._compiled.solve(known, options, tol, stable, eigenvalue, trace, grids)
    return equilibrium_of(scene, source, how, perf_counter() - began, choice)


def judge(result: Equilibrium, strict: bool, verbose: bool = False) -> None:
    """Refuses what is no equilibrium, and warns of what is doubtful."""
    if verbose:
        print(
            f"{result.status}: {result.iterations} iterations, {result.unknowns} unknowns of which "
            f"{result.multipliers} multipliers, fill {result.fill:.2f}",
            flush=True,
        )
    if strict and not result.converged:
        raise NotConverged(result)
    warn_of(result)


def warn_of(result: Equilibrium) -> None:
    """Warns of what is doubtful in an equilibrium that was just found."""
    for category, words in doubts(result):
        warnings.warn(words, category, stacklevel=users_level())


def doubts(result: Equilibrium) -> Iterator[tuple[type[Warning], str]]:
    """What a user should know before trusting an equilibrium that was just found."""
    return ((DOUBTS[kind], words) for kind, words in result._compiled.doubts)


def print_iteration(energy: float, residual: float, step: float, part: float, shift: float) -> None:
    """A line per iteration."""
    notes = (f"  part {part:.2g}" if part < 1 else "") + (f"  shift {shift:.2e}" if shift else "")
    print(f"energy {energy:+.9e}  residual {residual:.2e}  step {step:.2e} rad{notes}", flush=True)
