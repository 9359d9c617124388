"""How far loads are let grow, if nobody says so, and how fast: from the scene's own stiffness."""

from __future__ import annotations

from copy import copy
from dataclasses import replace
from math import inf, pi

import numpy as np

from pyrod.base.immutable import Array
from pyrod.result.equilibrium import Equilibrium
from pyrod.scene.scene import Scene
from pyrod.stability.state import State

MANY = 100
"""Times the load under which a hinged column would buckle."""


class Reach:
    """The factors of the loads that are tried: up to ``upper``, or as far as they mean something.

    The scales are columns hinged at both ends, and single edges: a scene may be far stiffer than
    its rods as hinged columns, say with many supports; but no compressed rod is stable where its
    edges buckle to and fro, under 4 EI/h^2.
    """

    def __init__(self, scene: Scene, growing: frozenset[int], upper: float | None) -> None:
        size = _size_of(scene, growing)
        softest = [rod.bending[:, :2].min(axis=1) for rod in scene.rods]
        soft = min(EI.min() for EI in softest)
        stiff = max(EI.max() for EI in softest)
        lengths = [rod.length for rod in scene.rods]
        shortest = min(rod.edge_lengths.min() for rod in scene.rods)
        self._upper = upper
        self.moment = size * max(lengths)
        """Of the loads with the longest arm there is."""
        hinged = float(pi**2 * soft / max(lengths) ** 2 / size)
        self.first = min(hinged, inf if upper is None else upper)
        """That of a hinged column as soft and as long as there is, from which steps are told."""
        self._enough = float(MANY * pi**2 * stiff / min(lengths) ** 2 / size)
        """Loads that have made the scene stiffer up to here go on to do so."""
        self._most = max(self._enough, float(4 * stiff / shortest**2 / size))

    def up_to(self, upper: float) -> Reach:
        """The same with another end."""
        other = copy(self)
        other._upper = upper
        return other

    def cut(self, factor: float, step: float) -> float:
        """The next factor, not beyond one at which the end may be."""
        ends = [self._enough, self._most] if self._upper is None else [self._upper]
        return min([factor + step, *(end for end in ends if end > factor)])

    def ends(self, state: State, unloaded: State) -> bool:
        """Whether no larger loads are tried than those of a stable state."""
        if self._upper is not None:
            return state.factor >= self._upper
        stiffer = state.factor >= self._enough and state.eigenvalue > unloaded.eigenvalue
        return stiffer or state.factor >= self._most

    def is_senseless(self, state: State) -> bool:
        """Whether edges are turned inside out, or their shape means nothing."""
        return self._upper is None and _is_absurd(state.result)

    def may_end(self, factor: float) -> bool:
        """Whether so many loads were tried that it is enough if more cannot be followed."""
        return self._upper is None and factor >= self._enough


def _is_absurd(result: Equilibrium) -> bool:
    for rod in result.rods:
        turns = rod.rod.cell_lengths * np.linalg.norm(rod.K, axis=1)
        if (rod.Gamma[:, 2] <= 0).any() or (turns > pi).any():
            return True
    return False


def _size_of(scene: Scene, growing: frozenset[int]) -> float:
    """The sum of the loads that grow, as forces."""
    length = max(rod.length for rod in scene.rods)
    pairs = enumerate(scene.loads)
    loads = tuple(load for number, load in pairs if number in growing or not load.grows)
    compiled = replace(scene, loads=loads)._compiled
    size = sum(_sum_of(compiled.dead_loads(i), length) for i in range(len(scene.rods)))
    if size == 0:
        raise ValueError("loads: all that are to grow are zero")
    return size


def _sum_of(dead: tuple[Array, ...], length: float) -> float:
    """Of forces on the vertices, and of moments on the edges and both ends."""
    forces, *moments = (np.linalg.norm(values, axis=-1).sum() for values in dead)
    return float(forces + sum(moments) / length)
