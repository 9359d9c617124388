"""A scene on ever finer grids, ready for the compiled solver."""

from __future__ import annotations

import weakref
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from pyrod import _core
from pyrod._breaks import Breaks, breaks_of, functions_of
from pyrod._immutable import Array
from pyrod._places import with_vertices
from pyrod.loads import any_function, load_places, load_steps, stepwise_load

if TYPE_CHECKING:
    from pyrod.rod import Rod
    from pyrod.scene import Scene

KEPT = 2**14
"""Levels with so many edges, or fewer, are kept for the next climb."""


class Ladder:
    """Levels of a scene: on level k each edge of level 0 is cut in 2^k.

    Level 0 is the scene itself, but for vertices where point loads act, or functions break.
    """

    def __init__(self, scene: Scene) -> None:
        self._given = scene
        self.scene, self.unresolved = _with_breaks(scene)
        self.scene.__dict__["_ladder"] = self  # also that of the scene that results have
        self._levels: dict[int, Any] = {}
        self._compiled: dict[str, _core.Ladder] = {}

    def brought(self, frames: Array) -> Array:
        """Frames of the edges that were given, on those of level 0."""
        given = self._given.rods
        if self.scene is self._given or len(frames) != sum(rod.edges for rod in given):
            return frames
        first, rows = 0, []
        for old, new in zip(given, self.scene.rods, strict=True):
            centres = (new.arc_lengths[1:] + new.arc_lengths[:-1]) / 2
            rows.append(first + np.searchsorted(old.arc_lengths[1:-1], centres))
            first += old.edges
        return frames[np.concatenate(rows)]

    @property
    def why_irregular(self) -> str:
        """What may be the reason if the grids do not converge as they should, in words."""
        if self.unresolved is not None:
            return (
                f"{self.unresolved} has more jumps and kinks than can be told apart, or is singular"
            )
        if self.asks:
            return (
                "a load, a section or the curvature may jump where that was not found; give it a "
                "vertex (Rod.with_vertices)"
            )
        return "something in the scene is smaller than the edges"

    @property
    def asks(self) -> bool:
        """Whether finer grids ask functions of arc length."""
        rods = enumerate(self.scene.rods)
        return any(any(functions_of(rod, self.scene.loads, i)) for i, rod in rods)

    def compiled(self, network: bool) -> _core.Ladder:
        """``network``: by the path for any scene."""
        key = "network" if network else "cantilever"
        if key not in self._compiled:
            self._compiled[key] = self._compile(key)
        return self._compiled[key]

    def _compile(self, key: str) -> _core.Ladder:
        scene = self.scene
        space = _core.Dimension.__members__[scene.space]
        asked = any(rod._law.asks for rod in scene.rods)  # type: ignore[union-attr]
        plain = not asked and not any_function(scene.loads)
        corners = any(rod._law.corners and rod.K0.any() for rod in scene.rods)  # type: ignore[union-attr]
        owner = weakref.ref(self)  # what is compiled must not keep alive what keeps it alive
        if key == "network":
            plain = plain and _places_are_given(scene)
            make = None if plain else lambda level: owner()._network(level)  # type: ignore[union-attr]
            net, loads = scene._network.compiled, list(scene._loads)
            return _core.Ladder.of_network(net, *scene.plane, loads, make, space, corners)
        make = None if plain else lambda level: owner()._cantilever(level)  # type: ignore[union-attr]
        rod = scene.rods[0]
        model = _core.Model.__members__[rod.model]
        held = scene.clamp_position, scene.clamp_frame
        return _core.Ladder.of_cantilever(
            rod._rod, scene._loads[0], make, space, model, *held, corners
        )

    def _cantilever(self, level: int) -> tuple[Any, ...]:
        scene = self._at(level)
        return scene.rods[0]._rod, scene._loads[0]

    def _network(self, level: int) -> tuple[Any, ...]:
        scene = self._at(level)
        return scene._network.compiled, *scene.plane

    def _at(self, level: int) -> Scene:
        if level == 0:
            return self.scene
        if level not in self._levels:
            made = self.scene._refined(level)
            if sum(rod.edges for rod in made.rods) > KEPT:
                return made
            self._levels[level] = made
        return self._levels[level]


def _places_are_given(scene: Scene) -> bool:
    """Whether no place follows from a curved shape at rest, which differs from grid to grid."""
    if not any(rod.K0.any() for rod in scene.rods):
        return True
    ends = [s.at in ("start", (0, "start")) or s.position is not None for s in scene.supports]
    return all(ends) and not scene.joints and len(scene.rods) == 1


def _with_breaks(scene: Scene) -> tuple[Scene, str | None]:
    """The scene with vertices at point loads, and where functions of arc length jump or have kinks.

    Loads brought to the grid as by levers, or what jumps inside an edge, would leave errors that
    are not regular. Also tells, in words, what has more kinks than can be told apart.
    """
    rods, unresolved = list(with_vertices(scene.rods, load_places(scene.loads))), None
    for number, at in load_steps(scene.loads, scene.rods):
        if rods[number]._breaks is not None:  # else they are vertices
            rods[number] = _broken(rods[number], at)
    for number, rod in enumerate(rods):
        for name, owner, function in functions_of(rod, scene.loads, number):
            breaks = _kept_breaks(owner, name, function, rod.length)
            rods[number] = _broken(rods[number], breaks.at)
            unresolved = unresolved or (name if breaks.unresolved else None)
    if all(new is old for new, old in zip(rods, scene.rods, strict=True)):
        return scene, unresolved
    loads = [stepwise_load(load, scene.rods) for load in scene.loads]
    return type(scene)(rods, scene.supports, loads, scene.space, scene.joints), unresolved


def _broken(rod: Rod, at: Sequence[float] | Array) -> Rod:
    """The rod with vertices at the breaks; they are vertices that are there, if so near."""
    if len(at) == 0:
        return rod
    there = rod.arc_lengths if rod._breaks is None else np.array([0.0, *rod._breaks, rod.length])
    nearest = there[np.abs(np.subtract.outer(at, there)).argmin(axis=1)]
    return rod.with_vertices(np.where(np.abs(nearest - at) < 1e-8 * rod.length, nearest, at))


def _kept_breaks(owner: Any, name: str, function: Callable[[float], Any], length: float) -> Breaks:
    """What is found of a function, kept by the law or the load that it belongs to."""
    found: dict[tuple[str, float], Breaks] = owner.__dict__.setdefault("_breaks", {})
    key = (name, length)
    if key not in found:
        found[key] = breaks_of(function, length)
    return found[key]
