"""The rod: what it is made of, and the shape it has at rest."""

from __future__ import annotations

import inspect
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

import pyrod._core as _core
from pyrod.base.arrays import array, finite
from pyrod.base.borrowed import borrowed
from pyrod.base.calls import spelled
from pyrod.base.immutable import Array, Immutable, Lazy, frozen
from pyrod.curve._sampling import edge_lengths, natural_edges
from pyrod.rod.along import Curvature, Sections, masses
from pyrod.rod.energy import Energy
from pyrod.rod.law import Law, Made, Placement, Points, table_of
from pyrod.rod.models import check_model, checked_model
from pyrod.rod.outline import Outline
from pyrod.rod.place import End
from pyrod.rod.rest_shape import rest_curvature, ribbon
from pyrod.rod.section import Model

_ORIGIN: Placement = (frozen([0, 0, 0]), frozen([1, 0, 0, 0]))
_NO_CURVATURE = frozen([0, 0, 0])
_ARRAYS = ("edge_lengths", "bending", "stretching", "K0", "mass_per_length")


@dataclass(frozen=True, eq=False, repr=False)
class Rod(Lazy, Immutable):
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
    _law: Law = field(default=None, compare=False)  # type: ignore[assignment]
    _compiled: _core.Rod = field(default=None, compare=False)  # type: ignore[assignment]
    """Made by the law; a rod with other arrays has another law. It has the arrays."""

    def __new__(cls, *args: Any, **kwargs: Any) -> Rod:
        if 0 < len(args) + len(kwargs) < 5:  # none: as pickles do
            raise TypeError(
                "Rod: takes the arrays of a discrete rod; make one with Rod.straight(length, "
                "edges, section), Rod.precurved or Rod.from_curve"
            )
        return super().__new__(cls)

    def __post_init__(self) -> None:
        check_model(self.model)
        for name in _ARRAYS[:4]:
            self._set(**{name: frozen(getattr(self, name), name)})
        position, frame = self.placement
        self._set(placement=(frozen(position, "placement"), frozen(frame, "placement")))
        self._set(mass_per_length=masses(self.mass_per_length, len(self.edge_lengths)))
        if self._compiled is not None and self._is_by_law():
            self._set(_compiled=self._compiled.replaced(self.model, *self.placement))
        else:
            law = table_of(self)
            self._set(_law=law, _compiled=law.compiled(self.model, self.placement, False))

    def _is_by_law(self) -> bool:
        """Whether the arrays are still those that the law says."""
        pairs = ((getattr(self, name), getattr(self._compiled, name)) for name in _ARRAYS)
        return all(np.array_equal(mine, theirs) for mine, theirs in pairs)

    def __eq__(self, other: object) -> bool:
        same = super().__eq__(other)
        if same is not True or not isinstance(other, Rod):
            return same
        return self._compiled.kept == other._compiled.kept

    def __getstate__(self) -> dict[str, Any]:
        """Functions of arc length that cannot be pickled are as linear between vertices."""
        state = super().__getstate__()
        made, law = state.pop("_compiled"), self._law
        state["_grid"] = made.kept, made.marks
        if not law.portable:
            state.update(_law=replace(table_of(self), jumps=made.jumps), _grid=(None, []))
        return state

    def __setstate__(self, state: dict[str, Any]) -> None:
        kept, marks = state.pop("_grid")
        super().__setstate__(state)
        made = self._law.compiled(self.model, self.placement, kept is not None)
        self._set(_compiled=made.on(self.edge_lengths, kept, marks))

    # Makers --------------------------------------------------------------------------------------

    @classmethod
    @spelled
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
        return cls.precurved(length, edges, section, _NO_CURVATURE, model)

    @classmethod
    @spelled
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
        law = Made(section, curvature, h)
        return rod_of(law.compiled(checked_model(model), _ORIGIN, free), law, _ORIGIN)

    @classmethod
    @spelled
    def from_curve(
        cls,
        positions: ArrayLike,
        frames: ArrayLike | None,
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
            matter. None: those that do not twist (`pyrod.curve.Polyline.bishop`).
        section, model : see `Rod.straight`
        """
        shape = ribbon(positions, frames)
        K0, start = rest_curvature(shape)
        h = shape.polyline.edge_lengths
        law = Points(section, frozen(K0), h)
        placement = (frozen(shape.polyline.positions[0]), frozen(start))
        return rod_of(law.compiled(checked_model(model), placement, False), law, placement)

    # Views ---------------------------------------------------------------------------------------

    @property
    def edges(self) -> int:
        """Number n of edges."""
        return self._compiled.edges

    @property
    def length(self) -> float:
        """Length at rest [m]."""
        return self._compiled.length

    @property
    def arc_lengths(self) -> Array:
        """(n + 1,) arc length of the vertices [m]."""
        return self._compiled.arc_lengths

    @property
    def cell_lengths(self) -> Array:
        """(n + 1,) length of the cell of each vertex, half edges at the ends [m]."""
        return np.convolve(self.edge_lengths, [0.5, 0.5])

    @borrowed("pyrod.rod.outlines:outline_at")
    def outline(self, at: End | float) -> Outline:  # type: ignore[empty-body]
        """The outline of the cross-section at a place."""

    @borrowed("pyrod.rod.at_rest:placed")
    def placed(  # type: ignore[empty-body]
        self,
        position: ArrayLike | None = None,
        frame: ArrayLike | None = None,
        *,
        tangent: ArrayLike | None = None,
        normal: ArrayLike | None = None,
    ) -> Rod:
        """The same rod with its start elsewhere at rest."""

    def in_model(self, model: Model) -> Rod:
        """The same rod with other strains."""
        check_model(model)
        return rod_of(self._compiled.replaced(model, *self.placement), self._law, self.placement)

    def with_vertices(self, at: ArrayLike) -> Rod:
        """The same rod with vertices at the given arc lengths [m].

        Edges are cut where there is none yet; within 1e-9 of an edge's length of a vertex there is.
        What sections and curvature are there, the functions tell that the rod was made of; of
        arrays compliance and curvature are linear between vertices; a rod made from points turns at
        these alone. Where `solve` chooses the edges, these vertices are kept. Jumps and kinks of
        functions get vertices by themselves where ``tol`` is asked for (docs/accuracy.md).
        """
        made = self._compiled.with_vertices(np.unique(finite(at, "at")))
        return self if made is None else rod_of(made, self._law, self.placement)

    def refined(self, level: int) -> Rod:
        """The same rod with every edge cut in 2^level, and no choice of edges left."""
        if level == 0 and self._compiled.kept is None:
            return self
        parts = 2**level
        return on_other_edges(self, np.repeat(self.edge_lengths / parts, parts), None)

    @borrowed("pyrod.rod.at_rest:frame_at_rest")
    def frame_at_rest(self, vertex: int, frames: Array | None = None) -> Array:  # type: ignore[empty-body]
        """(4,) frame of a vertex at rest; ``frames``: those of the edges, if they are at hand."""

    @borrowed("pyrod.rod.at_rest:at_rest")
    def at_rest(  # type: ignore[empty-body]
        self, position: ArrayLike | None = None, frame: ArrayLike | None = None
    ) -> tuple[Array, Array]:
        """Positions (n + 1, 3) and frames (n, 4) of the stress-free shape, started as given."""

    @borrowed("pyrod.rod.energy_of:energy_of")
    def energy(  # type: ignore[empty-body]
        self,
        positions: ArrayLike,
        frames: ArrayLike,
        start_frame: ArrayLike | None = None,
        end_frame: ArrayLike | None = None,
    ) -> Energy:
        """Elastic energy, Linn (49) and (51), with gradient and Hessian."""

    @borrowed("pyrod.notebook.views:rod_html")
    def _repr_html_(self) -> str:  # type: ignore[empty-body]
        """What notebooks show."""

    def __repr__(self) -> str:
        curved = "precurved" if self.K0.any() else "straight"
        edges = self.edges if self._compiled.kept is None else None
        return f"Rod({self.model}, {curved}, length={self.length:g}, edges={edges})"


def rod_of(made: _core.Rod, law: Law, placement: Placement) -> Rod:
    """What the compiled rod is."""
    rod = object.__new__(Rod)
    rod.__dict__.update(_law=law, _compiled=made, placement=placement)
    return rod


def on_other_edges(rod: Rod, h: Array, kept: list[float] | None) -> Rod:
    """The same rod; ``kept``: vertices that are kept if the solver chooses the edges."""
    made = rod._compiled
    return rod_of(made.on(h, kept, made.marks), rod._law, rod.placement)


# What help and editors show is what the dataclass takes, not what `__new__` looks at.
Rod.__signature__ = inspect.Signature(
    [
        parameter
        for name, parameter in inspect.signature(Rod.__init__).parameters.items()
        if name != "self" and name[0] != "_"
    ]
)
