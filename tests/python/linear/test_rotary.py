"""Rotary inertia: torsion, and beams after Rayleigh and Timoshenko."""

from __future__ import annotations

from math import pi

import numpy as np
import pytest

import pyrod
from pyrod import Clamp, Hinge, Material, Outline, Rod, Scene, Section, Slider

RUBBER = Material(E=2e6, nu=0.4, density=1200.0)


def test_torsion_of_a_shaft() -> None:
    """Clamped and free: (2 k - 1)/(4 L) of the speed of torsional waves."""
    section = Section.circle(0.02, RUBBER)
    rod = Rod.straight(0.5, 16, section, "inextensible")
    modes = pyrod.linearised(pyrod.solve(Scene(rod, Clamp()), tol=1e-9)).modes(16, rotary=True)
    speed = np.sqrt(section.GJ / (RUBBER.density * pi * 0.02**4 / 2))
    twist = [np.abs(turns[:, 2]).max() / np.abs(turns).max() > 0.99 for turns in modes.frames[0]]
    assert modes.frequencies[twist][:2] == pytest.approx(speed * np.array([1, 3]) / 2, rel=1e-9)


@pytest.mark.parametrize("model", ["inextensible", "cosserat"])
def test_a_thick_beam_on_hinges(model: str) -> None:
    """Sine waves: EI k^4/(rho A + rho I k^2), with shear Timoshenko's quadratic."""
    section = Section.rectangle(0.05, 0.04, RUBBER)
    L = 0.5
    rod = Rod.straight(L, 32, section, model)  # type: ignore[arg-type]
    ends = [Hinge(), Slider((0, 0, 1), at="end")]
    result = pyrod.solve(Scene(rod, ends, space="planar"), tol=1e-9)
    found = pyrod.linearised(result).modes(8, rotary=True)
    rA, rI = RUBBER.density * 0.05 * 0.04, RUBBER.density * 0.04 * 0.05**3 / 12
    EI, k = section.EI2, pi * np.arange(1, 4) / L
    if model == "inextensible":
        squares = EI * k**4 / (rA + rI * k**2)
    else:
        GA = section.GA1
        b = rA * GA + (rA * EI + rI * GA) * k**2
        squares = (b - np.sqrt(b**2 - 4 * rA * rI * EI * GA * k**4)) / (2 * rA * rI)
    for one in np.sqrt(squares):  # among those of stretching
        assert np.abs(found.angular_frequencies / one - 1).min() < 1e-8


def test_numbers_in_place_of_an_outline() -> None:
    section = Section.tube(0.02, 0.01, RUBBER)
    bare = Section(*section.bending, mass_per_length=section.mass_per_length)
    J = RUBBER.density * pi * (0.02**4 - 0.01**4) / 4
    shaped, told = (
        pyrod.linearised(pyrod.solve(Scene(Rod.straight(0.5, 12, one, "inextensible"), Clamp())))
        for one in (section, bare)
    )
    by_shape = shaped.modes(4, rotary=True).frequencies
    by_numbers = told.modes(4, rotary=(J, J, 2 * J)).frequencies
    assert by_numbers == pytest.approx(by_shape, rel=1e-10)
    assert told.modes(4, rotary=[(J, J, 2 * J)]).frequencies == pytest.approx(by_numbers, rel=1e-12)
    with pytest.raises(ValueError, match="rod 0 has no outline"):
        told.modes(4, rotary=True)
    for wrong in ((J, J), (J, J, -J), np.ones((2, 3)), (J, J, np.inf)):
        with pytest.raises(ValueError, match="rotary"):
            told.modes(4, rotary=wrong)


def test_an_outline_off_the_axis() -> None:
    corner = Outline.polygon([(0, 0), (0.02, 0), (0, 0.02)])
    section = Section(EI1=1.0, EI2=1.0, GJ=1.0, mass_per_length=1.0, outline=corner)
    lin = pyrod.linearised(pyrod.solve(Scene(Rod.straight(1.0, 8, section), Clamp())))
    with pytest.raises(ValueError, match="centroid"):
        lin.modes(2, rotary=True)


def test_second_moments_of_outlines() -> None:
    """Against sums over a fine grid of points."""
    x = (np.arange(2000) + 0.5) / 1000 - 1
    X, Y = np.meshgrid(x, x)
    angle = pi / 5
    corners = np.array([(-0.5, -0.3), (0.6, -0.3), (0.1, 0.7)])
    turned = corners @ np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    triangle = Outline.polygon(turned)
    left = [
        (b - a)[0] * (Y - a[1]) - (b - a)[1] * (X - a[0]) > 0
        for a, b in zip(turned, np.roll(turned, -1, axis=0), strict=True)
    ]
    shapes = [
        (Outline.circle(0.8), X**2 + Y**2 < 0.64),
        (Outline.tube(0.8, 0.5), (X**2 + Y**2 < 0.64) & (X**2 + Y**2 > 0.25)),
        (Outline.rectangle(1.2, 0.6), (np.abs(X) < 0.6) & (np.abs(Y) < 0.3)),
        (triangle, np.all(left, axis=0)),
    ]
    for outline, inside in shapes:
        a, b = X[inside], Y[inside]
        area = 1e-6
        expected = area * np.array(
            [
                [(b**2).sum(), -(a * b).sum(), 0],
                [-(a * b).sum(), (a**2).sum(), 0],
                [0, 0, (a**2 + b**2).sum()],
            ]
        )
        assert outline.second_moments == pytest.approx(expected, abs=2e-3)
        assert outline.centroid == pytest.approx([a.mean(), b.mean()], abs=2e-3)
    holed = Outline.polygon([(-1, -1), (1, -1), (1, 1), (-1, 1)], [(0, 0), (0.5, 0), (0, 0.5)])
    inner = Outline.polygon([(0, 0), (0.5, 0), (0, 0.5)])
    whole = Outline.rectangle(2.0, 2.0)
    assert holed.second_moments == pytest.approx(whole.second_moments - inner.second_moments)
