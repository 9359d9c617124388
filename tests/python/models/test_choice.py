"""The smallest model for a tolerance, against the differences to the full model."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from support import FLAT, REFERENCE, X, Y, Z

import pyrod
from pyrod import Clamp, DistributedForce, Force, Hinge, Moment, Rod, Scene, Section, Slider, solve
from pyrod.models.effects import _changes
from pyrod.reference import Case, load

THICK = Section(4, 1, 2, 60, 80, 200)
BEAMS = [
    load(REFERENCE / f"P4_{name}.json")[0]
    for name in ("thick_F1_a90", "thick_F10_a90", "slender1e4_F10_a135", "slender1e6_F10_a90")
]


def of_model(scene: Scene, model: Any, space: Any) -> Scene:
    rods = [replace(rod, model=model) for rod in scene.rods]
    return Scene(rods, scene.supports, scene.loads, space, scene.joints)


def missed(result: pyrod.Equilibrium) -> float:
    """What a result really differs from the full model's, in space."""
    full = of_model(result.scene, "cosserat", "spatial")
    return max(_changes(result, solve(full, start=result, stable=False)).values())


# The right tolerance ------------------------------------------------------------------------------


@pytest.mark.parametrize("case", BEAMS, ids=str)
def test_models_change_at_the_right_tolerance(case: Case) -> None:
    """At the true error of each model; the first order knows it to a part of its size."""
    scene = case.scene(case.intervals, "spatial")
    errors = {
        model: missed(solve(of_model(scene, model, "planar")))
        for model in ("inextensible", "extensible")
    }
    for model, error in errors.items():
        close = 1 + 2 * error
        found = pyrod.smallest_model(scene, error * close)
        assert (found.space, found.model) == ("planar", model)
        assert found.error == pytest.approx(error, rel=2 * error)
        assert pyrod.smallest_model(scene, error / close).model != model
    below = min(errors.values()) / 3
    assert pyrod.smallest_model(scene, below).model == "cosserat"


def test_errors_go_with_the_compliance() -> None:
    """Stiffer by 100: the error of the poorest model falls by 100."""
    at = [
        pyrod.smallest_model(load(REFERENCE / f"P4_{name}_F10_a90.json")[0].scene(64, "spatial"), 1)
        for name in ("slender1e4", "slender1e6")
    ]
    assert at[0].error / at[1].error == pytest.approx(100, rel=1e-2)
    for of in ("extension", "shear"):
        assert at[0].sizes[of] / at[1].sizes[of] == pytest.approx(100, rel=1e-2)


def random_scene(rng: np.random.Generator) -> Scene:
    """Thick to slender; in the plane, where it is soft, or in space; one end free or both held."""
    planar, slender = rng.random() < 0.5, 10 ** rng.uniform(1.5, 6)
    flat = np.array([1.0, 0.0 if planar else 1.0, 1.0])
    EI = 10 ** rng.uniform(-0.5, 0.5, 3) * ([30, 1, 30] if planar else 1)
    K0 = rng.uniform(-1.5, 1.5, 3) * ([0, 1, 0] if planar else 1)
    rod = Rod.precurved(1.0, 16, Section(*EI, *(slender * rng.uniform(0.3, 1, 3))), K0)
    force, end = rng.normal(size=(2, 3)) * flat
    force *= 10 ** rng.uniform(-1, 1) / np.linalg.norm(force)
    end *= rng.uniform(0.6, 0.95) / np.linalg.norm(end)
    other: Any = [[], [Clamp(end, at="end")], [Hinge(end, at="end")]][rng.integers(3)]
    loads: Any = [Force(force, at=0.5), DistributedForce(force), Force(force)]
    return Scene(rod, [Clamp(), *other], loads[rng.integers(2 if other else 3)])


@pytest.mark.filterwarnings("ignore::pyrod.StrainWarning")
def test_a_choice_is_as_good_as_it_says() -> None:
    """The difference to the full model is below the tolerance; with a poorer model it is not.

    Predicted to first order, with errors that are a part of the tolerance.
    """
    rng = np.random.default_rng(5)
    models = []
    for _ in range(120):
        scene, tol = random_scene(rng), 10 ** rng.uniform(-5, -1.5)
        found = pyrod.smallest_model(scene, tol)
        models.append((found.space, found.model))
        assert found.error <= tol
        if found.error > 0:
            assert missed(found.result) == pytest.approx(found.error, rel=0.02), found.text
        if found.model == "extensible":
            poorer = solve(of_model(scene, "inextensible", found.space))
            assert pyrod.effect(poorer, "strains").size > tol
    assert len(set(models)) == 6
    assert min(models.count(m) for m in set(models)) >= 2


# What it says -------------------------------------------------------------------------------------


def test_it_says_why() -> None:
    scene = BEAMS[-1].scene(16, "spatial")
    found = pyrod.smallest_model(scene, 1e-3)
    assert found.text == (
        f"planar, inextensible: extension changes results by {found.sizes['extension']:.2g}, "
        f"shear changes results by {found.sizes['shear']:.2g} (tol 0.001); "
        "out of the plane it is stable"
    )
    assert list(found.sizes) == ["extension", "shear", "space"]
    assert found.sizes["space"] < 1e-11
    assert found.scene.space == "planar"
    assert found.scene.rod.model == "inextensible"
    assert found.result.converged
    assert found.error < found.sizes["extension"] + found.sizes["shear"] * 1.01


