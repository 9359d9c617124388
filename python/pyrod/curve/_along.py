"""Places along an arc: what polylines tell between vertices and edges, and beside themselves."""

from __future__ import annotations

from numpy.typing import ArrayLike

from pyrod.base.arrays import Array
from pyrod.base.borrowed import borrowed
from pyrod.curve._ends import Ends
from pyrod.curve._knots import Nearest


class Along:
    """The part of a `Polyline` that takes means along it and finds places on it."""

    @borrowed("pyrod.curve._averages:derivative")
    def derivative(self, parameter: ArrayLike) -> Array:  # type: ignore[empty-body]
        """(n, 3) derivative by a parameter, l/h: second order at the centres of the intervals."""

    @property
    @borrowed("pyrod.curve._averages:vertex_tangents")
    def vertex_tangents(self) -> Array:  # type: ignore[empty-body]
        """Unit tangents at the vertices that halve the turn; a free end has that of its edge."""

    @property
    @borrowed("pyrod.curve._averages:circle_tangents")
    def circle_tangents(self) -> Array:  # type: ignore[empty-body]
        """Unit tangents at the vertices of the circles through three of them."""

    @borrowed("pyrod.curve._averages:at_vertices")
    def at_vertices(  # type: ignore[empty-body]
        self, values: ArrayLike, *, ends: Ends = "free"
    ) -> Array:
        """Values given per edge, (n, ...), at the vertices: linear between the edge centres."""

    @borrowed("pyrod.curve._averages:at_centres")
    def at_centres(self, values: ArrayLike) -> Array:  # type: ignore[empty-body]
        """Values given per vertex at the centres of the edges, (n, ...): the mean of two."""

    @borrowed("pyrod.curve._places:at_arc_lengths")
    def at(self, s: ArrayLike, values: ArrayLike | None = None) -> Array:  # type: ignore[empty-body]
        """Points of the arc, or values given per vertex, by arc length."""

    @borrowed("pyrod.curve._places:nearest")
    def nearest(self, points: ArrayLike) -> Nearest:  # type: ignore[empty-body]
        """Where the arc is nearest to points."""

    @borrowed("pyrod.curve._noise:estimated_noise")
    def estimated_noise(self) -> Array:  # type: ignore[empty-body]
        """(3,) standard deviations [m] of the noise of the positions along x, y, z."""
