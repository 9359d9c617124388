"""The cases of a sweep: all combinations of some values, or a list."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from itertools import product
from math import prod
from typing import TYPE_CHECKING, Any, NamedTuple, Union

import numpy as np

from pyrod.base.words import shortly

if TYPE_CHECKING:
    import pandas as pd

Parameters = Union[Mapping[str, Iterable[Any]], Sequence[Mapping[str, Any]], "pd.DataFrame"]

RESERVED = ("case", "time", "warnings", "error")
"""Names that tables of a sweep give to what is known of each case."""


class Cases(NamedTuple):
    """Values of parameters, in the order in which cases are numbered: the last runs fastest."""

    names: tuple[str, ...]
    axes: tuple[tuple[Any, ...], ...] | None  #: of a grid, the values of each parameter
    rows: list[tuple[Any, ...]]  #: of each case, the values of the parameters

    @property
    def shape(self) -> tuple[int, ...]:
        """Of the grid; or the number of cases."""
        return (len(self.rows),) if self.axes is None else tuple(map(len, self.axes))

    @property
    def line(self) -> int:
        """Number of neighbours along the last parameter: of a list, all."""
        return self.shape[-1]

    def arguments(self, case: int) -> dict[str, Any]:
        """The parameters of a case by name."""
        return dict(zip(self.names, self.rows[case], strict=True))


def cases_of(parameters: Parameters) -> Cases:
    """The cases that are meant.

    Raises
    ------
    ValueError, TypeError
        There are none, or they are not told by names.
    """
    if isinstance(parameters, Mapping):
        return _grid(parameters)
    if hasattr(parameters, "to_dict"):
        parameters = parameters.to_dict("records")
    return _list(parameters)


def _grid(parameters: Mapping[str, Iterable[Any]]) -> Cases:
    names = _parameter_names(parameters)
    axes = tuple(_checked_values(name, values) for name, values in parameters.items())
    if prod(map(len, axes)) == 0:
        empty = names[[len(axis) for axis in axes].index(0)]
        raise ValueError(f"parameters: {shortly(empty)} has no values")
    return Cases(names, axes, list(product(*axes)))


def _checked_values(name: str, values: Any) -> tuple[Any, ...]:
    if isinstance(values, str) or not isinstance(values, Iterable):
        raise TypeError(f"parameters: {name!r} needs a list of values, got {shortly(values)}")
    return tuple(map(_unboxed, values))


def _list(parameters: Any) -> Cases:
    if isinstance(parameters, str) or not isinstance(parameters, Iterable):
        raise TypeError(
            "parameters: expected lists of values by name, a list of cases or a DataFrame, got "
            f"a {type(parameters).__name__}"
        )
    listed = list(parameters)
    if not listed:
        raise ValueError("parameters: there are no cases")
    for number, one in enumerate(listed):
        if not isinstance(one, Mapping):
            kind = type(one).__name__
            raise TypeError(f"parameters: case {number} needs values by name, got a {kind}")
        if one.keys() != listed[0].keys():
            raise ValueError(
                f"parameters: case {number} has {sorted(one)}, but case 0 {sorted(listed[0])}"
            )
    names = _parameter_names(listed[0])
    return Cases(names, None, [tuple(_unboxed(one[name]) for name in names) for one in listed])


def _parameter_names(parameters: Mapping[str, Any]) -> tuple[str, ...]:
    names = tuple(parameters)
    if not names:
        raise ValueError("parameters: there is none")
    for name in names:
        if not isinstance(name, str):
            raise TypeError(f"parameters: names are strings, got {shortly(name)}")
        if name in RESERVED:
            raise ValueError(f"parameters: {name!r} is a column of every sweep, use another name")
    return names


def _unboxed(value: Any) -> Any:
    """Python's own number, where NumPy has made it its own."""
    return value.item() if isinstance(value, np.generic) else value
