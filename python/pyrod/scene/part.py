"""What supports, loads and joints have in common: each is what its compiled counterpart takes."""

from __future__ import annotations

from typing import Any, ClassVar

from pyrod.base.immutable import Immutable, Once


class Part(Immutable):
    """Base of the parts of scenes that are not rods."""

    _kind: ClassVar[Any]
    """The compiled class; it names the attributes that it takes, in ``fields``."""

    @Once
    def _compiled(self) -> Any:
        """The compiled part."""
        return self._kind(*self._given())

    def _given(self) -> list[Any]:
        """What the compiled class takes."""
        return [getattr(self, name) for name in self._kind.fields]
