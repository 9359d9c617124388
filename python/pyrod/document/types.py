"""Types of the values of a document: each reads, checks, writes and describes its values.

``read`` returns None for what is refused, and notes the problem where it is.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from math import isnan
from typing import Any, Protocol

import numpy as np

from pyrod.document.problems import Here, a, instead, shown
from pyrod.document.units import LENGTH, WORDS, Dimension, Misread, quantity


class Type(Protocol):
    """What a value may be."""

    @property
    def text(self) -> str:
        """In words, for tables and messages."""
        ...

    def read(self, value: Any, here: Here) -> Any:
        """From the plain value of a document."""
        ...

    def write(self, value: Any) -> Any:
        """To the plain value."""
        ...


@dataclass(frozen=True)
class Number:
    """A number in SI units, or a string with a unit."""

    dimension: Dimension

    @property
    def text(self) -> str:
        return self.dimension.text

    def read(self, value: Any, here: Here) -> float | None:
        try:
            if isinstance(value, str):
                return quantity(value, self.dimension)
            if isinstance(value, (int, float)) and not isinstance(value, bool):
                number = float(value)
                return here.wrong("nan is not a number") if isnan(number) else number
        except Misread as error:
            return here.wrong(f"{error}, got {shown(value)}")
        except OverflowError:
            return here.wrong("the number is too large")
        return here.wrong(f"expected {a(self.text)}, got {shown(value)}")

    def write(self, value: Any) -> float:
        return float(value)


@dataclass(frozen=True)
class Numbers:
    """An array of numbers of one dimension; None in a shape: any number of rows."""

    dimension: Dimension
    shapes: tuple[tuple[int | None, ...], ...]

    @property
    def text(self) -> str:
        sizes = [
            " x ".join("n" if size is None else str(size) for size in shape)
            for shape in self.shapes
        ]
        return f"{self.dimension.text}, {' or '.join(sizes)} numbers"

    def read(self, value: Any, here: Here) -> np.ndarray | None:
        before = len(here.found.problems)
        plain = self._plain(value, here, max(map(len, self.shapes)))
        if len(here.found.problems) > before:
            return None
        try:
            array = np.array(plain, dtype=np.float64)
        except ValueError:  # rows of different lengths
            return here.wrong(f"expected {self.text}, got rows of different lengths")
        if not any(_fits(array.shape, shape) for shape in self.shapes):
            return here.wrong(f"expected {self.text}, got shape {array.shape}")
        return array

    def _plain(self, value: Any, here: Here, depth: int) -> Any:
        if isinstance(value, list) and depth:
            return [self._plain(x, here / i, depth - 1) for i, x in enumerate(value)]
        if isinstance(value, (list, dict)):
            return here.wrong(f"expected {self.text}, got {shown(value)}")
        return Number(self.dimension).read(value, here)

    def write(self, value: Any) -> Any:
        return np.asarray(value, dtype=np.float64).tolist()


def vector_in(dimension: Dimension) -> Numbers:
    """Three numbers."""
    return Numbers(dimension, ((3,),))


def _fits(shape: tuple[int, ...], wanted: tuple[int | None, ...]) -> bool:
    return len(shape) == len(wanted) and all(
        b in (None, a) for a, b in zip(shape, wanted, strict=True)
    )


@dataclass(frozen=True)
class Plain:
    """A text, a flag or a whole number."""

    kind: Any
    text: str
    least: int | None = None
    most: int | None = None

    def read(self, value: Any, here: Here) -> Any:
        if type(value) is not self.kind:
            return here.wrong(f"expected {self.text}, got {shown(value)}")
        if self.least is not None and value < self.least:
            return here.wrong(f"must be at least {self.least}, got {shown(value)}")
        if self.most is not None and value > self.most:
            return here.wrong(f"must be at most {self.most}, got {shown(value)}")
        return value

    def write(self, value: Any) -> Any:
        return self.kind(value)


TEXT = Plain(str, "text")
FLAG = Plain(bool, "true or false")


def whole_number(least: int | None = None, most: int | None = None) -> Plain:
    """A whole number between two."""
    return Plain(int, "whole number", least, most)


@dataclass(frozen=True)
class Words:
    """One of some words."""

    words: tuple[str, ...]

    @property
    def text(self) -> str:
        return " or ".join(f'"{word}"' for word in self.words)

    def read(self, value: Any, here: Here) -> str | None:
        if isinstance(value, str) and value in self.words:
            return value
        if isinstance(value, str):
            return here.wrong(f"there is no {instead(value, self.words)}")
        return here.wrong(f"expected {self.text}, got {shown(value)}")

    def write(self, value: str) -> str:
        return value


@dataclass(frozen=True)
class Name:
    """The name of a material or a section; or a list of names, if ``many``."""

    kind: str
    many: bool = False

    @property
    def text(self) -> str:
        text = f"name of one of the {self.kind}"
        return f"{text}, or a list of n, one per edge" if self.many else text

    def read(self, value: Any, here: Here) -> Any:
        if self.many and isinstance(value, list):
            return [Name(self.kind).read(one, here / i) for i, one in enumerate(value)]
        known = here.found.names[self.kind]
        if not isinstance(value, str):
            return here.wrong(f"expected the {self.text}, got {shown(value)}")
        if value not in known:
            return here.wrong(f"none of the {self.kind} is called {instead(value, known)}")
        return value

    def write(self, value: Any) -> Any:
        return value


@dataclass(frozen=True)
class RodNumber:
    """A rod, by its name or its number."""

    text = "name or number of a rod, from 0"

    def read(self, value: Any, here: Here) -> int | None:
        rods = here.found.rods
        if isinstance(value, str):
            if value in rods:
                return rods.index(value)
            return here.wrong(f"no rod is called {instead(value, _texts(rods))}")
        if isinstance(value, int) and not isinstance(value, bool):
            if 0 <= value < len(rods):
                return value
            return here.wrong(f"there is no rod {value}, the scene has {len(rods)}, from 0")
        return here.wrong(f"expected the {self.text}, got {shown(value)}")

    def write(self, value: int) -> int:
        return int(value)


def _texts(values: Iterable[Any]) -> list[str]:
    return [value for value in values if isinstance(value, str)]


@dataclass(frozen=True)
class PlaceOnRod:
    """A place on rod 0, or on the one that is named."""

    text = '"start", "end", arc length [m], or { rod = ..., s = one of these }'

    def read(self, value: Any, here: Here) -> Any:
        if isinstance(value, dict):
            if set(value) != {"rod", "s"}:
                return here.wrong(f"expected {{ rod = ..., s = ... }}, got {shown(value)}")
            number = RodNumber().read(value["rod"], here / "rod")
            return number, self._on_one(value["s"], here / "s")
        return self._on_one(value, here)

    def _on_one(self, value: Any, here: Here) -> Any:
        if value in ("start", "end"):
            return value
        if isinstance(value, str) and value not in WORDS and not value[:1].strip("+-.0123456789"):
            return Number(LENGTH).read(value, here)
        if isinstance(value, (int, float)) and not isinstance(value, bool):
            return Number(LENGTH).read(value, here)
        return here.wrong(f"expected {self.text}, got {shown(value)}")

    def write(self, value: Any) -> Any:
        if isinstance(value, tuple):
            return {"rod": value[0], "s": value[1]}
        return value