@pytest.mark.parametrize(
    ("rod", "force", "why"),
    [
        (Rod.straight(1.0, 8, THICK), X + Y, "load 0 (Force) has a component 1 along a2"),
        (
            Rod.precurved(1.0, 8, THICK, (0, 1, 1)),
            X,
            "rod 0 is twisted at rest, K0 = 1",
        ),
        (
            Rod.precurved(1.0, 8, THICK, (1, 0, 0)),
            Y,
            "it lies in the plane of a2 and a3",
        ),
    ],
)
def test_what_is_not_planar_says_so(rod: Rod, force: Any, why: str) -> None:
    found = pyrod.smallest_model(Scene(rod, Clamp(), Force(force)), 1e-9)
    assert found.text.startswith(f"spatial ({why}), cosserat: ")
    assert found.result.scene.space == "spatial"
    assert "space" not in found.sizes


def test_what_leaves_its_plane_is_spatial() -> None:
    """A strip that buckles sideways at P = 4.27, on its strong side."""
    strip = Rod.straight(1.0, 16, Section(1, 20, 1))
    for P, space in ((4.1, "planar"), (4.5, "spatial")):
        found = pyrod.smallest_model(Scene(strip, Clamp(), Force(P * X)), 1e-3)
        assert found.space == space
        assert found.result.stable
        assert (np.abs(found.result.positions[:, 1]).max() > 0.05) == (space == "spatial")
    assert found.text.startswith("spatial (in its plane it is unstable), inextensible: ")


def test_a_scene_that_is_declared_planar_stays_so() -> None:
    strip = Rod.straight(1.0, 16, Section(1, 20, 1))
    found = pyrod.smallest_model(Scene(strip, Clamp(), Force(4.5 * X), "planar"), 1e-3)
    assert found.space == "planar"
    assert found.text.endswith("; out of the plane it is unstable")
    held = [Clamp(), Slider((1, 0.1, 0), position=(0, 0, 0.9), clamped=True)]
    found = pyrod.smallest_model(Scene(Rod.straight(1.0, 16, FLAT), held, space="planar"), 1e-3)
    assert found.text.endswith("; in space support 1 (Slider) may move aslant to the plane")


def test_without_a_potential_stability_is_unknown() -> None:
    scene = Scene(Rod.straight(1.0, 16, FLAT), Clamp(), Moment(Y))
    found = pyrod.smallest_model(scene, 1e-3)
    assert found.space == "planar"
    assert found.text.endswith(
        "shear would change nothing (tol 0.001); in space the loads have no potential"
    )


def test_what_cannot_do_without_a_strain_gets_it() -> None:
    """Clamps that are further apart than the rod is long."""
    rod = Rod.straight(1.0, 16, THICK, "inextensible")
    found = pyrod.smallest_model(Scene(rod, [Clamp(), Clamp(1.02 * Z, at="end")]), 1e-6)
    assert found.model == "extensible"
    assert found.sizes["extension"] == np.inf
    assert found.sizes["shear"] < 1e-12
    assert "extension cannot be left out" in found.text


def test_a_quantity_decides_alone() -> None:
    """The force at the clamp of a cantilever is told by the loads: no strain changes it."""
    scene = Scene(Rod.straight(1.0, 16, THICK), Clamp(), Force(X))
    assert pyrod.smallest_model(scene, 1e-3).model == "cosserat"
    force = pyrod.smallest_model(scene, 1e-3, lambda r: r.reaction.force)
    assert force.model == "inextensible"
    assert force.error < 1e-12
    small = Scene(Rod.straight(1.0, 64, THICK), Clamp(), Force(1e-3 * X))
    tip = pyrod.smallest_model(small, 1e-9, lambda r: r.tip[0])
    bending, shear = 1 / 3, 1 / 60  # F L^3/EI, F L/GA
    assert tip.sizes["shear"] == pytest.approx(shear / (bending + shear), rel=1e-3)


def test_the_scene_chosen_leaves_its_edges_to_the_solver() -> None:
    scene = Scene(Rod.straight(1.0, None, THICK), Clamp(), Force(X))
    found = pyrod.smallest_model(scene, 0.5)
    assert (found.scene.rod.model, found.scene.space) == ("inextensible", "planar")
    assert "edges=None" in repr(found.scene)
    assert found.result.rod.edges == scene.rod.edges
    fine = solve(found.scene, tol=1e-8)
    assert fine.errors is not None
    assert np.abs(fine.tip - solve(scene, tol=1e-8).tip).max() < found.error


@pytest.mark.parametrize("tol", [0.0, -1.0, float("nan")])
def test_tolerances_are_positive(tol: float) -> None:
    with pytest.raises(ValueError, match="tol: must be positive"):
        pyrod.smallest_model(BEAMS[0].scene(8), tol)


def test_what_has_no_equilibrium_says_so() -> None:
    far = Scene(Rod.straight(1.0, 8, FLAT, "extensible"), [Clamp(), Hinge(1.1 * Z, at="end")])
    with pytest.raises(ValueError, match="cannot stretch"):
        pyrod.smallest_model(far, 1e-3)
