"""Cross-sections against closed formulas, tables from the literature, and limits."""

from __future__ import annotations

import pickle
from dataclasses import FrozenInstanceError, astuple
from math import inf, nan, pi

import numpy as np
import pytest

import pyrod
from pyrod import Material, Section

STEEL = Material(E=200e9, nu=0.3)
NAMES = ("EI1", "EI2", "GJ", "GA1", "GA2", "EA")


def torsion_constant(section: Section, material: Material) -> float:
    return section.GJ / material.G


# Material -----------------------------------------------------------------------------------------


@pytest.mark.parametrize(("nu", "G"), [(-0.5, 1.0), (0.0, 0.5), (0.25, 0.4), (0.5, 1 / 3)])
def test_shear_modulus(nu: float, G: float) -> None:
    assert pytest.approx(G, rel=1e-15) == Material(1.0, nu).G


def test_poissons_ratio_defaults_to_that_of_steel() -> None:
    assert Material(1.0).nu == 0.3


@pytest.mark.parametrize(
    ("arguments", "name"),
    [((0.0,), "E"), ((-1.0,), "E"), ((inf,), "E"), ((nan,), "E")]
    + [((1.0, nu), "nu") for nu in (-1.0, 0.5000001, nan, inf)],
)
def test_material_refuses(arguments: tuple[float, ...], name: str) -> None:
    with pytest.raises(ValueError, match=f"^{name}: "):
        Material(*arguments)


# Circles and tubes --------------------------------------------------------------------------------


@pytest.mark.parametrize("nu", [0.0, 0.3, 0.5])
def test_circle_by_formula(nu: float) -> None:
    R, material = 0.02, Material(7e10, nu)
    inertia, A = pi * R**4 / 4, pi * R**2
    cowper = 6 * (1 + nu) / (7 + 6 * nu)
    E, G = material.E, material.G
    expected = (E * inertia, E * inertia, G * 2 * inertia, *2 * (cowper * G * A,), E * A)
    np.testing.assert_allclose(astuple(Section.circle(R, material))[:6], expected, rtol=1e-15)


@pytest.mark.parametrize("inner", [0.1, 0.5, 0.9])
def test_tube_by_formula(inner: float) -> None:
    R, m, nu = 0.02, inner, STEEL.nu
    inertia, A = pi * R**4 * (1 - m**4) / 4, pi * R**2 * (1 - m**2)
    s = (1 + m**2) ** 2
    cowper = 6 * (1 + nu) * s / ((7 + 6 * nu) * s + (20 + 12 * nu) * m**2)
    E, G = STEEL.E, STEEL.G
    expected = (E * inertia, E * inertia, G * 2 * inertia, *2 * (cowper * G * A,), E * A)
    np.testing.assert_allclose(astuple(Section.tube(R, inner * R, STEEL))[:6], expected, rtol=1e-14)


def test_tube_without_a_bore_is_the_circle() -> None:
    assert Section.tube(0.02, 0.0, STEEL) == Section.circle(0.02, STEEL)


@pytest.mark.parametrize("inner", [1e-3, 1e-5])
def test_tube_tends_to_the_circle_with_the_square_of_the_bore(inner: float) -> None:
    tube, circle = (
        np.array(astuple(s)[:6])
        for s in (Section.tube(1.0, inner, STEEL), Section.circle(1.0, STEEL))
    )
    relative = np.abs(tube / circle - 1)
    assert relative.max() < 10 * inner**2
    assert relative[5] == pytest.approx(inner**2, rel=1e-4)  # the area


@pytest.mark.parametrize("nu", [0.0, 0.3, 0.5])
def test_thin_tube_has_cowpers_coefficient(nu: float) -> None:
    """2 (1 + nu)/(4 + 3 nu), Cowper (1966), table 1."""
    material, thickness = Material(1.0, nu), 1e-6
    section = Section.tube(1.0, 1.0 - thickness, material)
    area = section.EA
    assert section.GA1 / (material.G * area) == pytest.approx(2 * (1 + nu) / (4 + 3 * nu), rel=1e-6)


# Rectangles ---------------------------------------------------------------------------------------


def test_rectangle_bends_harder_across_its_width() -> None:
    a, b = 0.03, 0.01  # along a1, a2
    section = Section.rectangle(a, b, STEEL)
    A, E, nu = a * b, STEEL.E, STEEL.nu
    cowper = 10 * (1 + nu) / (12 + 11 * nu)
    assert pytest.approx(E * a * b**3 / 12, rel=1e-15) == section.EI1
    assert pytest.approx(E * b * a**3 / 12, rel=1e-15) == section.EI2
    assert section.GA1 == section.GA2 == pytest.approx(cowper * STEEL.G * A, rel=1e-15)
    assert pytest.approx(E * A, rel=1e-15) == section.EA


def test_rectangle_turned_by_a_right_angle() -> None:
    upright, lying = Section.rectangle(1.0, 3.0, STEEL), Section.rectangle(3.0, 1.0, STEEL)
    assert (upright.EI1, upright.EI2) == (lying.EI2, lying.EI1)
    assert (upright.GJ, upright.EA) == (lying.GJ, lying.EA)


