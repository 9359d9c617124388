"""Solving a scene, in the model that is wanted."""

from __future__ import annotations

from collections.abc import Callable
from time import perf_counter
from typing import Literal

from numpy.typing import ArrayLike

from pyrod._core import Options
from pyrod.base.calls import spelled
from pyrod.base.progress import iterations
from pyrod.models.choice import in_model, smallest_model
from pyrod.result.equilibrium import Equilibrium
from pyrod.rod.section import Model
from pyrod.scene.scene import Scene, checked_scene
from pyrod.solving.job import DEFAULTS, How
from pyrod.solving.run import judge, print_iteration, unjudged


@spelled
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
    scene : `Scene`
        The rods, their supports, joints and loads.
    options : `Options`
        Tolerances and limits; see `Options`.
    tol : float
        The largest relative error wanted, of positions, frames, curvatures, forces, moments, energy
        and reactions, in (0, 0.1]; estimates come with the result (``errors``). The scene's edges
        are halved as often as needed; the result is told at their ends, which is all edges that a
        user gave. Default: the grid as it is, and 1e-6 where rods leave their edges to the solver.
    model : "cosserat", "extensible", "inextensible" or "auto"
        The model of all rods, in place of their own; "auto": the smallest, and the plane if that
        will do, in which results differ by less than ``tol`` from those with all strains whose
        stiffnesses are finite. What was chosen, and why, is in ``choice``; see `smallest_model`.
    start : `Equilibrium`, (n, 4) or (n, 3, 3) array
        An equilibrium of a similar scene with as many edges, or frames of the edges of all rods, to
        start from; default: the shape at rest, bent into the supports. A start is trusted to be
        near.
    strict : bool
        Raise `NotConverged` if no equilibrium is found; otherwise look at ``status``.
    verbose : bool
        Print a line per iteration.
    stable : bool
        Look for a stable equilibrium, and leave saddles along their unstable modes. Otherwise take
        the equilibrium that Newton's method leads to.
    eigenvalue : bool
        Find the lowest eigenvalue of the second variation, too.
    progress : bool
        Show the iterations on standard error once half a second has passed, and of a tolerance the
        grids, the edges of the finest, and the error reached so far.

    Raises
    ------
    NotConverged
        With the last iterate in ``.result``; also where ``tol`` is not reached, with the best
        answer that was, and its errors.
    KeyboardInterrupt
        Ctrl-C is looked for once per iteration.

    Warns
    -----
    UnstableWarning
        The equilibrium found is a saddle of the energy, though a stable one was wanted.
    StrainWarning
        An edge is stretched or sheared by more than three times its length or turned inside out, or
        neighbours turn by more than pi.
    AccuracyWarning
        The grids do not converge as they should, so that nothing was extrapolated.
    """
    checked_scene(scene)
    how = How(options or DEFAULTS, stable, eigenvalue, tol)
    if progress and not verbose:
        with iterations() as show:
            result = found(scene, how, model, start, show)
    else:
        result = found(scene, how, model, start, print_iteration if verbose else None)
    judge(result, strict, verbose)
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
        scene, choice = _chosen(scene, model, how.tol)
    return unjudged(scene, how, start, trace, choice, began)


def _chosen(
    scene: Scene, model: Literal["auto"] | Model, tol: float | None
) -> tuple[Scene, str | None]:
    """The scene with another model, and why."""
    if model != "auto":
        return in_model(scene, model), None
    if tol is None:
        raise ValueError("model: 'auto' needs tol, the error that is allowed")
    choice = smallest_model(scene, tol)
    return choice.scene, choice.text
