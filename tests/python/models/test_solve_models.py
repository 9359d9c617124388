"""The model as an argument of `solve`, and what a result tells of richer ones."""

from __future__ import annotations

import gc
import weakref
from pathlib import Path

import numpy as np
import pytest

import pyrod
from pyrod import Clamp, DistributedForce, Force, Options, Rod, Scene, Section
from pyrod.reference import load as cases

REFERENCE = Path(__file__).parents[2] / "reference"
BEAM = Section(1.0, 1.5, 0.7, 4e4, 4e4, 1e5)


def scene(edges: int | None = None) -> Scene:
    return Scene(Rod.straight(1.0, edges, BEAM), Clamp(), Force((3, 0, 0)))


@pytest.mark.parametrize(("tol", "model"), [(1e-3, "inextensible"), (1e-8, "cosserat")])
def test_the_smallest_model_that_will_do(tol: float, model: str) -> None:
    full = pyrod.solve(scene(), tol=1e-10)
    result = pyrod.solve(scene(), tol=tol, model="auto")
    assert result.scene.rods[0].model == model
    assert result.scene.space == "planar"
    assert result.choice.startswith(f"planar, {model}: extension changes results by ")
    assert np.abs(result.tip - full.tip).max() <= 2 * tol
    assert result.accuracy.reached <= tol


def test_a_model_by_its_name() -> None:
    result = pyrod.solve(scene(16), model="extensible")
    assert result.scene.rods[0].model == "extensible"
    assert np.all(result.Gamma[:, 0] == 0)
    assert np.any(result.Gamma[:, 2] != 1)
    assert result.choice is None
    with pytest.raises(ValueError, match="model: expected one of"):
        pyrod.solve(scene(16), model="rigid")
    with pytest.raises(ValueError, match="model: 'auto' needs tol"):
        pyrod.solve(scene(16), model="auto")


def test_a_result_tells_what_it_leaves_out() -> None:
    rod = Rod.straight(1.0, None, BEAM, "inextensible")
    result = pyrod.solve(Scene(rod, Clamp(), Force((3, 0, 0)), "planar"), tol=1e-8)
    richer = pyrod.solve(
        Scene(Rod.straight(1.0, None, BEAM), Clamp(), Force((3, 0, 0)), "planar"), tol=1e-10
    )
    found = result.effect("strains")
    change = richer.tip - result.tip
    # on the 16 edges of the result, of second order in h
    assert np.linalg.norm(found.tip - change) < 0.02 * np.linalg.norm(change)
    assert result.out_of_plane_index == 0


@pytest.mark.parametrize("load", [Force((1, 0, 0)), DistributedForce(lambda s: (s, 0, 0))])
@pytest.mark.parametrize("ends", [1, 2])
def test_a_scene_that_was_solved_is_let_go(load: object, ends: int) -> None:
    clamps = [Clamp(), Clamp((0.1, 0, 0.9), at="end")][:ends]
    made = Scene(Rod.straight(1.0, None, BEAM), clamps, load)
    pyrod.solve(made, tol=1e-5)
    alive = weakref.ref(made), weakref.ref(made._climbing)
    del made
    gc.collect()
    assert [one() for one in alive] == [None, None]


@pytest.mark.parametrize("ends", [1, 2])
def test_a_start_goes_on_where_the_first_grids_fail(ends: int) -> None:
    """Level 0 has no time for more than one iteration; the start is right on all levels."""
    clamps = [Clamp(), Clamp((0.2, 0.1, 0.7), at="end")][:ends]
    made = Scene(Rod.straight(1.0, 16, BEAM), clamps, Force((4, 2, 1), at=0.5))
    exact = pyrod.solve(made, tol=1e-10)
    turned = pyrod.rotation.multiply(exact.frames, pyrod.rotation.exp([1e-3, 0, 0]))
    few = Options(max_iterations=2, max_edges=2**12)
    result = pyrod.solve(made, few, tol=1e-3, start=turned, strict=False)
    assert result.accuracy.grids > 3  # the first ones failed
    assert result.status in ("converged", "not_accurate", "out_of_iterations")


def test_a_start_is_refined_with_the_grids() -> None:
    """32 edges are too few for this soliton, but not for a start."""
    case = cases(REFERENCE / "S6_soliton_a.json")[0]
    result = pyrod.solve(case.scene(32), start=case.start(32), stable=False, tol=1e-4, strict=False)
    assert "frame per edge" not in result.advice
    assert result.accuracy.grids > 2
