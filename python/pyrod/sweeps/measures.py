"""What is kept of each equilibrium of a sweep."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from pyrod.base.words import shortly
from pyrod.result.equilibrium import Equilibrium
from pyrod.sweeps.cases import RESERVED

_KINDS = {"b": bool, "i": int, "u": int, "f": float}
Measuring = Callable[[Equilibrium], Mapping[str, Any]]


def summary(result: Equilibrium) -> dict[str, Any]:
    """The numbers that are kept unless others are asked for; see `sweep`."""
    kept = {
        "status": result.status,
        "iterations": result.iterations,
        "energy": result.energy,
        "index": result.index,
        "tip": result.rods[-1].tip,
        "largest_K": result.largest_K,
        "largest_force": result.largest_force,
        "largest_moment": result.largest_moment,
    }
    if result.lowest_eigenvalue is not None:
        kept["lowest_eigenvalue"] = result.lowest_eigenvalue
    if result.accuracy is not None:
        kept["estimated_error"] = result.accuracy.reached
    return kept


def plain(values: Any, arguments: Mapping[str, Any]) -> dict[str, Any]:
    """What a measure returned, as numbers, text and arrays of numbers.

    Raises
    ------
    ValueError, TypeError
        It is something else, or has the name of something else.
    """
    if not isinstance(values, Mapping):
        raise TypeError(f"measure: expected a dict, got a {type(values).__name__}")
    for name in values:
        if not isinstance(name, str):
            raise TypeError(f"measure: names are strings, got {shortly(name)}")
        if name in RESERVED or name in arguments:
            raise ValueError(f"measure: {name!r} is another column already, use another name")
    return {name: _storable(name, value) for name, value in values.items()}


def _storable(name: str, value: Any) -> Any:
    if isinstance(value, str):
        return value
    array = np.array(value)
    if array.dtype.kind not in _KINDS:
        raise TypeError(
            f"measure: {name!r} must be a number, text or an array of real numbers, "
            f"got {shortly(value)}"
        )
    return array.astype(_KINDS[array.dtype.kind]) if array.ndim else array.item()
