"""Vibrations under loads without a potential."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import brentq, fsolve

import pyrod
from pyrod import Clamp, Force, Hinge, Moment, Rod, Scene, Section

UNIT = Section(EI1=1.0, EI2=1.0, GJ=0.8, mass_per_length=1.0)
PLANE = Section(EI1=1.3, EI2=1.0, GJ=0.8, mass_per_length=1.0)


def beck(P: float, omega: complex) -> complex:
    """The determinant of a cantilever under a force that follows its tip."""
    root = np.sqrt(P**2 / 4 + omega**2)
    a, b = np.sqrt(root - P / 2), np.sqrt(root + P / 2)
    return complex(
        P**2 + 2 * omega**2 * (1 + np.cosh(a) * np.cos(b)) + P * omega * np.sinh(a) * np.sin(b)
    )


def column(P: float, edges: int = 32, space: str = "planar") -> Scene:
    rod = Rod.straight(1.0, edges, UNIT)
    load = Force((0, 0, -P), follower=True)
    return Scene(rod, Clamp(), load, space=space)  # type: ignore[arg-type]


def test_becks_column_before_it_flutters() -> None:
    P = 15.0
    exact = [brentq(lambda w: beck(P, w).real, *ends) for ends in ((4, 10), (10, 20))]
    modes = pyrod.linearised(pyrod.solve(column(P), tol=1e-9)).modes(2)
    assert modes.angular_frequencies == pytest.approx(exact, rel=1e-8)
    assert modes.growth.tolist() == [0, 0]
    assert modes.stable
    assert modes.shapes[0].dtype == float


def test_becks_column_flutters() -> None:
    P = 22.0

    def parts(x: np.ndarray) -> list[float]:
        value = beck(P, complex(*x))
        return [value.real, value.imag]

    exact = fsolve(parts, (11.0, 1.5), xtol=1e-13)
    modes = pyrod.linearised(pyrod.solve(column(P), tol=1e-9)).modes(3)
    assert modes.angular_frequencies[:2] == pytest.approx(exact[0], rel=1e-8)
    assert np.abs(modes.growth[:2]) == pytest.approx(abs(exact[1]), rel=1e-7)
    assert modes.growth[0] == -modes.growth[1] > 0
    assert modes.growth[2] == 0
    assert not modes.stable
    assert np.iscomplexobj(modes.shapes[0])
    assert "flutters" in repr(modes)
    assert modes.growth_errors is not None
    assert (modes.growth_errors[:2] < 1e-6).all()


def test_from_which_load_on() -> None:
    """20.0509536 EI/L^2; the grid's own is a little off."""

    def flutters(P: float) -> bool:
        return not pyrod.linearised(pyrod.solve(column(P, 64))).modes(2).stable

    assert not flutters(20.0)
    assert flutters(20.1)


def test_in_space_each_is_there_twice() -> None:
    """Also on grids on which the operator is not written out."""
    planar = pyrod.linearised(pyrod.solve(column(15.0, 48))).modes(2).frequencies
    spatial = pyrod.linearised(pyrod.solve(column(15.0, 48, "spatial"))).modes(4)
    assert spatial.frequencies == pytest.approx(np.repeat(planar, 2), rel=1e-8)
    assert spatial.growth.tolist() == [0] * 4


def test_flutter_obeys_the_equation_of_motion() -> None:
    """s^2 M u is what the response to -s^2 M u, as loads, says."""
    modes = pyrod.linearised(pyrod.solve(column(22.0, 48))).modes(2)
    lin = pyrod.linearised(pyrod.solve(column(22.0, 48)))
    s = modes.growth + 2j * np.pi * modes.frequencies
    masses = np.convolve(np.full(48, 1 / 48), [0.5, 0.5])
    for one, u in zip(s, modes.shapes[0], strict=True):
        forces = -(one**2) * masses[:, None] * u
        answer = [
            lin._grid.push(lin._grid._compiled.of_forces([part]))["positions"]
            for part in (forces.real.copy(), forces.imag.copy())
        ]
        assert np.abs(answer[0] + 1j * answer[1] - u).max() < 1e-7 * np.abs(u).max()


def test_a_dead_moment_in_space_may_make_a_rod_diverge() -> None:
    """It has no potential; under so small a one nothing grows."""
    rod = Rod.straight(1.0, 24, PLANE)
    scene = Scene(rod, Clamp(), Moment((0, 0, 0.2)))
    modes = pyrod.linearised(pyrod.solve(scene)).modes(2)
    still = pyrod.linearised(pyrod.solve(Scene(rod, Clamp()))).modes(2)
    assert modes.frequencies == pytest.approx(still.frequencies, rel=0.02)
    assert (modes.frequencies != still.frequencies).all()


def test_divergence() -> None:
    """A column on hinges buckles; what follows a rod, if hardly, makes it a matter of motion."""
    rod = Rod.straight(1.0, 32, UNIT)
    ends = [Hinge(), pyrod.Slider((0, 0, 1), at="end")]

    def modes(P: float) -> pyrod.Modes:
        loads = [Force((0, 0, -P)), Force((1e-9, 0, 0), at=0.5, follower=True)]
        result = pyrod.solve(Scene(rod, ends, loads, space="planar"), stable=False)
        return pyrod.linearised(result).modes(2)

    calm, wild = modes(9.0), modes(11.0)
    assert calm.stable
    assert not wild.stable
    expected = np.pi * np.sqrt(11.0 - np.pi**2)  # w^2 = pi^2 (pi^2 - P)
    diverging = wild.frequencies == 0
    assert diverging.tolist() == [True, False]
    assert wild.growth[diverging] == pytest.approx([expected], rel=5e-3)
    assert "no oscillation, grows" in wild.title(0)
