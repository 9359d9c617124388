"""The largest values along rods, where they are, and how large their errors are."""

from __future__ import annotations

import pickle
from math import inf, pi

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import ellipk
from support import orders

import pyrod
from pyrod import Clamp, Force, Gravity, Material, Moment, Outline, Pivot, Rod, Scene, Section
from pyrod.result.peaks import QUANTITIES

UNIT = Section(EI1=1.0, EI2=1.0, GJ=1.0)
STEEL = Material(E=2e11, nu=0.3, density=7850.0)
SQUARE = [[0.01, 0.01], [-0.01, 0.01], [-0.01, -0.01], [0.01, -0.01]]


def held(
    section: Section, *loads: pyrod.scene.Load, n: int | None = 16, **how: float
) -> pyrod.Equilibrium:
    return pyrod.solve(Scene(Rod.straight(1.0, n, section), Clamp(), loads), **how)


def arch(n: int | None = None) -> Scene:
    sideways = [Clamp(p, tangent=(1, 0, 0), normal=(0, 0, 1), at=at) for p, at in ENDS]
    return Scene(Rod.straight(1.0, n, UNIT, "inextensible"), sideways, space="planar")


ENDS = (((0, 0, 0), "start"), ((0.4, 0, 0.1333), "end"))


def test_a_peak_between_two_vertices_is_found_where_it_is() -> None:
    result = pyrod.solve(arch(), tol=1e-9)
    fine = pyrod.solve(arch(512), tol=1e-9)
    found = result.largest("curvature")
    assert found.value == result.largest_K == pytest.approx(10.935168, abs=1e-6)
    assert np.linalg.norm(fine.at(found.s).K) == pytest.approx(found.value, rel=1e-5)
    assert np.abs(result.s - found.s).min() > 0.01
    assert found.error == pytest.approx(result.errors["extremes"] * found.value)
    bending = result.largest("bending")
    assert abs(bending.value - found.value) <= bending.error + found.error
    assert result.bending_radius == pytest.approx(1 / found.value, rel=1e-5)


def test_just_before_a_jump_it_is_the_value_there() -> None:
    """The bending moment of a beam rises to where a couple acts, and is less behind it."""
    held_at = [pyrod.Hinge(), pyrod.Slider(along=(0, 0, 1))]
    couple = Moment((0, 0.1, 0), at=0.75)
    result = pyrod.solve(Scene(Rod.straight(1.0, 16, UNIT), held_at, couple, "planar"))
    found = result.largest("bending moment")
    assert found.s == 0.75
    assert found.value == abs(result.at(0.75, before=True).moment[1])
    assert found.value == pytest.approx(0.075, rel=1e-2)


def test_errors_are_true() -> None:
    exact = pyrod.solve(arch(1024), tol=1e-10)
    for n in (16, 24, 40):
        result = pyrod.solve(arch(n), tol=1e-8)
        for name in ("curvature", "bending", "tension", "compression", "shear force", "moment"):
            found, truth = result.largest(name), exact.largest(name)
            assert abs(found.value - truth.value) <= found.error + truth.error, (n, name)
        found, truth = result.sag(), exact.sag()
        assert abs(found.value - truth.value) <= found.error + truth.error, n


def test_without_a_tolerance_they_have_the_order_of_the_grid() -> None:
    exact = pyrod.solve(arch(512), tol=1e-9)
    for name in ("bending", "shear force"):
        truth = exact.largest(name).value
        off = [abs(pyrod.solve(arch(n)).largest(name).value - truth) for n in (32, 64, 128)]
        assert orders(off)[-1] > 1.7, (name, off)
    plain = pyrod.solve(arch(32)).largest("moment")
    assert plain.error is None
    assert "±" not in repr(plain)


def test_both_sides_of_jumps_are_looked_at() -> None:
    loads = [Moment((0, 4, 0), at=0.5), Moment((0, -1, 0))]
    found = held(UNIT, *loads).largest("bending moment")
    assert found.value == pytest.approx(3, abs=1e-12)
    force = held(UNIT, Force((0, 0, 5.0), at=0.5), Force((0, 0, -1.0)))
    assert force.largest("tension").value == pytest.approx(4, abs=1e-12)
    assert force.largest("compression").value == pytest.approx(1, abs=1e-12)
    assert force.largest("compression").s >= 0.5


