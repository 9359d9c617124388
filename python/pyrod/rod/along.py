"""Sections along a rod: one for all, one per edge, or a function of arc length."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from itertools import pairwise
from typing import Any, Union

import numpy as np
from numpy.typing import ArrayLike

from pyrod.base.immutable import Array, frozen
from pyrod.rod.outline import Outline
from pyrod.rod.section import Section

Sections = Union[Section, Sequence[Section], Callable[[float], Section]]
Curvature = Union[ArrayLike, Callable[[float], ArrayLike]]
EndOutlines = tuple[Outline | None, Outline | None]
"""Outlines at the start and at the end of an edge, on its own side of where they jump."""


def section_rows(section: Sections, edges: int) -> Any:
    """What the compiled rod takes: the numbers of one, a row per edge, or a function of these."""
    if isinstance(section, Section):
        return _numbers_of(section)
    if callable(section):
        return lambda s: _numbers_of(_checked_section(section(s)))
    if not isinstance(section, Iterable):
        raise TypeError(
            "section: expected a Section, as Section.circle(radius, material), got a "
            f"{type(section).__name__}"
        )
    rows = [_numbers_of(_checked_section(one)) for one in section]
    if len(rows) != edges:
        raise ValueError(f"section: expected {edges}, one per edge, got {len(rows)}")
    return np.array(rows)


def outlines_of(section: Sections, h: Array) -> tuple[EndOutlines, ...]:
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


def _numbers_of(of: Section) -> tuple[float, ...]:
    return (of.EI1, of.EI2, of.GJ, of.GA1, of.GA2, of.EA, of.mass_per_length)


def _checked_section(section: Section) -> Section:
    if not isinstance(section, Section):
        raise TypeError(
            "section: expected a Section, as Section.circle(radius, material), got a "
            f"{type(section).__name__}"
        )
    return section
