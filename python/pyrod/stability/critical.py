"""The load under which a scene loses its stability."""

from __future__ import annotations

import warnings
from collections.abc import Iterable
from dataclasses import dataclass, field
from math import inf, isfinite, nan

from numpy.typing import ArrayLike

from pyrod._core import Options
from pyrod.base.arrays import number
from pyrod.base.calls import spelled, users_level
from pyrod.base.immutable import Array, Immutable
from pyrod.base.words import shortly
from pyrod.notebook.table import Row, page
from pyrod.notebook.views import pictured
from pyrod.pictures.displaced import shown_mode
from pyrod.result.equilibrium import Equilibrium
from pyrod.result.errors import AccuracyWarning
from pyrod.scene.scene import Scene, checked_scene
from pyrod.solving.run import solved, warn_of
from pyrod.stability.grids import Grids
from pyrod.stability.limit import limit_of
from pyrod.stability.path import Path
from pyrod.stability.reach import Reach
from pyrod.stability.state import Loss, LossKind


@dataclass(frozen=True, eq=False, repr=False)
class Critical(Immutable):
    """Where an equilibrium loses its stability as its loads grow."""

    kind: LossKind
    """"bifurcation", the equilibrium goes on, but is unstable; "limit point", it comes to an end,
    and the rod snaps; "none", it is stable up to the largest factor that was tried."""
    factor: float  #: of the loads, extrapolated from three grids; infinite if there is none
    error: float
    """Estimate of the error of ``factor``, that of the grids, and of the search on them."""
    equilibrium: Equilibrium
    """On the scene's edges, at their own critical load; of limit points, just below it; if there is
    none, under the largest loads that were tried. Edges are cut where something jumps inside."""
    grid_factor: float  #: of the loads of ``equilibrium``
    index_after: int | None  #: stability index above; None if there is no such equilibrium
    _path: Path = field(repr=False, compare=False)

    @property
    def mode(self) -> Array | None:
        """(edges of all rods, 3) turns of the edges in their frames [rad] in the critical mode."""
        return self.equilibrium.mode

    def buckled(self, amplitude: float = 0.1, beyond: float = 0.01) -> Equilibrium:
        """The stable equilibrium beyond the critical load.

        Parameters
        ----------
        amplitude : float [rad]
            Largest turn of the shape, along the mode, from which it is looked for; its sign says to
            which side. Default 0.1.
        beyond : float
            How far the loads exceed those of ``equilibrium``, relative to them; default 0.01.

        Raises
        ------
        ValueError
            There is no critical load.
        NotConverged
            No equilibrium is found.
        """
        if self.kind == "none":
            raise ValueError("buckled: no critical load was found, see kind")
        scene = self._path.scene((1 + beyond) * self.grid_factor)
        return solved(scene, start=self.equilibrium.along_mode(amplitude))

    def _repr_html_(self) -> str:
        """What notebooks show: the equilibrium; dashed: displaced along its mode."""
        moved = [] if self.mode is None else shown_mode(self.equilibrium)
        rows = [
            Row("kind", self.kind),
            Row("factor", self.factor),
            Row("error of the factor", self.error),
            Row("factor on the scene's edges", self.grid_factor),
            Row("index above", "no equilibrium" if self.index_after is None else self.index_after),
        ]
        return page("Critical load", rows, *pictured(self.equilibrium, moved))

    def __repr__(self) -> str:
        if self.kind == "none":
            return f"Critical(none, stable up to factor {self.grid_factor:.6g})"
        after = "no equilibrium" if self.index_after is None else f"index {self.index_after}"
        return f"Critical({self.kind}, factor {self.factor:.9g} ± {self.error:.1g}, then {after})"


@spelled
def critical_load(
    scene: Scene,
    upper: float | None = None,
    *,
    loads: Iterable[int] | None = None,
    start: Equilibrium | ArrayLike | None = None,
    rtol: float = 1e-8,
    options: Options | None = None,
) -> Critical:
    """The smallest factor of the loads under which an equilibrium loses its stability.

    The equilibrium is followed from that without the loads, in steps that are small where it
    changes fast; where its lowest eigenvalue passes zero, the root is found by Brent's method
    (SciPy). All is done on the scene's edges, on these halved and halved again, and extrapolated.
    Where a function of arc length jumps inside an edge, that is cut in two. An imperfect column
    bends more and more, but has no critical load.

    Parameters
    ----------
    scene : `Scene`
        A scene whose loads have a potential. Rods that leave their edges to the solver have those
        that it starts from.
    upper : float
        The largest factor that is tried; default: a hundred times that under which the stiffest rod
        would buckle as a hinged column (pi^2 EI/L^2 of the shortest, sum of all loads) if they make
        the scene stiffer, else as many as its edges can tell (4 EI/h^2), or until they turn it
        inside out.
    loads : sequence of int
        Numbers of the loads that grow, in the order of the scene; default: all. The others act as
        they are.
    start : `Equilibrium`, (n, 4) or (n, 3, 3) array
        What the equilibrium without the growing loads is looked for from, an equilibrium or frames
        of the edges of all rods; default: the shape at rest.
    rtol : float
        Relative error of the factor on each grid; default 1e-8.
    options : `Options`
        See `solve`.

    Raises
    ------
    ValueError
        Loads that follow the rods or have no potential otherwise; a scene that is unstable, or can
        move freely, without them.
    NotConverged
        Without the loads no equilibrium is found.
    RuntimeError
        The equilibrium cannot be followed, or the grids do not agree.

    Warns
    -----
    AccuracyWarning
        The grids do not converge as they should, so that nothing was extrapolated.
    StrainWarning
        As in `solve`.
    """
    growing = _growing(checked_scene(scene), loads)
    rtol = number(rtol, "rtol")
    if not 0 < rtol < 0.1:
        raise ValueError(f"rtol: must be in (0, 0.1), got {rtol}")
    upper = None if upper is None else number(upper, "upper")
    if upper is not None and not (isfinite(upper) and upper > 0):
        raise ValueError(f"upper: must be positive and finite, got {upper}")
    grids = Grids(scene, growing, options or Options(), start)
    reach = Reach(grids.first, growing, upper)
    return _critical(grids.path(0), grids.losses(reach, rtol))


def _critical(path: Path, losses: list[Loss]) -> Critical:
    first = losses[0]
    factor, error = inf, nan
    if first.kind != "none":
        limit = limit_of([loss.factor for loss in losses], [loss.error for loss in losses])
        factor, error = limit.value, limit.error
        if limit.order is not None:
            message = (
                f"the critical loads of the grids converge with order {limit.order:.2g} instead "
                "of 2, so that of the finest is told: a load, a section or the curvature is not "
                "smooth inside an edge; give that place a vertex (Rod.with_vertices)"
            )
            warnings.warn(message, AccuracyWarning, stacklevel=users_level())
    warn_of(first.at.result)
    after = first.index_after
    return Critical(first.kind, factor, error, first.at.result, first.at.factor, after, path)


def _growing(scene: Scene, loads: Iterable[int] | None) -> frozenset[int]:
    count = len(scene.loads)
    able = frozenset(i for i, load in enumerate(scene.loads) if load.grows)
    growing = able if loads is None else frozenset(loads)
    if not growing or not growing <= set(range(count)):
        raise ValueError(f"loads: expected numbers below {count}, got {shortly(list(growing))}")
    if not growing <= able:
        raise ValueError("loads: masses do not grow; name the Gravity that acts on them")
    if any(load.follower for load in scene.loads):
        raise ValueError(
            "loads: those that follow the rods have no potential, so that stability is a matter "
            "of motion, not of energy"
        )
    return growing
