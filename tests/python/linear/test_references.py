"""Numbers that are known from elsewhere."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

import pyrod
from pyrod import Clamp, Force, Hinge, Joint, Moment, Rod, Scene, Section, Spring
from pyrod.base.immutable import Array

UNIT = Section(EI1=1.0, EI2=1.0, GJ=0.8, mass_per_length=1.0)
GRIDS = (32, 64, 128, 256)


def cantilever(edges: int, force: float = 10.0) -> Scene:
    rod = Rod.straight(1.0, edges, UNIT)
    return Scene(rod, Clamp(), Force((force, 0, 0)), space="planar")


def extrapolated(values: list[Array]) -> Array:
    """Of grids each twice as fine, with even powers."""
    for power in (2, 4, 6, 8):
        values = [
            fine + (fine - coarse) / (2**power - 1) for coarse, fine in itertools.pairwise(values)
        ]
        if len(values) == 1:
            break
    return values[0]


def test_elastica_under_a_cross_force() -> None:
    """By integration of the linearised equation to 1e-13."""
    found = []
    for n in GRIDS:
        change = pyrod.linearised(pyrod.solve(cantilever(n))).jvp({"loads.0.force": (1, 0, 0)})
        across, _, along = change["tip"]
        angle, moment = change["tip_frame"][1], change["reactions.0.moment"][1]
        found.append(np.array([along, across, angle, moment]))
    expected = [-0.0215494661655, 0.0105359712168, 0.0222664098397, -0.2295097405916]
    assert extrapolated(found) == pytest.approx(expected, abs=2e-12)
    errors = [np.abs(one - expected).max() for one in found]
    assert errors[0] / errors[1] == pytest.approx(4, rel=0.02)


STRAIGHT = [3.5160152685002, 22.0344915646668, 61.6972144135491, 120.9019160523057]
BENT = [7.2049919149637, 23.4333018500811, 57.2104562866074, 114.4770912455378]


@pytest.mark.parametrize(("force", "expected"), [(0.0, STRAIGHT), (10.0, BENT)])
def test_frequencies_of_a_cantilever(force: float, expected: list[float]) -> None:
    found = []
    for n in GRIDS:
        result = pyrod.solve(cantilever(n, force))
        found.append(pyrod.linearised(result).modes(4).angular_frequencies)
    assert extrapolated(found) == pytest.approx(expected, rel=1e-9)
    errors = [np.abs(one / expected - 1) for one in found]
    assert errors[0] / errors[1] == pytest.approx(4, rel=0.05)


def test_modes_are_orthogonal_and_come_in_pairs() -> None:
    rod = Rod.straight(1.0, 24, UNIT)
    modes = pyrod.linearised(pyrod.solve(Scene(rod, Clamp()))).modes(6)
    pairs = modes.angular_frequencies.reshape(3, 2)
    assert pairs[:, 0] == pytest.approx(pairs[:, 1], rel=1e-10)
    masses = np.full(25, 1 / 24)
    masses[[0, -1]] /= 2
    gram = np.einsum("ivx,jvx,v->ij", modes.shapes[0], modes.shapes[0], masses)
    assert gram == pytest.approx(np.eye(6), abs=1e-9)


def test_small_deflections_are_those_of_beams() -> None:
    """Of a straight cantilever: exact but for the grid, of second order."""
    rod = Rod.straight(2.0, 64, Section(EI1=3.0, EI2=2.0, GJ=1.5, GA1=50.0, GA2=60.0, EA=70.0))
    C = pyrod.linearised(pyrod.solve(Scene(rod, Clamp()))).compliance()
    L = 2.0
    expected = np.diag([L**3 / 6 + L / 50, L**3 / 9 + L / 60, L / 70, L / 3, L / 2, L / 1.5])
    expected[0, 4] = expected[4, 0] = L**2 / 2 / 2
    expected[1, 3] = expected[3, 1] = -(L**2) / 2 / 3
    assert pytest.approx(expected, rel=1e-3, abs=1e-12) == C
    assert np.abs(C - C.T).max() < 1e-13


def test_energy_is_an_envelope() -> None:
    """What dead forces do is told by displacements: d(E - P.r) = -r.dP."""
    supports = [Clamp((0, 0, 0)), Hinge((0.2, 0.1, 0.8), at="end")]
    force = np.array([0.4, 0.7, 0.2])
    result = pyrod.solve(Scene(Rod.straight(1.0, 20, UNIT), supports, Force(force, at=0.5)))
    linear = pyrod.linearised(result)
    for unit in np.eye(3):
        change = linear.jvp({"loads.0.force": unit})
        assert change["energy"] == pytest.approx(force @ change["positions"][10], abs=1e-12)


def test_scaling_all_stiffness_and_all_loads_changes_no_shape() -> None:
    """On any grid: of an inextensible rod."""
    supports = [Clamp((0, 0, 0)), Hinge((0.2, 0.1, 0.8), at="end")]
    force = np.array([0.4, 0.7, 0.2])
    result = pyrod.solve(Scene(Rod.straight(1.0, 10, UNIT), supports, Force(force, at=0.5)))
    linear = pyrod.linearised(result)
    change = linear.jvp({"loads.0.force": force, "rods.0.bending": result.rods[0].rod.bending})
    for name in ("positions", "frames", "K"):
        assert np.abs(change[name]).max() < 1e-11
    for name in ("force", "moment"):
        assert change[name] == pytest.approx(getattr(result, name), abs=1e-9)
    assert change["energy"] == pytest.approx(result.energy, rel=1e-10)


def test_compliance_and_stiffness_are_inverse() -> None:
    """Of what holds an end, and what that end gives when it is free."""
    rod = Rod.precurved(1.0, 16, UNIT, (0.5, 1.0, 0.3))
    free = pyrod.solve(Scene(rod, Clamp()))
    at, frame = free.tip, free.vertex_frames[-1]
    held = pyrod.solve(Scene(rod, [Clamp(), Clamp(at, frame, at="end")]))
    C = pyrod.linearised(free).compliance()
    K = pyrod.linearised(held).stiffness(1)
    assert np.linalg.inv(C) == pytest.approx(K, abs=1e-8 * np.abs(K).max())
    assert np.abs(K - K.T).max() < 1e-9 * np.abs(K).max()


def test_a_spring_gives_as_it_says() -> None:
    rod = Rod.straight(1.0, 16, UNIT)
    scene = Scene(rod, [Clamp(), pyrod.Spring(5.0, position=(0, 0, 1.0), at="end")])
    C = pyrod.linearised(pyrod.solve(scene)).compliance()
    alone = pyrod.linearised(pyrod.solve(Scene(rod, Clamp()))).compliance()
    assert 1 / C[0, 0] == pytest.approx(1 / alone[0, 0] + 5.0, rel=1e-10)


def test_a_moment_under_which_a_rod_rolls_up() -> None:
    """Curvature M/EI, exactly on any grid."""
    scene = Scene(Rod.straight(1.0, 8, UNIT), Clamp(), Moment((0, 2.0, 0)))
    change = pyrod.linearised(pyrod.solve(scene)).jvp({"loads.0.moment": (0, 1, 0)})
    assert change["K"] == pytest.approx(np.tile([0, 1.0, 0], (9, 1)), abs=1e-12)
    assert change["energy"] == pytest.approx(2.0, rel=1e-12)
    assert change["tip_frame"] == pytest.approx([0, 1, 0], abs=1e-12)


@pytest.mark.parametrize("edges", [12, 48])
def test_a_ring_goes_where_the_springs_at_all_its_vertices_go(edges: int) -> None:
    """Spans of one edge that cannot stretch: the pivots of their forces are all shift."""
    ring = Rod.precurved(2 * np.pi * 1.3, edges, UNIT, (0, 1 / 1.3, 0))
    places = ring.at_rest()[0]
    k = 0.3 * ring.edge_lengths[0]
    springs = [Spring(k, position=places[j], at=float(ring.arc_lengths[j])) for j in range(edges)]
    closed = Joint([(0, "start"), (0, "end")])
    linear = pyrod.linearised(pyrod.solve(Scene(ring, springs, space="planar", joints=closed)))
    change = linear.jvp({f"supports.{i}.position": (1.0, 0, 0) for i in range(edges)})
    assert np.abs(change["positions"] - (1.0, 0, 0)).max() < 1e-12
    assert np.abs(change["force"]).max() < 1e-12
