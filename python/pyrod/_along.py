"""Values along a rod: one for all, one per place, or a function of arc length."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, Union, get_args

import numpy as np
from numpy.typing import ArrayLike

from pyrod._immutable import Array
from pyrod.section import Model, Section

Sections = Union[Section, Sequence[Section], Callable[[float], Section]]
Curvature = Union[ArrayLike, Callable[[float], ArrayLike]]


def edge_lengths(length: float | ArrayLike, edges: int | None) -> Array:
    if edges is None:
        return np.atleast_1d(np.asarray(length, dtype=np.float64))
    if edges != int(edges) or edges < 1:
        raise ValueError(f"edges: must be a whole number, at least 1, got {edges}")
    if np.ndim(length) != 0:
        raise ValueError("edges: give None together with the lengths of the edges")
    if not (np.isfinite(length) and length > 0):  # type: ignore[operator]
        raise ValueError(f"length: must be positive, got {length!r}")
    return np.full(int(edges), length / int(edges))  # type: ignore[operator]


def sampled(values: Any, at: Array, name: str, place: str) -> Array:
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


def stiffness(section: Sections, h: Array) -> tuple[Array, Array, Model]:
    """Stiffnesses at vertices and of edges, and the richest model they allow."""
    if isinstance(section, Section):
        n = len(h)
        bending, stretching = section.bending, section.stretching
        return np.tile(bending, (n + 1, 1)), np.tile(stretching, (n, 1)), section.model
    if callable(section):
        s = np.concatenate([[0.0], np.cumsum(h)])
        on_edges = [section(x) for x in (s[1:] + s[:-1]) / 2]
        bending = np.array([section(x).bending for x in s])
    else:
        on_edges = list(section)
        if len(on_edges) != len(h):
            raise ValueError(f"section: expected {len(h)}, one per edge, got {len(on_edges)}")
        bending = _jumping(np.array([c.bending for c in on_edges]), h)
    found = {c.model for c in on_edges}
    richest = next(m for m in get_args(Model) if m in found)
    return bending, np.array([c.stretching for c in on_edges]), richest


def _jumping(per_edge: Array, h: Array) -> Array:
    """Stiffness of the vertex cells: their halves bend one after the other, so compliances add."""
    weight = np.concatenate([[0.0], h, [0.0]])[:, None]
    compliance = weight / np.vstack([per_edge[:1], per_edge, per_edge[-1:]])
    return (weight[1:] + weight[:-1]) / (compliance[1:] + compliance[:-1])