# Stresses -----------------------------------------------------------------------------------------


def test_stresses_of_a_round_bar() -> None:
    """Stretched, bent and twisted at once, by ends that leave it straight: closed forms."""
    radius = 0.01
    bar = Section.circle(radius, STEEL)
    result = held(bar, Force((0, 0, 3000.0)), Moment((0, 0, 5.0)))
    assert result.largest("stress").value == pytest.approx(3000 / (pi * radius**2), rel=1e-9)
    shear = 5 * radius / (pi * radius**4 / 2)
    assert result.largest("torsional stress").value == pytest.approx(shear, rel=1e-9)
    both = np.hypot(3000 / (pi * radius**2), np.sqrt(3) * shear)
    assert result.largest("equivalent stress").value == pytest.approx(both, rel=1e-9)
    bent = held(bar, Moment((3.0, 4.0, 0)))
    assert bent.largest("stress").value == pytest.approx(
        5 * radius / (pi * radius**4 / 4), rel=1e-6
    )


@pytest.mark.parametrize(
    "outline", [Outline.rectangle(0.02, 0.02), Outline.polygon(SQUARE)], ids=["square", "polygon"]
)
def test_stresses_at_corners(outline: Outline) -> None:
    a, M = 0.02, 2.0
    section = Section(1000.0, 1000.0, 700.0, outline=outline)
    result = held(section, Moment((M, M, 0)))
    assert result.largest("stress").value == pytest.approx(2 * 6 * M / a**3, rel=1e-3)


def test_stresses_of_a_tube_and_of_an_eccentric_outline() -> None:
    tube = Section.tube(0.02, 0.015, STEEL)
    found = held(tube, Moment((0, 7.0, 0))).largest("stress")
    assert found.value == pytest.approx(7 * 0.02 / (pi / 4 * (0.02**4 - 0.015**4)), rel=1e-9)
    shifted = Outline.polygon(np.add(SQUARE, [0.005, 0.0]))
    section = Section(1000.0, 1000.0, 700.0, outline=shifted)
    pulled = held(section, Force((0, 0, 400.0))).largest("stress").value
    area, inertia, e = 4e-4, 0.02**4 / 12, 0.005
    assert pulled == pytest.approx(400 / area + 400 * e * 0.01 / inertia, rel=1e-9)


@pytest.mark.parametrize(
    ("ratio", "alpha"), [(1, 0.20817), (2, 0.24586), (4, 0.28166), (10, 0.31232)]
)
def test_torsion_of_rectangles_is_that_of_tables(ratio: int, alpha: float) -> None:
    """Timoshenko and Goodier, section 109: M = alpha a b^2 tau."""
    b = 0.01
    section = Section(1000.0, 1000.0, 700.0, outline=Outline.rectangle(b, ratio * b))
    found = held(section, Moment((0, 0, 1.0))).largest("torsional stress")
    assert found.value == pytest.approx(1 / (alpha * ratio * b**3), rel=2e-4)


def test_stresses_where_the_section_tapers() -> None:
    def taper(s: float) -> Section:
        return Section.circle(0.01 * (1 - 0.5 * s), STEEL)

    scene = Scene(Rod.straight(1.0, 64, taper), Clamp(), Force((0.01, 0, 0)))
    found = pyrod.solve(scene).largest("stress")
    r = 0.01 * (1 - 0.5 * np.linspace(0, 1, 100_001))
    wanted = 0.01 * (1 - np.linspace(0, 1, 100_001)) / (pi / 4 * r**3)
    assert found.value == pytest.approx(wanted.max(), rel=2e-3)


