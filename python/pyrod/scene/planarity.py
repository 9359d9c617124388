"""Whether a scene lies in one plane, and if not, what leaves it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from pyrod.base.immutable import Array
from pyrod.rod.place import on_rod
from pyrod.rotation import conjugate, multiply, rotate
from pyrod.scene.loads import DistributedForce, DistributedMoment, Force, Gravity, Moment, on_edges
from pyrod.scene.scene import Scene, checked_scene
from pyrod.scene.supports import Clamp


@dataclass(frozen=True)
class Planarity:
    """The plane in which a scene lies; it is true if there is one.

    Planar scenes are solved in the plane of a1 and a3; where a scene lies in that of a2 and a3,
    exchange the names of the directors to have it solved there.
    """

    plane: Literal["a1-a3", "a2-a3"] | None
    """Directors of the first clamp (else of the first rod at rest) that span it."""
    why: str
    """What leaves the plane of a1 and a3; empty if nothing does."""

    def __bool__(self) -> bool:
        return self.plane is not None


def is_planar(scene: Scene) -> Planarity:
    """Whether rods, supports, joints and loads lie in one plane and look the same in its mirror.

    The planar solution of such a scene is an equilibrium in space, too. Solving with
    ``space="planar"`` asks for a little less: of a support that could move aslant to the plane it
    takes what is left in the plane.
    """
    why = next(_leaving(checked_scene(scene), 1), "")
    if not why:
        return Planarity("a1-a3", "")
    return Planarity(None if any(_leaving(scene, 0)) else "a2-a3", why)


class _Plane:
    """Through the origin of the scene's plane, across the director a1 (0) or a2 (1)."""

    def __init__(self, scene: Scene, across: int) -> None:
        self.across = across
        self.origin, self.frame = scene.plane
        self.normal = rotate(self.frame, np.eye(3)[across])
        self.name = f"a{across + 1}"
        self.within = [i for i in range(3) if i != across]
        self.length = max(rod.length for rod in scene.rods)

    def distance(self, position: Array) -> float:
        """Of a point, 0 if it is rounding."""
        height = float(self.normal @ (position - self.origin))
        return height if abs(height) > 1e-9 * self.length else 0.0

    def keeps(self, turn: Array) -> bool:
        """Whether a rotation, seen from a frame in the plane, is about the normal."""
        return float(np.abs(turn[1:][self.within]).sum()) < 1e-9

    def holds(self, frame: Array) -> bool:
        return self.keeps(multiply(conjugate(self.frame), frame))

    def mirrors(self, directions: Array, normal: Array) -> bool:
        """Whether these directions span the same in the mirror: n is one of them, or across."""
        seen = directions.T @ (directions @ normal)
        return float(np.linalg.norm(seen - normal * (normal @ seen))) < 1e-9


def _leaving(scene: Scene, across: int) -> Iterator[str]:
    """What leaves the plane, in words, the first first."""
    plane = _Plane(scene, across)
    yield from _rods(scene, plane)
    yield from _supports(scene, plane)
    yield from _joints(scene, plane)
    yield from _loads(scene, plane)


def _rods(scene: Scene, plane: _Plane) -> Iterator[str]:
    lengths = [rod.length for rod in scene.rods]
    clamped = {on_rod(s.at, lengths)[0] for s in scene.supports if s.holds_frame}
    for number, rod in enumerate(scene.rods):
        for i in plane.within:
            if rod.K0[:, i].any():
                how = "is twisted" if i == 2 else f"bends about a{i + 1}"
                yield f"rod {number} {how} at rest, K0 = {_largest(rod.K0[:, i]):.3g}"
        if number in clamped:
            continue  # and carried there
        position, frame = rod.placement
        if not plane.holds(frame):
            yield f"the frame of rod {number} at rest is not one turned about {plane.name}"
        if off := plane.distance(position):
            yield f"rod {number} is {off:.3g} off the plane at rest"


def _supports(scene: Scene, plane: _Plane) -> Iterator[str]:
    for number, support in enumerate(scene.supports):
        what = f"support {number} ({type(support).__name__})"
        position, frame = scene._held(number)
        if off := plane.distance(position):
            yield f"{what} is {off:.3g} off the plane"
        if support.holds_frame and not plane.holds(frame):
            yield f"the frame of {what} is not one turned about {plane.name}"
        if not plane.mirrors(support._free(frame), plane.normal):
            yield f"{what} may move aslant to the plane"
        if support.holds_frame and not plane.mirrors(
            support._turns(frame), np.eye(3)[plane.across]
        ):
            yield f"{what} turns about an axis aslant to the plane"
        if isinstance(support, Clamp) and support.turns:
            yield f"{what} twists the rod, turns = {support.turns}"


def _joints(scene: Scene, plane: _Plane) -> Iterator[str]:
    for number, joint in enumerate(scene.joints):
        for rod, rigid, relative, turns, axis in scene._core.attachments(number):
            if rigid and joint.kind != "ball" and not plane.keeps(relative):
                yield f"joint {number} holds rod {rod} turned out of the plane"
            if turns:
                yield f"joint {number} twists rod {rod}, turns = {turns}"
            if axis is not None and 1e-9 <= abs(axis[plane.across]) <= 1 - 1e-9:
                yield f"joint {number} has an axis aslant to the plane"


# Loads ------------------------------------------------------------------------------------------


def _loads(scene: Scene, plane: _Plane) -> Iterator[str]:
    for number, load in enumerate(scene.loads):
        is_moment = isinstance(load, (Moment, DistributedMoment))
        forbidden = plane.within if is_moment else [plane.across]
        for rod, values in _acting(load, scene):
            parts = values if load.follower else rotate(conjugate(plane.frame), values)
            least = 0.0 if load.follower else 1e-12 * _scale(scene._core.dead_loads(rod), is_moment)
            for i in forbidden:
                if np.abs(parts[:, i]).max() > least:
                    of = f"load {number} ({type(load).__name__})"
                    per_length = _per_length(load, parts[:, i], scene.rods[rod])
                    yield f"{of} has a component {per_length:.3g} along a{i + 1}"


def _acting(load: Any, scene: Scene) -> Iterator[tuple[int, Array]]:
    """Rods a load acts on, with its forces or moments (m, 3) there."""
    if isinstance(load, Gravity):
        for number, rod in enumerate(scene.rods):
            yield number, (rod.mass_per_length * rod.edge_lengths)[:, None] * load.acceleration
    elif isinstance(load, (Force, Moment)):
        value = load.force if isinstance(load, Force) else load.moment
        yield on_rod(load.at, [rod.length for rod in scene.rods])[0], value[None]
    else:
        is_force = isinstance(load, DistributedForce)
        name = "force_per_length" if is_force else "moment_per_length"
        rod = scene.rods[load.rod]
        yield load.rod, rod.edge_lengths[:, None] * on_edges(getattr(load, name), rod, name)


def _scale(dead: tuple[Array, ...], is_moment: bool) -> float:
    """The largest dead force on a vertex, or moment on an edge: what rounding is compared with."""
    sizes = [np.linalg.norm(values, axis=-1).max() for values in dead]
    return float(max(sizes[1:]) if is_moment else sizes[0])


def _per_length(load: Any, values: Array, rod: Any) -> float:
    """The largest component, as the load was given."""
    if isinstance(load, (DistributedForce, DistributedMoment, Gravity)):
        values = values / rod.edge_lengths
    if isinstance(load, Gravity):
        values = values / np.where(rod.mass_per_length > 0, rod.mass_per_length, np.inf)
    return _largest(values)


def _largest(values: Array) -> float:
    return float(values[np.abs(values).argmax()])
