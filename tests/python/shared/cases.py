"""The cases of the reference folder, and how the tests start them.

The environment variable PYROD_REFERENCE names another folder of the same form.
"""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest

from pyrod.reference import Case, load
from pyrod.reference import _notes as notes
from pyrod.rotation import multiply

FOLDER = Path(os.environ.get("PYROD_REFERENCE", Path(__file__).parents[2] / "reference"))
CASES = load(FOLDER)


def parameters(cases: list[Case]) -> list[object]:
    return [pytest.param(c, s, id=f"{c}-{s}") for c in cases for s in c.spaces]


def start(case: Case, edges: int) -> np.ndarray:
    """Frames of the exact solution, as near as the case needs."""
    return (pulse if str(case) in notes.PULSES else Case.start)(case, edges)


def pulse(case: Case, edges: int) -> np.ndarray:
    """Frames Rz(psi) Ry(theta) Rz(phi) of the homoclinic solution, at the centres of the edges."""
    T, M = case.data["values"]["T"], case.data["values"]["M"]
    B, GJ = case.data["stiffness"]["EI1"], case.data["stiffness"]["GJ"]
    x = case.data["L"] * ((np.arange(edges) + 0.5) / edges - 0.5)
    g = np.sqrt(1 - M**2 / (4 * B * T))
    a = g * np.sqrt(T / B)
    theta = 2 * np.arcsin(g / np.cosh(a * x))
    swing = np.arctan(g / np.sqrt(1 - g**2) * np.tanh(a * x))
    psi, phi = M * x / (2 * B) + swing, M * x * (1 / GJ - 1 / (2 * B)) + swing
    return multiply(multiply(about(3, psi), about(2, theta)), about(3, phi))


def about(axis: int, angle: np.ndarray) -> np.ndarray:
    q = np.zeros((len(angle), 4))
    q[:, 0], q[:, axis] = np.cos(angle / 2), np.sin(angle / 2)
    return q
