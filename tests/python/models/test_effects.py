"""What a scene leaves out: predicted changes against those found by solving the richer scene."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from support import REFERENCE, SPACES, Array, X, Z

import pyrod
from pyrod import Clamp, DistributedForce, Force, Hinge, Joint, Rod, Scene, Section, Slider, solve
from pyrod.reference import load

STRAINS = ("extension", "shear", "strains")


def bent(space: str, kind: str, stiff: float, model: Any = "inextensible") -> Scene:
    """A precurved rod of length 1 with bending stiffnesses about 1, far from straight."""
    y = 0.0 if space == "planar" else 1.0
    section = Section(1.0, 1.3, 0.8, 6 * stiff, 8 * stiff, 15 * stiff)
    rod = Rod.precurved(1.0, 16, section, (0.5 * y, 1.0, -0.7 * y), model)
    force = np.array([2.0, 1.5 * y, -3.0])
    ends: list[Any] = [Clamp()]
    what: Any = Force(force, at=0.5)
    if kind == "clamped":
        ends.append(Clamp((0.5, 0.1 * y, 0.6), at="end"))
    elif kind == "hinged":
        ends.append(Hinge((0.5, 0.0, 0.6), at="end"))
        what = DistributedForce(force)
    elif kind == "follower":
        what = Force((2.0, 1.5 * y, 1.0), follower=True)
    return Scene(rod, ends, what, space)


def told(result: pyrod.Equilibrium) -> dict[str, Array]:
    return {
        "middle": result.positions[8],
        "energy": np.array(result.energy),
        "force": result.reactions[0].force,
        "moment": result.reactions[0].moment,
        "frames": result.frames,
    }


def changes(effect: pyrod.Effect) -> dict[str, tuple[float, float]]:
    """Of each quantity: the error of the predicted change, and the change."""
    exact = solve(effect.predicted.scene, start=effect.result, stable=False)
    before, predicted, after = told(effect.result), told(effect.predicted), told(exact)
    return {
        key: (
            float(np.linalg.norm(predicted[key] - after[key])),
            float(np.linalg.norm(after[key] - before[key])),
        )
        for key in before
    }


# Predictions ------------------------------------------------------------------------------------


@pytest.mark.parametrize("of", STRAINS)
@pytest.mark.parametrize("kind", ["cantilever", "clamped", "hinged", "follower"])
@pytest.mark.parametrize("space", SPACES)
def test_errors_are_of_second_order(space: str, kind: str, of: Any) -> None:
    """Stiffer by 10: changes fall by 10, errors by 100."""
    free = kind in ("cantilever", "follower")
    stiff = {"cantilever": (30.0, 300.0), "follower": (10.0, 100.0)}.get(kind, (1e4, 1e5))
    soft, hard = (changes(pyrod.effect(solve(bent(space, kind, k)), of)) for k in stiff)
    for key in soft:
        if soft[key][1] < 1e-9:
            assert free or kind == "hinged"  # forces that the loads tell, moments at a hinge
            continue
        assert 9 < soft[key][1] / hard[key][1] < 11, key
        assert 95 < soft[key][0] / hard[key][0] < 110, key
        assert hard[key][0] < 0.01 * hard[key][1], key


@pytest.mark.parametrize("space", SPACES)
def test_extension_and_shear_add_up(space: str) -> None:
    result = solve(bent(space, "clamped", 1e5))
    tips = [pyrod.effect(result, of).positions for of in STRAINS]
    assert np.abs(tips[0] + tips[1] - tips[2]).max() < 1e-3 * np.abs(tips[2]).max()
    assert np.abs(tips[0]).max() > 1e-2 * np.abs(tips[1]).max() > 0


def test_a_little_force_across_shears_as_timoshenkos_beam() -> None:
    """F L/GA at the tip, exactly, beside the bending."""
    F, GA = 1e-5, 80.0
    rod = Rod.straight(1.0, 8, Section(4, 1, 2, GA, GA, 200.0), "inextensible")
    found = pyrod.effect(solve(Scene(rod, Clamp(), Force(F * X))), "shear")
    assert found.tip == pytest.approx([F / GA, 0, 0], rel=1e-8, abs=1e-5 * F / GA)
    assert found.energy == pytest.approx(F**2 / GA / 2, rel=1e-8)


def test_a_force_along_the_rod_stretches_it() -> None:
    rod = Rod.straight(2.0, 8, Section(4, 1, 2, 80.0, 80.0, 200.0), "inextensible")
    found = pyrod.effect(solve(Scene(rod, Clamp(), Force(3 * Z))), "extension")
    assert found.tip == pytest.approx([0, 0, 3 * 2 / 200], rel=1e-12)
    assert found.energy == pytest.approx(3**2 * 2 / 200 / 2, rel=1e-12)
    assert found.sizes["positions"] == pytest.approx(3 / 200, rel=1e-12)
    assert found.sizes["energy"] == 1.0  # of the larger energy: before there was none
    assert found.turn == found.sizes["forces"] == found.sizes["moments"] == 0


def test_sizes_are_relative_to_what_there_is() -> None:
    before = solve(bent("spatial", "clamped", 1e4))
    found = pyrod.effect(before, "strains")
    after = found.predicted
    most = lambda a, b: np.abs(a - b).max() / np.abs(b).max()  # noqa: E731
    sizes = found.sizes
    assert sizes["positions"] == pytest.approx(
        np.abs(after.positions - before.positions).max(), rel=1e-6
    )
    assert sizes["forces"] == pytest.approx(most(after.vertex_force, before.vertex_force), rel=1e-6)
    assert sizes["moments"] == pytest.approx(most(after.moment, before.moment), rel=1e-6)
    assert sizes["energy"] == pytest.approx(abs(1 - before.energy / after.energy), rel=0.1)
    turns = 2 * np.sum(after.vertex_frames * before.vertex_frames, axis=1).clip(-1, 1)
    assert sizes["frames"] == pytest.approx(2 * np.arccos(turns.min() / 2), rel=1e-3)
    assert found.size == max(sizes.values()) > 0


@pytest.mark.parametrize("unit", [1e-9, 1e3])
def test_sizes_know_no_units(unit: float) -> None:
    """Lengths in other units, stiffnesses and forces with them."""

    def size(m: float) -> float:
        section = Section(m**2, m**2, m**2, 500, 500, 500)
        rod = Rod.precurved(m, 8, section, (0, 1 / m, 0), "inextensible")
        ends = [Clamp(), Clamp((0.3 * m, 0, 0.8 * m), at="end")]
        return pyrod.effect(solve(Scene(rod, ends, Force(X, at=m / 2))), "strains").size

    assert size(unit) == pytest.approx(size(1.0), rel=1e-6)


@pytest.mark.parametrize("EA", [1e2, 1e5, 1e8])
def test_a_taut_straight_rod_does_not_shear(EA: float) -> None:
    rod = Rod.straight(1.0, 16, Section(4, 1, 2, EA, EA, EA), "extensible")
    for space in SPACES:
        taut = solve(Scene(rod, [Clamp(), Clamp(1.02 * Z, at="end")], space=space))
        assert pyrod.effect(taut, "shear").size < 1e-12


def test_of_what_is_modelled_nothing_is_left() -> None:
    for model, rest in (("cosserat", STRAINS), ("extensible", ("extension",))):
        result = solve(bent("spatial", "clamped", 1e2, model))
        for of in rest:
            found = pyrod.effect(result, of)
            assert found.predicted is result
            assert found.size == 0
    assert pyrod.effect(result, "shear").size > 1e-3


def test_rigid_sections_have_no_strains() -> None:
    rod = Rod.straight(1.0, 8, Section(1, 1, 1))
    result = solve(Scene(rod, Clamp(), Force(X)))
    assert [pyrod.effect(result, of).size for of in STRAINS] == [0, 0, 0]
    stretches = Rod.straight(1.0, 8, Section(1, 1, 1, EA=50), "inextensible")
    result = solve(Scene(stretches, Clamp(), Force(X)))
    assert [pyrod.effect(result, of).size > 0 for of in STRAINS] == [True, False, True]


def test_a_quantity_changes_as_its_function_says() -> None:
    result = solve(bent("planar", "cantilever", 1e3))
    found = pyrod.effect(result, "shear", lambda r: r.tip[[0, 2]])
    assert found.quantity is not None
    assert found.quantity.tolist() == found.tip[[0, 2]].tolist()
    number = pyrod.effect(result, "shear", lambda r: r.energy).quantity
    assert number is not None
    assert float(number) == found.energy
    assert pyrod.effect(result, "shear").quantity is None


def elbow(k: float) -> Scene:
    """Two rods, rigidly joined at a right angle, clamped at one end and pulled at the other."""
    section = Section(1, 1.3, 0.8, 60 * k, 80 * k, 150 * k)
    rod = Rod.straight(1.0, 8, section, "inextensible")
    other = rod.placed((0, 0, 1), tangent=X, normal=-Z)
    joint = Joint(((0, "end"), (1, "start")))
    return Scene([rod, other], Clamp(), Force((0.3, 0.5, 1), at=(1, "end")), joints=joint)


def test_many_rods() -> None:
    errors = []
    for k in (10, 100):
        result = solve(elbow(k))
        found = pyrod.effect(result, "strains", lambda r: r.rods[1].tip)
        exact = solve(found.predicted.scene, start=result, stable=False)
        change = exact.rods[1].tip - result.rods[1].tip
        errors.append(np.abs(found.quantity - change).max() / np.abs(change).max())
    assert errors[0] / errors[1] == pytest.approx(10, rel=0.15)
    with pytest.raises(AttributeError, match="2 rods"):
        found.tip  # noqa: B018
    assert "tip" not in repr(found)


@pytest.mark.parametrize("kind", ["cantilever", "clamped"])
def test_results_of_a_tolerance_have_the_same_effects(kind: str) -> None:
    """Extrapolated results are not in equilibrium on their grid; changes are counted from there."""
    given = bent("spatial", kind, 1e4)
    K0 = given.rod.K0[0]
    section = Section(1.0, 1.3, 0.8, 6e4, 8e4, 15e4)
    chosen = Rod.precurved(1.0, None, section, K0, "inextensible")
    free = solve(Scene(chosen, given.supports, given.loads), tol=1e-7)
    fine = solve(
        Scene(Rod.precurved(1.0, 256, section, K0, "inextensible"), given.supports, given.loads)
    )
    for of in STRAINS:
        coarse, exact = pyrod.effect(free, of), pyrod.effect(fine, of)
        assert coarse.first_order
        assert coarse.size == pytest.approx(exact.size, rel=0.1)  # on few edges
        assert coarse.energy == pytest.approx(exact.energy, rel=0.1)


# Where the first order ends ---------------------------------------------------------------------


def thick(F: float) -> pyrod.Equilibrium:
    rod = Rod.straight(1.0, 16, Section(1, 1, 1, 20, 20, 40), "inextensible")
    return solve(Scene(rod, Clamp(), Force((F, 0, -F)), "planar"))


def test_what_is_not_small_is_solved() -> None:
    found = pyrod.effect(thick(30), "strains")
    assert not found.first_order
    assert found.predicted.converged
    assert found.size > 0.5
    assert "not small" in repr(found)


@pytest.mark.filterwarnings("ignore::pyrod.StrainWarning")
def test_where_no_equilibrium_is_found_it_is_told() -> None:
    rod = Rod.straight(1.0, 16, Section(1, 1, 1, 2, 2, 4), "inextensible")
    ends = [Clamp(), Clamp((0.3, 0, 0.8), at="end")]
    held = solve(Scene(rod, ends, Force((50, 0, 50), at=0.5), "planar"))
    with pytest.raises(pyrod.NotConverged):
        pyrod.effect(held, "shear")


def test_a_state_that_is_no_equilibrium_has_no_effects() -> None:
    scene = bent("planar", "cantilever", 1e3)
    state = solve(scene, pyrod.Options(max_iterations=1), strict=False)
    with pytest.raises(ValueError, match="no equilibrium, but out_of_iterations"):
        pyrod.effect(state, "shear")
    with pytest.raises(ValueError, match=r"of: .*, got 'warping'"):
        pyrod.effect(solve(scene), "warping")  # type: ignore[arg-type]


def test_it_says_what_it_found() -> None:
    found = pyrod.effect(solve(bent("planar", "cantilever", 1e4)), "shear", lambda r: r.energy)
    text = repr(found)
    assert text.startswith("Effect(shear: ")
    assert "tip by (" in text
    assert "quantity by" in text
    assert "not small" not in text


# Out of the plane -------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", ["cantilever", "clamped", "hinged"])
def test_space_changes_nothing_in_a_plane(kind: str) -> None:
    found = pyrod.effect(solve(bent("planar", kind, 1e3)), "space", lambda r: r.positions[:, 1])
    assert found.size < 1e-11
    assert found.quantity is not None
    assert np.abs(found.quantity).max() == 0


@pytest.mark.parametrize("name", ["P1_F10_a135", "P3_clamp_m2_d50", "P5_chain_w1e4_span0.8"])
def test_space_changes_nothing_in_planar_cases(name: str) -> None:
    case = load(REFERENCE / f"{name}.json")[0]
    n = 4 * case.intervals
    planar = solve(case.scene(n, "planar"), start=case.start(n), stable=False)
    assert pyrod.effect(planar, "space").size < 1e-11


def test_space_changes_what_only_looks_planar() -> None:
    """A slider aslant to the plane is held in it, and slides in space."""
    rod = Rod.straight(1.0, 8, Section(4, 1, 2))
    aslant = Slider((1, 0.1, 0), position=(0, 0, 0.8), clamped=True)
    scene = Scene(rod, [Clamp(), aslant], Force(X, at=0.5), "planar")
    found = pyrod.effect(solve(scene), "space")
    assert found.sizes["positions"] > 1e-3
    exact = solve(found.predicted.scene, start=found.result, stable=False)
    error = np.abs(found.predicted.positions - exact.positions).max()
    assert error < 0.02 * np.abs(found.positions).max()


def test_space_is_for_planar_scenes() -> None:
    with pytest.raises(ValueError, match="spatial already"):
        pyrod.effect(solve(bent("spatial", "cantilever", 1e3)), "space")


def test_effects_stay_as_they_are() -> None:
    found = pyrod.effect(solve(bent("planar", "cantilever", 1e3)), "shear")
    with pytest.raises(AttributeError):
        found.of = "space"  # type: ignore[misc]
    assert replace(found, of="strains").of == "strains"
