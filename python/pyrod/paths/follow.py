"""Following equilibria."""

from __future__ import annotations

from math import isfinite
from typing import Any

import pyrod._core as _core
from pyrod._core import Options
from pyrod.base.arrays import number, whole
from pyrod.base.calls import spelled
from pyrod.base.progress import Progress, progress_shown
from pyrod.paths.branch import Branch
from pyrod.paths.family import Family, Scenes
from pyrod.paths.limits import extrapolated
from pyrod.result.accuracy import checked_tolerance
from pyrod.result.equilibrium import Equilibrium
from pyrod.solving.job import DEFAULTS
from pyrod.solving.run import solved
from pyrod.stability.state import halved

_LEAST = 1e-3
"""Of the range: what errors of values are relative to at the least."""


@spelled
def follow(
    family: Family,
    start: float,
    stop: float,
    tol: float | None = None,
    *,
    max_points: int = 500,
    equilibrium: Equilibrium | None = None,
    options: Options | None = None,
    progress: bool | Progress = False,
) -> Branch:
    """The equilibria of scenes as a number changes, followed from one to the next.

    Steps go along the path, not along the number: they go on where the number turns back (a fold)
    and where another branch crosses (a bifurcation). Both are found to rounding, on the edges of
    the scenes, and the branch that crosses can be followed from there.

    Parameters
    ----------
    family : function, or (scene, path, direction)
        A function of the number that makes a scene, each with the same rods, edges, supports and
        joints; or a scene, the path of an entry as in `sweep`, and what is added to that entry per
        unit of the number: ``(scene, "loads.0.force", (0, 0, -1))``, ``(scene,
        "supports.1.position.0", 1.0)``; to a frame, a rotation vector in its components. Forces,
        moments that do not follow, and positions are the quickest.
    start, stop : float
        The number at the start, and where the path ends. It also ends as far on the other side of
        ``start``.
    tol : float
        Largest error wanted of the values of special points, relative to these, or to a thousandth
        of the range where they are smaller: they are followed on the edges of the scenes, on these
        halved, and so on, and extrapolated. The points of the branch stay on the first of these.
        Default: no other edges than those of the scenes.
    max_points : int
        Points at the most; default 500.
    equilibrium : `Equilibrium`
        The one at ``start``, of a scene with the same edges, stable or not; default: what `solve`
        finds.
    options : `Options`
        Of the solve at ``start``.
    progress : bool or function
        True: a bar on standard error; or a function of the number of points and ``max_points``.

    Returns
    -------
    Branch
        Ctrl-C ends it, too, and keeps what was found: then ``ended`` is "interrupted".

    Raises
    ------
    ValueError
        The scenes differ in more than numbers, or there is no equilibrium at ``start``.

    Warns
    -----
    AccuracyWarning
        ``tol`` was not reached.
    """
    start, stop = number(start, "start"), number(stop, "stop")
    if not (isfinite(start) and isfinite(stop) and start != stop):
        raise ValueError(f"stop: must be finite and differ from start, got {start} and {stop}")
    max_points = whole(max_points, "max_points")
    tol = None if tol is None else checked_tolerance(tol)

    def on(level: int | None, near: Equilibrium | None, show: Any) -> Branch:
        scenes = Scenes(family, level)
        if level and near is not None:
            near = solved(scenes(start), start=halved(near), stable=False)
        given: Any = None if near is None else near._compiled
        look = None if show is None else lambda points, _: show(points)
        settings = options or DEFAULTS
        found = _core.follow(scenes.compiled, start, stop, max_points, given, settings, look)
        return Branch(found, scenes, (start, stop, max_points))

    with progress_shown(progress, max_points, "points") as show:
        if tol is None:
            return on(None, equilibrium, show)
        least = _LEAST * abs(stop - start)
        return extrapolated(lambda level, near: on(level, near, show), equilibrium, tol, least)
