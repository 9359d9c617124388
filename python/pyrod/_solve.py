"""Solving a scene."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator
from dataclasses import replace
from time import perf_counter
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from pyrod._core import Options
from pyrod._jobs import How, Job
from pyrod._progress import iterations
from pyrod.equilibrium import Equilibrium
from pyrod.errors import AccuracyWarning, NotConverged, StrainWarning, UnstableWarning
from pyrod.scene import Scene, checked_scene
from pyrod.section import Model

MOST_STRAIN = 3.0
"""Of an edge, in stretch or shear: beyond what rubber does, so units are wrong more likely."""


def solve(
    scene: Scene,
    options: Options | None = None,
    *,
    tol: float | None = None,
    model: Literal["auto"] | Model | None = None,
    start: Equilibrium | ArrayLike | None = None,
    strict: bool = True,
    verbose: bool = False,
    stable: bool = True,
    eigenvalue: bool = False,
    progress: bool = False,
) -> Equilibrium:
    """Static equilibrium of a scene.

    Parameters
    ----------
    scene : the rods, their supports, joints and loads.
    options : tolerances and limits; see `Options`.
    tol : the largest relative error wanted, of positions, frames, curvatures, forces, moments,
        energy and reactions, in (0, 0.1]; estimates come with the result (``errors``). The scene's
        edges are halved as often as needed; the result is told at their ends, which is all edges
        that a user gave. Default: the grid as it is, and 1e-6 where rods leave their edges to the
        solver.
    model : the model of all rods, in place of their own; "auto": the smallest, and the plane if
        that will do, in which results differ by less than ``tol`` from those with all strains
        whose stiffnesses are finite. What was chosen, and why, is in ``choice``; see
        `smallest_model`.
    start : an equilibrium of a similar scene with as many edges, or frames (n, 4) or (n, 3, 3) of
        the edges of all rods, to start from; default: the shape at rest, bent into the supports. A
        start is trusted to be near.
    strict : raise `NotConverged` if no equilibrium is found; otherwise look at ``status``.
    verbose : print a line per iteration.
    stable : look for a stable equilibrium, and leave saddles along their unstable modes. Otherwise
        take the equilibrium that Newton's method leads to.
    eigenvalue : find the lowest eigenvalue of the second variation, too.
    progress : show the iterations on standard error once half a second has passed, and of a
        tolerance the grids, the edges of the finest, and the error reached so far.

    Raises
    ------
    NotConverged : with the last iterate in ``.result``; also where ``tol`` is not reached, with
        the best answer that was, and its errors.
    KeyboardInterrupt : Ctrl-C is looked for once per iteration.

    Warns
    -----
    UnstableWarning : the equilibrium found is a saddle of the energy, though a stable one was
        wanted.
    StrainWarning : an edge is stretched or sheared by more than three times its length or turned
        inside out, or neighbours turn by more than pi.
    AccuracyWarning : the grids do not converge as they should, so that nothing was extrapolated.
    """
    checked_scene(scene)
    how = How(options or Options(), stable, eigenvalue, tol)
    with iterations(progress and not verbose) as show:
        result = found(scene, how, model, start, _print_iteration if verbose else show)
    judge(result, strict, stable, verbose)
    return result


def found(
    scene: Scene,
    how: How,
    model: Literal["auto"] | Model | None = None,
    start: Equilibrium | ArrayLike | None = None,
    trace: Callable[..., None] | None = None,
) -> Equilibrium:
    """What `solve` finds, not judged yet."""
    began = perf_counter()
    choice = None
    if model is not None:
        scene, choice = _in_model(scene, model, how.tol)
    job = Job(scene, start, how)
    solution = job.run(trace)
    if (other := job.again(solution)) is not None:
        job, solution = other, other.run(trace)
    return job.equilibrium(solution, perf_counter() - began, choice)


def _in_model(
    scene: Scene, model: Literal["auto"] | Model, tol: float | None
) -> tuple[Scene, str | None]:
    """The scene with another model, and why."""
    if model != "auto":
        rods = [replace(rod, model=model) for rod in scene.rods]
        return Scene(rods, scene.supports, scene.loads, scene.space, scene.joints), None
    from pyrod._choice import smallest_model

    if tol is None:
        raise ValueError("model: 'auto' needs tol, the error that is allowed")
    choice = smallest_model(scene, tol)
    return choice.scene, choice.text


def judge(result: Equilibrium, strict: bool, stable: bool, verbose: bool = False) -> None:
    """Refuses what is no equilibrium, and warns of what is doubtful."""
    refuse_drift(result)
    if verbose:
        print(
            f"{result.status}: {result.iterations} iterations, {result.unknowns} unknowns of which "
            f"{result.multipliers} multipliers, fill {result.fill:.2f}",
            flush=True,
        )
    if strict and not result.converged:
        raise NotConverged(result)
    for category, message in doubts(result, stable):
        warnings.warn(message, category, stacklevel=3)


def doubts(result: Equilibrium, stable: bool) -> Iterator[tuple[type[Warning], str]]:
    """What a user should know before trusting an equilibrium."""
    if result.index > 0 and stable:
        message = (
            f"the equilibrium is unstable (index {result.index}): a disturbed rod leaves it; "
            "start from a shape on the side that it would fall to"
        )
        yield UnstableWarning, message
    if result.accuracy is not None and result.converged and not result.accuracy.regular:
        message = (
            f"the grids converge with order {result.accuracy.order:.2g} instead of 2, so the "
            f"results are those of the finest, {result.accuracy.finest_edges} edges"
        )
        yield AccuracyWarning, f"{message}: {result.scene._ladder.why_irregular}"
    elif result.accuracy is not None and result.converged and result.scene._ladder.unresolved:
        message = (
            f"{result.scene._ladder.why_irregular}: the errors that are told may be too small; "
            "smooth it, or give the places vertices (Rod.with_vertices)"
        )
        yield AccuracyWarning, message
    if result.accuracy is not None and result.converged and result.accuracy.of_rounding:
        message = (
            f"rounding allows no more than {result.accuracy.of_rounding}: they are small "
            "differences of large numbers, as the stretch of a stiff member is of lengths"
        )
        yield AccuracyWarning, message
    for number, rod in enumerate(result.rods):
        of = f" of rod {number}" if len(result.rods) > 1 else ""
        turn, vertex, stretch, edge, strain, strained, sheared = rod._source.doubts(rod.rod._rod)
        if stretch <= 0:
            message = (
                f"edge {edge}{of} is compressed to {stretch:.3g} of its length, turned inside "
                "out: the loads exceed what EA allows"
            )
            yield StrainWarning, message
        elif strain > MOST_STRAIN:
            stretched = f"stretched to {1 + strain:.4g} times its length"
            how = f"sheared by {strain:.3g}" if sheared else stretched
            message = (
                f"edge {strained}{of} is {how}: EA or GA and the loads do not fit, look at their "
                "units"
            )
            yield StrainWarning, message
        if turn > np.pi and result.accuracy is None:  # else it was solved on finer grids
            message = (
                f"the rod turns by {turn:.3g} rad at vertex {vertex}{of}: more edges are needed "
                "for the shape to mean anything"
            )
            yield StrainWarning, message


def refuse_drift(result: Equilibrium) -> None:
    """Forces that follow the rods, in directions in which nothing holds these: no equilibrium.

    Of dead forces it is known before the solve. A ring under pressure may drift, but need not.
    """
    scene = result.scene
    if not result.converged or not any(load.follower for load in scene.loads):
        return
    acting = np.vstack([rod.load for rod in result.rods] + [r.force for r in result.reactions])
    left = acting.sum(axis=0)
    for number, support in enumerate(scene.supports):
        if support._springs[0] == 0:
            free = support._free(scene._held(number)[1])
            left = left - (result.reactions[number].force @ free.T) @ free
    if np.linalg.norm(left) > 1e-6 * np.abs(acting).sum():
        raise ValueError(
            f"supports: nothing holds the rods against the force {left} of the loads that follow "
            "them; hold a point of them"
        )


def _print_iteration(
    energy: float, residual: float, step: float, part: float, shift: float
) -> None:
    notes = (f"  part {part:.2g}" if part < 1 else "") + (f"  shift {shift:.2e}" if shift else "")
    print(f"energy {energy:+.9e}  residual {residual:.2e}  step {step:.2e} rad{notes}", flush=True)
