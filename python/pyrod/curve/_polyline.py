"""Polygonal arcs: discrete Frenet curves, parallel transport, knots."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, Literal, Union

import numpy as np
from numpy.typing import ArrayLike

import pyrod._core as _core
from pyrod.base.arrays import number, precision_of, yes_or_no
from pyrod.base.borrowed import borrowed
from pyrod.base.immutable import Array, Immutable, Once, frozen, sealed
from pyrod.curve._along import Along
from pyrod.curve._ends import Ends, Spacing, torsion_lengths, with_ends
from pyrod.curve._knots import Approach
from pyrod.curve._points import (
    direction,
    positions_of,
    refuse_folds,
    refuse_gaps,
    straight_angles,
    warn_of_near_repeats,
)
from pyrod.curve._shown import Shown
from pyrod.curve._spline import SmoothCurve
from pyrod.curve._strains import Measure, checked_measure
from pyrod.curve._winding import Winding

NO_ANGLE = 0.0
"""The default, for which nothing is turned."""


@dataclass(frozen=True, eq=False, init=False, repr=False)
class Polyline(Along, Winding, Shown, Immutable):
    """A polygonal arc of n edges in space, open or closed (Linn 2020, sect. 4 and A.3).

    Angles and curvatures are invariant under rigid motion. Values at vertices are those of the
    cells around them, which have half a length at the ends of an open arc.

    Parameters
    ----------
    positions : (n + 1, 3) array [m]
        Vertices of an open arc, (n, 3) of a closed one, whose last edge leads back to vertex 0. Two
        columns are taken for points of the plane z = 0.
    closed : bool
        Whether the arc is closed.
    start_tangent, end_tangent : (3,) array
        Directions that hold the ends of an open arc. The half cell between such a direction and the
        edge turns; without one, an end has the direction of its edge, and its half cell does not
        turn: its curvature is then 0.
    straight : float [rad]
        Vertices that turn by no more than this angle have no binormal of their own and take that of
        the vertex before. Those that turn by no more than the rounding of the positions explains
        always count as straight, of single precision if they came in it.
    resolution : float [m]
        What the positions are known to. Vertices that turn by no more than it explains count as
        straight, too. Default: only the rounding of the numbers.

    Raises
    ------
    ValueError
        Shape, numbers that are not finite, neighbours that coincide (`without_repeats` helps),
        neighbouring edges that are antiparallel; with the index and the remedy.

    Warns
    -----
    CurveWarning
        A point nearly repeats the one before, which spoils curvature and torsion.
    """

    positions: Array
    closed: bool
    start_tangent: Array | None
    end_tangent: Array | None
    straight: float
    resolution: float | None
    precision: float = field(compare=False)
    """Relative rounding of the positions as they came."""

    def __init__(
        self,
        positions: ArrayLike,
        closed: bool = False,
        start_tangent: ArrayLike | None = None,
        end_tangent: ArrayLike | None = None,
        straight: float = 0.0,
        resolution: float | None = None,
    ) -> None:
        straight = number(straight, "straight")
        if not 0 <= straight < np.pi:
            raise ValueError(f"straight: must be an angle in [0, pi), got {straight}")
        if resolution is not None:
            resolution = number(resolution, "resolution")
            if not 0 <= resolution < np.inf:
                raise ValueError(f"resolution: must be finite and not negative, got {resolution}")
        r, flat = positions_of(positions)
        refuse_gaps(r)
        self._set(
            positions=frozen(r),
            closed=yes_or_no(closed, "closed"),
            start_tangent=direction(start_tangent, "start_tangent", flat),
            end_tangent=direction(end_tangent, "end_tangent", flat),
            straight=straight,
            resolution=resolution,
            precision=precision_of(positions),
        )
        _ = self._compiled  # refuses what is no arc
        if resolution is not None or self.precision > np.finfo(np.float64).eps:
            refuse_folds(self)
        warn_of_near_repeats(self)

    @Once
    def _compiled(self) -> _core.curve.Arc:
        return _core.curve.Arc(self.positions, self.closed, self.start_tangent, self.end_tangent)

    @borrowed("pyrod.notebook.views:polyline_html")
    def _repr_html_(self) -> str:  # type: ignore[empty-body]
        """What notebooks show."""

    def __repr__(self) -> str:
        kind = "closed" if self.closed else "open"
        return f"Polyline({kind}, edges={self.edges}, length={self.length:g})"

    # Lengths and directions -----------------------------------------------------------------------

    @property
    def edges(self) -> int:
        """Number n of edges."""
        return len(self.positions) - (not self.closed)

    @property
    def length(self) -> float:
        """Sum of the edge lengths [m]."""
        return float(self._compiled.arc_lengths[-1])

    @property
    def edge_vectors(self) -> Array:
        """(n, 3) differences l of neighbouring vertices."""
        ends = self.positions[:1] if self.closed else self.positions[:0]
        return np.diff(self.positions, axis=0, append=ends)

    @cached_property
    def edge_lengths(self) -> Array:
        """(n,) lengths of the edges, the grid of discrete arc length."""
        return sealed(self._compiled.edge_lengths)

    @cached_property
    def cell_lengths(self) -> Array:
        """Lengths of the cells around the vertices, half of the edges before and behind."""
        return sealed(self._compiled.cell_lengths)

    @cached_property
    def arc_lengths(self) -> Array:
        """Arc length at the vertices. Second order in that of a smooth curve through them."""
        return sealed(self._compiled.arc_lengths[: len(self.positions)])

    @property
    def centre_arc_lengths(self) -> Array:
        """(n,) arc length at the centres of the edges."""
        return self.arc_lengths[: self.edges] + self.edge_lengths / 2

    @property
    def centres(self) -> Array:
        """(n, 3) centres of the edges."""
        return self.positions[: self.edges] + self.edge_vectors / 2

    @cached_property
    def tangents(self) -> Array:
        """(n, 3) unit tangents of the edges."""
        return sealed(self._compiled.tangents())

    # Frenet ---------------------------------------------------------------------------------------

    @cached_property
    def turning_angles(self) -> Array:
        """Angles theta [rad] between the directions before and behind each vertex, from 0 to pi."""
        return sealed(self._compiled.turning_angles())

    def curvature(self, measure: Measure = "log", *, ends: Ends = "free") -> Array:
        """Frenet curvature kappa = theta/cell length at the vertices, Linn (3).

        ``measure`` names how the turn is measured, see `Measure`. At an end that no tangent holds
        the curvature is 0; ``ends="continued"`` gives it that of its neighbour.
        """
        turns = _core.curve.measured(self.turning_angles, checked_measure(measure))
        return with_ends(self, turns / self.cell_lengths, ends)

    @cached_property
    def binormals(self) -> Array:
        """Unit axes b of the turns at the vertices.

        A straight vertex takes the axis of the one before by parallel transport (at the start: that
        of the first bent one); a straight arc gets one of its normals. At an inflection in a plane
        the axis turns by pi from one vertex to the next.
        """
        return sealed(self._compiled.binormals(straight_angles(self)))

    def curvature_binormals(self, measure: Measure = "log") -> Array:
        """kappa b at the vertices: continuous through inflections. In a plane, signed curvature."""
        return self.curvature(measure)[:, None] * self.binormals

    @cached_property
    def dihedral_angles(self) -> Array:
        """(n,) angles alpha [rad] about each edge from one binormal to the next, in (-pi, pi]."""
        return sealed(self._compiled.dihedral_angles(self.binormals))

    def torsion(
        self,
        measure: Measure | Literal["sauer"] = "log",
        *,
        ends: Ends = "free",
        spacing: Spacing = "even",
    ) -> Array:
        """(n,) torsion tau = alpha/edge length, Linn (4).

        On an edge to an end that no tangent holds the torsion is 0.

        Parameters
        ----------
        measure : `Measure` or "sauer"
            "sauer" is sin(alpha)/length: of the same order, but no longer growing beyond a right
            angle, so that it mistakes sharp turns for mild ones.
        ends : "free" or "continued"
            "continued" gives edges to free ends the torsion of the next edge.
        spacing : "even" or "uneven"
            "even" (default): of second order where neighbouring edges are nearly equal; where their
            lengths vary at random it does not converge. "uneven" divides by the way from one
            binormal to the next, a third of three edges, and converges: see docs/curves.md.
        """
        alpha = self.dihedral_angles
        if checked_measure(measure, "sauer") == "sauer":
            turns = np.sin(alpha)
        else:
            turns = _core.curve.measured(alpha, measure)
        return with_ends(self, turns / torsion_lengths(self, spacing), ends)

    @borrowed("pyrod.curve._transport:frenet")
    def frenet(self) -> Any:
        """The arc with Frenet frames (n, b, t) on its edges, a `FramedCurve`."""

    def vertex_frenet_frames(self) -> Array:
        """Frenet frames (n, b, t) at the vertices, quaternions; t halves the turn."""
        return self._compiled.vertex_frenet_frames(self.binormals)

    # Parallel transport ---------------------------------------------------------------------------

    @borrowed("pyrod.curve._transport:bishop")
    def bishop(
        self,
        normal: ArrayLike | None = None,
        angles: ArrayLike = NO_ANGLE,
        frame: ArrayLike | None = None,
    ) -> Any:
        """The arc with frames that do not twist, or that twist as told: a `FramedCurve`."""

    @borrowed("pyrod.curve._transport:closed_ribbon")
    def closed_ribbon(self, link: int | None = None, normal: ArrayLike | None = None) -> Any:
        """Frames that close, with the least twist or of a linking number: a `FramedCurve`."""

    # Data -----------------------------------------------------------------------------------------

    @borrowed("pyrod.curve._smooth:smooth_curve")
    def smooth_curve(self, noise: ArrayLike = 0.0, *, degree: int = 5) -> SmoothCurve:  # type: ignore[empty-body]
        """The spline through the vertices, or near them as their noise lets it: a `SmoothCurve`."""

    @borrowed("pyrod.curve._resampling:resampled")
    def resampled(self, edges: int, *, smooth: bool = True) -> Polyline:  # type: ignore[empty-body]
        """As many edges, equal along the curve."""

    @borrowed("pyrod.curve._resampling:smoothed")
    def smoothed(self, noise: ArrayLike, edges: int | None = None) -> Polyline:  # type: ignore[empty-body]
        """The arc without the noise of its positions."""

    # Two arcs -------------------------------------------------------------------------------------

    @borrowed("pyrod.curve._facing:facing")
    def facing(self, directions: ArrayLike) -> Any:
        """Frames whose a1 looks as near to directions as can be: a `FramedCurve`."""

    @borrowed("pyrod.curve._facing:towards")
    def towards(
        self,
        other: Union[Polyline, ArrayLike],
        *,
        by: Literal["number", "nearest"] = "number",
    ) -> Any:
        """The ribbon from this arc to another, a `FramedCurve`: a1 points there."""

    @borrowed("pyrod.curve._link:approach")
    def approach(  # type: ignore[empty-body]
        self, other: Union[Polyline, ArrayLike], threads: int = 0
    ) -> Approach:
        """Smallest distance between an edge of this and an edge of another."""


def as_polyline(given: Union[Polyline, ArrayLike], name: str, closed: bool) -> Polyline:
    """A polyline as it is, or made of positions."""
    if isinstance(given, Polyline):
        return given
    try:
        return Polyline(given, closed=closed)
    except (ValueError, TypeError) as error:
        raise type(error)(f"{name}: expected a Polyline or positions; {error}") from None
