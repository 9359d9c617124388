"""Errors that fit on a screen, however long the values are that they tell."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from support import ROUND

import pyrod
from pyrod import Clamp, Force, Rod, Scene

ROD = Rod.straight(1.0, 4, ROUND)
SCENE = Scene(ROD, Clamp(), Force((0, 0, 1)))
LONG: dict[str, Any] = {
    "list": list(range(100_000)),
    "array": np.zeros((1000, 7)),
    "text": "x" * 100_000,
    "dict": {str(i): i for i in range(5000)},
}
REFUSING: dict[str, Any] = {
    "force": Force,
    "at": lambda v: Force((0, 0, 1), at=v),
    "position": Clamp,
    "turns": lambda v: Clamp(turns=v),
    "section": lambda v: pyrod.Section(v, 1, 1),
    "length": lambda v: Rod.straight(v, 4, ROUND),
    "model": lambda v: Rod.straight(1, 4, ROUND, v),
    "curvature": lambda v: Rod.precurved(1, 4, ROUND, v),
    "space": lambda v: Scene(ROD, Clamp(), space=v),
    "rods": lambda v: Scene(v, Clamp()),
    "kind": lambda v: pyrod.Joint(("start", "end"), v),
    "tol": lambda v: pyrod.solve(SCENE, tol=v),
    "start": lambda v: pyrod.solve(SCENE, start=v),
    "closed": lambda v: pyrod.curve.Polyline(np.eye(3), v),
    "parameters": lambda v: pyrod.sweep(SCENE, v, progress=False),
    "loads": lambda v: pyrod.critical_load(SCENE, loads=v),
    "quantity": lambda v: pyrod.effect(SCENE, v),
    "vector": pyrod.rotation.exp,
    "radius": pyrod.Outline.circle,
}


@pytest.mark.parametrize("value", LONG)
@pytest.mark.parametrize("argument", REFUSING)
def test_errors_fit_on_a_screen(argument: str, value: str) -> None:
    """Whatever was given is not repeated at length, nor are the errors of helpers below."""
    with pytest.raises((TypeError, ValueError)) as raised:
        REFUSING[argument](LONG[value])
    error = raised.value
    assert len(str(error)) < 400
    assert error.__cause__ is None
    assert error.__suppress_context__ or error.__context__ is None


def test_few_values_are_told_as_they_are() -> None:
    with pytest.raises(ValueError, match=r"got 'pin'$"):
        pyrod.Joint(("start", "end"), "pin")  # type: ignore[arg-type]
