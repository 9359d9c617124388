"""One number per row out of every quantity, with a label."""

from __future__ import annotations

import numpy as np

import pyrod
from pyrod.pictures.measure import measure, measures

Equilibrium = pyrod.Equilibrium


def test_all_measures_have_a_number_per_row_and_a_label(cantilever: Equilibrium) -> None:
    assert {"s", "moment", "moment.x", "frames.qw", "Gamma.3"} <= set(measures())
    for name in measures():
        found = measure(cantilever, name)
        (values,) = found.values
        assert values.shape == (11 if found.place == "vertex" else 10,), name
        assert found.label.endswith("]"), name
        assert found.at_vertices[0].shape == (11,)
    assert measure(cantilever, "s").label == "arc length s [m]"
    assert measure(cantilever, "K").label == "curvature and twist |K| [1/m]"
    assert measure(cantilever, "K.3").label == "curvature and twist K3 [1/m]"
    assert measure(cantilever, "Gamma.3").label == "shear and stretch Γ3 [1]"
    assert measure(cantilever, "frames.qw").label == "frame qw [1]"


def test_values_of_edges_at_vertices_are_means(cantilever: Equilibrium) -> None:
    values = measure(cantilever, "force.x").at_vertices[0]
    np.testing.assert_allclose(values[1], cantilever.force[:2, 0].mean(), rtol=1e-15)
    np.testing.assert_array_equal(values[[0, -1]], cantilever.force[[0, -1], 0])
