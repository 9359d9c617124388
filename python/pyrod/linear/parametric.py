"""Scenes as functions of parameters: outputs of their equilibria, and products with derivatives.

It knows no package for derivatives; `pyrod.jax` and `pyrod.torch` put it before theirs.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Iterable, Sequence
from functools import cached_property
from threading import Lock
from typing import Any

import numpy as np

from pyrod.base.immutable import Array
from pyrod.linear.grid import Grid
from pyrod.linear.numbers import slope
from pyrod.linear.told import resolved
from pyrod.result.equilibrium import Equilibrium
from pyrod.scene.scene import Scene
from pyrod.solving.many import solve_many

_KEPT = 64
"""Equilibria that wait for what is asked of their derivatives."""
_MOST = 250_000
"""Numbers that each keeps for it."""
_STEP = 3e-3
"""Of parameters, relative: it is numbers of scenes that are differenced, not equilibria."""
_VALUES = ("positions", "K", "moment", "Gamma", "force", "energy")

Shapes = Sequence[tuple[int, ...]]


class _Here:
    """An equilibrium, and what each parameter changes of the numbers of its scene."""

    def __init__(self, of: Parametric, p: Array, result: Equilibrium) -> None:
        self.result = result
        self._of, self._p = of, p
        self._known: dict[int, Array] = {}

    @cached_property
    def grid(self) -> Grid:
        return Grid(self.result)

    @cached_property
    def numbers(self) -> Array:
        return self.grid.numbers(self.grid.scene)

    def unit(self, i: int) -> Array:
        """Of one parameter. A step is short enough if it may as well be shorter."""
        if i in self._known:
            return self._known[i]
        found = self._found(i, self._of.step(self._p, i))
        if self.numbers.size * len(self._p) <= _MOST:
            self._known[i] = found
        return found

    def _found(self, i: int, step: float) -> Array:
        refused, before = None, None
        for shorter in (1.0, 0.5, 0.01, 0.005, 1e-4, 5e-5):
            try:
                now = slope(self._line(i), shorter * step, self.numbers, f"parameter {i}")
            except ValueError as error:
                refused, before = error, None
                continue
            if before is not None and np.abs(now - before).max() <= 1e-8 * np.abs(now).max():
                return now
            before = now
        raise refused or ValueError(f"parameter {i}: the scene is not smooth in it")

    def _line(self, i: int) -> Callable[[float], Array]:
        unit = np.zeros(len(self._p))
        unit[i] = 1.0
        return lambda t: self.grid.numbers(self._of.scene(self._p + t * unit))


class Parametric:
    """Flat outputs of the equilibrium of ``scene_of(parameters)``, as functions of them, flat.

    Parameters
    ----------
    scene_of : function
        Of arrays of these shapes, in their order; a scene.
    shapes : list
        Of the arrays.
    outputs : names
        As those of `Linearised`, but no frames: these are turned, not added to.
    """

    def __init__(
        self, scene_of: Callable[[list[Array]], Scene], shapes: Shapes, outputs: Iterable[str]
    ) -> None:
        self.outputs = list(outputs)
        self._scene_of, self._shapes = scene_of, list(shapes)
        self._cuts = np.cumsum([int(np.prod(shape)) for shape in self._shapes])
        self._kept: OrderedDict[bytes, _Here] = OrderedDict()
        self._lock = Lock()
        self._output_shapes: list[tuple[int, ...]] | None = None

    def scene(self, p: Array) -> Scene:
        """Of flat parameters."""
        parts = np.split(np.asarray(p, dtype=float), self._cuts[:-1])
        return self._scene_of([a.reshape(s) for a, s in zip(parts, self._shapes, strict=True)])

    @property
    def size(self) -> int:
        """Of the parameters."""
        return int(self._cuts[-1]) if len(self._cuts) else 0

    def output_shapes(self) -> list[tuple[int, ...]]:
        """In the order of the outputs. What is not known yet is that of all parameters one."""
        if self._output_shapes is None:
            try:
                scene = self.scene(np.ones(self.size))
            except (ValueError, ArithmeticError) as error:
                raise ValueError(
                    "solver: the shapes of the outputs are not known before a first scene, and "
                    "that of parameters that are all 1 is refused; call it once without jit, "
                    f"({error})"
                ) from error
            self._output_shapes = [_told_shape(scene, name) for name in self.outputs]
        return self._output_shapes

    @property
    def output_size(self) -> int:
        return sum(int(np.prod(shape)) for shape in self.output_shapes())

    def solve(self, p: Array) -> Array:
        """Outputs of (..., size) parameters, (..., output_size); many are solved at once."""
        rows = np.asarray(p, dtype=float).reshape(-1, self.size)
        out = np.array([self._flat(here.result) for here in self._found(rows)])
        return out.reshape(*np.shape(p)[:-1], -1) if len(rows) else self._none(p)

    def push(self, p: Array, v: Array) -> Array:
        """Derivatives of the outputs along v, a row of each for a row of the other."""
        return self._each(p, v, self._push_one, self.output_size)

    def pull(self, p: Array, w: Array) -> Array:
        """Gradients of the sums of outputs with weights w."""
        return self._each(p, w, self._pull_one, self.size)

    def step(self, p: Array, i: int) -> float:
        """How far a parameter goes for its effect on the scene to be seen."""
        array = np.split(p, self._cuts[:-1])[int(np.searchsorted(self._cuts, i, side="right"))]
        return _STEP * (float(np.abs(array).max()) or 1.0)

    # One scene ------------------------------------------------------------------------------------

    def _push_one(self, here: _Here, v: Array) -> Array:
        change = np.zeros_like(here.numbers)
        for i in np.flatnonzero(v):
            change += v[i] * here.unit(int(i))
        told = here.grid.push(change)
        return np.concatenate([np.reshape(told[name], -1) for name in self.outputs])

    def _pull_one(self, here: _Here, w: Array) -> Array:
        shapes = self.output_shapes()
        parts = np.split(w, np.cumsum([int(np.prod(shape)) for shape in shapes])[:-1])
        weights = [part.reshape(shape) for part, shape in zip(parts, shapes, strict=True)]
        told: dict[str, Any] = dict(zip(self.outputs, weights, strict=True))
        gradient = here.grid.gradient(told)
        return np.array([gradient @ here.unit(i) for i in range(self.size)])

    # Many -----------------------------------------------------------------------------------------

    def _each(self, p: Array, v: Array, one: Callable[..., Array], size: int) -> Array:
        rows = np.asarray(p, dtype=float).reshape(-1, self.size)
        others = np.asarray(v, dtype=float).reshape(len(rows), -1)
        out = [one(here, other) for here, other in zip(self._found(rows), others, strict=True)]
        return np.array(out).reshape(*np.shape(p)[:-1], size)

    def _none(self, p: Array) -> Array:
        return np.zeros((*np.shape(p)[:-1], self.output_size))

    def _found(self, rows: Array) -> list[_Here]:
        keys = [row.tobytes() for row in rows]
        with self._lock:
            found = {key: self._kept[key] for key in keys if key in self._kept}
            missing = {key: row for key, row in zip(keys, rows, strict=True) if key not in found}
            results = solve_many([self.scene(row) for row in missing.values()]) if missing else []
            for (key, row), result in zip(missing.items(), results, strict=True):
                found[key] = self._kept[key] = _Here(self, row.copy(), result)
            while len(self._kept) > _KEPT:
                self._kept.popitem(last=False)
        return [found[key] for key in keys]

    def _flat(self, result: Equilibrium) -> Array:
        values = [_told_value(result, name) for name in self.outputs]
        self._output_shapes = [np.shape(value) for value in values]
        return np.concatenate([np.reshape(value, -1) for value in values])


def _told_value(result: Equilibrium, name: str) -> Any:
    path, row = resolved(result.scene, name)
    if path == "energy":
        return result.bend_twist_energy + result.stretch_shear_energy
    kind, number, what = path.split(".")
    if kind == "reactions":
        return getattr(result.reactions[int(number)], what)
    value = getattr(result.rods[int(number)], what)
    return value if row is None else value[row]


def _told_shape(scene: Scene, name: str) -> tuple[int, ...]:
    path, row = resolved(scene, name)
    if path == "energy":
        return ()
    kind, number, what = path.split(".")
    if kind == "reactions" or row is not None:
        return (3,)
    edges = scene.rods[int(number)].edges
    return (edges if what in ("Gamma", "force") else edges + 1, 3)


def checked_outputs(outputs: str | Iterable[str]) -> list[str]:
    """Refuses frames."""
    names = [outputs] if isinstance(outputs, str) else list(outputs)
    for name in names:
        last = name.rsplit(".", 1)[-1]
        if not name.startswith("reactions.") and last not in (*_VALUES, "tip"):
            raise ValueError(
                f"outputs: {name} has no values that can be added to; there are positions, tip, "
                "K, moment, Gamma, force, energy and reactions"
            )
    if not names:
        raise ValueError("outputs: expected names, got none")
    return names
