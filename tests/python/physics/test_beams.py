"""Rods on supports against the theory of beams; what is free carries nothing; springs.

Loads of 1e-5 bend a rod so little that it is a beam: what is left of the geometry is of the order
of 1e-10. The exact values of the beam are those that n -> infinity leads to.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from support import (
    FLAT,
    IDENTITY,
    SOFT,
    SPACES,
    X,
    Y,
    Z,
    about_y,
    angle_between,
    differences,
    extrapolated,
    pin,
)

import pyrod
from pyrod import (
    Clamp,
    DistributedForce,
    Force,
    Hinge,
    Moment,
    Pivot,
    Rod,
    Scene,
    Section,
    Sleeve,
    Slider,
    Spring,
    solve,
)
from pyrod.rotation import rotate

SMALL = 1e-5
ROD = Rod.straight(1.0, 8, FLAT)


def beam(n: int, supports: Any, *loads: Any, space: str = "spatial") -> pyrod.Equilibrium:
    return solve(Scene(Rod.straight(1.0, n, FLAT), supports, loads, space))


# Beams --------------------------------------------------------------------------------------------


@pytest.mark.parametrize("space", SPACES)
def test_the_propped_cantilever(space: str) -> None:
    """3/8 of the load on the prop, 5/8 and w L^2/8 on the clamp."""
    found = []
    for n in (8, 16, 32, 64):
        r = beam(n, [Clamp(), pin("end", Z)], DistributedForce(SMALL * X), space=space)
        clamp, prop = r.reactions
        found.append([-prop.force[0], -clamp.force[0], -clamp.moment[1]])
        assert abs(prop.force[2]) < 1e-9 * SMALL
        assert np.abs(prop.moment).max() < 1e-9 * SMALL
    assert np.allclose(extrapolated(found) / SMALL, [3 / 8, 5 / 8, 1 / 8], rtol=0, atol=1e-6)


@pytest.mark.parametrize("space", SPACES)
def test_the_simply_supported_beam(space: str) -> None:
    """Sag 5/384 w L^4/EI, turn 1/24 at the ends, moment 1/8 in the middle."""
    found = []
    for n in (8, 16, 32, 64):
        r = beam(n, [pin("start"), pin("end", Z)], DistributedForce(SMALL * X), space=space)
        turn = 2 * r.vertex_frames[0][2]
        found.append([r.positions[n // 2, 0], turn, r.moment[n // 2, 1]])
    assert np.allclose(extrapolated(found) / SMALL, [5 / 384, 1 / 24, -1 / 8], rtol=0, atol=1e-6)


@pytest.mark.parametrize("space", SPACES)
def test_the_beam_over_three_supports(space: str) -> None:
    """Two equal spans l: 3/8 w l at the ends, 10/8 w l in the middle."""
    found = []
    for n in (8, 16, 32, 64):
        supports = [pin("start"), pin(0.5, Z), pin("end", Z)]
        r = beam(n, supports, DistributedForce(SMALL * X), space=space)
        found.append([-x.force[0] for x in r.reactions])
    exact = np.array([3 / 16, 10 / 16, 3 / 16])
    assert np.allclose(extrapolated(found) / SMALL, exact, rtol=0, atol=1e-6)


@pytest.mark.parametrize("space", SPACES)
def test_a_prescribed_displacement_and_turn(space: str) -> None:
    """12 and 6 EI for a displacement of an end that keeps its frame, 4 and 2 EI for a turn."""
    d, found = SMALL, []
    for n in (8, 16, 32, 64):
        shifted = Slider(Z, position=(d, 0, 1), clamped=True)
        turned = Slider(Z, frame=about_y(d))
        a = beam(n, [Clamp(), shifted], space=space).reactions
        b = beam(n, [Clamp(), turned], space=space).reactions
        row = [a[1].force[0], -a[1].moment[1], -a[0].moment[1]]
        found.append([*row, b[1].moment[1], b[0].moment[1]])
        assert np.array_equal(a[1].force[1:], [0, 0])
    assert np.allclose(extrapolated(found) / d, [12, 6, 6, 4, 2], rtol=0, atol=3e-4)


# What is free carries nothing ---------------------------------------------------------------------

LOAD = [Force((8.0, 5.0, -6.0), at=0.4), DistributedForce((10.0, -20.0, 3.0))]


def bent(*supports: Any) -> pyrod.Equilibrium:
    """A shearable rod, far from straight, clamped at its start and held by these supports."""
    return solve(Scene(Rod.straight(1.0, 12, SOFT), [Clamp(), *supports], LOAD))


@pytest.mark.parametrize("clamped", [False, True])
def test_a_slider_pushes_across_its_line_only(clamped: bool) -> None:
    along = np.array([0.6, 0.0, 0.8])
    r = bent(Slider(along, clamped=clamped))
    off = r.tip - Z
    assert np.linalg.norm(off) > 0.01
    assert np.linalg.norm(off - along * (off @ along)) < 1e-12
    assert abs(r.reactions[1].force @ along) < 1e-12
    assert np.linalg.norm(r.reactions[1].force) > 0.1
    if clamped:
        assert angle_between(r.tip_frame, IDENTITY) < 1e-12
    else:
        assert np.abs(r.reactions[1].moment).max() < 1e-12


def test_a_slider_in_a_plane_pushes_along_its_normal() -> None:
    normal = np.array([0.6, 0.8, 0.0])
    r = bent(Slider(normal=normal))
    assert abs((r.tip - Z) @ normal) < 1e-12
    assert np.linalg.norm(np.cross(r.reactions[1].force, normal)) < 1e-12
    assert abs(r.reactions[1].force @ normal) > 0.1


def test_a_sleeve_holds_the_frame_and_lets_it_slide_along_a3() -> None:
    axis = np.array([0.1, 0.0, 1.0]) / np.sqrt(1.01)
    r = bent(Sleeve(tangent=axis, normal=X, at="end"))
    off = r.tip - Z
    assert np.linalg.norm(off) > 0.01
    assert np.linalg.norm(np.cross(off, axis)) < 1e-12
    assert np.abs(rotate(r.tip_frame, Z) - axis).max() < 1e-12
    assert abs(r.reactions[1].force @ axis) < 1e-12
    assert np.linalg.norm(r.reactions[1].moment) > 0.1


@pytest.mark.parametrize("at", [0.5, "end"])
def test_a_pivot_has_no_moment_about_its_pin(at: Any) -> None:
    axis = np.array([2.0, 1.0, 2.0]) / 3
    r = bent(Pivot(axis, at=at))
    moment = r.reactions[1].moment
    assert abs(moment @ axis) < 1e-12
    assert np.linalg.norm(moment) > 0.1
    if at == "end":
        assert np.abs(rotate(r.tip_frame, axis) - axis).max() < 1e-12
        assert angle_between(r.tip_frame, IDENTITY) > 0.01


@pytest.mark.parametrize("at", [0.5, "end"])
def test_a_hinge_has_no_moment(at: Any) -> None:
    r = bent(Hinge(at=at))
    assert np.abs(r.reactions[1].moment).max() < 1e-12
    assert np.linalg.norm(r.reactions[1].force) > 0.1


# Springs ------------------------------------------------------------------------------------------


@pytest.mark.parametrize("space", SPACES)
def test_a_rod_hung_on_a_spring_gives_by_the_sum(space: str) -> None:
    """In series: F/k + F L/EA, exact at any n and F."""
    section = Section(4, 1, 2, EA=7.0)
    F, k = 3.0, 5.0
    rod = Rod.straight(2.0, 5, section)
    r = solve(Scene(rod, Spring(k, at="start"), Force(F * Z), space))
    assert np.allclose(r.positions[0], F / k * Z, rtol=0, atol=1e-14)
    assert np.allclose(r.tip, (2 + F / k + 2 * F / 7) * Z, rtol=0, atol=1e-13)
    assert np.allclose(r.reaction.force, -F * Z, rtol=0, atol=1e-13)


@pytest.mark.parametrize("space", SPACES)
def test_a_torsion_spring_turns_before_the_rod_bends(space: str) -> None:
    """In series: M/k + M L/EI, exact at any n and M."""
    M, k = 2.0, 4.0
    r = solve(Scene(ROD, Spring(1.0, k, at="start"), Moment(M * Y), space))
    assert angle_between(r.vertex_frames[0], about_y(M / k)) < 1e-9
    assert angle_between(r.tip_frame, about_y(M / k + M)) < 1e-9
    assert np.allclose(r.reaction.moment, -M * Y, rtol=0, atol=1e-9)
    assert np.abs(r.positions[0]).max() < 1e-9


def test_a_spring_beside_a_beam_takes_its_share() -> None:
    """In parallel: F/(k + 3 EI/L^3) at the tip of a cantilever."""
    k, found = 5.0, []
    for n in (8, 16, 32, 64):
        r = beam(n, [Clamp(), Spring(k)], Force(SMALL * X))
        found.append(r.tip[0])
        assert np.isclose(r.reactions[1].force[0], -k * r.tip[0], rtol=1e-9)
    assert abs(extrapolated(found) / SMALL - 1 / (k + 3)) < 1e-9


def test_a_stiff_spring_is_a_clamp() -> None:
    clamped = solve(Scene(ROD, Clamp(), Force((1, 0.5, -1))))
    differ = [
        differences(
            solve(Scene(ROD, Spring(k, k, at="start"), Force((1, 0.5, -1)))).positions,
            clamped.positions,
        )
        for k in (1e4, 1e6)
    ]
    assert 50 < differ[0] / differ[1] < 200  # of first order in 1/k
    assert differ[1] < 1e-5


def test_an_off_centre_rest_position_pulls() -> None:
    """A spring at rest elsewhere is a force k d on a clamped rod that does not give way."""
    stiff = Rod.straight(1.0, 4, Section(1e9, 1e9, 1e9))
    r = solve(Scene(stiff, [Clamp(), Spring(2.0, position=(0.5, 0, 1))]))
    assert np.allclose(r.reactions[1].force, [1, 0, 0], rtol=0, atol=1e-8)
    assert np.allclose(r.reactions[0].moment, -Y, rtol=0, atol=1e-8)


def test_the_axis_of_a_pivot_is_in_space() -> None:
    """The same scene, turned as a whole, does the same."""
    axis, F = np.array([0.6, 0.8, 0.0]), np.array([6.0, 9.0, -3.0])
    askew = Rod.straight(1.0, 8, SOFT).placed((1, 2, 3), tangent=(2, 1, 2), normal=(1, 0, 0))
    q = askew.placement[1]
    turned = solve(
        Scene(askew, [Clamp(), Pivot(rotate(q, axis), at="end")], Force(rotate(q, F), 0.5))
    )
    plain = solve(
        Scene(Rod.straight(1.0, 8, SOFT), [Clamp(), Pivot(axis, at="end")], Force(F, 0.5))
    )
    assert np.abs(turned.positions - (1, 2, 3) - rotate(q, plain.positions)).max() < 1e-12
    assert abs(turned.reactions[1].moment @ rotate(q, axis)) < 1e-12
    assert angle_between(plain.tip_frame, IDENTITY) > 0.01


@pytest.mark.parametrize("turns", [-1, 1])
def test_the_turns_of_a_clamp_are_twist(turns: int) -> None:
    """With the frames of the untwisted rod: K3 = 2 pi turns, below Greenhill's M = 8.99 EI/L."""
    r = solve(Scene(Rod.straight(1.0, 12, SOFT), [Clamp(), Clamp(at="end", turns=turns)]))
    twist = 2 * np.pi * turns
    assert np.abs(r.K - twist * Z).max() < 1e-9
    assert np.isclose(r.energy, SOFT.GJ * twist**2 / 2, rtol=1e-12)
    assert np.allclose(r.reactions[1].moment, SOFT.GJ * twist * Z, rtol=0, atol=1e-9)
    assert r.stable
