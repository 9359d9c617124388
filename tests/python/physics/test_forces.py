"""Forces that the loads do not tell, of straight and of slender members.

References: linear bar theory, exact for straight members; statics of the cable.
"""

from __future__ import annotations

import itertools
import warnings

import numpy as np
import pytest

import pyrod
from pyrod import Clamp, Force, Gravity, Hinge, Joint, Material, Rod, Scene, Section, Slider


def wire_between(
    radius: float, strain: float, **solving: object
) -> tuple[float, pyrod.Equilibrium]:
    """A straight steel wire of 1 m, stretched between clamps, and the force that it must have."""
    wire = Section.circle(radius, Material(E=200e9))
    apart = 1 + strain
    ends = [Clamp(), Clamp((0, 0, apart), at="end")]
    result = pyrod.solve(Scene(Rod.straight(1.0, 16, wire), ends), **solving)
    return wire.EA * (apart - 1), result


@pytest.mark.parametrize("tol", [None, 1e-8])
@pytest.mark.parametrize(
    ("radius", "strain"), list(itertools.product((1e-2, 1e-3, 5e-4, 2e-4), (1e-6, 1e-5, 1e-3)))
)
def test_wire_between_clamps(radius, strain, tol):
    force, result = wire_between(radius, strain, tol=tol)
    told = result.errors["forces"] if tol else 0.0
    for found in (result.force[:, 2], result.vertex_force[:, 2], result.reactions[1].force[2]):
        assert found == pytest.approx(force, rel=max(1e-10, told))


@pytest.mark.parametrize("space", ["planar", "spatial"])
@pytest.mark.parametrize("direction", [(0, 0, 1), (0.6, 0, 0.8)])
@pytest.mark.parametrize("strain", [1e-9, 1e-6, 1e-3, 0.3, -1e-9])
@pytest.mark.parametrize("EA", [1e-2, 1.0, 1e4, 1e8, 1e11, 1e14])
def test_bar_of_any_slenderness(EA, strain, direction, space):
    along = np.array(direction)
    apart = (1 + strain) * along
    if strain < 0 and EA * abs(strain) > 1:
        pytest.skip("it buckles")
    bar = Rod.straight(1.0, 8, Section(1, 1, 1, EA=EA)).placed(
        tangent=along, normal=(-along[2], 0, along[0])
    )
    ends = [Clamp(frame=bar.placement[1]), Clamp(apart, frame=bar.placement[1], at="end")]
    with warnings.catch_warnings():
        warnings.simplefilter(
            "ignore", pyrod.AccuracyWarning
        )  # of rounding, where strains are small
        result = pyrod.solve(Scene(bar, ends, space=space), tol=1e-8)
    exact = EA * (np.linalg.norm(apart) - 1)
    found = result.force @ along
    told = max(1e-10, result.errors["forces"])
    given = 2**-51 / abs(strain)  # the place of the end is rounded
    assert np.abs(found / exact - 1).max() <= told + given
    assert told < 1e-4 if abs(strain) < 1e-8 or EA * abs(strain) < 1e-5 else told < 1e-8
    assert result.index == 0


def bars_side_by_side(stiffness: list[float], bending: list[float]) -> pyrod.Equilibrium:
    bars = [
        Rod.straight(1.0, 8, Section(EI, EI, EI, EA=EA))
        for EA, EI in zip(stiffness, bending, strict=True)
    ]
    ends = [Joint(tuple((i, x) for i in range(len(bars))), "ball") for x in ("start", "end")]
    held = [Hinge(at=(0, "start")), Slider((0, 0, 1), at=(0, "end"))]
    return pyrod.solve(Scene(bars, held, Force((0, 0, 3), at=(0, "end")), "planar", ends), tol=1e-8)


@pytest.mark.parametrize(
    ("stiffness", "bending"),
    [
        ([1e8, 2e8, 3e8], [1, 1, 1]),
        ([1, 1e6, 1e-6], [1, 1, 1]),
        ([1e14, 2e14, 1e8], [1, 1, 1]),
        ([1e2, 1e8, 1e14], [1, 1, 1]),
        ([1e8, 2e8, 3e8], [1, 1e-6, 1e6]),
        ([1, 1e6, 1e-6], [1, 1e-6, 1e6]),
        ([1e2, 1e8, 1e14], [1e-12, 1, 1]),
    ],
)
def test_bars_share_a_load_by_their_stiffness(stiffness, bending):
    result = bars_side_by_side(stiffness, bending)
    exact = 3 * np.array(stiffness) / sum(stiffness)
    found = np.array([bar.force[0, 2] for bar in result.rods])
    told = max(1e-10, result.errors["forces"])
    assert np.abs(found - exact).max() <= told * exact.max()
    assert told <= 1e-8
    if max(bending) < 1e6:
        assert np.abs(found / exact - 1).max() < 1e-8