@pytest.mark.parametrize(
    ("quantity", "outline", "words"),
    [
        ("stress", None, r"need the outline.*Section\(..., outline=Outline.circle\(radius\)\)"),
        ("torsional stress", Outline.polygon(SQUARE), "known of circles, tubes and rectangles"),
        ("equivalent stress", Outline.rectangle(1, 1), "is known of circles and tubes"),
        ("stretch", None, "there is no 'stretch'; there are curvature, bending"),
        ("twisting", None, "there is no 'twisting'; did you mean twist?"),
    ],
)
def test_what_cannot_be_told(quantity: str, outline: Outline | None, words: str) -> None:
    result = held(Section(1.0, 1.0, 1.0, outline=outline), Force((0.1, 0, 0)), n=4)
    with pytest.raises(ValueError, match=words):
        result.largest(quantity)


# Sag ----------------------------------------------------------------------------------------------


def test_the_sag_of_a_buckled_column() -> None:
    """Of the elastica: with k = sin(a/2), half the length is K(k), its height 2 k."""
    k = np.sin(0.6)
    length = 2 * ellipk(k**2)
    chord = quad(lambda u: 2 * np.sqrt(1 - k**2 * np.sin(u) ** 2), 0, pi / 2)[0] * 2 - length
    pins = [Pivot((0, 1, 0)), Pivot((0, 1, 0), (0, 0, chord), at="end")]
    scene = Scene(Rod.straight(length, 24, UNIT), pins, space="planar")
    result = pyrod.solve(scene, tol=1e-9)
    found = result.sag()
    assert found.value == pytest.approx(2 * k, abs=1e-7)
    assert found.s == pytest.approx(length / 2, abs=1e-3)
    assert abs(found.value - 2 * k) <= found.error
    assert result.largest("bending").value == pytest.approx(2 * k, abs=1e-6)


def test_a_cable_hangs_along_gravity() -> None:
    cable = Section(1e-3, 1e-3, 1e-3, mass_per_length=0.2)
    ends = [Pivot((0, 1, 0), (0, 0, 0)), Pivot((0, 1, 0), (0.8, 0, 0.2), at="end")]
    rod = Rod.straight(1.0, 48, cable)
    result = pyrod.solve(Scene(rod, ends, Gravity(), space="planar"))
    found = result.sag()
    below = result.positions[:, 0] * 0.25 - result.positions[:, 2]
    assert found.value == pytest.approx(below.max(), rel=2e-3)
    assert found.value >= below.max()
    assert result.sag((0, 0, -2)) == found
    across = result.sag((0.2, 0, -0.8)).value
    assert across < found.value


def test_sags_that_are_none() -> None:
    ring = pyrod.solve(Scene(Rod.straight(1.0, 32, UNIT), joints=pyrod.Joint(("start", "end"))))
    with pytest.raises(ValueError, match="ends of the rod are in one place"):
        ring.sag()
    result = held(UNIT, Force((0.1, 0, 0)), n=4)
    with pytest.raises(ValueError, match="direction: must not be zero"):
        result.sag((0, 0, 0))


# All of it ----------------------------------------------------------------------------------------


def test_of_several_rods_the_largest_and_its_number(joined_rods: pyrod.Equilibrium) -> None:
    found = joined_rods.largest("moment")
    each = [joined_rods.largest("moment", rod=i) for i in (0, 1)]
    assert found == max(each, key=float)
    assert [one.rod for one in each] == [0, 1]
    assert each[1].value == joined_rods.rods[1].largest("moment").value
    with pytest.raises(ValueError, match="there is no rod 2, the scene has 2"):
        joined_rods.largest("moment", rod=2)
    assert joined_rods.bending_radius == min(rod.bending_radius for rod in joined_rods.rods)


def test_every_quantity_is_told_with_its_unit() -> None:
    result = held(Section.circle(0.01, STEEL), Force((10.0, 0, 20.0)), tol=1e-6)
    for name, (unit, *_) in QUANTITIES.items():
        found = result.largest(name)
        assert found.unit == unit
        assert f"Largest({name}, " in repr(found)
        assert found.value >= 0
        assert found.error is not None
        assert float(found) == found.value
        assert pickle.loads(pickle.dumps(found)) == found
    assert held(UNIT, n=4).bending_radius == inf
