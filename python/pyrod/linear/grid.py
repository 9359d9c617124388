"""The linear response of an equilibrium on the edges of its scene."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import cached_property
from typing import Any

import numpy as np

import pyrod._core as _core
from pyrod._core import SingularEquilibrium
from pyrod.base.immutable import Array
from pyrod.base.words import listed
from pyrod.linear.numbers import Entry
from pyrod.linear.told import Told, one_weight, resolved, weights_of
from pyrod.result.equilibrium import Equilibrium
from pyrod.rod.place import Place
from pyrod.scene.scene import Scene

_LEEWAY = 1e-6
"""Of what rounding may do to what is told."""


class Grid:
    """Products with the derivatives of one equilibrium, and what is made of them."""

    def __init__(self, result: Equilibrium, first: Grid | None = None, level: int = 0) -> None:
        """``first``: of which this has every edge cut in 2^level."""
        self.result, self.level = result, level
        self._first = first or self
        self.scene: Scene = result.scene
        self._compiled = _core.Linearised(self.scene._compiled, result._compiled)
        self._entries: dict[str, Entry] = {}

    def entry(self, path: str) -> Entry:
        """What a path of the scene names."""
        if path not in self._entries:
            first = self._first.scene
            self._entries[path] = Entry(self.scene, self._compiled, path, first, self.level)
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

    def vjp(
        self, weights: Mapping[str, Any], paths: Iterable[str], strict: bool = True
    ) -> dict[str, Array]:
        """The gradient of a weighted sum of outputs. What rounding moves is refused if strict, else
        it is NaN."""
        pulled = self._pull(self._weights(weights))
        return {path: self._gradient(self.entry(path), pulled, strict) for path in paths}

    def gradient(self, weights: Mapping[str, Any]) -> Array:
        """In all numbers of the network."""
        numbers, rounding = self._pull(self._weights(weights))
        if np.linalg.norm(rounding) > _LEEWAY * np.linalg.norm(numbers):
            raise _too_straight("the gradient")
        return numbers

    def _weights(self, weights: Mapping[str, Any]) -> dict[str, Any]:
        """Of whole arrays of this grid, from those of the first."""
        whole = weights_of(self._first.scene, weights, self._first.zeros)
        return {name: self._here(name, w) for name, w in whole.items()} if self.level else whole

    def _here(self, name: str, weights: Any) -> Any:
        if not name.startswith("rods."):
            return weights
        out = np.zeros(np.shape(self.zeros[name]))
        out[:: 2**self.level] = weights
        return out

    def _pull(self, weights: dict[str, Any]) -> tuple[Array, Array]:
        """The gradient in all numbers, and how far rounding moves it."""
        self._refuse_what_moves(weights)
        return self._compiled.pull(weights)

    @cached_property
    def free(self) -> list[dict[str, Any]]:
        """What each free motion of the equilibrium changes, by whole paths."""
        return self._compiled.free()

    @cached_property
    def _pushes(self) -> list[Array]:
        return self._compiled.pushes_freely()

    def _refuse_what_moves(self, weights: dict[str, Any]) -> None:
        for moved in self.free:
            parts = {name: w * moved[name] for name, w in weights.items()}
            if abs(sum(np.sum(p) for p in parts.values())) <= _LEEWAY * sum(
                np.abs(p).sum() for p in parts.values()
            ):
                continue
            names = [name for name, p in parts.items() if np.any(p)]
            raise SingularEquilibrium(
                f"vjp: the equilibrium may move freely, and {listed(names)} as weighed with it: "
                "there is no derivative"
            )

    def _gradient(self, entry: Entry, pulled: tuple[Array, Array], strict: bool) -> Array:
        out = entry.gradient(pulled[0])
        wrong = self._pushing(entry)
        if pulled[1].any():
            moved = np.abs(entry.gradient(pulled[1])) > _LEEWAY * np.nanmax(np.abs(out))
            if strict and moved.any():
                raise _too_straight(f"the derivative in {entry.path}")
            wrong = wrong | moved
        return np.where(wrong, np.nan, out) if np.any(wrong) else out

    def _pushing(self, entry: Entry) -> Array:
        """Which of its numbers push along a free motion."""
        unit = max(float(rod.bending.max()) / rod.length for rod in self.scene.rods)
        out = np.zeros(entry.shape, dtype=bool)
        for pushes in self._pushes if self.free else ():
            out |= np.abs(entry.gradient(pushes)) * entry.unit > _LEEWAY * unit
        return out

    def jacobian(self, output: str, paths: list[str]) -> dict[str, Array]:
        """Forwards or backwards, whichever needs fewer solves."""
        shape = self._first.shape(output)
        size = int(np.prod(shape))
        back = [path for path in paths if self.entry(path).size > size]
        rows: dict[str, list[Array]] = {path: [] for path in back}
        for i in range(size if back else 0):
            unit = one_weight(self._first.scene, output, self._first.zeros, i)
            weights = {name: self._here(name, w) for name, w in unit.items()}
            for path, row in self._rows(weights, back).items():
                rows[path].append(row)
        out = {}
        for path in paths:
            made = np.array(rows[path]) if path in rows else self._columns(output, path, size)
            out[path] = made.reshape(shape + self.entry(path).shape)
        return out

    def _rows(self, weights: dict[str, Any], paths: list[str]) -> dict[str, Array]:
        """NaN of what moves freely."""
        try:
            pulled = self._pull(weights)
        except SingularEquilibrium:
            if not self.free:
                raise
            return {path: np.full(self.entry(path).size, np.nan) for path in paths}
        return {path: self._gradient(self.entry(path), pulled, True).reshape(-1) for path in paths}

    def _columns(self, output: str, path: str, size: int) -> Array:
        columns = []
        for unit in self.entry(path).units():
            column = np.full(size, np.nan) if unit is None else self._column(output, unit, size)
            columns.append(np.reshape(column, -1))
        return np.stack(columns, axis=1)

    def _column(self, output: str, unit: Array, size: int) -> Array:
        """NaN if it pushes along a free motion."""
        try:
            return self.push(unit)[output]
        except SingularEquilibrium:
            if not self.free:
                raise
            return np.full(size, np.nan)

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


def _too_straight(what: str) -> SingularEquilibrium:
    return SingularEquilibrium(
        f"linear: a rod that cannot stretch is held so straight that rounding of its length moves "
        f"{what}; let the rod stretch, or hold it less taut"
    )
