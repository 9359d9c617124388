"""Every case of the reference folder: the error against the exact solution is of order two."""

from __future__ import annotations

import pytest
from reference_cases import Case, NotPossible, load

LEVELS = (128, 256, 512)  # each a multiple of the 32 sample intervals
ROUNDING = 1e-11


@pytest.mark.parametrize(
    ("case", "space"), [pytest.param(c, s, id=f"{c}-{s}") for c in load() for s in c.spaces]
)
def test_converges_to_the_exact_solution(case: Case, space: str) -> None:
    import pyrod

    try:
        scenes = [case.scene(n, space) for n in LEVELS]
    except NotPossible as reason:
        pytest.skip(f"not yet possible: {reason}")
    errors = [case.errors(pyrod.solve(scene)) for scene in scenes]
    for quantity in errors[0]:
        e = [level[quantity] for level in errors]
        assert e[-1] < 4e-3, f"{quantity}: {e}"
        for coarse, fine in zip(e, e[1:], strict=False):
            assert fine < ROUNDING or 3.5 < coarse / fine < 4.6, f"{quantity}: {e}"


def test_the_folder_holds_cases() -> None:
    assert len(load()) > 0