@pytest.mark.parametrize(
    ("ratio", "beta"),
    [(1, 0.1406), (1.5, 0.1958), (2, 0.2287), (3, 0.2633), (4, 0.2808), (5, 0.2913), (10, 0.3123)],
)
def test_torsion_constant_of_the_table(ratio: float, beta: float) -> None:
    """J = beta a b^3 to four digits, Timoshenko and Goodier, Theory of Elasticity, section 109."""
    section = Section.rectangle(ratio, 1.0, STEEL)
    assert torsion_constant(section, STEEL) == pytest.approx(beta * ratio, abs=1.05e-4 * ratio)


def test_torsion_constant_of_the_square_to_twelve_digits() -> None:
    """0.140577014955..., the sum of Saint-Venant's series."""
    odd = np.arange(99_999, 0, -2, dtype=float)
    exact = 1 / 3 - 64 / pi**5 * np.sum(np.tanh(odd * pi / 2) / odd**5)
    assert exact == pytest.approx(0.1405770149, abs=1e-10)
    assert torsion_constant(Section.rectangle(1.0, 1.0, STEEL), STEEL) == pytest.approx(
        exact, rel=1e-13
    )


@pytest.mark.parametrize("ratio", [1e2, 1e4, 1e6])
def test_torsion_constant_of_a_thin_strip(ratio: float) -> None:
    """a b^3 (1/3 - 0.2100 b/a): the ends of the strip take 192 zeta_odd(5)/pi^5 of b/a."""
    J = torsion_constant(Section.rectangle(ratio, 1.0, STEEL), STEEL) / ratio
    ends = 64 / pi**5 * (31 / 32) * 1.0369277551433699  # zeta(5)
    assert pytest.approx(1 / 3 - ends / ratio, rel=1e-12) == J


# Refusals -----------------------------------------------------------------------------------------

BAD_SECTIONS = [
    *[({name: value}, name) for name in NAMES for value in (0.0, -1.0, nan)],
    *[({name: inf}, name) for name in ("EI1", "EI2", "GJ")],
    ({"GA1": inf}, "GA1, GA2"),
    ({"GA2": inf}, "GA1, GA2"),
    ({"EA": inf}, "EA"),
]


@pytest.mark.parametrize(("change", "name"), BAD_SECTIONS)
def test_section_refuses(change: dict[str, float], name: str) -> None:
    good = dict.fromkeys(NAMES, 1.0)
    with pytest.raises(ValueError, match=f"^{name}: "):
        Section(**{**good, **change})


@pytest.mark.parametrize("size", [0.0, -1.0, nan, inf])
def test_dimensions_are_refused_by_name(size: float) -> None:
    with pytest.raises(ValueError, match=r"^radius: must be positive"):
        Section.circle(size, STEEL)
    with pytest.raises(ValueError, match=r"^outer_radius: must be positive"):
        Section.tube(size, 0.0, STEEL)
    with pytest.raises(ValueError, match=r"^width: must be positive"):
        Section.rectangle(size, 1.0, STEEL)
    with pytest.raises(ValueError, match=r"^height: must be positive"):
        Section.rectangle(1.0, size, STEEL)


@pytest.mark.parametrize("inner", [-0.1, 1.0, 2.0, nan])
def test_bore_is_refused_by_name(inner: float) -> None:
    with pytest.raises(ValueError, match=r"^inner_radius: must lie in \[0, outer_radius\)"):
        Section.tube(1.0, inner, STEEL)


# As objects ---------------------------------------------------------------------------------------


def test_richest_model_of_the_finite_stiffnesses() -> None:
    assert Section(1, 1, 1).model == "inextensible"
    assert Section(1, 1, 1, EA=1).model == "extensible"
    assert Section(1, 1, 1, 1, 1, 1).model == "cosserat"
    assert Section.circle(1, STEEL).model == "cosserat"


def test_diagonals_of_linns_matrices() -> None:
    section = Section(1, 2, 3, 4, 5, 6)
    np.testing.assert_array_equal(section.bending, [1, 2, 3])
    np.testing.assert_array_equal(section.stretching, [4, 5, 6])


@pytest.mark.parametrize("thing", [STEEL, Section.circle(1.0, STEEL), Section(1, 2, 3)])
def test_immutable_equal_hashable_and_pickled(thing: Material | Section) -> None:
    name = "E" if isinstance(thing, Material) else "GJ"
    with pytest.raises(FrozenInstanceError):
        setattr(thing, name, 1.0)
    copy = pickle.loads(pickle.dumps(thing))
    assert copy == thing
    assert hash(copy) == hash(thing)


def test_changing_the_diagonal_leaves_the_section() -> None:
    section = Section(1, 2, 3)
    section.bending[0] = 7
    assert section.EI1 == 1


def test_repr_builds_the_same_again() -> None:
    for thing in (STEEL, Section.rectangle(1.0, 2.0, STEEL), Section(1, 2, 3)):
        assert eval(repr(thing), {**vars(pyrod), "inf": inf}) == thing
