"""Materials and cross-sections."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from math import inf, isinf
from typing import Literal

import numpy as np

import pyrod._core as _core
from pyrod.base.arrays import Array, not_negative, number
from pyrod.base.calls import Answering, spelled
from pyrod.rod.outline import Outline

Model = Literal["cosserat", "extensible", "inextensible"]


@dataclass(frozen=True)
class Material(Answering):
    """Isotropic, linearly elastic material.

    Parameters
    ----------
    E : float [Pa]
        Young's modulus, positive.
    nu : float
        Poisson's ratio, in (-1, 0.5]; default 0.3.
    density : float [kg/m^3]
        For `Gravity`; default 0.
    """

    E: float
    nu: float = 0.3
    density: float = 0.0

    def __post_init__(self) -> None:
        _to_numbers(self, "E", "nu", "density")
        _core.section.check_material(self.E, self.nu)
        not_negative(self.density, "density")

    @property
    def G(self) -> float:
        """Shear modulus E/(2 (1 + nu)) [Pa]."""
        return self.E / (2 * (1 + self.nu))


@dataclass(frozen=True)
class Section(Answering):
    """Stiffnesses of a cross-section, from dimensions or given outright.

    Parameters
    ----------
    EI1, EI2 : float [N m^2]
        Bending stiffness about the directors a1, a2.
    GJ : float [N m^2]
        Torsional stiffness.
    GA1, GA2 : float [N]
        Shear stiffness along a1, a2; default infinite, the rod does not shear.
    EA : float [N]
        Axial stiffness; default infinite, the rod keeps its length.
    mass_per_length : float [kg/m]
        For `Gravity`; default 0.
    outline : `Outline`
        What the section looks like, for pictures and solids; by keyword. Default None: unknown. No
        stiffness follows from it.
    """

    EI1: float
    EI2: float
    GJ: float
    GA1: float = inf
    GA2: float = inf
    EA: float = inf
    mass_per_length: float = 0.0
    outline: Outline | None = field(default=None, kw_only=True)

    def __post_init__(self) -> None:
        _to_numbers(self, "EI1", "EI2", "GJ", "GA1", "GA2", "EA", "mass_per_length")
        _core.section.check(self.EI1, self.EI2, self.GJ, self.GA1, self.GA2, self.EA)
        not_negative(self.mass_per_length, "mass_per_length")
        if not isinstance(self.outline, Outline | None):
            raise TypeError(
                f"outline: expected an Outline or None, got a {type(self.outline).__name__}"
            )

    @staticmethod
    @spelled
    def circle(radius: float, material: Material) -> Section:
        """Solid circle of the given radius [m]. Shear after Cowper (1966)."""
        radius, material = number(radius, "radius"), _checked_material(material)
        stiffnesses = _core.section.circle(radius, material.E, material.nu)
        return _of(stiffnesses, material, Outline.circle(radius))

    @staticmethod
    @spelled
    def tube(outer_radius: float, inner_radius: float, material: Material) -> Section:
        """Ring between two radii. Shear after Cowper (1966).

        Parameters
        ----------
        outer_radius, inner_radius : float [m]
        material : `Material`
        """
        outer_radius = number(outer_radius, "outer_radius")
        inner_radius, material = number(inner_radius, "inner_radius"), _checked_material(material)
        stiffnesses = _core.section.tube(outer_radius, inner_radius, material.E, material.nu)
        return _of(stiffnesses, material, Outline.tube(outer_radius, inner_radius))

    @staticmethod
    @spelled
    def rectangle(width: float, height: float, material: Material) -> Section:
        """Solid rectangle. Torsion after Saint-Venant, shear after Cowper (1966).

        Parameters
        ----------
        width, height : float [m]
            Along a1 and a2.
        material : `Material`
        """
        width, height = number(width, "width"), number(height, "height")
        material = _checked_material(material)
        stiffnesses = _core.section.rectangle(width, height, material.E, material.nu)
        return _of(stiffnesses, material, Outline.rectangle(width, height))

    @property
    def bending(self) -> Array:
        """(EI1, EI2, GJ), the diagonal of C_bt in Linn (49)."""
        return np.array([self.EI1, self.EI2, self.GJ], dtype=np.float64)

    @property
    def stretching(self) -> Array:
        """(GA1, GA2, EA), the diagonal of C_es in Linn (51)."""
        return np.array([self.GA1, self.GA2, self.EA], dtype=np.float64)

    @property
    def model(self) -> Model:
        """The richest rod model that the finite stiffnesses allow."""
        if isinf(self.EA):
            return "inextensible"
        return "extensible" if isinf(self.GA1) else "cosserat"


def _of(stiffnesses: Iterable[float], material: Material, outline: Outline) -> Section:
    mass = outline.area * material.density
    return replace(Section(*stiffnesses), mass_per_length=mass, outline=outline)


def _to_numbers(made: Material | Section, *names: str) -> None:
    for name in names:
        value = getattr(made, name)
        if type(value) is not float and type(value) is not int:
            object.__setattr__(made, name, number(value, name))


def _checked_material(material: Material) -> Material:
    if not isinstance(material, Material):
        raise TypeError(
            f"material: expected a Material, as Material(E=210e9), got a {type(material).__name__}"
        )
    return material
