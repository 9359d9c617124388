"""Framed curves: strains, twist and link, and the curves that have them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

import pyrod._core as _core
from pyrod.base.arrays import array
from pyrod.base.borrowed import borrowed
from pyrod.base.immutable import Array, Immutable, frozen, sealed, vector
from pyrod.curve._polyline import Polyline
from pyrod.curve._reading import between_vertices, check_count, check_reading, held, signed
from pyrod.curve._sampling import edge_lengths as lengths_of
from pyrod.curve._sampling import sampled
from pyrod.curve._shown import Shown
from pyrod.curve._strains import Measure, checked_measure, reconstruct, strains
from pyrod.rotation import as_frame, rotate, to_matrix


@dataclass(frozen=True, eq=False, init=False, repr=False)
class FramedCurve(Shown, Immutable):
    """A polyline with a frame on each edge: a discrete Cosserat curve (Linn 2020, sect. 5 and 6).

    A ribbon is a curve whose frames are adapted, a3 along the edge. Its K are the normal curvature
    (bending about a1), the geodesic curvature (about a2, in the surface along a1) and the geodesic
    torsion.

    Parameters
    ----------
    polyline : `Polyline` or (n + 1, 3) array [m]
        The curve, or the positions of an open one.
    frames : (n, 4) or (n, 3, 3) array, or ``Rotation``
        One per edge: unit quaternions, whose signs matter: a turn may reach 2 pi; or rotation
        matrices, or a ``Rotation`` of SciPy, whose quaternions are given the signs that continue
        each other. For frames at the points see `from_vertex_frames`.
    edge_lengths : (n,) array [m]
        Reference lengths h; default: those of the polyline.
    start_frame, end_frame : (4,) or (3, 3) array
        Frames that hold the ends of an open curve; an end without one does not turn over its half
        edge.

    Raises
    ------
    ValueError
        Shapes, frames of another length than 1, neighbours that differ by 2 pi (matrices: by pi),
        where the turn has lost its axis; frames that fit the edges only if they are read as (x, y,
        z, w) or as rows; with the index and the remedy.

    Warns
    -----
    CurveWarning
        a3 is far from every edge.
    """

    polyline: Polyline
    frames: Array
    edge_lengths: Array
    start_frame: Array | None
    end_frame: Array | None

    def __init__(
        self,
        polyline: Polyline | ArrayLike,
        frames: ArrayLike,
        edge_lengths: ArrayLike | None = None,
        start_frame: ArrayLike | None = None,
        end_frame: ArrayLike | None = None,
    ) -> None:
        if not isinstance(polyline, Polyline):
            polyline = Polyline(polyline)
        h = frozen(polyline.edge_lengths if edge_lengths is None else edge_lengths, "edge_lengths")
        if h.shape != (polyline.edges,):
            raise ValueError(f"edge_lengths: expected {polyline.edges}, got shape {h.shape}")
        q = signed(frames)
        check_count(q, polyline.edges, polyline.closed)
        start, end = held(start_frame, "start_frame", q[:1]), held(end_frame, "end_frame", q[-1:])
        self._fill(polyline, frozen(q), h, start, end)
        check_reading(frames, q, polyline.tangents)

    def _fill(
        self, polyline: Polyline, q: Array, h: Array, start: Array | None, end: Array | None
    ) -> FramedCurve:
        self._set(polyline=polyline, frames=q, edge_lengths=h, start_frame=start, end_frame=end)
        self.twist_angles  # noqa: B018  checks everything
        return self

    @borrowed("pyrod.notebook.views:framed_html")
    def _repr_html_(self) -> str:  # type: ignore[empty-body]
        """What notebooks show."""

    def __repr__(self) -> str:
        kind = "closed" if self.polyline.closed else "open"
        return f"FramedCurve({kind}, edges={self.polyline.edges}, length={self.polyline.length:g})"

    # Makers ---------------------------------------------------------------------------------------

    @classmethod
    def from_vertex_frames(cls, polyline: Polyline | ArrayLike, frames: ArrayLike) -> FramedCurve:
        """The curve whose frames are given at its points, as base pairs or waypoints have them.

        Each edge has the frame half-way between those of its ends, the shorter way; the first and
        the last frame hold the ends of an open curve. So nothing of the twist between the points
        is lost.

        Parameters
        ----------
        polyline : `Polyline` or (n + 1, 3) array [m]
            The curve, or the positions of an open one.
        frames : (n + 1, 4) or (n + 1, 3, 3) array, or ``Rotation``
            One per vertex; n if it is closed.

        Raises
        ------
        ValueError
            Neighbours that differ by pi, and what the constructor refuses.
        """
        if not isinstance(polyline, Polyline):
            polyline = Polyline(polyline)
        between, q = between_vertices(frames, polyline.edges, polyline.closed)
        ends = (None, None) if polyline.closed else (q[0], q[-1])
        return cls(polyline, between, None, *ends)

    @classmethod
    def from_strains(
        cls,
        edge_lengths: ArrayLike,
        K: ArrayLike,
        Gamma: ArrayLike | None = None,
        position: ArrayLike = (0.0, 0.0, 0.0),
        frame: ArrayLike = (1.0, 0.0, 0.0, 0.0),
        *,
        measure: Measure = "log",
    ) -> FramedCurve:
        """The open curve with these strains, held by its end frames: see `reconstruct`.

        With K = (kappa1, kappa2, 0) its frames are Bishop's.

        Parameters
        ----------
        edge_lengths, K, Gamma, position, frame, measure : see `reconstruct`
        """
        h, start = array(edge_lengths, "edge_lengths"), as_frame(frame, "frame")
        r, q, end = reconstruct(h, K, Gamma, position, start, measure=measure)
        return cls._held_by(r, q, h, start, end)

    @classmethod
    def from_frenet(
        cls,
        edge_lengths: ArrayLike,
        curvature: ArrayLike,
        torsion: ArrayLike,
        position: ArrayLike = (0.0, 0.0, 0.0),
        frame: ArrayLike = (1.0, 0.0, 0.0, 0.0),
        *,
        measure: Measure = "log",
    ) -> FramedCurve:
        """The open curve with this curvature (n + 1,) and torsion (n,), with its Bishop frames.

        The exact inverse of `Polyline.curvature` and `Polyline.torsion`; the curvature of a free
        end is 0.

        Parameters
        ----------
        edge_lengths : (n,) array [m]
        curvature : (n + 1,) array [1/m]
        torsion : (n,) array [1/m]
        position : (3,) array [m]
            Where the curve starts.
        frame : (4,) or (3, 3) array
            The frame (n, b, t) at the start.
        measure : `Measure`
        """
        h, start = array(edge_lengths, "edge_lengths"), as_frame(frame, "frame")
        r, q, end = _core.curve.reconstruct_frenet(
            h,
            array(curvature, "curvature"),
            array(torsion, "torsion"),
            vector(position, "position"),
            start,
            checked_measure(measure),
        )
        return cls._held_by(r, q, h, start, end)

    @classmethod
    def sampled(
        cls,
        length: float | ArrayLike,
        edges: int | None,
        K: ArrayLike | Callable[[float], ArrayLike],
        Gamma: ArrayLike | Callable[[float], ArrayLike] = (0.0, 0.0, 1.0),
        position: ArrayLike = (0.0, 0.0, 0.0),
        frame: ArrayLike = (1.0, 0.0, 0.0, 0.0),
    ) -> FramedCurve:
        """A smooth curve of given strains, K(s) and Gamma(s), on n edges: second order.

        K is taken at the vertices, Gamma at the centres of the edges; exact where both are
        constant.

        Parameters
        ----------
        length : float or (n,) array [m]
            The length, or with ``edges=None`` the lengths h of the edges.
        edges : int or None
            Number n of edges.
        K : (3,) or (n + 1, 3) array [1/m], or function
        Gamma : (3,) or (n, 3) array, or function
        position, frame : see `reconstruct`
        """
        h = lengths_of(length, edges)
        s = np.concatenate([[0.0], np.cumsum(h)])
        return cls.from_strains(
            h,
            sampled(K, s, "K", "vertex"),
            sampled(Gamma, (s[1:] + s[:-1]) / 2, "Gamma", "edge"),
            position,
            frame,
        )

    @classmethod
    def _held_by(cls, r: Array, q: Array, h: Array, start: Array, end: Array) -> FramedCurve:
        a3 = np.array([0.0, 0.0, 1.0])
        ends = rotate(np.array([start, end]), a3)
        arrays = frozen(q), frozen(h), frozen(start), frozen(end)
        return cls.__new__(cls)._fill(Polyline(r, False, ends[0], ends[1]), *arrays)

    # Strains --------------------------------------------------------------------------------------

    def strains(self, measure: Measure = "log") -> tuple[Array, Array]:
        """K at the vertices and Gamma of the edges, Linn (48) and (50): see `strains`."""
        return strains(*self._whole, measure=measure, closed=self.polyline.closed)

    @cached_property
    def K(self) -> Array:
        """Material curvature at the vertices, bending about a1 and a2, twist."""
        return self._strains[0]

    @cached_property
    def Gamma(self) -> Array:
        """(n, 3) shear along a1 and a2, and stretch; (0, 0, 1) for an adapted frame if h is l."""
        return self._strains[1]

    @cached_property
    def _strains(self) -> tuple[Array, Array]:
        return sealed(self.strains())

    @property
    def _whole(self) -> tuple[Array, Array, Array, Array | None, Array | None]:
        return (
            self.edge_lengths,
            self.polyline.positions,
            self.frames,
            self.start_frame,
            self.end_frame,
        )

    # Frames ---------------------------------------------------------------------------------------

    @property
    def matrices(self) -> Array:
        """(n, 3, 3) the frames as rotation matrices with the columns a1, a2, a3."""
        return to_matrix(self.frames)

    @cached_property
    def vertex_frames(self) -> Array:
        """Frames at the vertices, between those of the edges; at the ends those that hold."""
        return sealed(_core.curve.vertex_frames(*self._whole, closed=self.polyline.closed))

    @borrowed("pyrod.curve._poses:places_with_frames")
    def at(self, s: ArrayLike) -> tuple[Array, Array]:  # type: ignore[empty-body]
        """Points of the curve and the frames there, by arc length."""

    @borrowed("pyrod.curve._poses:resampled_frames")
    def resampled(self, edges: int, *, smooth: bool = True) -> FramedCurve:  # type: ignore[empty-body]
        """The same curve on as many edges of equal length; frames along the edges stay so."""

    @borrowed("pyrod.curve._ribbon:turned")
    def turned(self, angles: ArrayLike) -> FramedCurve:  # type: ignore[empty-body]
        """Every frame turned about its a3 by an angle [rad], one for all or (n,)."""

    @borrowed("pyrod.curve._ribbon:adapted")
    def adapted(self, limit: float = 0.5) -> FramedCurve:  # type: ignore[empty-body]
        """Every frame turned the least way that brings a3 into the tangent: a ribbon."""

    @borrowed("pyrod.curve._ribbon:angles_from")
    def angles_from(self, other: FramedCurve) -> Array:  # type: ignore[empty-body]
        """(n,) angles [rad] that turn the other frames about their tangents into these."""

    # Twist and link -------------------------------------------------------------------------------

    @cached_property
    def twist_angles(self) -> Array:
        """Angles psi [rad] at the vertices by which the frames turn beside parallel transport."""
        return sealed(_core.curve.twist_angles(*self._whole, closed=self.polyline.closed))

    @property
    def twist(self) -> float:
        """Total twist, in turns."""
        return float(self.twist_angles.sum() / (2 * np.pi))

    @borrowed("pyrod.curve._ribbon:link")
    def link(self, threads: int = 0) -> int:  # type: ignore[empty-body]
        """Linking number of a closed ribbon, twist plus writhe (Calugareanu, White, Fuller)."""

    @borrowed("pyrod.curve._ribbon:edge")
    def edge(self, distance: float, threads: int = 0) -> Polyline:  # type: ignore[empty-body]
        """The edge of the ribbon: each vertex moved by ``distance`` along a1 of its frame."""
