"""Jumps of functions of arc length that no grid may see: between neighbouring samples."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from pyrod._arrays import array
from pyrod._law import Made
from pyrod._places import with_vertices
from pyrod.loads import DistributedForce, DistributedMoment, stepwise_load

if TYPE_CHECKING:
    from pyrod.rod import Rod
    from pyrod.scene import Scene

SAMPLES = 257
PART = 0.05
"""Of the range of the function: what changes so much from sample to sample is looked at closer."""


def hidden_jump(scene: Scene) -> str | None:
    """The first jump inside an edge that is found, in words."""
    for name, rod, function in _functions(scene):
        for s in _jumps(function, rod.length):
            if np.abs(rod.arc_lengths - s).min() > 1e-9 * rod.length:
                return f"{name} jumps at {s:.6g}, inside an edge"
    return None


def with_jumping_vertices(scene: Scene) -> Scene:
    """The scene with vertices at the jumps that are found, which then are no harm."""
    numbers = {id(rod): number for number, rod in enumerate(scene.rods)}
    places = [
        (numbers[id(rod)], s)
        for _, rod, function in _functions(scene)
        for s in _jumps(function, rod.length)
    ]
    if not places:
        return scene
    loads = [stepwise_load(load, scene.rods) for load in scene.loads]
    rods = with_vertices(scene.rods, places)
    return type(scene)(rods, scene.supports, loads, scene.space, scene.joints)


def _functions(scene: Scene) -> Iterator[tuple[str, Rod, Callable[[float], Any]]]:
    for number, load in enumerate(scene.loads):
        if isinstance(load, DistributedForce) and callable(load.force_per_length):
            yield f"load {number}", scene.rods[load.rod], load.force_per_length
        if isinstance(load, DistributedMoment) and callable(load.moment_per_length):
            yield f"load {number}", scene.rods[load.rod], load.moment_per_length
    for number, rod in enumerate(scene.rods):
        law = rod._law
        if isinstance(law, Made) and callable(section := law.section):
            yield f"the section of rod {number}", rod, _bending(section)
        if isinstance(law, Made) and callable(law.curvature):
            yield f"the curvature of rod {number}", rod, law.curvature


def _bending(section: Callable[[float], Any]) -> Callable[[float], Any]:
    return lambda s: section(s).bending


def _jumps(function: Callable[[float], Any], length: float) -> Iterator[float]:
    """Where the function jumps, found by halving the intervals in which it changes most."""

    def value(s: float) -> Any:
        return array(function(float(s)), "a function of arc length")

    s = np.linspace(0, length, SAMPLES)
    values = np.array([value(x) for x in s])
    spread = np.ptp(values, axis=0).max()
    change = np.abs(np.diff(values, axis=0)).max(axis=1)
    for i in np.flatnonzero(change > PART * spread)[:16]:
        low, high = s[i], s[i + 1]
        for _ in range(40):
            middle = (low + high) / 2
            at = value(middle)
            if np.abs(at - value(low)).max() > np.abs(value(high) - at).max():
                high = middle
            else:
                low = middle
        if np.abs(value(high) - value(low)).max() > PART * spread / 2:
            yield (low + high) / 2
