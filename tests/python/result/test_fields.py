"""The table of quantities."""

from __future__ import annotations

import numpy as np
import pytest

import pyrod
from pyrod.result.fields import KINDS, field, fields
from pyrod.result.rods import OfTheOnlyRod, RodEquilibrium
from pyrod.rotation import rotate

ROD = pyrod.Rod.precurved(1.0, 8, pyrod.Section(2.0, 1.0, 1.5, 50.0, 60.0, 70.0), (0.2, 0.4, 1.0))
RESULT = pyrod.solve(pyrod.Scene(ROD, pyrod.Clamp(), pyrod.Force((1.0, 2.0, 3.0))))
(ONE,) = RESULT.rods


def test_shapes_are_those_the_table_says() -> None:
    for name, found in fields(ONE).items():
        rows = 9 if KINDS[name].place == "vertex" else 8
        columns = KINDS[name].components
        assert found.values.shape == ((rows, len(columns)) if columns else (rows,)), name


def test_directors_are_the_columns_of_the_frames() -> None:
    for axis, name in enumerate(("a1", "a2", "a3")):
        expected = rotate(ONE.vertex_frames, np.eye(3)[axis])
        np.testing.assert_allclose(field(ONE, name).values, expected, atol=1e-15)


def test_every_array_of_a_rod_in_equilibrium_is_in_the_table() -> None:
    arrays = {
        name
        for name in pyrod.RodEquilibrium.__dataclass_fields__
        if isinstance(value := getattr(ONE, name), np.ndarray) and len(value) in (8, 9)
    }
    assert arrays <= set(KINDS)
    assert len(arrays) >= 10


def test_values_of_edges_at_vertices() -> None:
    strain = field(ONE, "Gamma")
    assert strain.at_vertices.shape == (9, 3)
    np.testing.assert_array_equal(strain.at_vertices[[0, -1]], strain.values[[0, -1]])
    np.testing.assert_allclose(strain.at_vertices[3], (strain.values[2] + strain.values[3]) / 2)
    curvature = field(ONE, "K")
    assert curvature.at_vertices is curvature.values


def test_magnitudes() -> None:
    moment = field(ONE, "moment")
    np.testing.assert_allclose(moment.magnitude**2, (moment.values**2).sum(axis=1))
    length = field(ONE, "s")
    assert length.magnitude is length.values


def test_an_unknown_quantity_is_refused() -> None:
    with pytest.raises(ValueError, match=r"expected one of s, positions.*got 'colour'"):
        field(ONE, "colour")


def test_editors_are_told_what_is_known_of_the_only_rod() -> None:
    """All that a rod has and an equilibrium has not by itself."""
    rod = {*RodEquilibrium.__dataclass_fields__, *vars(RodEquilibrium)}
    own = {*pyrod.Equilibrium.__dataclass_fields__, *vars(pyrod.Equilibrium)}
    assert {n for n in rod - own if not n.startswith("_")} == {*OfTheOnlyRod.__annotations__}
