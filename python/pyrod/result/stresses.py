"""Stresses of cross-sections with an outline; see docs/accuracy.md."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from pyrod.base.immutable import Array
from pyrod.result.between import Station
from pyrod.result.rods import RodEquilibrium
from pyrod.rod.outline import Circle, Outline, Rectangle, Tube


def normal_stress(rod: RodEquilibrium, at: Station) -> Array:
    """(k,) the largest of either sign in each section [Pa]."""
    axial, moments = at.material_backbone_force[:, 2], at.material_moment

    def one(outline: Outline, rows: Array) -> Array:
        if isinstance(outline, (Circle, Tube)):
            bent = np.linalg.norm(moments[rows, :2], axis=1) * _outer(outline)
            return np.abs(axial[rows]) / outline.area + bent / outline.second_moments[0, 0]
        points = outline.loops()[0]
        lever = np.column_stack([np.ones(len(points)), points[:, 1], -points[:, 0]])
        acting = np.column_stack([axial[rows], moments[rows, :2]])
        strains = np.linalg.solve(_flexure(outline), acting.T)
        return np.abs(lever @ strains).max(axis=0)

    return _of_sections(rod, at.s, one)


def torsional_stress(rod: RodEquilibrium, at: Station) -> Array:
    """(k,) the largest shear stress of the torque in each section [Pa]."""
    return _of_sections(
        rod, at.s, lambda outline, rows: np.abs(at.material_moment[rows, 2]) * _torsion(outline)
    )


def equivalent_stress(rod: RodEquilibrium, at: Station) -> Array:
    """(k,) after von Mises, of normal and torsional stress at the rim of round sections [Pa]."""
    _of_sections(rod, at.s, lambda outline, rows: np.full(len(rows), _refuse_angular(outline)))
    return np.sqrt(normal_stress(rod, at) ** 2 + 3 * torsional_stress(rod, at) ** 2)


def _of_sections(rod: RodEquilibrium, s: Array, one: Callable[[Outline, Array], Array]) -> Array:
    """Values of the sections at these arc lengths, those of one outline at once."""
    told = rod.rod._law.outlines(rod.rod.edge_lengths)
    edges = np.clip(np.searchsorted(rod.s, s, "right") - 1, 0, len(rod.s) - 2)
    rows: dict[Outline, list[int]] = {}
    for i, edge in enumerate(edges.tolist()):
        start, end = told[edge]
        if start is None or end is None:
            raise ValueError(
                "quantity: stresses need the outline of the section, which is not known; give it, "
                "Section(..., outline=Outline.circle(radius))"
            )
        part = (s[i] - rod.s[edge]) / (rod.s[edge + 1] - rod.s[edge])
        here = start if start is end or start == end else start.towards(end, float(part))
        rows.setdefault(here, []).append(i)
    out = np.empty(len(s))
    for outline, which in rows.items():
        out[which] = one(outline, np.array(which))
    return out


def _flexure(outline: Outline) -> Array:
    """(3, 3) what stretch and bending make of force and moments, over E."""
    x, y = outline.centroid * outline.area
    inertia = outline.second_moments
    return np.array(
        [
            [outline.area, y, -x],
            [y, inertia[0, 0], inertia[0, 1]],
            [-x, inertia[1, 0], inertia[1, 1]],
        ]
    )


def _outer(outline: Circle | Tube) -> float:
    return outline.radius if isinstance(outline, Circle) else outline.outer_radius


def _torsion(outline: Outline) -> float:
    """The largest shear stress of a torque of one [1/m^3]."""
    if isinstance(outline, (Circle, Tube)):
        return _outer(outline) / float(outline.second_moments[2, 2])
    if isinstance(outline, Rectangle):
        short, long = sorted((outline.width, outline.height))
        n = np.arange(1, 40, 2)
        half = np.minimum(n * np.pi * long / (2 * short), 700.0)
        rate = 1 - 8 / np.pi**2 * float(np.sum(1 / (n**2 * np.cosh(half))))
        series = float(np.sum(np.tanh(half) / n**5))
        return rate / (short**2 * long * (1 / 3 - 64 * short / (np.pi**5 * long) * series))
    raise ValueError("quantity: torsional stresses are known of circles, tubes and rectangles")


def _refuse_angular(outline: Outline) -> float:
    if not isinstance(outline, (Circle, Tube)):
        raise ValueError("quantity: the equivalent stress is known of circles and tubes")
    return 0.0
