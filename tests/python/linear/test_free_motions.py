"""Equilibria that may move freely: what that does not change has derivatives, all else has none."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

import pyrod
from pyrod import Clamp, Force, Gravity, Hinge, Linearised, Rod, Scene, Section

UNIT = Section(EI1=1.0, EI2=1.0, GJ=0.8, mass_per_length=1.0)


def bow(end: tuple[float, float, float] = (0.1, 0, 0.8), EI: float = 1.0) -> Scene:
    """A round rod between ball joints: it turns about its chord, and about its own axis."""
    rod = Rod.straight(1.0, 16, Section(EI1=EI, EI2=EI, GJ=0.8))
    return Scene(rod, [Hinge((0, 0, 0)), Hinge(end, at="end")])


@pytest.fixture(scope="module")
def linear() -> Linearised:
    return pyrod.linearised(pyrod.solve(bow()))


def slope(of: Callable[[float], np.ndarray], h: float) -> np.ndarray:
    return (8 * (of(h) - of(-h)) - of(2 * h) + of(-2 * h)) / (12 * h)


def test_what_it_does_not_change_is_told(linear: Linearised) -> None:
    """Energy and the forces along the chord, under changes that keep its freedom."""
    chord = np.array([0.1, 0, 0.8])
    change = linear.jvp({"supports.1.position": chord})

    def energy(t: float) -> np.ndarray:
        return np.array(pyrod.solve(bow(tuple((1 + t) * chord))).energy)

    def force(t: float) -> np.ndarray:
        return pyrod.solve(bow(tuple((1 + t) * chord))).reactions[1].force

    assert change["energy"] == pytest.approx(slope(energy, 1e-3), rel=1e-8)
    assert change["reactions.1.force"] == pytest.approx(slope(force, 1e-3), abs=1e-7)
    assert change["positions"][[0, -1]] == pytest.approx(np.array([0 * chord, chord]), abs=1e-9)


def test_the_rest_is_not(linear: Linearised) -> None:
    change = linear.jvp({"supports.1.position": (0, 0, 1.0)})
    assert np.isnan(change["positions"][1:-1]).any(axis=1).all()
    assert np.isnan(change["moment"][1:-1]).any(axis=1).all()
    assert np.isnan(change["frames"]).any(axis=1).all()
    with pytest.raises(pyrod.SingularEquilibrium, match=r"rods\.0\.positions"):
        linear.vjp({"positions": np.ones((17, 3)), "energy": 1.0})


def test_the_stiffness_of_a_support_that_keeps_it(linear: Linearised) -> None:
    """That of a force along the chord, which turns with it."""
    K = linear.stiffness(1)[:3, :3]
    force = linear.result.reactions[1].force
    chord = np.array([0.1, 0, 0.8])
    across = np.array([0.8, 0, -0.1]) / np.linalg.norm(chord)
    assert pytest.approx(K.T, abs=1e-9) == K
    along = force @ chord / (chord @ chord)
    assert K @ across == pytest.approx(along * across, abs=1e-9)
    assert pytest.approx(along * np.array([0, 1.0, 0]), abs=1e-9) == K @ (0, 1.0, 0)


def test_changes_that_push_it_are_refused(linear: Linearised) -> None:
    bent = linear.result.positions[8] - [0.05, 0, 0.4]
    across = np.cross(bent, [0.1, 0, 0.8])
    scene = Scene(bow().rods[0], bow().supports, Force((0, 0, 0), at=0.5))
    loaded = pyrod.linearised(pyrod.solve(scene, start=linear.result))
    with pytest.raises(pyrod.SingularEquilibrium, match="pushes"):
        loaded.jvp({"loads.0.force": across})
    assert np.isfinite(loaded.jvp({"loads.0.force": (0.1, 0, 0.8)})["energy"])
    J = loaded.jacobian("energy", ["rods.0.K0", "loads.0.force"])
    assert np.isnan(J["loads.0.force"]).any()
    assert np.isfinite(J["rods.0.K0"][:, 2]).all()  # twist at rest pushes nothing
    assert np.isnan(J["rods.0.K0"][:, :2]).any()  # curvature does


def test_gradients_are_those_of_what_pushes_nothing(linear: Linearised) -> None:
    gradient = linear.vjp({"energy": 1.0})
    force = linear.result.reactions[1].force
    assert gradient["supports.1.position"] == pytest.approx(force, abs=1e-9)  # an envelope
    both = np.tile([1.0, 1.0, 0.0], (17, 1))
    change = linear.jvp({"rods.0.bending": both})["energy"]
    assert change == pytest.approx(linear.result.energy, rel=1e-9)


def test_a_rod_that_hangs_on_a_ball_joint() -> None:
    """It may spin, and swings as in the plane."""

    def hanging(space: str) -> Linearised:
        rod = Rod.straight(1.0, 16, UNIT).placed((0, 0, 0), tangent=(0, 0, -1))
        scene = Scene(rod, Hinge((0, 0, 0)), Gravity((0, 0, -9.81)), space=space)  # type: ignore[arg-type]
        return pyrod.linearised(pyrod.solve(scene))

    C, plane = hanging("spatial").compliance(), hanging("planar").compliance()
    known = np.isfinite(plane)
    assert np.isnan(C[:, 5]).all()  # a moment about its axis
    assert np.isnan(C[5]).all()
    for rows in (slice(0, 3), slice(3, 5)):
        found, expected = C[rows][known[rows]], plane[rows][known[rows]]
        assert found == pytest.approx(expected, abs=1e-9)
    assert C[0, 0] == pytest.approx(C[1, 1], rel=1e-9)


def test_a_critical_equilibrium_is_no_free_motion() -> None:
    scene = Scene(Rod.straight(1.0, 16, UNIT), Clamp(), Force((0, 0, -1.0)))
    factor = pyrod.critical_load(scene).grid_factor
    heavy = Scene(Rod.straight(1.0, 16, UNIT), Clamp(), Force((0, 0, -factor)))
    result = pyrod.solve(heavy, stable=False)
    with pytest.raises(pyrod.SingularEquilibrium, match="critical"):
        pyrod.linearised(result)
