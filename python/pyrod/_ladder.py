"""A scene on ever finer grids, ready for the compiled solver."""

from __future__ import annotations

import weakref
from functools import cached_property
from typing import TYPE_CHECKING, Any

from pyrod import _core
from pyrod._places import with_vertices
from pyrod.loads import any_function, load_places, stepwise_load

if TYPE_CHECKING:
    from pyrod.scene import Scene

KEPT = 2**14
"""Levels with so many edges, or fewer, are kept for the next climb."""


class Ladder:
    """Levels of a scene: on level k each edge of level 0 is cut in 2^k.

    Level 0 is the scene itself, but for vertices where point loads act.
    """

    def __init__(self, scene: Scene) -> None:
        self.scene = _with_loaded_vertices(scene)
        self._levels: dict[int, Any] = {}
        self._compiled: dict[str, _core.Ladder] = {}

    @cached_property
    def hidden_jump(self) -> str | None:
        """A jump inside an edge that all grids may have missed, in words."""
        from pyrod._jumps import hidden_jump

        return hidden_jump(self.scene)

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
        owner = weakref.ref(self)  # what is compiled must not keep alive what keeps it alive
        if key == "network":
            plain = plain and _places_are_given(scene)
            make = None if plain else lambda level: owner()._network(level)  # type: ignore[union-attr]
            net, loads = scene._network.compiled, list(scene._loads)
            return _core.Ladder.of_network(net, *scene.plane, loads, make, space)
        make = None if plain else lambda level: owner()._cantilever(level)  # type: ignore[union-attr]
        rod = scene.rods[0]
        model = _core.Model.__members__[rod.model]
        held = scene.clamp_position, scene.clamp_frame
        return _core.Ladder.of_cantilever(rod._rod, scene._loads[0], make, space, model, *held)

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
            made = _refined(self.scene, level)
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


def _refined(scene: Scene, level: int) -> Scene:
    loads = [stepwise_load(load, scene.rods) for load in scene.loads]
    rods = [rod._refined(level) for rod in scene.rods]
    return type(scene)(rods, scene.supports, loads, scene.space, scene.joints)


def _with_loaded_vertices(scene: Scene) -> Scene:
    """Point loads on vertices: brought to the grid as by levers, errors would not be regular."""
    rods = with_vertices(scene.rods, load_places(scene.loads))
    if all(new is old for new, old in zip(rods, scene.rods, strict=True)):
        return scene
    loads = [stepwise_load(load, scene.rods) for load in scene.loads]
    return type(scene)(rods, scene.supports, loads, scene.space, scene.joints)
