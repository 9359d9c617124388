"""Tables of a document: what keys they have, of what types, with what defaults."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from inspect import Parameter, signature
from typing import Any, NamedTuple

from pyrod.base.immutable import same
from pyrod.document.problems import Here, a, instead, shown
from pyrod.document.types import Type

REQUIRED = Parameter.empty


class Key(NamedTuple):
    """A key of a table."""

    type: Type
    default: Any = None  #: REQUIRED; None: nothing, or as the text on the kind says


@dataclass(frozen=True)
class Form:
    """A kind of table, and what is made from its values."""

    name: str
    make: Callable[..., Any]
    keys: dict[str, Key]

    @staticmethod
    def of(name: str, make: Callable[..., Any], **types: Type) -> Form:
        """Defaults are those of what is called to make it."""
        known = signature(make).parameters
        return Form(name, make, {key: Key(t, known[key].default) for key, t in types.items()})

    @property
    def text(self) -> str:
        """In words."""
        return f"table of {a(self.name)}"

    def read(self, value: Any, here: Here) -> dict[str, Any] | None:
        """The values of the keys that are there."""
        if not isinstance(value, dict):
            return here.wrong(f"expected a {self.text}, got {shown(value)}")
        out = {}
        for name, plain in value.items():
            if name in self.keys:
                out[name] = self.keys[name].type.read(plain, here / name)
            else:
                (here / name).wrong(f"{a(self.name)} has no key {instead(name, self.keys)}")
        for name, key in self.keys.items():
            if key.default is REQUIRED and name not in value:
                here.wrong(f'"{name}" is missing: {key.type.text}')
        return out

    def write(self, thing: Any) -> dict[str, Any]:
        """The values that are not the defaults, of a thing with attributes of these names."""
        values = {name: getattr(thing, name, None) for name in self.keys}
        return {
            name: self.keys[name].type.write(value)
            for name, value in values.items()
            if value is not None and not same(value, self.keys[name].default)
        }


@dataclass(frozen=True)
class OneOf:
    """A table whose key "kind" tells which of several kinds it is."""

    name: str
    kinds: dict[str, Form]

    @property
    def text(self) -> str:
        """In words."""
        return f"table of {a(self.name)}"

    def read(self, value: Any, here: Here) -> tuple[Form, Any] | None:
        """The kind, and the values of the keys."""
        if not isinstance(value, dict):
            return here.wrong(f"expected a {self.text}, got {shown(value)}")
        name = value.get("kind")
        if not isinstance(name, str):
            return here.wrong(f'"kind" is missing: one of {", ".join(self.kinds)}')
        if name not in self.kinds:
            return (here / "kind").wrong(f"no {self.name} is a {instead(name, self.kinds)}")
        kind = self.kinds[name]
        return kind, kind.read({k: v for k, v in value.items() if k != "kind"}, here)

    def write(self, thing: Any) -> dict[str, Any]:
        """With the kind first."""
        for name, kind in self.kinds.items():
            if type(thing) is kind.make:
                return {"kind": name, **kind.write(thing)}
        raise TypeError(f"{type(thing).__name__} cannot be written: no {self.name} of a scene file")


@dataclass(frozen=True)
class Listed:
    """A list of values of one type."""

    type: Type
    least: int = 0

    @property
    def text(self) -> str:
        """In words."""
        return f"list, each a {self.type.text}"

    def read(self, value: Any, here: Here) -> list[Any] | None:
        """One by one."""
        if not isinstance(value, list):
            return here.wrong(f"expected a {self.text}, got {shown(value)}")
        if len(value) < self.least:
            return here.wrong(f"expected at least {self.least}, got {len(value)}")
        return [self.type.read(one, here / number) for number, one in enumerate(value)]

    def write(self, values: Any) -> list[Any]:
        """One by one."""
        return [self.type.write(one) for one in values]


@dataclass(frozen=True)
class OneOrEach:
    """A table for all edges of a rod, or two for each edge: at its start and at its end."""

    kind: Form

    @property
    def text(self) -> str:
        """In words."""
        return f"{self.kind.text}, or n pairs of them, for both ends of each edge"

    def _type(self, value: Any) -> Type:
        return Listed(Listed(self.kind)) if isinstance(value, list) else self.kind

    def read(self, value: Any, here: Here) -> Any:
        """All of them."""
        return self._type(value).read(value, here)

    def write(self, value: Any) -> Any:
        """They are plain already."""
        return value


@dataclass(frozen=True)
class Named:
    """Tables of one kind by name."""

    kind: Form

    @property
    def text(self) -> str:
        """In words."""
        return f"tables by name, each a {self.kind.text}"

    def read(self, value: Any, here: Here) -> dict[str, Any] | None:
        """One by one."""
        if not isinstance(value, dict):
            return here.wrong(f"expected {self.text}, got {shown(value)}")
        return {name: self.kind.read(one, here / name) for name, one in value.items()}

    def write(self, things: dict[str, Any]) -> dict[str, Any]:
        """One by one."""
        return {name: self.kind.write(thing) for name, thing in things.items()}
