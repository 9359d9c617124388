"""Whatever is given for a number or an array: taken as it is meant, or refused in plain words."""

from __future__ import annotations

from collections.abc import Callable
from decimal import Decimal
from fractions import Fraction
from typing import Any

import numpy as np
import pandas as pd
import pytest
from arguments import (
    ARRAYS,
    E3,
    FRAMES,
    MANY_FRAMES,
    NUMBERS,
    OTHER_WORDS,
    RING,
    SOFT,
    STEEL,
    UNITS,
    Call,
    assert_matches,
    named,
    refused,
)

import pyrod
from pyrod import Outline, Rod, Section
from pyrod.curve import Polyline

RECORDS = np.zeros(4, dtype=[("x", "f8"), ("y", "f8"), ("z", "f8")])
STRANGE: dict[str, tuple[Any, str]] = {
    "quantity": (np.ones(3) * UNITS.kN, "kilonewton; give its magnitude in SI units"),
    "quantities": ([1 * UNITS.mm, 2 * UNITS.mm, 3 * UNITS.mm], "millimeter; give its magnitude"),
    "masked": (
        np.ma.masked_equal([[1.0, -1.0, 2.0]] * 4, -1),
        r"\[0, 1\]: is masked, as are 4 num",
    ),
    "masked, one": (np.ma.masked, "is masked"),
    "complex": (np.ones(3) * 1j, r"got complex ones; take their real part"),
    "complex, one": (1 + 1j, r"got complex ones; take their real part"),
    "ragged": ([[1.0, 2.0, 3.0], [4.0, 5.0]], "in rows of one length"),
    "text": ("1 m", "got '1 m'; texts with units are for scene files"),
    "texts": (["1", "2", "3"], "texts with units are for scene files"),
    "NA": ([1.0, pd.NA, 2.0], "expected numbers, got a NAType among them"),
    "none": ([1.0, None, 2.0], "expected numbers, got None among them"),
    "records": (RECORDS, "fields x, y, z; stack their columns"),
    "dict": ({"x": 1.0}, "expected numbers, got a dict"),
    "map": (map(float, [1, 2, 3]), "expected numbers, got a map"),
    "dates": (np.zeros(3, dtype="M8[s]"), "expected numbers, got"),
    "huge": ([10**400, 1, 1], "too large"),
}


PLAIN_NUMBERS = {name: entry for name, entry in NUMBERS.items() if name not in OTHER_WORDS}


@pytest.mark.parametrize(
    ("argument", "call"), named(PLAIN_NUMBERS) + named(ARRAYS | FRAMES | MANY_FRAMES)
)
def test_strange_things(argument: str, call: Call) -> None:
    for value, words in STRANGE.values():
        text = refused(call, value)
        assert text.startswith(argument)
        assert_matches(words, text)


@pytest.mark.parametrize("name", sorted(OTHER_WORDS))
def test_places_and_options(name: str) -> None:
    argument, call = NUMBERS[name]
    for value, _ in STRANGE.values():
        assert refused(call, value).startswith(argument)


@pytest.mark.parametrize(("argument", "call"), named(PLAIN_NUMBERS))
def test_one_number_is_wanted(argument: str, call: Call) -> None:
    text = refused(call, np.eye(3))
    assert text.startswith((argument, "edges"))


@pytest.mark.parametrize("name", [k for k in NUMBERS if k not in {"Section.GA1", "Section.GA2"}])
def test_no_number(name: str) -> None:
    argument, call = NUMBERS[name]
    if name != "Section.EA":  # infinite is a stiffness, too; NaN is none
        assert argument in refused(call, np.nan)
    assert argument in refused(call, -np.inf)


LET_THROUGH = ("vector", "values", "force_per_length", "moment_per_length")
"""Rotations and averages of NaN are NaN; loads along rods meet their rod in the scene."""


@pytest.mark.parametrize(
    ("argument", "call"),
    named({k: entry for k, entry in ARRAYS.items() if entry[0] not in LET_THROUGH}),
)
def test_arrays_with_nan(argument: str, call: Call) -> None:
    for shape in ((3,), (4, 3), (5, 3)):
        text = refused(call, np.full(shape, np.nan))
        assert argument in text or (argument == "curvature" and text.startswith("K0"))


ONE = {
    "0-d": np.array,
    "of one": lambda x: np.array([x]),
    "float32": np.float32,
    "fraction": lambda x: Fraction(x).limit_denominator(1000),
    "decimal": lambda x: Decimal(str(x)),
    "series": lambda x: pd.Series([x]),
    "unmasked": lambda x: np.ma.array([x]),
}


@pytest.mark.parametrize("form", ONE)
def test_one_number_in_any_form(form: str) -> None:
    one = ONE[form]
    assert Section(EI1=one(0.5), EI2=one(0.25), GJ=one(2)) == Section(0.5, 0.25, 2.0)
    assert Section.circle(one(0.5), STEEL) == Section.circle(0.5, STEEL)
    assert Outline.rectangle(one(0.5), one(2)) == Outline.rectangle(0.5, 2)
    assert Rod.straight(one(0.5), one(4), SOFT).length == 0.5
    assert pyrod.Force(E3, at=one(0.5)).at == 0.5
    assert pyrod.Clamp(turns=one(2)).turns == 2
    assert pyrod.Spring(one(0.5)).stiffness == 0.5
    assert RING.closed_ribbon(one(0)).link() == 0


@pytest.mark.parametrize(
    "form",
    [
        lambda x: x.astype(np.float32),
        lambda x: x.tolist(),
        lambda x: [tuple(row) for row in x],
        np.asfortranarray,
        lambda x: np.ma.array(x, mask=False),
        pd.DataFrame,
        lambda x: x.astype(object),
        lambda x: [[Fraction(v) for v in row] for row in x],
    ],
)
def test_tables_in_any_form(form: Callable[[Any], Any]) -> None:
    points = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [1, 1, 0.5]])
    assert Polyline(form(points)) == Polyline(points)
