"""Rods, scenes and comparisons that several test files use."""

from __future__ import annotations

from typing import Any

import numpy as np
from hypothesis import strategies as st

import pyrod
from pyrod import rotation

Array = np.ndarray
MODELS = ("cosserat", "extensible", "inextensible")
SPACES = ("planar", "spatial")
SOFT = pyrod.Section(EI1=1.0, EI2=1.3, GJ=0.8, GA1=60.0, GA2=80.0, EA=150.0)
"""A section for unit length whose shear and stretch are seen; anisotropic."""
ROUND = pyrod.Section(EI1=1.0, EI2=1.0, GJ=0.7)
"""An isotropic section, neither shearable nor extensible."""
IDENTITY = np.array([1.0, 0.0, 0.0, 0.0])


def unit(vector: Any) -> Array:
    """The vector, or each row, divided by its length."""
    vector = np.asarray(vector, dtype=float)
    return vector / np.linalg.norm(vector, axis=-1, keepdims=True)


def random_frames(rng: np.random.Generator, *shape: int) -> Array:
    """Unit quaternions, evenly distributed."""
    return unit(rng.normal(size=(*shape, 4)))


def vectors(largest: float = 1.0) -> st.SearchStrategy[Array]:
    """Vectors in a cube, for property tests; rounded, so that no product of two underflows."""
    number = st.floats(-largest, largest).map(lambda x: round(x, 12))
    return st.tuples(number, number, number).map(np.array)


def frames() -> st.SearchStrategy[Array]:
    """Unit quaternions of both signs, for property tests."""
    number = st.floats(-1, 1, allow_subnormal=False)
    quadruples = st.tuples(number, number, number, number).map(np.array)
    return quadruples.filter(lambda q: np.linalg.norm(q) > 0.1).map(unit)


def angle_between(a: Array, b: Array) -> Array:
    """Angle [rad] between frames, whatever the signs of the quaternions."""
    turn = rotation.multiply(rotation.conjugate(a), b)
    return 2 * np.arctan2(np.linalg.norm(turn[..., 1:], axis=-1), np.abs(turn[..., 0]))


def solved(
    rod: pyrod.Rod,
    *loads: Any,
    clamp: pyrod.Clamp | None = None,
    space: str = "spatial",
    **more: Any,
) -> pyrod.Equilibrium:
    """Solves a rod clamped at its start."""
    return pyrod.solve(pyrod.Scene(rod, clamp or pyrod.Clamp(), loads, space), **more)


def orders(errors: Any, ratio: float = 2.0) -> Array:
    """Observed orders of convergence between neighbouring levels."""
    errors = np.asarray(errors, dtype=float)
    return np.log(errors[:-1] / errors[1:]) / np.log(ratio)


def differences(a: Any, b: Any) -> float:
    """Largest difference relative to the largest entry of b."""
    a, b = np.asarray(a), np.asarray(b)
    return float(np.abs(a - b).max() / (np.abs(b).max() or 1.0))
