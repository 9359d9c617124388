"""Weight: where it comes from, hanging rods and chains, and the column that buckles under it."""

from __future__ import annotations

import pickle
from math import inf, nan, pi

import numpy as np
import pytest
from scipy.optimize import brentq
from support import FLAT, SPACES, X, Y, Z, differences, extrapolated, solved, table

import pyrod
from pyrod import Clamp, DistributedForce, Gravity, Hinge, Material, Rod, Scene, Section, solve

HEAVY = Section(4.0, 1.0, 2.0, mass_per_length=0.3)
STEEL = Material(E=200e9, density=7850.0)


# Arguments ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("density", [-1.0, nan, inf])
def test_masses_are_not_negative(density: float) -> None:
    with pytest.raises(ValueError, match=r"^density: must be finite and not negative"):
        Material(1.0, density=density)
    with pytest.raises(ValueError, match=r"^mass_per_length: must be finite and not negative"):
        Section(1, 1, 1, mass_per_length=density)
    with pytest.raises(ValueError, match=r"^mass_per_length: expected finite numbers"):
        Rod([1.0], np.ones((2, 3)), np.ones((1, 3)), np.zeros((2, 3)), "cosserat",
            mass_per_length=[density])  # fmt: skip


@pytest.mark.parametrize("values", [[1.0, 2.0, 3.0], [[1.0, 2.0]], []])
def test_masses_are_those_of_edges(values: object) -> None:
    with pytest.raises(ValueError, match=r"^mass_per_length: expected 2 numbers, one per edge"):
        Rod([1.0, 1.0], np.ones((3, 3)), np.ones((2, 3)), np.zeros((3, 3)), "cosserat",
            mass_per_length=values)  # fmt: skip


def test_gravity_needs_masses() -> None:
    with pytest.raises(
        ValueError, match=r"^Gravity: no rod has a mass; give its material a density"
    ):
        Scene(Rod.straight(1.0, 4, FLAT), Clamp(), Gravity())


@pytest.mark.parametrize("acceleration", [(0, 0), 9.81, (0, 0, nan)])
def test_gravity_refuses(acceleration: object) -> None:
    with pytest.raises(ValueError, match=r"^acceleration: expected"):
        Gravity(acceleration)


def test_gravity_is_a_value() -> None:
    assert Gravity() == Gravity((0, 0, -9.81)) == pickle.loads(pickle.dumps(Gravity()))
    assert Gravity() != Gravity((0, 0, -1.62))
    assert not Gravity().follower


# Masses -------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("section", "area"),
    [
        (Section.circle(2e-3, STEEL), pi * 4e-6),
        (Section.tube(3e-3, 2e-3, STEEL), pi * 5e-6),
        (Section.rectangle(2e-3, 5e-3, STEEL), 1e-5),
    ],
    ids=["circle", "tube", "rectangle"],
)
def test_the_weight_of_a_section_is_that_of_its_area(section: Section, area: float) -> None:
    assert section.mass_per_length == pytest.approx(7850 * area, rel=1e-15)
    rod = Rod.straight(0.5, 5, section)
    assert solved(rod, Gravity()).reaction.force == pytest.approx(
        [0, 0, 9.81 * 0.5 * 7850 * area], rel=1e-14
    )


def test_masses_vary_along_a_rod_and_survive_a_cut() -> None:
    """A vertex that a support asks for divides an edge and its mass."""

    def section(s: float) -> Section:
        return Section(4, 1, 2, mass_per_length=1 + s)

    rod = Rod.straight(1.0, 5, section)
    assert np.allclose(rod.mass_per_length, 1.1 + 0.2 * np.arange(5), rtol=1e-15)
    per_edge = Rod.straight(1.0, 2, [section(0), section(3)])
    assert np.array_equal(per_edge.mass_per_length, [1, 4])
    scene = Scene(rod, [Clamp(), Clamp(at=0.3)], Gravity((0, 0, -1)))
    assert scene.rod.edges == 6
    assert scene.rod.mass_per_length @ scene.rod.edge_lengths == pytest.approx(1.5, rel=1e-14)
    assert pickle.loads(pickle.dumps(rod)) == rod
    assert np.array_equal(rod.placed((1, 0, 0)).mass_per_length, rod.mass_per_length)
    assert rod != Rod.straight(1.0, 5, FLAT)


