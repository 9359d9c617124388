"""Objects that stay as they were made: frozen dataclasses whose arrays are read-only."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields
from math import isfinite
from typing import TYPE_CHECKING, Any, Generic, TypeVar, overload

import numpy as np
from numpy.typing import ArrayLike

from pyrod.base.arrays import Array as Array
from pyrod.base.arrays import array
from pyrod.base.calls import Answering, no_attribute

Made = TypeVar("Made")
LazyKind = TypeVar("LazyKind", bound="Lazy")


def frozen(values: ArrayLike, name: str = "values") -> Array:
    """A read-only array of doubles that shares no memory with ``values``."""
    made = array(values, name)
    if not isinstance(values, (tuple, list)):  # which share no memory anyway
        made = np.array(made, order="C")
    made.setflags(write=False)
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
    if not all(map(isfinite, made.tolist())):
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


def made_later(thing: Any, name: str) -> Any:
    """What is compiled has it; else there is none."""
    state = thing.__dict__
    source = state.get("_compiled")
    if source is not None and not name.startswith("_"):
        try:
            value = state[name] = getattr(source, name)
        except AttributeError:
            pass
        else:
            return value
    raise no_attribute(thing, name)


class Lazy:
    """Mixin of frozen dataclasses whose arrays are made when they are first asked for.

    ``_compiled`` is what has the attributes that are still missing, or None.
    """

    _compiled: Any

    if not TYPE_CHECKING:  # who would find every name
        __getattr__ = made_later


def lazily(kind: type[LazyKind], compiled: Any, **known: Any) -> LazyKind:
    """An object of which this is known, and all else is what is compiled."""
    made = object.__new__(kind)
    made.__dict__.update(_compiled=compiled, **known)
    return made


class Once(Generic[Made]):
    """A property that is computed when it is first asked for.

    Two threads may compute it both; without a lock it costs a fifth.
    """

    def __init__(self, compute: Callable[[Any], Made]) -> None:
        self.compute = compute
        self.__doc__ = compute.__doc__

    def __set_name__(self, owner: type, name: str) -> None:
        self.name = name

    @overload
    def __get__(self, thing: None, owner: type | None = None) -> Once[Made]: ...
    @overload
    def __get__(self, thing: object, owner: type | None = None) -> Made: ...
    def __get__(self, thing: object | None, owner: type | None = None) -> Made | Once[Made]:
        if thing is None:
            return self
        made = thing.__dict__[self.name] = self.compute(thing)
        return made


def same(a: Any, b: Any) -> bool:
    if isinstance(a, dict) and isinstance(b, dict):
        return a.keys() == b.keys() and all(same(a[key], b[key]) for key in a)
    if isinstance(a, np.ndarray) or isinstance(b, np.ndarray):
        return np.array_equal(a, b)
    if isinstance(a, tuple) and isinstance(b, tuple):
        return len(a) == len(b) and all(map(same, a, b))
    return bool(a == b)


class Immutable(Answering):
    """Base of the frozen dataclasses: equality of arrays, and pickles that stay read-only."""

    def __dir__(self) -> list[str]:
        """What completion shows: what exists, made already or not, and nothing private."""
        names = {*super().__dir__(), *(f.name for f in fields(self))}  # type: ignore[arg-type]
        return sorted(name for name in names if name[0] != "_" or name[:2] == "__")

    def _set(self, **values: Any) -> None:
        self.__dict__.update(values)

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
