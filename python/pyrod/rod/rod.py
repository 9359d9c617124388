"""The rod: what it is made of, and the shape it has at rest."""

from __future__ import annotations

import inspect
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

import pyrod._core as _core
from pyrod.base.arrays import array, finite, rows
from pyrod.base.borrowed import borrowed
from pyrod.base.immutable import Array, Immutable, frozen, sealed, vector
from pyrod.base.words import shortly
from pyrod.curve._sampling import edge_lengths, natural_edges
from pyrod.rod.along import Curvature, Sections, masses
from pyrod.rod.energy import Energy
from pyrod.rod.law import Law, Made, Placement, Points, Table, kept_outlines
from pyrod.rod.outline import Outline
from pyrod.rod.place import End
from pyrod.rod.rest_shape import rest_curvature, ribbon
from pyrod.rod.section import Model
from pyrod.rotation import as_frame, as_frames, exp, frame_along, multiply, unit_frame

_ORIGIN: Placement = (frozen([0, 0, 0]), frozen([1, 0, 0, 0]))


@dataclass(frozen=True, eq=False, repr=False)
class Rod(Immutable):
    """A rod of n edges; its sections and its curvature at rest may vary along it.

    Make one with `Rod.straight`, `Rod.precurved` or `Rod.from_curve`; the constructor takes what
    the discrete rod consists of (Linn 2020, B.7).

    Parameters
    ----------
    edge_lengths : (n,) array [m]
        Lengths h of the edges at rest, positive, not necessarily equal.
    bending : (n + 1, 3) array [N m^2]
        Stiffnesses (EI1, EI2, GJ) at the vertices.
    stretching : (n, 3) array [N]
        Stiffnesses (GA1, GA2, EA) of the edges; ``inf`` is rigid.
    K0 : (n + 1, 3) array [1/m]
        Material curvature at rest at the vertices: about a1, a2, and twist.
    model : "cosserat", "extensible" or "inextensible"
        "cosserat" shears and stretches, "extensible" (Kirchhoff) stretches, "inextensible"
        (Kirchhoff) does neither. Strains that a model excludes are zero whatever their stiffness.
    placement : ((3,) array [m], (4,) array)
        Position and frame that the start of the rod has at rest.
    mass_per_length : (n,) array [kg/m]
        Of the edges, for `Gravity`; default: none.

    Raises
    ------
    ValueError
        Wrong shapes, numbers that are not finite, lengths or stiffnesses that are not positive, a
        rest shape that turns by pi or more from one edge to the next.
    """

    edge_lengths: Array
    bending: Array
    stretching: Array
    K0: Array
    model: Model
    placement: Placement = field(default=_ORIGIN, compare=False)
    mass_per_length: Array = field(default_factory=lambda: frozen(0))
    _law: Law | None = field(default=None, compare=False)
    _rod: _core.Rod = field(default=None, compare=False)  # type: ignore[assignment]
    """Made by the law; a rod with other arrays has another law."""

    def __new__(cls, *args: Any, **kwargs: Any) -> Rod:
        if 0 < len(args) + len(kwargs) < 5:  # none: as pickles do
            raise TypeError(
                "Rod: takes the arrays of a discrete rod; make one with Rod.straight(length, "
                "edges, section), Rod.precurved or Rod.from_curve"
            )
        return super().__new__(cls)

    def __post_init__(self) -> None:
        _check_model(self.model)
        for name in ("edge_lengths", "bending", "stretching", "K0"):
            self._set(**{name: frozen(getattr(self, name), name)})
        position, frame = self.placement
        self._set(placement=(frozen(position, "placement"), frozen(frame, "placement")))
        self._set(mass_per_length=masses(self.mass_per_length, self.edges))
        if self._rod is None or not self._is_by_law():
            law = self._table()
            self._set(_law=law, _rod=law.compiled(self.model, self.placement, False))
        else:
            kind = _core.Model.__members__[self.model]
            self._set(_rod=self._rod.replaced(kind, *self.placement))

    @classmethod
    def _of(cls, made: _core.Rod, law: Law, placement: Placement) -> Rod:
        """What the compiled rod is."""
        self = object.__new__(cls)
        arrays = made.edge_lengths, made.bending, made.stretching, made.K0, made.mass
        h, bending, stretching, K0, mass = sealed(arrays)
        self._set(edge_lengths=h, bending=bending, stretching=stretching, K0=K0)
        self._set(model=made.model.name, placement=placement, mass_per_length=mass)
        self._set(_law=law, _rod=made)
        return self

    def _with(self, made: _core.Rod) -> Rod:
        """The same rod, on other edges perhaps."""
        mine = self._rod
        same = len(made.edge_lengths) == self.edges and made.kept == mine.kept
        return self if same and made.marks == mine.marks else Rod._of(made, *self._what)

    @property
    def _what(self) -> tuple[Any, Placement]:
        return self._law, self.placement

    @property
    def _breaks(self) -> tuple[float, ...] | None:
        """Arc lengths that must be vertices if the solver chooses the grid; None: it does not."""
        kept = self._rod.kept
        return None if kept is None else tuple(kept)

    def _is_by_law(self) -> bool:
        """Whether the arrays are still those that the law says."""
        made = self._rod
        theirs = made.edge_lengths, made.bending, made.stretching, made.K0, made.mass
        return all(map(np.array_equal, (self.edge_lengths, *self._arrays()), theirs))

    def __eq__(self, other: object) -> bool:
        same = super().__eq__(other)
        return self._breaks == other._breaks if same is True and isinstance(other, Rod) else same

    __hash__ = None

    def _arrays(self) -> tuple[Array, Array, Array, Array]:
        return self.bending, self.stretching, self.K0, self.mass_per_length

    def _table(self) -> Table:
        shapes = kept_outlines(self._law, self.edge_lengths)
        corners = self._law is not None and self._law.corners
        return Table(self.edge_lengths, *self._arrays(), shapes, corners)

    def __getstate__(self) -> dict[str, Any]:
        """Functions of arc length that cannot be pickled are as linear between vertices."""
        state = super().__getstate__()
        made, law = state.pop("_rod"), self._law
        state["_grid"] = made.kept, made.marks
        if not law.portable:  # type: ignore[union-attr]
            state.update(_law=replace(self._table(), jumps=made.jumps), _grid=(None, []))
        return state

    def __setstate__(self, state: dict[str, Any]) -> None:
        kept, marks = state.pop("_grid")
        super().__setstate__(state)
        made = self._law.compiled(self.model, self.placement, kept is not None)  # type: ignore[union-attr]
        self._set(_rod=made.on(self.edge_lengths, kept, marks))

    # Makers --------------------------------------------------------------------------------------

    @classmethod
    def straight(
        cls, length: float, edges: int | None, section: Sections, model: Model | None = None
    ) -> Rod:
        """A rod that is straight at rest, of equal edges.

        Parameters
        ----------
        length : float [m]
            Length at rest.
        edges : int or None
            Number n of edges; None: `solve` chooses them, to the accuracy that is wanted.
        section : `Section`, function or sequence
            One for all, a function of arc length that returns one, or n of them, one per edge.
        model : str
            See `Rod`; default: the richest that the section's finite stiffnesses allow.
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
        length : float or (n,) array [m]
            The length, or, with ``edges=None``, the lengths of the edges.
        edges : int or None
            Number n of edges; None, with one length: `solve` chooses them.
        section : see `Rod.straight`
        curvature : (3,) or (n + 1, 3) array [1/m], or function
            (K1, K2, K3), bending about a1 and a2 and twist; or one per vertex; or a function of arc
            length.
        model : see `Rod.straight`
        """
        free = edges is None and array(length, "length").ndim == 0
        h = edge_lengths(length, natural_edges(length, curvature) if free else edges)
        law = Made(section, curvature, frozen(h))
        return cls._of(law.compiled(_checked_model(model), _ORIGIN, free), law, _ORIGIN)

    @classmethod
    def from_curve(
        cls,
        positions: ArrayLike,
        frames: ArrayLike,
        section: Sections,
        model: Model | None = None,
    ) -> Rod:
        """A rod that has the given shape at rest, and that place unless it is clamped elsewhere.

        The frame at the start continues the curvature of the first vertex over the half edge. The
        rod *is* the polygon: on finer grids (``tol``) all of its turn stays at these vertices,
        where its curvature is told as on its own edges.

        Parameters
        ----------
        positions : (n + 1, 3) array [m]
            Vertices; neighbours must not coincide.
        frames : (n, 4) or (n, 3, 3) array
            Quaternions or matrices, the frame of each edge. Each is turned the shortest way that
            brings a3 into the edge; more than 0.5 rad is refused. The signs of quaternions do not
            matter.
        section, model : see `Rod.straight`
        """
        shape = ribbon(positions, frames)
        K0, start = rest_curvature(shape)
        h = shape.polyline.edge_lengths
        placement = (shape.polyline.positions[0], start)
        law = Points(section, frozen(K0), h)
        placement = sealed((frozen(placement[0]), frozen(placement[1])))
        return cls._of(law.compiled(_checked_model(model), placement, False), law, placement)

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

    @borrowed("pyrod.rod.outlines:outline_at")
    def outline(self, at: End | float) -> Outline:  # type: ignore[empty-body]
        """The outline of the cross-section at a place."""

    def placed(
        self,
        position: ArrayLike | None = None,
        frame: ArrayLike | None = None,
        *,
        tangent: ArrayLike | None = None,
        normal: ArrayLike | None = None,
    ) -> Rod:
        """The same rod with its start elsewhere at rest.

        Parameters
        ----------
        position, frame, tangent, normal : as for `Clamp`
        """
        if tangent is not None:
            frame = frame_along(tangent, normal)
        place = (
            self.placement[0] if position is None else vector(position, "position"),
            self.placement[1] if frame is None else frozen(unit_frame(frame, "frame")),
        )
        return replace(self, placement=place)

    def with_vertices(self, at: ArrayLike) -> Rod:
        """The same rod with vertices at the given arc lengths [m].

        Edges are cut where there is none yet; within 1e-9 of an edge's length of a vertex there is.
        What sections and curvature are there, the functions tell that the rod was made of; of
        arrays compliance and curvature are linear between vertices; a rod made from points turns at
        these alone. Where `solve` chooses the edges, these vertices are kept. Jumps and kinks of
        functions get vertices by themselves where ``tol`` is asked for (docs/accuracy.md).
        """
        return self._with(self._rod.with_vertices(np.unique(finite(at, "at"))))

    def _on(self, h: Array, breaks: tuple[float, ...] | None = None) -> Rod:
        """The same rod on other edges."""
        return Rod._of(self._rod.on(h, breaks, self._rod.marks), *self._what)

    def _refined(self, level: int) -> Rod:
        """The same rod with every edge cut in 2^level, and no choice of edges left."""
        if level == 0 and self._breaks is None:
            return self
        parts = 2**level
        return self._on(np.repeat(self.edge_lengths / parts, parts))

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
            self.placement[0] if position is None else vector(position, "position"),
            self.placement[1] if frame is None else as_frame(frame, "frame"),
        )

    def energy(
        self,
        positions: ArrayLike,
        frames: ArrayLike,
        start_frame: ArrayLike | None = None,
        end_frame: ArrayLike | None = None,
    ) -> Energy:
        """Elastic energy, Linn (49) and (51), with gradient and Hessian.

        Strains that the rod's model excludes carry no energy.

        Parameters
        ----------
        positions : (n + 1, 3) array [m]
            The vertices.
        frames : (n, 4) array
            Unit quaternions; their signs matter, a turn may reach 2 pi.
        start_frame, end_frame : (4,) array
            Frames that hold the ends. An end without one has no half cell and no energy there.
        """
        bend_twist, stretch_shear, gradient, hessian = self._rod.energy(
            rows(positions, "positions", 3),
            as_frames(frames, "frames"),
            None if start_frame is None else as_frame(start_frame, "start_frame"),
            None if end_frame is None else as_frame(end_frame, "end_frame"),
        )
        return Energy(bend_twist, stretch_shear, frozen(gradient), hessian)

    @borrowed("pyrod.notebook.views:rod_html")
    def _repr_html_(self) -> str:  # type: ignore[empty-body]
        """What notebooks show."""

    def __repr__(self) -> str:
        curved = "precurved" if self.K0.any() else "straight"
        edges = self.edges if self._breaks is None else None
        return f"Rod({self.model}, {curved}, length={self.length:g}, edges={edges})"


def _check_model(model: Any) -> None:
    if not isinstance(model, str) or model not in _core.Model.__members__:
        raise ValueError(
            f"model: expected one of {', '.join(_core.Model.__members__)}, got {shortly(model)}"
        )


def _checked_model(model: Model | None) -> Model | None:
    if model is not None:
        _check_model(model)
    return model


# What help and editors show is what the dataclass takes, not what `__new__` looks at.
Rod.__signature__ = inspect.Signature(  # type: ignore[attr-defined]
    [
        parameter
        for name, parameter in inspect.signature(Rod.__init__).parameters.items()
        if name != "self" and name[0] != "_"
    ]
)
