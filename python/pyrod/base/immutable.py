"""Objects that stay as they were made: frozen dataclasses whose arrays are read-only."""

from __future__ import annotations

from dataclasses import fields
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from pyrod.base.arrays import Array as Array
from pyrod.base.arrays import array


def frozen(values: ArrayLike, name: str = "values") -> Array:
    """A read-only array of doubles that shares no memory with ``values``."""
    made = np.array(array(values, name), order="C")
    made.flags.writeable = False
    return made


def vector(values: ArrayLike, name: str) -> Array:
    """Three finite numbers."""
    made = frozen(values, name)
    if made.shape == ():
        raise ValueError(
            f"{name}: expected 3 numbers in one tuple or array, as in (0, 0, -2), got {made}"
        )
    if made.shape != (3,):
        raise ValueError(f"{name}: expected 3 numbers, got shape {made.shape}")
    if not np.isfinite(made).all():
        raise ValueError(f"{name}: expected finite numbers, got {made}")
    return made


def sealed(values: Any) -> Any:
    """The same values; all arrays in them, also inside of tuples and dicts, are read-only now."""
    if isinstance(values, np.ndarray):
        values.flags.writeable = False
    elif isinstance(values, dict):
        sealed(tuple(values.values()))
    elif isinstance(values, tuple):
        for value in values:
            sealed(value)
    return values


class Lazy:
    """Mixin of frozen dataclasses whose arrays are made when they are first asked for.

    ``_source`` is what has the attributes that are still missing, or None.
    """

    def __getattr__(self, name: str) -> Any:
        state = self.__dict__
        source = state.get("_source")
        missing = AttributeError(f"{type(self).__name__} has no {name!r}")
        if source is None or name.startswith("_"):
            raise missing
        try:
            value = state[name] = getattr(source, name)
        except AttributeError:
            raise missing from None
        return value


def same(a: Any, b: Any) -> bool:
    if isinstance(a, dict) and isinstance(b, dict):
        return a.keys() == b.keys() and all(same(a[key], b[key]) for key in a)
    if isinstance(a, np.ndarray) or isinstance(b, np.ndarray):
        return np.array_equal(a, b)
    if isinstance(a, tuple) and isinstance(b, tuple):
        return len(a) == len(b) and all(map(same, a, b))
    return bool(a == b)


class Immutable:
    """Base of the frozen dataclasses: equality of arrays, and pickles that stay read-only."""

    def __dir__(self) -> list[str]:
        """What completion shows: what exists, made already or not, and nothing private."""
        names = {*super().__dir__(), *(f.name for f in fields(self))}  # type: ignore[arg-type]
        return sorted(name for name in names if name[0] != "_" or name[:2] == "__")

    def _set(self, **values: Any) -> None:
        for name, value in values.items():
            object.__setattr__(self, name, value)

    def __eq__(self, other: object) -> bool:
        if type(self) is not type(other):
            return NotImplemented
        return all(
            same(getattr(self, f.name), getattr(other, f.name))
            for f in fields(self)  # type: ignore[arg-type]
            if f.compare
        )

    __hash__ = None  # type: ignore[assignment]

    def __getstate__(self) -> dict[str, Any]:
        """What the object was made from; what it derives is derived again."""
        return {f.name: getattr(self, f.name) for f in fields(self) if f.init}  # type: ignore[arg-type]

    def __setstate__(self, state: dict[str, Any]) -> None:
        self._set(**sealed(state))
