"""Every case of the reference folder: the error against the exact solution is of order two.

The environment variable PYROD_REFERENCE names another folder of the same form.
"""

from __future__ import annotations

import os
from itertools import pairwise
from pathlib import Path

import pytest

import pyrod
from pyrod.reference import Case, NotPossible, load

FOLDER = Path(os.environ.get("PYROD_REFERENCE", Path(__file__).parents[1] / "reference"))
CASES = load(FOLDER)

CELLS = (4, 8, 16)  # edges in a sample interval
ROUNDING = 1e-11


@pytest.mark.parametrize(
    ("case", "space"), [pytest.param(c, s, id=f"{c}-{s}") for c in CASES for s in c.spaces]
)
def test_converges_to_the_exact_solution(case: Case, space: str) -> None:
    try:
        scenes = [case.scene(n * case.intervals, space) for n in CELLS]
    except NotPossible as reason:
        pytest.skip(f"not yet possible: {reason}")
    errors = [case.errors(pyrod.solve(scene)) for scene in scenes]
    for quantity in errors[0]:
        e = [level[quantity] for level in errors]
        assert e[-1] < 4e-3, f"{quantity}: {e}"
        for coarse, fine in pairwise(e):
            assert fine < ROUNDING or coarse / fine > 3.4, f"{quantity}: {e}"


def test_the_folder_holds_cases() -> None:
    assert CASES, f"no cases in {FOLDER}"
