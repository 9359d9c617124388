"""Sections that vary along a rod."""

from __future__ import annotations

import numpy as np
import pytest
from support import ROUND, orders, solved

import pyrod
from pyrod import Rod, Section


def test_section_function_is_taken_at_vertices_and_centres() -> None:
    rod = Rod.straight(1.0, 2, lambda s: Section(1 + s, 1, 1, 1, 1, 1 + s))
    np.testing.assert_array_equal(rod.bending[:, 0], [1, 1.5, 2])
    np.testing.assert_array_equal(rod.stretching[:, 2], [1.25, 1.75])


def test_compliances_of_the_two_halves_of_a_cell_add() -> None:
    rod = Rod.precurved([1.0, 3.0], None, [Section(1, 1, 1), Section(2, 4, 8)], (0, 0, 0))
    middle = [4 / (1 + 3 / k) for k in (2, 4, 8)]
    np.testing.assert_allclose(rod.bending, [[1, 1, 1], middle, [2, 4, 8]], rtol=1e-15)


def stepped_tip(n: int, load: float) -> float:
    """Deflection of a cantilever whose second half is ten times softer."""
    sections = [Section(10, 10, 10)] * (n // 2) + [Section(1, 1, 1)] * (n // 2)
    return solved(Rod.straight(1.0, n, sections), pyrod.Force((load, 0, 0)), space="planar").tip[0]


def test_stepped_cantilever_converges_with_order_two() -> None:
    """Small deflection: F L^3 ((1 - 1/8)/(3 EI_a) + (1/8)/(3 EI_b)), by parts."""
    load = 1e-6
    exact = load * (7 / 8 / 30 + 1 / 8 / 3)
    errors = [abs(stepped_tip(n, load) / exact - 1) for n in (8, 16, 32, 64)]
    np.testing.assert_allclose(orders(errors), 2, atol=0.02)


def test_stepped_cantilever_converges_with_order_two_in_large_deflection() -> None:
    tips = [stepped_tip(n, 5.0) for n in (16, 32, 64, 128, 256)]
    np.testing.assert_allclose(orders(np.abs(np.diff(tips))), 2, atol=0.05)


@pytest.mark.parametrize("count", [0, 1, 3])
def test_wrong_number_of_sections_is_refused(count: int) -> None:
    with pytest.raises(ValueError, match=f"section: expected 2, one per edge, got {count}"):
        Rod.straight(1.0, 2, [ROUND] * count)
