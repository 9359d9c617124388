"""Quantities: numbers in SI units, or strings such as "2 mm"."""

from __future__ import annotations

import re
from decimal import Decimal
from functools import lru_cache
from math import isfinite
from typing import Any, NamedTuple

from pyrod.base.optional import need
from pyrod.document.problems import a


class Dimension(NamedTuple):
    """What kind of quantity a number is."""

    name: str
    unit: str  #: SI; none of a pure number
    example: str

    @property
    def text(self) -> str:
        """For tables and messages."""
        return f"{self.name} [{self.unit}]" if self.unit else self.name


NONE = Dimension("number", "", "0.3")
LENGTH = Dimension("length", "m", "2 mm")
CURVATURE = Dimension("curvature", "1/m", "0.5 1/cm")
FORCE = Dimension("force", "N", "-2 N")
MOMENT = Dimension("moment", "N m", "3 N mm")
FORCE_PER_LENGTH = Dimension("force per length", "N/m", "-3.5 N/m")
PRESSURE = Dimension("pressure", "Pa", "200 GPa")
DENSITY = Dimension("density", "kg/m^3", "7850 kg/m^3")
BENDING_STIFFNESS = Dimension("bending stiffness", "N m^2", "2 N m^2")
MASS_PER_LENGTH = Dimension("mass per length", "kg/m", "3 g/m")
ACCELERATION = Dimension("acceleration", "m/s^2", "-9.81 m/s^2")
MASS = Dimension("mass", "kg", "1 kg")
MOMENT_OF_INERTIA = Dimension("moment of inertia", "kg m^2", "2 kg mm^2")
TIME = Dimension("time", "s", "1 s")

DIMENSIONS = tuple(d for d in list(globals().values()) if isinstance(d, Dimension))

_FACTOR = r"[^\W\d_]+(?:(?:\^|\*\*)-?\d|[²³])?"
_QUANTITY = re.compile(
    r"(?P<number>[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d{1,3})?) ?"
    rf"(?P<unit>(?:1 ?)?/ ?{_FACTOR}(?: ?[*/·] ?{_FACTOR}| {_FACTOR})*"
    rf"|{_FACTOR}(?: ?[*/·] ?{_FACTOR}| {_FACTOR})*)"
)
"""A number and a product of powers of units. Nothing else reaches the library of units, in which
``9**9**9`` would take for ever."""
LONGEST = 80
WORDS = ("inf", "+inf", "-inf")


class Misread(ValueError):
    """A string that is no quantity of the dimension that is asked for."""


def quantity(text: str, dimension: Dimension) -> float:
    """The number in SI units that a string such as "2 mm" tells.

    Raises
    ------
    Misread
        What is wrong with it.
    """
    if text in WORDS:
        return float(text)
    match = _QUANTITY.fullmatch(text.strip()) if len(text) <= LONGEST else None
    if match is None or dimension is NONE:
        raise Misread(f"expected {_expected(dimension)}")
    unit = match["unit"]
    value = _in_si(Decimal(match["number"]), f"1{unit}" if unit[0] == "/" else unit, dimension)
    if not isfinite(value):
        raise Misread("the number is too large")
    return value


def _expected(dimension: Dimension) -> str:
    if dimension is NONE:
        return "not a string: write the number without quotes and unit, such as 0.3"
    return f'{a(dimension.name)} such as "{dimension.example}" or a number in {dimension.unit}'


def _in_si(number: Decimal, unit: str, dimension: Dimension) -> float:
    """Exact decimal arithmetic: "9.2 mm" is the double that 9.2e-3 is."""
    registry = _registry()
    try:
        units = registry.parse_units(unit.replace("·", "*"))
        kind = units.dimensionality
    except (AttributeError, ValueError, TypeError, KeyError):
        raise Misread(f'unknown unit "{unit}", expected {_expected(dimension)}') from None
    if kind != registry.parse_units(dimension.unit).dimensionality:
        raise Misread(f'expected {_expected(dimension)}; "{unit}" is {_kind(registry, kind)}')
    try:
        return float(registry.Quantity(number, units).to(dimension.unit).magnitude)
    except (ValueError, TypeError):  # decibels and their like
        raise Misread(f'expected {_expected(dimension)}; "{unit}" is on another scale') from None


def _kind(registry: Any, kind: Any) -> str:
    for dimension in DIMENSIONS:
        if registry.parse_units(dimension.unit).dimensionality == kind:
            return f"a unit of {dimension.name}" if dimension.unit else "a pure number"
    return f"a unit of {kind}"


@lru_cache(1)
def _registry() -> Any:
    return need("pint", "files").UnitRegistry(non_int_type=Decimal)
