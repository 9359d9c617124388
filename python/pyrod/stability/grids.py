"""Critical loads on a scene's edges, on these halved, and so on."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from pyrod._core import Options
from pyrod.base.immutable import Array
from pyrod.result.equilibrium import Equilibrium
from pyrod.rotation import as_frames
from pyrod.scene.scene import Scene
from pyrod.stability.path import Path
from pyrod.stability.reach import Reach
from pyrod.stability.state import Loss, halved


class Grids:
    """The grids of a scene, each with edges half as long as those of the one before.

    Where a function of arc length jumps or has a kink inside an edge, that is cut.
    """

    def __init__(
        self,
        scene: Scene,
        growing: frozenset[int],
        options: Options,
        start: Equilibrium | ArrayLike | None,
    ) -> None:
        self._scene = scene._climbing
        self.first = self._scene.refined(0)  #: the scene on its own edges
        self._start = None if start is None else scene._compiled.on_climbing_edges(_frames(start))
        self._more = growing, options
        self._paths: list[Path] = []

    def path(self, level: int) -> Path:
        """Where the edges are cut in 2^level."""
        if not self._paths:
            self._paths.append(Path(self.first, *self._more, self._start))
        while len(self._paths) <= level:
            before = halved(self._paths[-1].start.result)
            grid = self._scene.refined(len(self._paths))
            self._paths.append(Path(grid, *self._more, before))
        return self._paths[level]

    def losses(self, reach: Reach, rtol: float) -> list[Loss]:
        """Where stability is lost on each.

        If that is on none of the first two, there are no others. If it is near the largest factor,
        some grids may need a little more. Functions of arc length that are not smooth are seen on
        a fourth.
        """
        losses = [self.path(level).loss(reach, rtol) for level in range(2)]
        found = [loss.factor for loss in losses if loss.kind != "none"]
        if not found:
            return losses
        more = reach.up_to(1.5 * max(found))
        for level, loss in enumerate(losses):
            if loss.kind == "none":
                near = self.path(level).loss_near(max(found), loss.states, more, rtol)
                losses[level] = near
        for level in range(2, 4 if self._has_functions() else 3):
            losses.append(self.path(level).loss_like(losses[-1], more, rtol))
        _refuse_different(losses)
        return losses

    def _has_functions(self) -> bool:
        functions = (callable(load.acting) for load in self._scene.loads)
        return any(functions) or self.first._compiled.rods_are_asked


def _refuse_different(losses: list[Loss]) -> None:
    if len({loss.kind for loss in losses}) > 1:
        told = "; ".join(
            "none" if loss.kind == "none" else f"{loss.kind} at a factor of {loss.at.factor:.6g}"
            for loss in losses
        )
        raise RuntimeError(
            f"the scene's edges, these halved, and so on, differ in what is there: {told}; give "
            "rods more edges"
        )


def _frames(start: Equilibrium | ArrayLike) -> Array:
    if isinstance(start, Equilibrium):
        return np.vstack([rod.frames for rod in start.rods])
    return as_frames(start, "start")
