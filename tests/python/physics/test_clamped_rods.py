"""Rods clamped at one end, whichever it is: extremes, free turns, small forces, far places."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from support import work

import pyrod
from pyrod import Clamp, DistributedForce, Force, Rod, Scene, Section, solve

ENDS = [("start", "end", 1.0), ("end", "start", -1.0)]
EULER = np.pi**2 / 4


@pytest.mark.parametrize(("held", "free", "_"), ENDS)
def test_a_foil_bends_as_a_strip_however_thin(held: str, free: str, _: float) -> None:
    """Loads in units of the soft stiffness: the stiff direction stays straight, and nothing else
    depends on how stiff it is."""

    def bent(ratio: float) -> pyrod.Equilibrium:
        rod = Rod.straight(1.0, 64, Section(1, ratio, 4 * ratio))
        return solve(Scene(rod, Clamp(at=held), Force((10 * ratio, 1e-3 * ratio, 0), at=free)))

    strip = bent(1e-6).positions
    for ratio in (1e-7, 1e-8, 1e-9, 1e-10):
        foil = bent(ratio)
        assert foil.iterations <= 10
        assert np.abs(foil.positions - strip).max() < 2e-8


@pytest.mark.parametrize("edges", [64, 1024])
@pytest.mark.parametrize(("held", "free", "sign"), ENDS)
def test_a_round_column_that_has_buckled_turns_freely(
    held: str, free: str, sign: float, edges: int
) -> None:
    push = Force((0, 0, -sign * 1.5 * EULER), at=free)
    column = solve(Scene(Rod.straight(1.0, edges, Section(1, 1, 1)), Clamp(at=held), push))
    assert column.stable
    assert column.neutral
    assert column.descents > 0
    assert work(column) <= 12


@pytest.mark.parametrize(("held", "free", "sign"), ENDS)
def test_small_forces_near_the_free_end_are_exact(held: str, free: str, sign: float) -> None:
    """What acts behind a section, however small beside all that acts."""
    n = 10000
    weight = DistributedForce((1.0, 0, 0))
    force = solve(Scene(Rod.straight(1.0, n, Section(1, 1, 1)), Clamp(at=held), weight)).force
    from_free = (sign * force[:, 0])[:: -1 if free == "end" else 1]
    np.testing.assert_allclose(from_free, (np.arange(n) + 0.5) / n, rtol=1e-12)


@pytest.mark.parametrize(("held", "free", "_"), ENDS)
def test_far_from_the_origin_rounding_does_not_add_up(held: str, free: str, _: float) -> None:
    far = np.array((1e7, -2e7, 3e7))
    rod = Rod.straight(1.0, 4000, Section(1, 1, 1))
    here, there = (
        solve(Scene(rod, Clamp(place, at=held), Force((5, 0, 1), at=free)))
        for place in ((0, 0, 0), far)
    )
    assert np.abs(there.positions - far - here.positions).max() < 2 * np.spacing(far.max())


def test_threads_may_solve_one_scene_to_tolerances_at_once() -> None:
    rod = Rod.straight(1.0, None, lambda s: Section(1 + s, 1, 1))
    scene = Scene(rod, Clamp(), Force((5, 1, 0)))
    tolerances = [1e-4, 1e-6, 1e-8] * 8
    alone = {tol: solve(Scene(rod, Clamp(), Force((5, 1, 0))), tol=tol) for tol in tolerances}
    with ThreadPoolExecutor(8) as pool:
        found = list(pool.map(lambda tol: solve(scene, tol=tol), tolerances))
    for tol, result in zip(tolerances, found, strict=True):
        np.testing.assert_array_equal(result.positions, alone[tol].positions)
