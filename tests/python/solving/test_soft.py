"""Shapes that next to nothing holds: errors are told from the softness, or the motion is named."""

from __future__ import annotations

import warnings

import numpy as np
import pytest
from cases import CASES, start

import pyrod
from pyrod import Clamp, Equilibrium, Force, Hinge, Rod, Scene, Section

PULSES = [case for case in CASES if str(case).startswith(("S6", "S7_figure"))]


def pulse(case: object, tol: float) -> Equilibrium:
    edges = case.first_edges or 16
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        how = {"start": start(case, edges), "stable": False, "strict": False}
        return pyrod.solve(case.scene(edges, case.spaces[0]), tol=tol, **how)


@pytest.mark.parametrize("case", PULSES, ids=str)
@pytest.mark.parametrize("tol", [1e-6, 1e-9])
def test_a_pulse_is_told_as_neutral_or_its_errors_hold(case: object, tol: float) -> None:
    result = pulse(case, tol)
    if result.neutral:
        assert result.free_motion == "the shape goes over into others of the same energy"
        assert "but for the free motion" in str(result.accuracy)
        return
    assert "free motion" not in str(result.accuracy)
    for name, error in case.errors(result).items():
        assert error <= max(result.errors[name], case.rounding), name


def arch(spring: float) -> Scene:
    """A round arch between ball joints, which only a spring keeps from turning over."""
    section = Section(EI1=1, EI2=1, GJ=0.8)
    rod = Rod.straight(1.0, None, section, "inextensible")
    held = [
        Hinge(),
        Hinge((0.4, 0, 0.4), at="end"),
        pyrod.Spring(stiffness=spring, position=(-0.3, 0, 0.9), at=0.5),
    ]
    return Scene(rod, held, Force((-0.3, 0, 0.3), at=0.5))


@pytest.mark.parametrize("spring", [1e-1, 1e-2, 1e-3])
def test_errors_of_soft_scenes_hold(spring: float) -> None:
    exact = pyrod.solve(arch(spring), tol=1e-10, strict=False)
    result = pyrod.solve(arch(spring), start=exact, tol=1e-7)
    scale = np.linalg.norm(exact.moment, axis=1).max()
    error = np.abs(result.moment - exact.moment).max() / scale
    assert error <= result.errors["moments"] + exact.errors["moments"]
    assert np.abs(result.positions - exact.positions).max() <= (
        result.errors["positions"] + exact.errors["positions"]
    )


def test_stiff_scenes_are_told_no_worse() -> None:
    section = Section(EI1=1, EI2=1, GJ=0.8)
    held = [Clamp(), Hinge((0.2, 0, 0.9), at="end")]
    scene = Scene(Rod.straight(1.0, None, section), held, Force((1, 1, 0), at=0.5))
    result = pyrod.solve(scene, tol=1e-11)
    assert result.accuracy.reached <= 1e-11
