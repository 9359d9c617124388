"""A scene as nodes and attachments for the compiled solver."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from pyrod import _core
from pyrod._immutable import Array
from pyrod._places import Place, on_rod
from pyrod._rest import Rest, carrier
from pyrod.joints import Joint
from pyrod.rotation import conjugate, multiply, rotate
from pyrod.supports import FREE, Clamp, Support

if TYPE_CHECKING:
    from pyrod.scene import Scene

Point = tuple[int, int]
"""Number of a rod, and of a vertex of it."""


@dataclass
class _Node:
    """What meets in one point."""

    points: list[Point]
    rigid: bool = False
    hinge: Array | None = None
    support: Support | None = None
    held: Point | None = None
    turns: dict[Point, int] = field(default_factory=dict)
    aligned: bool = False


class Network:
    """The compiled network of a scene, and which node each support has."""

    def __init__(self, scene: Scene) -> None:
        self._scene = scene
        self._rest = [Rest(rod) for rod in scene.rods]
        self._default = [
            Rest(rod, carrier(i, scene.supports, scene.rods)) for i, rod in enumerate(scene.rods)
        ]
        nodes = self._nodes()
        self.compiled = _core.Network()
        clamped = {on_rod(s.at, scene.rods)[0] for s in scene.supports if s.holds_frame}
        for number, (rod, loads) in enumerate(zip(scene.rods, scene._loads, strict=True)):
            position, frame = rod.placement
            if number in clamped:
                position, frame = self._nearest(position, frame)
            self.compiled.add_rod(
                rod._rod, _core.Model.__members__[rod.model], loads, position, frame
            )
        self.node_of: dict[Point, int] = {}
        self.points: list[Point] = []
        for node in nodes:
            self._add(node)

    def _vertex(self, at: Place) -> Point:
        return self._scene._vertex(at)

    def _nodes(self) -> list[_Node]:
        nodes: list[_Node] = []
        owner: dict[Point, _Node] = {}

        def owned(point: Point) -> _Node:
            if point not in owner:
                owner[point] = _Node([point])
                nodes.append(owner[point])
            return owner[point]

        for joint in self._scene.joints:
            points = [self._vertex(p) for p in joint.points]
            if len(set(points)) < len(points):
                raise ValueError(f"joints: the points {joint.points} are not different vertices")
            node = owned(points[0])
            for point in points[1:]:
                if point in owner and owner[point] is not node:
                    raise ValueError(f"joints: vertex {point[1]} of rod {point[0]} is joined twice")
                owner[point] = node
                node.points.append(point)
            node.rigid = joint.kind != "ball"
            node.hinge = joint.axis
            node.turns[points[-1]] = joint.turns
            node.aligned = self._aligned(joint, points)
        for support in self._scene.supports:
            point = self._vertex(support.at)
            node = owned(point)
            if node.support is not None:
                raise ValueError(f"supports: vertex {point[1]} of rod {point[0]} is held twice")
            node.support, node.held = support, point
            if isinstance(support, Clamp):
                node.turns[point] = support.turns
        return nodes

    def _aligned(self, joint: Joint, points: list[Point]) -> bool:
        if joint.aligned is not None:
            return joint.aligned
        places = np.array([self._rest[i].position(j) for i, j in points])
        size = max(rod.length for rod in self._scene.rods)
        return bool(np.linalg.norm(places - places[0], axis=1).max() > 1e-9 * size)

    def _add(self, node: _Node) -> None:
        first = node.held or node.points[0]
        position, frame = self._default[first[0]].place(first[1])
        own = self._rest[first[0]].frame(first[1])  # where the axis of a hinge is told
        free, turns, springs, holds = FREE, FREE, (0.0, 0.0), False
        if (support := node.support) is not None:
            position = position if support.position is None else support.position
            frame = frame if support.frame is None else support.frame
            own = own if support.frame is None else support.frame
            free, turns, springs = support._free(frame), support._turns(frame), support._springs
            holds = support.holds_frame
        at, to = self._nearest(position, frame)
        index = self.compiled.add_node(
            at if support is None else position,
            free,
            to if turns is FREE and not holds else frame,
            turns,
            *springs,
        )
        self.points.append(first)
        for point in node.points:
            self.node_of[point] = index
            rigid = node.rigid or (holds and point == node.held)
            hinge = None
            if node.hinge is not None and point != first:
                hinge = rotate(conjugate(own), node.hinge)
            relative = self._relative(first, point, node)
            self.compiled.attach(*point, index, rigid, relative, node.turns.get(point, 0), hinge)

    def _nearest(self, position: Array, frame: Array) -> tuple[Array, Array]:
        """The place in the plane of a planar scene, for what is but a start of the search."""
        if self._scene.space != "planar":
            return position, frame
        origin, plane = self._scene.plane
        local = rotate(conjugate(plane), position - origin)
        turn = multiply(conjugate(plane), frame)
        size = np.hypot(turn[0], turn[2])
        kept = (
            np.array([turn[0], 0, turn[2], 0]) / size if size > 1e-9 else np.array([1.0, 0, 0, 0])
        )
        return origin + rotate(plane, local * [1.0, 0.0, 1.0]), multiply(plane, kept)

    def _relative(self, first: Point, point: Point, node: _Node) -> Array:
        """The frame of the rod at the node, seen from the node's."""
        if point == first or node.aligned:
            return np.array([1.0, 0.0, 0.0, 0.0])
        a, b = self._rest[first[0]].frame(first[1]), self._rest[point[0]].frame(point[1])
        return multiply(conjugate(a), b)

    def places(self) -> list[tuple[int, float]]:
        """What the nodes are: the rod whose cross-section gives the node its frame, and where."""
        rods = self._scene.rods
        return [(i, round(rods[i].arc_lengths[j] / rods[i].length, 9)) for i, j in self.points]

    def support_nodes(self) -> list[int]:
        """The node of each support of the scene."""
        return [self.node_of[self._vertex(support.at)] for support in self._scene.supports]
