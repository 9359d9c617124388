"""The linear response of an equilibrium."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from pyrod.base.calls import spelled
from pyrod.base.immutable import Array
from pyrod.base.optional import need
from pyrod.linear.grid import Grid
from pyrod.linear.inertia import Rotary
from pyrod.linear.numbers import all_paths
from pyrod.linear.rungs import Rungs, refuse_entries, refuse_of_one_grid
from pyrod.linear.stability_modes import StabilityModes, stability_modes_of
from pyrod.linear.told import Told
from pyrod.linear.vibration import Modes, modes_of
from pyrod.result.equilibrium import Equilibrium
from pyrod.rod.place import Place


@spelled
def linearised(result: Equilibrium) -> Linearised:
    """How an equilibrium answers to small changes of its scene, exactly, at the price of a solve of
    one linear system each.

    Of a result without a tolerance, those of the equilibrium on its own edges. Of one with, what
    those on its edges, on these halved, and so on tend to, with errors of their own.

    Parameters
    ----------
    result : Equilibrium
        Converged; any, stable or not.

    Raises
    ------
    ValueError
        It is no equilibrium.
    SingularEquilibrium
        A mode has no stiffness: at a critical load. (Where something may move freely there are
        derivatives of all that the motion does not change.)
    """
    return Linearised(result)


class Linearised:
    """Derivatives of an equilibrium; make one with `linearised`.

    Names of outputs are those of results: ``"positions"``, ``"frames"`` (of edges) and
    ``"vertex_frames"``, both as rotation vectors in the components of the frame,
    ``R <- R exp(phi)``; ``"rotations"`` of the vertices in space, what moments work on;
    ``"K"``, ``"moment"``, ``"Gamma"``, ``"force"``; ``"tip"``, ``"tip_frame"``; ``"energy"``;
    ``"reactions.0.force"`` and ``"reactions.0.moment"``; ``"tendons.0.length"`` and
    ``"tendons.0.tension"``. With several rods say ``"rods.1.positions"``; ``"multipliers"`` are the
    section forces with which spans begin. NaN is told where there is no derivative, or where it is
    not known: at vertices where a section jumps or a moment acts that no node takes, for forces
    that are not determined, and for what moves freely.

    Names of what changes are the paths of scenes, as in `sweep`: ``"loads.0.force"``,
    ``"supports.1.position"``, ``"supports.1.frame"`` (a rotation vector in its components),
    ``"supports.1.turns"``, ``"actuators.0.tension"`` or ``"actuators.0.length"``,
    ``"rods.0.K0"``, ``"rods.0.bending"``, ``"rods.0.edge_lengths"``.
    """

    def __init__(self, result: Equilibrium) -> None:
        self.result = result
        self.scene = result.scene
        self.errors: dict[str, float] = {}
        """Estimated errors of the last answer, by output and relative to the largest number of it;
        empty without a tolerance."""
        self._grid = Grid(result)
        self._rungs = Rungs(self._grid, self.errors)

    # Products -------------------------------------------------------------------------------------

    def jvp(self, changes: Mapping[str, Any]) -> Told:
        """What a small change of the scene does: derivatives of all outputs along it."""
        if not changes:
            raise ValueError("jvp: expected changes by their paths, got none")
        if not self._rungs.climbs:
            return self._grid.jvp(changes)
        refuse_entries(self._grid.entry(path) for path in changes)
        return Told(self._rungs.told(lambda grid: grid.jvp(changes)), self.scene)

    def vjp(
        self, weights: Mapping[str, Any], wrt: str | Iterable[str] | None = None
    ) -> dict[str, Array]:
        """The gradient of a weighted sum of outputs, in all that the scene consists of at once.

        With a tolerance outputs are those at vertices of the scene's own edges, and gradients in
        arrays along rods those in the scene's own numbers, between which finer edges interpolate.
        NaN: what pushes along a free motion, or leaves the plane of a planar scene; without ``wrt``
        also what rounding of a taut rod's length changes, which is refused by name.

        Parameters
        ----------
        weights : dict
            By names of outputs, arrays of their shapes.
        wrt : paths
            Default: stiffnesses and curvatures of all rods, loads, and supports.
        """
        paths = all_paths(self.scene) if wrt is None else _paths_of(wrt)
        if not self._rungs.climbs:
            return self._grid.vjp(weights, paths, wrt is not None)
        refuse_entries(self._grid.entry(path) for path in paths)
        refuse_of_one_grid(self.scene, weights, True)
        return self._rungs.limits(lambda grid: grid.vjp(weights, paths, wrt is not None))

    def jacobian(self, output: str, wrt: str | Iterable[str]) -> dict[str, Array]:
        """Derivatives of an output, by path: the shape of the output, then that of the entry.

        In planar scenes changes that leave the plane have none: NaN.
        """
        paths = _paths_of(wrt)
        if not self._rungs.climbs:
            return self._grid.jacobian(output, paths)
        refuse_entries(self._grid.entry(path) for path in paths)
        refuse_of_one_grid(self.scene, [output], False)
        return self._rungs.limits(lambda grid: grid.jacobian(output, paths))

    def operator(self, output: str, wrt: str) -> Any:
        """The same as a ``LinearOperator`` of SciPy, of flat arrays, never formed."""
        linalg = need("scipy.sparse.linalg", "all")
        shape, entry = self._grid.shape(output), self._grid.entry(wrt)

        def forward(v: Array) -> Array:
            return np.reshape(self.jvp({wrt: np.reshape(v, entry.shape)})[output], -1)

        def backward(w: Array) -> Array:
            return self.vjp({output: np.reshape(w, shape)}, wrt)[wrt].reshape(-1)

        size = (int(np.prod(shape)), entry.size)
        return linalg.LinearOperator(size, matvec=forward, rmatvec=backward, dtype=np.float64)

    # Compliance, stiffness, vibration -------------------------------------------------------------

    def compliance(self, at: Place = "end") -> Array:
        """(6, 6) displacement [m] and rotation vector [rad] of a place under unit force and moment
        there, dead, all in space.

        The rotation of a vertex is what a moment works on: the mean of those of the edges beside,
        as by a lever, or that of the node that holds it. ``at`` must be a vertex. In planar scenes
        columns of loads that leave the plane are NaN.
        """
        rod, vertex = self.scene._compiled.vertex(at)
        s = self.scene.rods[rod].arc_lengths[vertex]
        place = at[1] if isinstance(at, tuple) else at
        if not isinstance(place, str) and abs(place - s) > 1e-9 * self.scene.rods[rod].length:
            raise ValueError(f"at: there is no vertex at {place:g}; the nearest is at {s:g}")
        return self._rungs.limit("compliance", lambda grid: grid.compliance(at))

    def stiffness(self, support: int = 0) -> Array:
        """(6, 6) changes of the force and the moment that a support exerts, about its own point,
        under unit motions of it: of its point, and of its frame about the axes of space.

        Columns of what the support leaves free are zero.
        """
        if not 0 <= support < len(self.scene.supports):
            raise ValueError(f"support: there are {len(self.scene.supports)}, got {support}")
        return self._rungs.limit("stiffness", lambda grid: grid.stiffness(support))

    def modes(self, count: int = 6, *, rotary: Rotary = False) -> Modes:
        """The lowest modes of vibration about the equilibrium.

        Masses are those of the sections, and of the scene's `PointMass`. By SciPy's methods of
        Lanczos and, of loads without a potential, Arnoldi.

        Parameters
        ----------
        count : int
            How many.
        rotary : bool, (3,) or (rods, 3) array [kg m]
            Whether cross-sections resist turning, and torsion vibrates, too: by the outlines of the
            sections; or moments of inertia per length about a1, a2, a3, of all rods or one row for
            each. Bodies resist as their ``inertia`` says, anyway.

        Raises
        ------
        ValueError
            Rods without a mass, or without an outline; an unstable equilibrium under loads that
            have a potential; fewer modes than asked for on these edges.
        """
        return modes_of(self._rungs, count, rotary)

    def stability_modes(self, count: int = 6) -> StabilityModes:
        """The motions in which the energy grows least, or falls most: the lowest modes of the
        second variation, of which `Equilibrium` tells the first.

        ``count`` is how many. Of loads without a potential, and where something may move freely,
        there are none.
        """
        return stability_modes_of(self._rungs, count)

    def __repr__(self) -> str:
        return f"Linearised({self.scene!r})"


def _paths_of(wrt: str | Iterable[str]) -> list[str]:
    return [wrt] if isinstance(wrt, str) else list(wrt)
