"""Clamped cases on many edges: the shape is found on few, and little is left to do on all."""

from __future__ import annotations

import numpy as np
import pytest
from cases import CASES, parameters

import pyrod
from pyrod.reference import Case

NEUTRAL = ("S4_twist_X0.8_t0.5_iso", "S4_twist_X0.8_t1_iso", "S7_ring")
"""Rounding moves them along a circle of equilibria, at each step anew."""
LAYERS = ("P5_chain",)
"""Boundary layers of a hundredth of the length: few edges do not tell the shape in them."""
CLAMPED = [c for c in CASES if c.found_alone and c.data["bc"]["s0"]["type"] == "clamped"]


@pytest.mark.parametrize("edges", [1024, 3000])
@pytest.mark.parametrize(("case", "space"), parameters(CLAMPED))
def test_one_step_and_its_check_on_all_edges(case: Case, space: str, edges: int) -> None:
    result = pyrod.solve(case.scene(edges, space))
    on_all = result.record["unknowns"] == result.unknowns
    most = 4 if str(case).startswith(NEUTRAL) else 3 if str(case).startswith(LAYERS) else 2
    assert np.count_nonzero(on_all) <= most
    assert on_all[-1]
    assert result.record["exact"][-1]
    assert max(case.nearest(result).errors(result).values()) < 4e-3
