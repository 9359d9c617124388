"""Sections along a rod: one for all, one per edge, or a function of arc length."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from itertools import pairwise
from typing import Union, get_args

import numpy as np
from numpy.typing import ArrayLike

from pyrod._immutable import Array, frozen
from pyrod.outline import Outline
from pyrod.section import Model, Section

Sections = Union[Section, Sequence[Section], Callable[[float], Section]]
Curvature = Union[ArrayLike, Callable[[float], ArrayLike]]
Ends = tuple[Outline | None, Outline | None]
"""Outlines at the start and at the end of an edge, on its own side of where they jump."""


def stiffness(section: Sections, h: Array) -> tuple[Array, Array, Array, Model]:
    """Stiffnesses at vertices and of edges, masses of these, and the richest model they allow."""
    if isinstance(section, Section):
        n = len(h)
        bending, stretching = section.bending, section.stretching
        mass = np.full(n, section.mass_per_length)
        return np.tile(bending, (n + 1, 1)), np.tile(stretching, (n, 1)), mass, section.model
    if callable(section):
        s = np.concatenate([[0.0], np.cumsum(h)])
        on_edges = [_checked(section(x)) for x in (s[1:] + s[:-1]) / 2]
        bending = np.array([_checked(section(x)).bending for x in s])
    elif not isinstance(section, Iterable):
        raise TypeError(f"section: expected a Section, got a {type(section).__name__}")
    else:
        on_edges = [_checked(one) for one in section]
        if len(on_edges) != len(h):
            raise ValueError(f"section: expected {len(h)}, one per edge, got {len(on_edges)}")
        bending = _jumping(np.array([c.bending for c in on_edges]), h)
    found = {c.model for c in on_edges}
    richest = next(m for m in get_args(Model) if m in found)
    mass = np.array([c.mass_per_length for c in on_edges])
    return bending, np.array([c.stretching for c in on_edges]), mass, richest


def outlines(section: Sections, h: Array) -> tuple[Ends, ...]:
    """Outlines at both ends of each edge."""
    if isinstance(section, Section):
        return ((section.outline, section.outline),) * len(h)
    if callable(section):
        s = np.concatenate([[0.0], np.cumsum(h)])
        inside = 1e-9 * s[-1]
        return tuple(
            (section(a + inside).outline, section(b - inside).outline) for a, b in pairwise(s)
        )
    return tuple((one.outline, one.outline) for one in section)


def masses(values: ArrayLike, edges: int) -> Array:
    """One mass per length for each edge."""
    mass = frozen(values, "mass_per_length")
    if mass.shape not in ((), (edges,)):
        raise ValueError(
            f"mass_per_length: expected {edges} numbers, one per edge, got shape {mass.shape}"
        )
    if not (np.isfinite(mass) & (mass >= 0)).all():
        raise ValueError("mass_per_length: expected finite numbers, not negative")
    return mass if mass.shape else frozen(np.full(edges, mass))


def _checked(section: Section) -> Section:
    if not isinstance(section, Section):
        raise TypeError(f"section: expected a Section, got a {type(section).__name__}")
    return section


def _jumping(per_edge: Array, h: Array) -> Array:
    """Stiffness of the vertex cells: their halves bend one after the other, so compliances add."""
    weight = np.concatenate([[0.0], h, [0.0]])[:, None]
    compliance = weight / np.vstack([per_edge[:1], per_edge, per_edge[-1:]])
    return (weight[1:] + weight[:-1]) / (compliance[1:] + compliance[:-1])