def braced_strut(n: int = 2, space: str = "planar", hung: float = 0.0) -> Scene:
    strut = Rod.straight(1.0, n, Section(1, 1, 1))
    cable = Rod.straight(0.97, n, Section(1e-3, 1e-3, 1e-3, EA=100))
    ends = [Joint(((0, x), (1, x)), "ball") for x in ("start", "end")]
    loads = Force((0, 0, hung), at=(0, "end")) if hung else ()
    return Scene([strut, cable], Hinge(at=(0, "start")), loads, joints=ends, space=space)


@pytest.mark.parametrize("n", [2, 16])
@pytest.mark.parametrize("space", ["planar", "spatial"])
def test_structure_under_self_stress_may_turn_and_is_stable(space, n):
    result = pyrod.solve(braced_strut(n, space), eigenvalue=True)
    assert result.index == 0
    assert result.neutral
    assert abs(result.lowest_eigenvalue) < 1e-9


def test_the_same_hung_up():
    """Its weight holds it upright, by as much as it would turn it over."""
    result = pyrod.solve(braced_strut(64, hung=0.0044), eigenvalue=True)
    assert result.index == 0
    assert not result.neutral
    assert result.lowest_eigenvalue == pytest.approx(0.0044, rel=0.02)


def test_bow_with_a_string_has_the_eigenvalue_of_its_turn():
    limb = Rod.straight(1.0, 48, Section(1, 1, 1))
    string = Rod.straight(0.9, 48, Section(1e-3, 1e-3, 1e-3, EA=100))
    ends = [Joint(((0, x), (1, x)), "ball") for x in ("start", "end")]
    scene = Scene([limb, string], Hinge(at=(0, "start")), joints=ends, space="planar")
    result = pyrod.solve(scene, eigenvalue=True)
    assert result.index == 0
    assert result.neutral
    assert abs(result.lowest_eigenvalue) < 1e-8


def chain(weight: float, n: int = 32, end: type = Hinge, EA: float = np.inf, space: str = "planar"):
    limp = Section(1, 1, 1, EA=EA, mass_per_length=weight / 9.81)
    rod = Rod.straight(1.0, n, limp).placed(tangent=(1, 0, 0), normal=(0, 0, 1))
    return Scene(rod, [end(), end((0.8, 0, 0), at="end")], Gravity(), space)


@pytest.mark.parametrize("weight", [1e6, 1e8, 1e10, 1e12, 1e15])
@pytest.mark.parametrize("space", ["planar", "spatial"])
def test_chain_however_limp(weight, space):
    result = pyrod.solve(chain(weight, space=space))
    assert result.iterations <= 60
    assert result.index == 0


@pytest.mark.parametrize("weight", [1e12, 1e15])
def test_catenary(weight):
    """The pull is that of a cable. Ends bend within 1e-6 of the length: untold."""
    from scipy.optimize import brentq

    a = brentq(lambda a: 2 * a * np.sinh(0.4 / a) - 1, 0.1, 1, xtol=1e-16)  # of length 1, span 0.8
    options = pyrod.Options(max_edges=2**12)
    result = pyrod.solve(chain(weight, n=16), options, tol=1e-9, strict=False)
    found = abs(result.reactions[0].force[0]) / weight
    assert found == pytest.approx(a, rel=1e-9)
    assert abs(found / a - 1) <= result.errors["reactions"] + 100 / weight  # no cable, quite


def truss(radius: float) -> Scene:
    """Three wires that meet in a point, pulled down by 6 N."""
    wire = Section.circle(radius, Material(E=200e9))
    tops = [np.array((x, 0, 1.0)) for x in (-1, 0, 1)]
    rods = [
        Rod.straight(np.linalg.norm(p), 8, wire).placed(
            p, tangent=-p, normal=np.cross((0, 1, 0), -p)
        )
        for p in tops
    ]
    held = [Hinge(p, at=(i, "start")) for i, p in enumerate(tops)]
    joint = Joint([(i, "end") for i in range(3)], "ball")
    return Scene(rods, held, Force((0, 0, -6), at=(1, "end")), "planar", joint)


@pytest.mark.parametrize("tol", [None, 1e-3, 1e-8])
@pytest.mark.parametrize("radius", [1e-4, 1e-3, 3e-3])
def test_truss(radius, tol):
    result = pyrod.solve(truss(radius), tol=tol)
    inner = 6 / (1 + 2 * np.cos(np.pi / 4) ** 3)
    outer = inner * np.cos(np.pi / 4) ** 2
    found = [np.linalg.norm(rod.force[0]) for rod in result.rods]
    strain = inner / Section.circle(radius, Material(E=200e9)).EA  # second order is not in these
    assert found == pytest.approx([outer, inner, outer], rel=10 * strain + 1e-9)