def test_gravity_is_the_weight_of_every_rod() -> None:
    rod, light = Rod.straight(1.0, 8, HEAVY), Rod.straight(1.0, 8, FLAT)
    g = np.array([1.0, -2.0, 3.0])
    supports = [Clamp(at=(i, "start")) for i in range(2)]
    r = solve(Scene([rod, light], supports, Gravity(g)))
    same = solve(Scene([rod, light], supports, DistributedForce(0.3 * g)))
    assert differences(r.rods[0].positions, same.rods[0].positions) == 0
    assert np.abs(r.reactions[0].force + 0.3 * g).max() < 1e-14
    assert np.abs(r.reactions[1].force).max() == 0


# Hanging ------------------------------------------------------------------------------------------


@pytest.mark.parametrize("space", SPACES)
def test_a_rod_hangs_and_stretches(space: str) -> None:
    """w (L - s) in every edge, and w L^2/2 EA longer: exact at any n."""
    section = Section(4, 1, 2, EA=5.0, mass_per_length=2.0)
    rod = Rod.straight(3.0, 6, section)
    r = solved(rod, Gravity((0, 0, 1)), space=space)
    centres = (np.arange(6) + 0.5) / 2
    assert np.allclose(r.material_force[:, 2], 2 * (3 - centres), rtol=1e-14)
    assert np.abs(r.tip - (3 + 2 * 9 / 2 / 5) * Z).max() < 1e-14
    assert r.stable


def chain(n: int, w: float, span: float) -> tuple[np.ndarray, float]:
    """Vertices and horizontal force of n links without stiffness, hung from two points on x."""
    vertical = w * (0.5 - (np.arange(n) + 0.5) / n)

    def links(H: float) -> np.ndarray:
        return np.stack([0 * vertical + H, 0 * vertical, -vertical], axis=1) / (
            n * np.hypot(H, vertical)[:, None]
        )

    H = brentq(lambda H: links(H)[:, 0].sum() - span, 1e-3 * w, 1e3 * w, xtol=1e-15)
    return np.vstack([np.zeros(3), np.cumsum(links(H), axis=0)]), H


def test_a_hanging_chain() -> None:
    """A rod of little stiffness on two hinges hangs as its links would; the rest is of order EI."""
    n, w, span = 32, 2.0, 0.8
    exact, H = chain(n, w, span)
    errors = []
    for EI in (2e-5, 1e-5, 5e-6):
        section = Section(EI, EI, EI, mass_per_length=w)
        rod = Rod.straight(1.0, n, section).placed(tangent=X, normal=Y)
        r = solve(Scene(rod, [Hinge(), Hinge((span, 0, 0), at="end")], Gravity(-Z)))
        errors.append(
            [np.abs(r.positions - exact).max(), abs(np.linalg.norm(r.reactions[0].force[0]) - H)]
        )
        assert [x.force[2] for x in r.reactions] == pytest.approx([w / 2, w / 2], rel=1e-9)
        assert r.stable
    assert np.max(errors[-1]) < 2e-3
    assert np.all(np.abs(np.divide(*errors[:2]) - 2) < 0.1)
    assert np.all(np.abs(np.divide(*errors[1:]) - 2) < 0.1)


# The heavy column ---------------------------------------------------------------------------------


def standing(n: int, w: float, space: str) -> pyrod.Equilibrium:
    section = Section(4.0, 1.0, 2.0, mass_per_length=w)
    scene = Scene(Rod.straight(1.0, n, section), Clamp(), Gravity(-Z), space)
    return solve(scene, stable=False, eigenvalue=True)


@pytest.mark.parametrize("space", SPACES)
def test_the_column_that_buckles_under_its_weight(space: str) -> None:
    """w L^3/EI = 7.8373...: the lowest eigenvalue, linear in w nearly, passes zero there."""
    exact = float(table("S5_heavy_column")["rows"][0]["wL3/EI"])
    critical = []
    for n in (8, 16, 32, 64):
        at = brentq(lambda w, n=n: standing(n, w, space).lowest_eigenvalue, 7.0, 8.5, xtol=1e-12)
        assert [standing(n, part * at, space).index for part in (0.999, 1.001)] == [0, 1]
        critical.append(at)
    assert abs(extrapolated(critical, (2, 4, 6)) / exact - 1) < 1e-7
