"""The rod: what it is made of, and the shape it has at rest."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from pyrod import _core
from pyrod._along import Curvature, Model, Sections, stiffness
from pyrod._immutable import Array, Immutable, frozen, vector
from pyrod._rest_shape import rest_curvature, ribbon
from pyrod._sampling import edge_lengths, sampled
from pyrod.rotation import exp, frame_along, multiply


@dataclass(frozen=True, eq=False, repr=False)
class Rod(Immutable):
    """A rod of n edges; its sections and its curvature at rest may vary along it.

    Make one with `Rod.straight`, `Rod.precurved` or `Rod.from_curve`; the constructor takes what
    the discrete rod consists of (Linn 2020, B.7).

    Parameters
    ----------
    edge_lengths : (n,) lengths h [m] of the edges at rest, positive, not necessarily equal.
    bending : (n + 1, 3) stiffnesses (EI1, EI2, GJ) [N m^2] at the vertices.
    stretching : (n, 3) stiffnesses (GA1, GA2, EA) [N] of the edges; ``inf`` is rigid.
    K0 : (n + 1, 3) material curvature at rest [1/m] at the vertices: about a1, a2, and twist.
    model : "cosserat" (shears and stretches), "extensible" (Kirchhoff, stretches), "inextensible"
        (Kirchhoff). Strains that a model excludes are zero whatever their stiffness.
    placement : position (3,) and frame (4,) that the start of the rod has at rest.
    mass_per_length : (n,) of the edges [kg/m], for `Gravity`; default: none.

    Raises
    ------
    ValueError : wrong shapes, numbers that are not finite, lengths or stiffnesses that are not
        positive, a rest shape that turns by pi or more from one edge to the next.
    """

    edge_lengths: Array
    bending: Array
    stretching: Array
    K0: Array
    model: Model
    placement: tuple[Array, Array] = field(
        default=(frozen([0, 0, 0]), frozen([1, 0, 0, 0])), compare=False
    )
    mass_per_length: Array = field(default_factory=lambda: frozen(0))
    _rod: _core.Rod = field(init=False, compare=False)

    def __post_init__(self) -> None:
        if self.model not in _core.Model.__members__:
            raise ValueError(
                f"model: expected one of {', '.join(_core.Model.__members__)}, got {self.model!r}"
            )
        for name in ("edge_lengths", "bending", "stretching", "K0"):
            self._set(**{name: frozen(getattr(self, name))})
        self._set(_rod=self._compiled(), placement=tuple(frozen(x) for x in self.placement))
        self._set(mass_per_length=_masses(self.mass_per_length, self.edges))

    def _compiled(self) -> _core.Rod:
        return _core.Rod(self.edge_lengths, self.bending, self.stretching, self.K0)

    def __setstate__(self, state: dict[str, Any]) -> None:
        super().__setstate__(state)
        self._set(_rod=self._compiled())

    # Makers --------------------------------------------------------------------------------------

    @classmethod
    def straight(
        cls, length: float, edges: int, section: Sections, model: Model | None = None
    ) -> Rod:
        """A rod that is straight at rest, of equal edges.

        Parameters
        ----------
        length : length [m].
        edges : number n of edges.
        section : a `Section`, a function of arc length that returns one, or a sequence of n
            sections, one per edge.
        model : see `Rod`; default: the richest that the section's finite stiffnesses allow.
        """
        return cls.precurved(length, edges, section, (0.0, 0.0, 0.0), model)

    @classmethod
    def precurved(
        cls,
        length: float | ArrayLike,
        edges: int | None,
        section: Sections,
        curvature: Curvature,
        model: Model | None = None,
    ) -> Rod:
        """A rod with curvature at rest.

        Parameters
        ----------
        length : length [m], or, with ``edges=None``, the lengths of the edges.
        edges : number n of edges.
        section, model : see `Rod.straight`.
        curvature : (K1, K2, K3) [1/m], bending about a1 and a2 and twist; or one per vertex,
            (n + 1, 3); or a function of arc length.
        """
        h = edge_lengths(length, edges)
        bending, stretching, mass, natural = stiffness(section, h)
        K0 = sampled(curvature, np.concatenate([[0.0], np.cumsum(h)]), "curvature", "vertex")
        return cls(h, bending, stretching, K0, model or natural, mass_per_length=mass)

    @classmethod
    def from_curve(
        cls,
        positions: ArrayLike,
        frames: ArrayLike,
        section: Sections,
        model: Model | None = None,
    ) -> Rod:
        """A rod that has the given shape at rest, and that place unless it is clamped elsewhere.

        Parameters
        ----------
        positions : (n + 1, 3) vertices [m]; neighbours must not coincide.
        frames : (n, 4) quaternions or (n, 3, 3) matrices, the frame of each edge. Each is turned
            the shortest way that brings a3 into the edge; more than 0.5 rad is refused. The signs
            of quaternions do not matter.
        section, model : see `Rod.straight`.

        The frame at the start continues the curvature of the first vertex over the half edge.
        """
        shape = ribbon(positions, frames)
        K0, start = rest_curvature(shape)
        h = shape.polyline.edge_lengths
        bending, stretching, mass, natural = stiffness(section, h)
        placement = (shape.polyline.positions[0], start)
        return cls(h, bending, stretching, K0, model or natural, placement, mass)

    # Views ---------------------------------------------------------------------------------------

    @property
    def edges(self) -> int:
        """Number n of edges."""
        return len(self.edge_lengths)

    @property
    def length(self) -> float:
        """Length at rest [m]."""
        return self._rod.length

    @property
    def arc_lengths(self) -> Array:
        """(n + 1,) arc length of the vertices [m]."""
        return self._rod.arc_lengths

    @property
    def cell_lengths(self) -> Array:
        """(n + 1,) length of the cell of each vertex, half edges at the ends [m]."""
        return np.convolve(self.edge_lengths, [0.5, 0.5])

    def placed(
        self,
        position: ArrayLike | None = None,
        frame: ArrayLike | None = None,
        *,
        tangent: ArrayLike | None = None,
        normal: ArrayLike | None = None,
    ) -> Rod:
        """The same rod with its start elsewhere at rest; arguments as for `Clamp`."""
        if tangent is not None:
            frame = frame_along(tangent, normal)
        place = (
            self.placement[0] if position is None else vector(position, "position"),
            self.placement[1] if frame is None else frozen(frame),
        )
        return replace(self, placement=place)

    def with_vertices(self, at: ArrayLike) -> Rod:
        """The same rod with vertices at the given arc lengths [m].

        Edges are cut where there is none yet; within 1e-9 of an edge's length of a vertex there is.
        The cells of the new vertices get the mean compliance and the mean curvature of their
        neighbours.
        """
        rod = self
        for s in np.unique(np.asarray(at, dtype=np.float64)):
            j = int(np.clip(np.searchsorted(rod.arc_lengths, s, "right") - 1, 0, rod.edges - 1))
            h, part = rod.edge_lengths[j], s - rod.arc_lengths[j]
            if not 1e-9 * h < part < (1 - 1e-9) * h:
                continue
            rod = rod._cut(j, float(part))
        return rod

    def _cut(self, j: int, part: float) -> Rod:
        C, K0 = self.bending, self.K0
        twice = lambda values: np.insert(values, j, values[j], axis=0)  # noqa: E731
        h = twice(self.edge_lengths)
        h[j], h[j + 1] = part, self.edge_lengths[j] - part
        return Rod(
            h,
            np.insert(C, j + 1, 2 / (1 / C[j] + 1 / C[j + 1]), axis=0),
            twice(self.stretching),
            np.insert(K0, j + 1, (K0[j] + K0[j + 1]) / 2, axis=0),
            self.model,
            self.placement,
            twice(self.mass_per_length),
        )

    def frame_at_rest(self, vertex: int, frames: Array | None = None) -> Array:
        """(4,) frame of a vertex at rest; ``frames``: those of the edges, if they are at hand."""
        if vertex == 0:
            return self.placement[1]
        q = self.at_rest()[1] if frames is None else frames
        return multiply(q[vertex - 1], exp(self.edge_lengths[vertex - 1] / 2 * self.K0[vertex]))

    def at_rest(
        self, position: ArrayLike | None = None, frame: ArrayLike | None = None
    ) -> tuple[Array, Array]:
        """Positions (n + 1, 3) and frames (n, 4) of the stress-free shape, started as given."""
        return self._rod.at_rest(
            self.placement[0] if position is None else np.asarray(position, dtype=np.float64),
            self.placement[1] if frame is None else np.asarray(frame, dtype=np.float64),
        )

    def energy(
        self,
        positions: ArrayLike,
        frames: ArrayLike,
        start_frame: ArrayLike | None = None,
        end_frame: ArrayLike | None = None,
    ) -> Energy:
        """Elastic energy, Linn (49) and (51), with gradient and Hessian.

        Parameters
        ----------
        positions : (n + 1, 3).
        frames : (n, 4) unit quaternions; their signs matter, a turn may reach 2 pi.
        start_frame, end_frame : (4,) frames that hold the ends. An end without one has no half cell
            and no energy there.

        Strains that the rod's model excludes carry no energy.
        """
        bend_twist, stretch_shear, gradient, hessian = self._rod.energy(
            _core.Model.__members__[self.model],
            np.asarray(positions, dtype=np.float64),
            np.asarray(frames, dtype=np.float64),
            start_frame,
            end_frame,
        )
        return Energy(bend_twist, stretch_shear, frozen(gradient), hessian)

    def __repr__(self) -> str:
        curved = "precurved" if self.K0.any() else "straight"
        return f"Rod({self.model}, {curved}, length={self.length:g}, edges={self.edges})"


@dataclass(frozen=True, eq=False)
class Energy(Immutable):
    """Value and derivatives of a rod's energy.

    The unknowns are numbered station by station, r_0, q_{1/2}, r_1, q_{3/2}, ..., r_n; frames move
    as R <- R exp(phi), phi in the components of the frame.
    """

    bend_twist: float
    stretch_shear: float
    gradient: Array
    _hessian: tuple[Array, Any, Any] = field(repr=False)

    @property
    def total(self) -> float:
        """Bending, twisting, stretching and shearing together [J]."""
        return self.bend_twist + self.stretch_shear

    @property
    def hessian(self) -> Any:
        """Second derivatives, a symmetric `scipy.sparse.csc_array`. Needs SciPy."""
        from scipy.sparse import csc_array

        return csc_array(self._hessian, shape=(len(self.gradient),) * 2)


def _masses(values: ArrayLike, edges: int) -> Array:
    """One mass per length for each edge."""
    mass = frozen(values)
    if mass.shape not in ((), (edges,)):
        raise ValueError(
            f"mass_per_length: expected {edges} numbers, one per edge, got shape {mass.shape}"
        )
    if not (np.isfinite(mass) & (mass >= 0)).all():
        raise ValueError("mass_per_length: expected finite numbers, not negative")
    return frozen(np.broadcast_to(mass, edges))
