"""One number per row out of every quantity, with a label."""

from __future__ import annotations

import numpy as np
import pytest
from support import SOFT, solved

import pyrod
from pyrod import Force, Rod
from pyrod._measure import measure, measures

Equilibrium = pyrod.Equilibrium


@pytest.fixture(scope="module")
def one() -> Equilibrium:
    rod = Rod.precurved(1.0, 10, SOFT, (0.3, 1.0, 0.5))
    return solved(rod, Force((1, 3, -5)), eigenvalue=True)


def test_all_measures_have_a_number_per_row_and_a_label(one: Equilibrium) -> None:
    assert {"s", "moment", "moment.x", "frames.qw", "Gamma.3"} <= set(measures())
    for name in measures():
        found = measure(one, name)
        (values,) = found.values
        assert values.shape == (11 if found.place == "vertex" else 10,), name
        assert found.label.endswith("]"), name
        assert found.at_vertices[0].shape == (11,)
    assert measure(one, "s").label == "arc length s [m]"
    assert measure(one, "K").label == "curvature and twist |K| [1/m]"
    assert measure(one, "K.3").label == "curvature and twist K3 [1/m]"
    assert measure(one, "Gamma.3").label == "shear and stretch Γ3 [1]"
    assert measure(one, "frames.qw").label == "frame qw [1]"


def test_values_of_edges_at_vertices_are_means(one: Equilibrium) -> None:
    values = measure(one, "force.x").at_vertices[0]
    np.testing.assert_allclose(values[1], one.force[:2, 0].mean(), rtol=1e-15)
    np.testing.assert_array_equal(values[[0, -1]], one.force[[0, -1], 0])
