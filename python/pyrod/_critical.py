"""The load under which a scene loses its stability."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from math import inf, isfinite, nan, pi

import numpy as np
from numpy.typing import ArrayLike

from pyrod import _core
from pyrod._core import Options
from pyrod._effects import on_its_grid
from pyrod._immutable import Array, Immutable
from pyrod._path import Kind, Loss, Path
from pyrod._solve import solve
from pyrod.equilibrium import Equilibrium
from pyrod.rotation import as_frames
from pyrod.scene import Scene


@dataclass(frozen=True, eq=False, repr=False)
class Critical(Immutable):
    """Where an equilibrium loses its stability as its loads grow."""

    kind: Kind
    """"bifurcation": the equilibrium goes on, but is unstable; "limit point": it comes to an end,
    and the rod snaps; "none": it is stable up to the largest factor that was tried."""
    factor: float  #: of the loads, extrapolated from two grids; infinite if there is none
    error: float  #: estimate of the error of ``factor``: the difference to that of the finer grid
    equilibrium: Equilibrium
    """On the scene's edges, at their own critical load; of limit points, just below it; if there is
    none, under the largest loads that were tried."""
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
        amplitude : largest turn [rad] of the shape, along the mode, from which it is looked for;
            its sign says to which side. Default 0.1.
        beyond : how far the loads exceed those of ``equilibrium``, relative to them; default 0.01.

        Raises
        ------
        ValueError : there is no critical load.
        NotConverged : no equilibrium is found.
        """
        if self.kind == "none":
            raise ValueError("buckled: no critical load was found, see kind")
        scene = self._path.scene((1 + beyond) * self.grid_factor)
        return solve(scene, start=self.equilibrium.along_mode(amplitude))

    def __repr__(self) -> str:
        if self.kind == "none":
            return f"Critical(none, stable up to factor {self.grid_factor:.6g})"
        after = "no equilibrium" if self.index_after is None else f"index {self.index_after}"
        return f"Critical({self.kind}, factor {self.factor:.9g} ± {self.error:.1g}, then {after})"


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
    (SciPy). All is done on the scene's edges and on these halved, and extrapolated. An imperfect
    column bends more and more, but has no critical load.

    Parameters
    ----------
    scene : a scene whose loads have a potential. Rods that leave their edges to the solver have
        those that it starts from.
    upper : the largest factor that is tried; default: a hundred times that under which a hinged
        column would buckle (pi^2 EI/L^2, softest bending, longest rod, sum of all loads).
    loads : numbers of the loads that grow, in the order of the scene; default: all. The others act
        as they are.
    start : what the equilibrium without the growing loads is looked for from, an equilibrium or
        frames (n, 4) or (n, 3, 3) of the edges of all rods; default: the shape at rest.
    rtol : relative error of the factor on each grid; default 1e-8.
    options : see `solve`.

    Raises
    ------
    ValueError : loads that follow the rods or have no potential otherwise; a scene that is
        unstable, or can move freely, without them.
    NotConverged : without the loads no equilibrium is found.
    RuntimeError : the equilibrium cannot be followed, or two grids do not agree.
    """
    growing = _growing(scene, loads)
    if not 0 < rtol < 0.1:
        raise ValueError(f"rtol: must be in (0, 0.1), got {rtol}")
    if upper is not None and not (isfinite(upper) and upper > 0):
        raise ValueError(f"upper: must be positive and finite, got {upper}")
    guess = _hinged(scene, growing)
    upper = 100 * guess if upper is None else upper
    grids = on_its_grid(scene._ladder.scene), scene._ladder._at(1)
    frames = _frames(start)
    frames = None if frames is None else scene._ladder.brought(frames)
    starts = frames, None if frames is None else np.repeat(frames, 2, axis=0)
    paths = [
        Path(grid, growing, options or Options(), on)
        for grid, on in zip(grids, starts, strict=True)
    ]
    coarse, fine = (path.loss(upper, min(guess, upper) / 16, rtol) for path in paths)
    if coarse.kind != fine.kind:
        raise RuntimeError(
            f"on the scene's edges there is {_told(coarse)}, on these halved {_told(fine)}; give "
            "rods more edges"
        )
    return _critical(paths[0], coarse, fine)


def _critical(path: Path, coarse: Loss, fine: Loss) -> Critical:
    at = coarse.at
    factor, error = inf, nan
    if coarse.kind != "none":
        change = (fine.at.factor - at.factor) / 3  # errors are of second order
        factor, error = fine.at.factor + change, abs(change)
    return Critical(coarse.kind, factor, error, at.result, at.factor, coarse.index_after, path)


def _frames(start: Equilibrium | ArrayLike | None) -> Array | None:
    if start is None:
        return None
    if isinstance(start, Equilibrium):
        return np.vstack([rod.frames for rod in start.rods])
    return as_frames(start, "start")


def _told(loss: Loss) -> str:
    return "none" if loss.kind == "none" else f"a {loss.kind} at a factor of {loss.at.factor:.6g}"


def _growing(scene: Scene, loads: Iterable[int] | None) -> frozenset[int]:
    count = len(scene.loads)
    growing = frozenset(range(count) if loads is None else loads)
    if not growing or not growing <= set(range(count)):
        raise ValueError(f"loads: expected numbers below {count}, got {sorted(growing)}")
    if any(load.follower for load in scene.loads):
        raise ValueError(
            "loads: those that follow the rods have no potential, so that stability is a matter "
            "of motion, not of energy"
        )
    return growing


def _hinged(scene: Scene, growing: frozenset[int]) -> float:
    """The factor under which a hinged column would buckle."""
    length = max(rod.length for rod in scene.rods)
    bending = min(rod.bending[:, :2].min() for rod in scene.rods)
    acting = tuple(_core.Loads(rod._rod) for rod in scene.rods)
    for number in growing:
        scene.loads[number]._apply(acting, scene.rods)
    sizes = [_size(on, length) for on in acting]
    if sum(sizes) == 0:
        raise ValueError("loads: all that are to grow are zero")
    return pi**2 * bending / length**2 / sum(sizes)


def _size(loads: _core.Loads, length: float) -> float:
    moments = loads.moment, loads.start_moment[None], loads.end_moment[None]
    sums = [np.linalg.norm(values, axis=1).sum() for values in (loads.force, *moments)]
    return float(sums[0] + sum(sums[1:]) / length)
