"""A scene some of whose numbers have changed, and which is made when it is asked for."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from pyrod.rod.rod import Rod
from pyrod.scene.changes import changed, entries_of, part_keys
from pyrod.scene.scene import Scene

_PLAIN = {float, int, np.float64}
_MOST = 1e300  # above, and if it is no number, it is looked at as the part's
Entry = tuple[bool, int, str, int]
"""Whether of a load, else of a support; its number, an entry, and a component, -1: all."""


class NewNumbers:
    """A scene, and new values of vectors that its loads and supports have."""

    def __init__(
        self,
        base: Scene,
        values: Mapping[str, Any] | None = None,
        known: dict[str, Entry | None] | None = None,
    ) -> None:
        self._base = base
        self._values = values or {}
        self._known = {} if known is None else known  # of paths

    @property
    def rods(self) -> tuple[Rod, ...]:
        """The rods of the scene, which are those of before."""
        return self._base.rods

    def made(self) -> Scene:
        """The scene."""
        return changed(self._base, self._values)[0] if self._values else self._base

    @property
    def scene(self) -> Scene:
        """The scene; what was made is kept."""
        self._base, self._values = self.made(), {}
        return self._base

    def with_these(self, changes: Mapping[str, Any]) -> NewNumbers:
        """The same with other values, the last of them last."""
        values = {path: x for path, x in self._values.items() if path not in changes}
        for path, value in changes.items():
            values[path] = tuple(value) if isinstance(value, (list, np.ndarray)) else value
        return NewNumbers(self._base, values, self._known)

    def read(self, changes: Mapping[str, Any]) -> list[tuple[Entry, Any]] | None:
        """What the compiled solver takes; none if there is more to it than such numbers.

        Raises
        ------
        ValueError, TypeError
            A path is no entry.
        """
        out = []
        for path, value in changes.items():
            try:
                entry = self._known[path]
            except KeyError:
                entry = self._known[path] = self._entry(path)
            if entry is None:
                return None
            if entry[3] < 0:
                if isinstance(value, np.ndarray) and value.shape == (3,):
                    value = value.tolist()
                if (
                    type(value) not in (tuple, list)
                    or len(value) != 3
                    or not all(map(_plain, value))
                ):
                    return None
            elif not _plain(value):
                return None
            out.append((entry, value))
        return out

    def _entry(self, path: str) -> Entry | None:
        kind, which, *rest = part_keys(self._base, path)
        if kind not in ("loads", "supports") or len(rest) not in (1, 2):
            return None
        part = getattr(self._base, kind)[which]
        name = rest[0]
        kind_of_part: Any = type(part)
        if name not in entries_of(kind_of_part) or (kind == "supports" and name != "position"):
            return None
        old = getattr(part, name)
        if not isinstance(old, np.ndarray) or old.shape != (3,):
            return None
        if len(rest) == 1:
            return (kind == "loads", which, name, -1)
        return (kind == "loads", which, name, int(rest[1])) if rest[1] in ("0", "1", "2") else None


def _plain(value: Any) -> bool:
    return type(value) in _PLAIN and abs(value) < _MOST
