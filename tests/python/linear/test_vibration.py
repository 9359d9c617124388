"""Frequencies beside closed forms, and what modes do to the energy."""

from __future__ import annotations

import itertools
from math import pi

import numpy as np
import pytest
from scipy.optimize import brentq

import pyrod
from pyrod import Clamp, Force, Hinge, Joint, PointMass, Rod, Scene, Section, Spring
from pyrod.base.immutable import Array
from pyrod.rotation import exp, multiply, rotate

UNIT = Section(EI1=1.0, EI2=1.0, GJ=0.8, mass_per_length=1.0)
LIGHT = Section(EI1=1.0, EI2=1.0, GJ=0.8)


def angular(scene: Scene, count: int, **options: object) -> Array:
    return pyrod.linearised(pyrod.solve(scene)).modes(count, **options).angular_frequencies


def orders(values: list[Array], exact: Array) -> Array:
    """Of grids each twice as fine."""
    errors = [np.abs(one - exact) for one in values]
    return np.log2([a / b for a, b in itertools.pairwise(errors)])


# A ring ------------------------------------------------------------------------------------------


def ring(edges: int, hold: float) -> Scene:
    """Free, but for twelve soft springs, by which the squares of all frequencies are ``hold`` more.

    To first order, and for motions of less than six waves, of which the springs see the mean.
    """
    radius = 1.3
    rod = Rod.precurved(2 * pi * radius, edges, UNIT, (0, 1 / radius, 0))
    stiffness = hold * rod.length / 12
    places = range(0, edges, edges // 12)
    r, s = rod.at_rest()[0], rod.arc_lengths
    supports = [Spring(stiffness, position=r[j], at=float(s[j])) for j in places]
    return Scene(rod, supports, space="planar", joints=Joint([(0, "start"), (0, "end")]))


def test_a_ring() -> None:
    """In its plane, inextensible: two of each; before them the rigid motions, on the springs."""
    hold, found = 1e-3, []
    for edges in (24, 48, 96):
        squares = angular(ring(edges, hold), 9) ** 2 - hold
        assert squares[:3] == pytest.approx(0, abs=1e-3 * hold)
        found.append(squares[3:])
    k = np.array([2, 3, 4])
    exact = np.repeat(k**2 * (k**2 - 1) ** 2 / (k**2 + 1) / 1.3**4, 2)
    for squares in found:
        assert squares[::2] == pytest.approx(squares[1::2], rel=1e-5)
    assert orders(found, exact)[1] == pytest.approx(2, abs=0.03)
    limit = found[2] + (found[2] - found[1]) / 3
    assert limit == pytest.approx(exact, rel=2e-4)


# Energy ------------------------------------------------------------------------------------------


@pytest.mark.parametrize("rotary", [False, (0.002, 0.005, 0.007)])
def test_frequencies_are_what_the_energy_says(rotary: object) -> None:
    """Of a twisted, bent rod in space: the second difference of all energy along a mode, of rods
    put together again from their frames, over the kinetic energy."""
    section = Section(EI1=1.0, EI2=1.5, GJ=0.8, mass_per_length=1.0)
    rod = Rod.precurved(1.0, 20, section, (0.3, 1.0, 0.5))
    force = np.array([2.0, 3.0, -1.5])
    result = pyrod.solve(Scene(rod, Clamp(), Force(force)))
    modes = pyrod.linearised(result).modes(5, rotary=rotary)
    h, inertia = rod.edge_lengths, 0.0 if rotary is False else np.array(rotary)
    masses = np.convolve(h, [0.5, 0.5])

    def total(turns: Array) -> float:
        frames = multiply(result.frames, exp(turns))
        steps = h[:, None] * rotate(frames, np.array([0, 0, 1.0]))
        r = np.vstack([np.zeros((1, 3)), np.cumsum(steps, axis=0)])
        start = rod.frame_at_rest(0)
        return float(rod.energy(r, frames, start_frame=start).total - force @ r[-1])

    for omega, u, turns in zip(
        modes.angular_frequencies, modes.shapes[0], modes.frames[0], strict=True
    ):
        kinetic = (masses[:, None] * u**2).sum() + (h[:, None] * inertia * turns**2).sum()
        assert kinetic == pytest.approx(1, rel=1e-8)
        step = 1e-3 / np.abs(turns).max()
        second = (total(step * turns) - 2 * total(0 * turns) + total(-step * turns)) / step**2
        assert second == pytest.approx(omega**2, rel=2e-5)


def test_modes_of_a_prestressed_network_are_orthogonal() -> None:
    post = Rod.straight(1.0, 16, UNIT)
    beam = Rod.straight(0.7, 12, UNIT).placed((0, 0, 1.0), tangent=(1, 0, 0.2))
    joint = Joint([(0, "end"), (1, "start")])
    scene = Scene([post, beam], Clamp((0, 0, 0)), Force((0.5, 1, -0.5), at=(1, "end")), "spatial")
    scene = Scene(scene.rods, scene.supports, scene.loads, joints=joint)
    modes = pyrod.linearised(pyrod.solve(scene)).modes(8)
    assert (np.diff(modes.frequencies) > 0).all()
    gram = np.zeros((8, 8))
    for rod, shape in zip(scene.rods, modes.shapes, strict=True):
        masses = np.convolve(rod.edge_lengths, [0.5, 0.5])
        gram += np.einsum("ivx,jvx,v->ij", shape, shape, masses)
    assert gram == pytest.approx(np.eye(8), abs=1e-9)


def test_all_of_many_equal_frequencies_are_found() -> None:
    """Five round cantilevers side by side, which know nothing of each other: ten of each."""
    rods = [Rod.straight(1.0, 12, UNIT).placed((0.1 * i, 0, 0)) for i in range(5)]
    scene = Scene(rods, [Clamp(at=(i, "start")) for i in range(5)])
    found = angular(scene, 25)
    alone = angular(Scene(rods[0], Clamp(at="start")), 6)[::2]
    assert found == pytest.approx(np.repeat(alone, 10)[:25], rel=1e-9)


# A gridshell -------------------------------------------------------------------------------------


def dome(edges: int) -> Scene:
    """Four laths that cross, drawn in at their feet."""
    lath = Section.rectangle(0.02, 0.04, pyrod.Material(E=10e9, nu=0.3, density=600))
    laths: list[Rod] = []
    feet: list[Hinge] = []
    at = (1.5, 3.5)
    for along in np.eye(3)[:2]:
        for y in at:
            beside = y * (np.array([1, 1, 0]) - along)
            rod = Rod.straight(5.0, edges, lath, "inextensible")
            laths.append(rod.placed(beside, tangent=along, normal=(0, 0, 1)))
            for end, s in (("start", 0.25), ("end", 4.75)):
                feet.append(Hinge(beside + s * along, at=(len(laths) - 1, end)))
    pins = [Joint(((i, x), (2 + k, y)), "ball") for i, y in enumerate(at) for k, x in enumerate(at)]
    lift = [pyrod.DistributedForce((0, 0, 10.0), rod) for rod in range(4)]
    return Scene(laths, feet, lift, joints=pins)


def standing(edges: int, tol: float | None = None) -> pyrod.Equilibrium:
    """Under its own weight."""
    lifted = dome(edges)
    scene = Scene(lifted.rods, lifted.supports, pyrod.Gravity(), joints=lifted.joints)
    return pyrod.solve(scene, start=pyrod.solve(lifted), tol=tol)


def test_the_ten_lowest_of_a_gridshell() -> None:
    """Of second order, and to a tolerance what that tends to."""
    found = [pyrod.linearised(standing(edges)).modes(10).frequencies for edges in (20, 40, 80)]
    first, second = np.abs(np.diff(found, axis=0))
    assert np.log2(first / second) == pytest.approx(2, abs=0.15)
    limit = found[2] + (found[2] - found[1]) / 3
    modes = pyrod.linearised(standing(20, tol=1e-5)).modes(10)
    assert modes.errors is not None
    assert modes.frequencies == pytest.approx(limit, rel=1e-4)
    assert (modes.errors < 1e-4 * modes.frequencies).all()
    assert modes.frequencies[0] > 1


# Bodies ------------------------------------------------------------------------------------------


def test_a_body_on_a_rod_without_mass() -> None:
    """3 EI/L^3 over the mass; with an inertia two modes in each plane, by the compliance."""
    rod = Rod.straight(1.0, 64, LIGHT)
    assert angular(Scene(rod, Clamp(), PointMass(2.0)), 2) == pytest.approx(1.5**0.5, rel=2e-4)
    lin = pyrod.linearised(pyrod.solve(Scene(rod, Clamp())))
    C, J = lin.compliance(), np.diag([0.3, 0.5, 0.7])
    M = np.block([[2.0 * np.eye(3), np.zeros((3, 3))], [np.zeros((3, 3)), J]])
    expected = 1 / np.sqrt(np.sort(np.linalg.eigvals(C @ M).real)[::-1][:5])
    given = PointMass(2.0, inertia=(0.3, 0.5, 0.7))
    assert angular(Scene(rod, Clamp(), given), 5) == pytest.approx(expected, rel=1e-9)
    with pytest.raises(ValueError, match="fewer than 6"):
        angular(Scene(rod, Clamp(), given), 6)


def test_an_inertia_turns_with_its_cross_section() -> None:
    """Bent through a quarter turn the axes of a body are others in space."""
    rod = Rod.precurved(1.0, 32, LIGHT, (0, pi / 2, 0))
    J, R = np.array([[0.3, 0.1, 0], [0.1, 0.5, 0], [0, 0, 0.7]]), np.eye(3)
    R = pyrod.rotation.to_matrix(pyrod.solve(Scene(rod, Clamp())).tip_frame)
    C = pyrod.linearised(pyrod.solve(Scene(rod, Clamp()))).compliance()
    M = np.block([[2.0 * np.eye(3), np.zeros((3, 3))], [np.zeros((3, 3)), R @ J @ R.T]])
    expected = 1 / np.sqrt(np.sort(np.linalg.eigvals(C @ M).real)[::-1][:5])
    found = angular(Scene(rod, Clamp(), PointMass(2.0, inertia=J)), 5)
    assert found == pytest.approx(expected, rel=1e-9)


def test_a_body_at_the_tip_of_a_heavy_rod() -> None:
    """1 + cos b cosh b + mu b (cos b sinh b - sin b cosh b) = 0."""
    ratio = 0.7

    def determinant(b: float) -> float:
        c, s, ch, sh = np.cos(b), np.sin(b), np.cosh(b), np.sinh(b)
        return float(1 + c * ch + ratio * b * (c * sh - s * ch))

    exact = np.array([brentq(determinant, *ends) for ends in ((0.5, 2), (3, 4.5), (6, 7.5))]) ** 2
    scene = Scene(Rod.straight(1.0, 32, UNIT), Clamp(), PointMass(ratio), space="planar")
    modes = pyrod.linearised(pyrod.solve(scene, tol=1e-9)).modes(3)
    assert modes.angular_frequencies == pytest.approx(exact, rel=1e-9)


def test_a_body_between_vertices() -> None:
    """It is shared by them; the solver gives it a vertex where there is a tolerance."""
    at, found = 0.437, []
    for edges in (16, 32, 64):
        scene = Scene(Rod.straight(1.0, edges, UNIT), Clamp(), PointMass(1.0, at), "planar")
        found.append(angular(scene, 2))
    exact = Scene(Rod.straight(1.0, 16, UNIT), Clamp(), PointMass(1.0, at), space="planar")
    limit = pyrod.linearised(pyrod.solve(exact, tol=1e-8)).modes(2).angular_frequencies
    errors = [np.abs(one / limit - 1).max() for one in found]
    assert errors[2] < errors[0] / 6
    assert errors[2] < 2e-3


def test_a_pendulum() -> None:
    """A light, hardly bending thread with a bob: g over L, and how it stiffens it."""
    thread = Section(EI1=1e-2, EI2=1e-2, GJ=1e-2)
    rod = Rod.straight(1.0, 64, thread).placed(tangent=(0, 0, -1))
    scene = Scene(rod, Clamp(), [pyrod.Gravity((0, 0, -9.81)), PointMass(2.0)], space="planar")
    found = pyrod.linearised(pyrod.solve(scene, tol=1e-8)).modes(1).angular_frequencies[0]
    k = (2.0 * 9.81 / 1e-2) ** 0.5  # of the boundary layer at the clamp
    assert found**2 == pytest.approx(9.81 / (1 - np.tanh(k) / k), rel=1e-8)


# With a tolerance --------------------------------------------------------------------------------


def test_a_body_that_resists_turning_with_a_tolerance() -> None:
    """The first grid tells it by its own frames, not by those that are extrapolated."""
    rod = Rod.precurved(1.0, 8, LIGHT, (0, 1.5, 0.4))
    body = PointMass(1.0, inertia=(0.1, 0.5, 0.55))
    scene = Scene(rod, Clamp(), [body, Force((1.0, 0.5, 0))])
    modes = pyrod.linearised(pyrod.solve(scene, tol=1e-8)).modes(3)
    fine = pyrod.linearised(pyrod.solve(scene.refined(5))).modes(3)
    finer = pyrod.linearised(pyrod.solve(scene.refined(6))).modes(3)
    limit = finer.frequencies + (finer.frequencies - fine.frequencies) / 3
    assert modes.frequencies == pytest.approx(limit, rel=1e-7)
    assert modes.errors is not None
    assert (modes.errors < 1e-7 * modes.frequencies).all()
