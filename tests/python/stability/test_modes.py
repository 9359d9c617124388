"""The lowest mode: its eigenvalue and shape, starts along it, and motions that cost nothing."""

from __future__ import annotations

import numpy as np
import pytest
from support import ROUND, X, Y, Z

import pyrod
from pyrod import Clamp, Force, Hinge, Rod, Scene, Section, solve

STRIP = Section(EI1=4.0, EI2=1.0, GJ=2.0)
HALF = Clamp((0, 0, 0.9), at="end")


def column(n: int, P: float) -> pyrod.Equilibrium:
    rod = Rod.straight(1.0, n, ROUND)
    return solve(Scene(rod, Clamp(), Force(-P * Z), "planar"), stable=False, eigenvalue=True)


@pytest.mark.parametrize(("P", "index"), [(1.0, 0), (3.0, 1)])
def test_eigenvalue_and_mode_of_a_column(P: float, index: int) -> None:
    """EI phi'' + P phi = -lambda phi: sin(pi s/2), and pi^2/4 - P."""
    errors = []
    for n in (32, 64):
        result = column(n, P)
        assert result.index == index
        errors.append(abs(result.lowest_eigenvalue - (np.pi**2 / 4 - P)))
        s = (np.arange(n) + 0.5) / n
        shape = result.mode[:, 1] / result.mode[-1, 1] * np.sin(np.pi * s[-1] / 2)
        np.testing.assert_allclose(shape, np.sin(np.pi * s / 2), rtol=0, atol=1e-5)
        assert np.abs(result.mode).max() == 1.0
    assert errors[1] < 1e-3
    assert 3.9 < errors[0] / errors[1] < 4.1


def test_along_the_mode_of_a_saddle_lie_both_stable_shapes() -> None:
    """The straight strip between clamps, let go to either side."""
    rod = Rod.straight(1.0, 32, Section(4.0, 1.0, 2.0, EA=1e3))
    scene = Scene(rod, [Clamp(), HALF], space="planar")
    straight = solve(scene, start=np.tile([1.0, 0, 0, 0], (32, 1)), stable=False, eigenvalue=True)
    # found in one step, in which the force jumps from nothing to all: it is counted at the end
    np.testing.assert_allclose(straight.force, np.tile([0, 0, -100.0], (32, 1)), rtol=1e-12, atol=0)
    assert straight.index == 2  # P (1 - P/EA) = 90 is beyond 4 pi^2 and 8.183 pi^2
    assert straight.lowest_eigenvalue == pytest.approx(4 * np.pi**2 - 90, rel=0.01)
    sides = [solve(scene, start=straight.along_mode(a)) for a in (0.5, -0.5)]
    assert all(side.stable for side in sides)
    assert sides[0].energy == pytest.approx(sides[1].energy, rel=1e-10)
    assert sides[0].positions[16, 0] * sides[1].positions[16, 0] < -0.01


def test_without_a_mode_there_is_nothing_to_go_along() -> None:
    result = solve(Scene(Rod.straight(1.0, 8, STRIP), [Clamp(), HALF]))
    assert result.mode is None
    assert not result.neutral
    assert result.free_motion is None
    with pytest.raises(ValueError, match="solve with eigenvalue=True"):
        result.along_mode(0.1)


def test_free_motions_are_named() -> None:
    rod = Rod.straight(1.0, 8, ROUND)
    hanging = solve(Scene(rod, Hinge(), Force(X)))
    assert hanging.neutral
    assert "neutral" in repr(hanging)
    words = hanging.free_motion
    assert words is not None
    assert words.startswith("everything turns about the direction (")
    direction = np.array([float(x) for x in words.split("(")[1].rstrip(")").split(",")])
    np.testing.assert_allclose(np.abs(direction), X, rtol=0, atol=1e-6)

    round_arch = solve(Scene(Rod.straight(1.0, 32, ROUND), [Clamp(), HALF]))
    assert round_arch.free_motion == "the shape goes over into others of the same energy"
    strip = solve(Scene(Rod.straight(1.0, 32, STRIP), [Clamp(), HALF]))
    assert strip.free_motion is None
    spindle = solve(Scene(rod, [Hinge(), Hinge(at="end")]))
    assert spindle.neutral
    assert pyrod.solve(Scene(rod, Clamp(), Force(Y))).free_motion is None
