"""What must not matter: mirrors, turns, order, scale. Rods are nearly straight and compressed below
the first buckling load, so that each scene has one stable solution, which an equal scene finds."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from support import MODELS, SOFT, angle_between, differences, solved, vectors

import pyrod
from pyrod import Clamp, DistributedForce, Force, Moment, Rod, Section, rotation

N = 16
models = st.sampled_from(MODELS)
forces = vectors(4.0).map(lambda F: np.array([F[0], F[1], max(F[2], -1.0)]))
curvatures = vectors(0.5)
places = st.floats(0.0, 1.0)


def bent(K0: np.ndarray, model: str, section: Section = SOFT) -> Rod:
    return Rod.precurved(1.0, N, section, K0, model)


def tip_of(rod: Rod, force: np.ndarray) -> np.ndarray:
    return solved(rod, Force(force)).tip


# Mirrors and turns of the scene -------------------------------------------------------------------

# Reflections of positions; those of turns carry the other signs.
MIRRORS = [np.array([-1, 1, 1]), np.array([1, -1, 1]), np.array([-1, -1, 1])]


@pytest.mark.parametrize("mirror", MIRRORS, ids=["a1", "a2", "both"])
@given(force=forces, moment=vectors(0.5), K0=curvatures, at=places, model=models)
def test_mirrored_scenes_have_mirrored_solutions(mirror, force, moment, K0, at, model) -> None:
    turns = mirror * np.prod(mirror)
    here = solved(bent(K0, model), Force(force), Moment(moment, at=at))
    there = solved(bent(turns * K0, model), Force(mirror * force), Moment(turns * moment, at=at))
    np.testing.assert_allclose(there.positions, mirror * here.positions, rtol=0, atol=1e-12)
    np.testing.assert_allclose(there.K, turns * here.K, rtol=0, atol=1e-11)
    np.testing.assert_allclose(there.Gamma, mirror * here.Gamma, rtol=0, atol=1e-12)
    np.testing.assert_allclose(there.moment, turns * here.moment, rtol=0, atol=1e-11)
    assert there.energy == pytest.approx(here.energy, rel=1e-12, abs=1e-15)


@given(force=forces, model=models, quarter=st.sampled_from([1, 2, 3]))
def test_directors_may_be_renamed(force, model, quarter) -> None:
    """A clamp turned about a3 by right angles with the stiffnesses exchanged is the same rod."""
    here = solved(bent(np.zeros(3), model), Force(force))
    s = SOFT
    swapped = Section(s.EI2, s.EI1, s.GJ, s.GA2, s.GA1, s.EA) if quarter % 2 else s
    clamp = Clamp(frame=rotation.exp((0, 0, quarter * np.pi / 2)))
    there = solved(bent(np.zeros(3), model, swapped), Force(force), clamp=clamp)
    np.testing.assert_allclose(there.positions, here.positions, rtol=0, atol=1e-12)
    assert there.energy == pytest.approx(here.energy, rel=1e-12, abs=1e-15)


@given(force=forces, angle=st.floats(-3.0, 3.0))
def test_round_rods_do_not_know_how_they_are_marked(force, angle) -> None:
    rod = bent(np.zeros(3), "cosserat", Section(1, 1, 0.7, 50, 50, 100))
    here = solved(rod, Force(force))
    there = solved(rod, Force(force), clamp=Clamp(frame=rotation.exp((0, 0, angle))))
    np.testing.assert_allclose(there.positions, here.positions, rtol=0, atol=1e-12)
    expected = rotation.multiply(here.frames, rotation.exp((0, 0, angle)))
    assert angle_between(there.frames, expected).max() < 1e-12


# Loads --------------------------------------------------------------------------------------------


@given(force=forces, at=places, K0=curvatures, model=models)
def test_two_halves_of_a_force_are_the_force(force, at, K0, model) -> None:
    whole = solved(bent(K0, model), Force(force, at=at))
    halves = solved(bent(K0, model), Force(force / 2, at=at), Force(force / 2, at=at))
    np.testing.assert_allclose(halves.positions, whole.positions, rtol=0, atol=1e-13)


@given(force=forces, other=forces, moment=vectors(0.5))
def test_the_order_of_loads_does_not_matter(force, other, moment) -> None:
    loads = [
        Force(force / 2),
        Force(other / 2, at=0.3),
        DistributedForce(other / 4),
        Moment(moment),
    ]
    rod = bent(np.zeros(3), "cosserat")
    a, b = solved(rod, *loads), solved(rod, *loads[::-1])
    np.testing.assert_allclose(b.positions, a.positions, rtol=0, atol=1e-13)


@given(force=forces, K0=curvatures, model=models)
def test_nothing_added_changes_nothing(force, K0, model) -> None:
    zeros = [Force((0, 0, 0), at=0.3), DistributedForce((0, 0, 0)), Moment((0, 0, 0))]
    alone, crowded = (
        solved(bent(K0, model), Force(force)),
        solved(bent(K0, model), Force(force), *zeros),
    )
    np.testing.assert_array_equal(crowded.positions, alone.positions)
    assert crowded.index == alone.index == 0


@given(force=forces, at=places)
def test_what_is_beyond_the_last_load_stays_straight(force, at) -> None:
    result = solved(bent(np.zeros(3), "cosserat"), Force(force, at=at))
    beyond = result.scene.rod.arc_lengths > at + 1 / N
    np.testing.assert_allclose(result.moment[beyond], 0, rtol=0, atol=1e-13)
    np.testing.assert_allclose(result.K[beyond], 0, rtol=0, atol=1e-12)


# Work and energy ----------------------------------------------------------------------------------


@given(force=forces, K0=curvatures, model=models)
def test_tip_is_the_slope_of_the_complementary_energy(force, K0, model) -> None:
    """Engesser: F . r - W has the slope r with respect to F, exactly for the discrete rod."""
    rod, step = bent(K0, model), 1e-3

    def complementary(F: np.ndarray) -> float:
        result = solved(rod, Force(F))
        return F @ result.tip - result.energy

    here = tip_of(rod, force)
    for i, e in enumerate(np.eye(3)):
        slopes = [
            (complementary(force + k * step * e) - complementary(force - k * step * e))
            / (2 * k * step)
            for k in (1, 2)
        ]
        assert (4 * slopes[0] - slopes[1]) / 3 == pytest.approx(here[i], abs=1e-9)


@given(force=forces, K0=curvatures, model=models)
def test_small_changes_are_reciprocal(force, K0, model) -> None:
    """Maxwell and Betti: the change of the tip with the force is a symmetric matrix."""
    rod, step = bent(K0, model), 1e-4
    compliance = np.array(
        [
            (tip_of(rod, force + step * e) - tip_of(rod, force - step * e)) / (2 * step)
            for e in np.eye(3)
        ]
    )
    assert np.abs(compliance - compliance.T).max() < 1e-7
    assert np.linalg.eigvalsh(compliance + compliance.T).min() > -1e-7  # and positive: it is stable


# Scale --------------------------------------------------------------------------------------------


@given(force=forces, K0=curvatures, model=models, power=st.integers(-60, 60))
def test_stiffer_rods_under_larger_loads_have_the_same_shape(force, K0, model, power) -> None:
    """With a power of two, to the last bit."""
    scale = 2.0**power
    s = SOFT
    section = Section(*(scale * x for x in (s.EI1, s.EI2, s.GJ, s.GA1, s.GA2, s.EA)))
    here, there = (
        solved(bent(K0, model), Force(force)),
        solved(bent(K0, model, section), Force(scale * force)),
    )
    np.testing.assert_array_equal(there.positions, here.positions)
    np.testing.assert_array_equal(there.frames, here.frames)
    assert there.energy == scale * here.energy


@given(force=forces, K0=curvatures, model=models, power=st.integers(-30, 30))
def test_longer_rods_have_the_same_shape(force, K0, model, power) -> None:
    length = 2.0**power
    F, s = force / length**2, SOFT
    section = Section(s.EI1, s.EI2, s.GJ, *(x / length**2 for x in (s.GA1, s.GA2, s.EA)))
    here = solved(bent(K0, model), Force(force))
    there = solved(Rod.precurved(length, N, section, K0 / length, model), Force(F))
    np.testing.assert_array_equal(there.positions / length, here.positions)
    assert there.energy * length == here.energy


# Grids --------------------------------------------------------------------------------------------


@given(force=forces, model=models)
def test_equal_edges_may_be_given_one_by_one(force, model) -> None:
    by_number = Rod.precurved(1.0, N, SOFT, (0, 1, 0), model)
    by_lengths = Rod.precurved(
        np.full(N, 1 / N), None, [SOFT] * N, np.tile([0, 1, 0], (N + 1, 1)), model
    )
    assert differences(tip_of(by_lengths, force), tip_of(by_number, force)) < 1e-15
    assert pyrod.solve(pyrod.Scene(by_lengths, Clamp())).stable
