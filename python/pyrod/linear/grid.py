"""The linear response of an equilibrium on the edges of its scene."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import cached_property
from typing import Any

import numpy as np

import pyrod._core as _core
from pyrod.base.immutable import Array
from pyrod.linear.numbers import Entry
from pyrod.linear.told import Told, one_weight, resolved, weights_of
from pyrod.result.equilibrium import Equilibrium
from pyrod.rod.place import Place
from pyrod.scene.scene import Scene


class Grid:
    """Products with the derivatives of one equilibrium, and what is made of them."""

    def __init__(self, result: Equilibrium) -> None:
        self.result = result
        self.scene: Scene = result.scene
        self._compiled = _core.Linearised(self.scene._compiled, result._compiled)
        self._entries: dict[str, Entry] = {}

    def entry(self, path: str) -> Entry:
        """What a path of the scene names."""
        if path not in self._entries:
            self._entries[path] = Entry(self.scene, self._compiled, path)
        return self._entries[path]

    def numbers(self, like: Scene) -> Array:
        """Of a scene that differs in numbers only."""
        return self._compiled.numbers(like._compiled)

    @property
    def symmetric(self) -> bool:
        """Whether all loads have a potential."""
        return self._compiled.symmetric

    @cached_property
    def zeros(self) -> dict[str, Any]:
        """Of all that is told, by whole paths."""
        return self._compiled.push(0 * self._compiled.numbers(self.scene._compiled))

    def shape(self, output: str) -> tuple[int, ...]:
        """Of an output."""
        path, row = resolved(self.scene, output)
        return np.shape(self.zeros[path] if row is None else self.zeros[path][row])

    def push(self, numbers: Array) -> Told:
        """What a change of the network's numbers does."""
        return Told(self._compiled.push(numbers), self.scene)

    def jvp(self, changes: Mapping[str, Any]) -> Told:
        """What a change of the scene does."""
        numbers = [self.entry(path).numbers(v) for path, v in changes.items()]
        return self.push(np.sum(numbers, axis=0))

    def vjp(self, weights: Mapping[str, Any], paths: Iterable[str]) -> dict[str, Array]:
        """The gradient of a weighted sum of outputs."""
        numbers = self.gradient(weights)
        return {path: self.entry(path).gradient(numbers) for path in paths}

    def gradient(self, weights: Mapping[str, Any]) -> Array:
        """In all numbers of the network."""
        return self._compiled.pull(weights_of(self.scene, weights, self.zeros))

    def jacobian(self, output: str, paths: list[str]) -> dict[str, Array]:
        """Forwards or backwards, whichever needs fewer solves."""
        shape = self.shape(output)
        size = int(np.prod(shape))
        back = [path for path in paths if self.entry(path).size > size]
        rows: dict[str, list[Array]] = {path: [] for path in back}
        for i in range(size if back else 0):
            numbers = self._compiled.pull(one_weight(self.scene, output, self.zeros, i))
            for path in back:
                rows[path].append(self.entry(path).gradient(numbers).reshape(-1))
        out = {}
        for path in paths:
            made = np.array(rows[path]) if path in rows else self._columns(output, path, size)
            out[path] = made.reshape(shape + self.entry(path).shape)
        return out

    def _columns(self, output: str, path: str, size: int) -> Array:
        columns = []
        for unit in self.entry(path).units():
            column = np.full(size, np.nan) if unit is None else self.push(unit)[output]
            columns.append(np.reshape(column, -1))
        return np.stack(columns, axis=1)

    def compliance(self, at: Place) -> Array:
        """See `Linearised.compliance`."""
        return self._compiled.compliance(*self.scene._compiled.vertex(at))

    def stiffness(self, support: int) -> Array:
        """See `Linearised.stiffness`."""
        out = np.empty((6, 6))
        for j, unit in enumerate(np.eye(6)):
            told = self.push(self._compiled.of_motion(support, unit[:3], unit[3:]))
            out[:3, j] = told[f"reactions.{support}.force"]
            out[3:, j] = told[f"reactions.{support}.moment"]
        return out
