"""The rod: what it is made of, and the shape it has at rest."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any, Literal, Union

import numpy as np
from numpy.typing import ArrayLike

from pyrod import _core
from pyrod._immutable import Array, Immutable, frozen
from pyrod.rotation import as_frames, continued, exp, log, conjugate, multiply, rotate
from pyrod.section import Section

Model = Literal["cosserat", "extensible", "inextensible"]
Sections = Union[Section, Sequence[Section], Callable[[float], Section]]
Curvature = Union[ArrayLike, Callable[[float], ArrayLike]]


@dataclass(frozen=True, eq=False, repr=False)
class Rod(Immutable):
    """A rod of n edges; its sections and its curvature at rest may vary along it.

    Make one with `Rod.straight`, `Rod.precurved` or `Rod.from_curve`; the constructor takes what the
    discrete rod consists of (Linn 2020, B.7).

    Parameters
    ----------
    edge_lengths : (n,) lengths h [m] of the edges at rest, positive, not necessarily equal.
    bending : (n + 1, 3) stiffnesses (EI1, EI2, GJ) [N m^2] at the vertices.
    stretching : (n, 3) stiffnesses (GA1, GA2, EA) [N] of the edges; ``inf`` is rigid.
    K0 : (n + 1, 3) material curvature at rest [1/m] at the vertices: bending about a1 and a2, twist.
    model : "cosserat" (shears and stretches), "extensible" (Kirchhoff, stretches), "inextensible"
        (Kirchhoff). Strains that a model excludes are zero whatever their stiffness.
    placement : position (3,) and frame (4,) that the start of the rod has at rest.

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

    def __post_init__(self) -> None:
        if self.model not in _core.Model.__members__:
            raise ValueError(
                f"model: expected one of {', '.join(_core.Model.__members__)}, got {self.model!r}"
            )
        for name in ("edge_lengths", "bending", "stretching", "K0"):
            self._set(**{name: frozen(getattr(self, name))})
        self._set(_rod=self._compiled(), placement=tuple(frozen(x) for x in self.placement))

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
        h = _edge_lengths(length, edges)
        bending, stretching, natural = _stiffness(section, h)
        K0 = _sampled(curvature, np.concatenate([[0.0], np.cumsum(h)]), "curvature", "vertex")
        return cls(h, bending, stretching, K0, model or natural)

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
        frames : (n, 4) quaternions or (n, 3, 3) matrices, the frame of each edge. Each is turned the
            shortest way that brings a3 into the edge; more than 0.5 rad is refused. The signs of
            quaternions do not matter.
        section, model : see `Rod.straight`.

        The frame at the start continues the curvature of the first vertex over the half edge.
        """
        r = np.asarray(positions, dtype=np.float64)
        if r.ndim != 2 or r.shape[1] != 3 or len(r) < 2 or not np.isfinite(r).all():
            raise ValueError(
                f"positions: expected (n + 1, 3) finite numbers, n >= 1, got shape {r.shape}"
            )
        edges = np.diff(r, axis=0)
        h = np.linalg.norm(edges, axis=1)
        if not h.all():
            raise ValueError(f"positions[{int(np.argmin(h)) + 1}]: coincides with the one before")
        q = _adapted(as_frames(frames, "frames"), edges / h[:, None])
        K0, start = _rest_curvature(q, h)
        bending, stretching, natural = _stiffness(section, h)
        return cls(h, bending, stretching, K0, model or natural, (r[0], start))

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


def _edge_lengths(length: float | ArrayLike, edges: int | None) -> Array:
    if edges is None:
        return np.atleast_1d(np.asarray(length, dtype=np.float64))
    if edges != int(edges) or edges < 1:
        raise ValueError(f"edges: must be a whole number, at least 1, got {edges}")
    if np.ndim(length) != 0:
        raise ValueError("edges: give None together with the lengths of the edges")
    if not (np.isfinite(length) and length > 0):  # type: ignore[operator]
        raise ValueError(f"length: must be positive, got {length}")
    return np.full(int(edges), length / int(edges))  # type: ignore[operator]


def _sampled(values: Any, at: Array, name: str, place: str) -> Array:
    """(len(at), 3) from one vector, one per place, or a function of arc length."""
    if callable(values):
        values = [np.asarray(values(s), dtype=np.float64) for s in at]
    array = np.asarray(values, dtype=np.float64)
    if array.shape not in ((3,), (len(at), 3)):
        raise ValueError(
            f"{name}: expected 3 numbers, or {len(at)} times 3 (one per {place}), "
            f"got shape {array.shape}"
        )
    return np.array(np.broadcast_to(array, (len(at), 3)))


def _stiffness(section: Sections, h: Array) -> tuple[Array, Array, Model]:
    """Stiffnesses at vertices and of edges, and the richest model they allow.

    Sections given per edge may jump at a vertex; the two halves of the cell there bend one after the
    other, so their compliances add.
    """
    if isinstance(section, Section):
        model = section.model
        n = len(h)
        return np.tile(section.bending, (n + 1, 1)), np.tile(section.stretching, (n, 1)), model
    s = np.concatenate([[0.0], np.cumsum(h)])
    if callable(section):
        at_vertices = [section(x) for x in s]
        on_edges = [section(x) for x in (s[1:] + s[:-1]) / 2]
        bending = np.array([c.bending for c in at_vertices])
    else:
        on_edges = list(section)
        if len(on_edges) != len(h):
            raise ValueError(f"section: expected {len(h)}, one per edge, got {len(on_edges)}")
        weight = np.concatenate([[0.0], h, [0.0]])[:, None]
        per_edge = np.array([c.bending for c in on_edges])
        padded = np.vstack([per_edge[:1], per_edge, per_edge[-1:]])
        compliance = weight / padded
        bending = (weight[1:] + weight[:-1]) / (compliance[1:] + compliance[:-1])
    models = {c.model for c in on_edges}
    model = next(m for m in ("cosserat", "extensible", "inextensible") if m in models)
    return bending, np.array([c.stretching for c in on_edges]), model  # type: ignore[return-value]


def _adapted(frames: Array, tangents: Array) -> Array:
    """Frames turned the shortest way so that a3 is the tangent, with continued signs."""
    if len(frames) != len(tangents):
        raise ValueError(f"frames: expected {len(tangents)}, one per edge, got {len(frames)}")
    a3 = rotate(frames, np.array([0.0, 0.0, 1.0]))
    axis = np.cross(a3, tangents)
    sine, cosine = np.linalg.norm(axis, axis=1), np.einsum("ij,ij->i", a3, tangents)
    angle = np.arctan2(sine, cosine)
    worst = int(np.argmax(angle))
    if angle[worst] > 0.5:
        raise ValueError(
            f"frames[{worst}]: a3 is {angle[worst]:.3g} rad away from the edge; the third director "
            "must point along the rod"
        )
    scale = np.divide(angle, sine, out=np.ones_like(sine), where=sine > 0)
    return continued(multiply(exp(axis * scale[:, None]), frames))


def _rest_curvature(frames: Array, h: Array) -> tuple[Array, Array]:
    """K0 at the vertices, and the frame at the start."""
    n = len(h)
    K0 = np.zeros((n + 1, 3))
    if n > 1:
        turns = log(multiply(conjugate(frames[:-1]), frames[1:]))
        size = np.linalg.norm(turns, axis=1)
        worst = int(np.argmax(size))
        if size[worst] > np.pi - 1e-9:
            raise ValueError(
                f"frames[{worst + 1}]: turned by pi from the one before, so that the sense of the "
                "turn is lost; use more edges"
            )
        K0[1:n] = turns / ((h[1:] + h[:-1]) / 2)[:, None]
        K0[0], K0[n] = K0[1], K0[n - 1]
    return K0, multiply(frames[0], exp(-h[0] / 2 * K0[0]))
