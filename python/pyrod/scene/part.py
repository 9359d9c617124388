"""What supports, loads and joints have in common: each is what its compiled counterpart takes."""

from __future__ import annotations

from typing import Any, ClassVar

from pyrod.base.immutable import Immutable, Once
from pyrod.curve._sampling import along


class Part(Immutable):
    """Base of the parts of scenes that are not rods."""

    _kind: ClassVar[Any]
    """The compiled class; it names the attributes that it takes, in ``fields``."""

    @Once
    def _compiled(self) -> Any:
        """The compiled part."""
        return self._kind(*[self._given(name) for name in self._kind.fields])

    def _given(self, name: str) -> Any:
        """An attribute; if it is a function of arc length, one whose values are looked at."""
        value = getattr(self, name)
        return along(value, 1, name, "edge") if callable(value) else value
