"""How an arc winds around itself: what polylines tell of writhe, link and nearness."""

from __future__ import annotations

from pyrod.base.arrays import Array
from pyrod.base.borrowed import borrowed
from pyrod.curve._knots import Approach


class Winding:
    """The part of a `Polyline` that goes over all pairs of edges."""

    @borrowed("pyrod.curve._link:holonomy")
    def holonomy(self) -> float:  # type: ignore[empty-body]
        """Angle [rad] in (-pi, pi] by which parallel transport once around turns a frame."""

    @borrowed("pyrod.curve._link:writhe")
    def writhe(self, threads: int = 0) -> float:  # type: ignore[empty-body]
        """Writhe, exact for the polygon. O(n^2), on all cores unless ``threads`` says how many."""

    @borrowed("pyrod.curve._crossings:local_writhe")
    def local_writhe(self, window: float) -> Array:  # type: ignore[empty-body]
        """Writhe of the stretch of a given length around each vertex."""

    @borrowed("pyrod.curve._link:frenet_link")
    def frenet_link(self, threads: int = 0) -> int:  # type: ignore[empty-body]
        """Linking number of a closed arc with its Frenet ribbon: writhe plus total torsion/2 pi."""

    @borrowed("pyrod.curve._link:self_approach")
    def self_approach(self, threads: int = 0) -> Approach:  # type: ignore[empty-body]
        """Smallest distance between two parts of the arc that are not near along it."""
