"""The solid that the cross-sections of rods sweep, as a mesh."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from pyrod.base.immutable import Array
from pyrod.result.equilibrium import Equilibrium
from pyrod.result.fields import KINDS, field
from pyrod.result.rods import RodEquilibrium
from pyrod.rod.outline import Outline
from pyrod.rod.outlines import outlines
from pyrod.rod.polygons import triangles
from pyrod.rotation import to_matrix

Indices = NDArray[np.int64]
Run = list[tuple[int, Outline]]
"""Neighbouring vertices and the outlines there, between which nothing jumps."""


class Swept(NamedTuple):
    """Closed surfaces; their faces go round counter-clockwise seen from outside."""

    points: Array  #: (p, 3) [m]
    quads: Indices  #: (f, 4) points of the faces along the rods
    caps: Indices  #: (t, 3) points of the triangles across them
    rod: Indices  #: (p,) number of the rod to which a point belongs
    vertex: Indices  #: (p,) number of the vertex of that rod
    edge: Indices  #: (f + t,) number of the edge of that rod to which a face belongs

    @property
    def triangles(self) -> Indices:
        """(2 f + t, 3) points of the faces, quads cut in two."""
        q = self.quads
        return np.vstack([q[:, [0, 1, 2]], q[:, [0, 2, 3]], self.caps])

    def at_points(self, of_rods: Sequence[Array]) -> Array:
        """(p, ...) of what each rod has at its vertices, (n + 1, ...)."""
        return _picked(of_rods, self.rod, self.vertex)

    def on_faces(self, of_rods: Sequence[Array]) -> Array:
        """(f + t, ...) of what each rod has on its edges, (n, ...): on quads, then on caps."""
        corner = np.concatenate([self.quads[:, 0], self.caps[:, 0]])
        return _picked(of_rods, self.rod[corner], self.edge)

    def quantities(self, result: Equilibrium) -> tuple[dict[str, Any], dict[str, Any]]:
        """All quantities (`KINDS`): those of vertices at the points, those of edges on the
        faces; and "rod", the number of the rod, at the points."""
        at_points: dict[str, Any] = {"rod": self.rod}
        on_faces: dict[str, Any] = {}
        for name, kind in KINDS.items():
            values = [field(rod, name).values for rod in result.rods]
            if kind.place == "vertex":
                at_points[name] = self.at_points(values)
            else:
                on_faces[name] = self.on_faces(values)
        return at_points, on_faces


def _picked(of_rods: Sequence[Array], rod: Indices, row: Indices) -> Array:
    first = np.cumsum([0, *map(len, of_rods[:-1])])
    return np.concatenate(of_rods)[first[rod] + row]


def swept(result: Equilibrium, sides: int = 24) -> Swept:
    """Sweeps the outlines of all rods between their frames at the vertices.

    Where outlines jump one closed surface ends and the next begins. A rod whose ends meet is joined
    to a ring without caps, where the corners of its outlines meet, too: in nearly the same frame,
    or turned onto themselves.

    Parameters
    ----------
    result : `Equilibrium`
        The equilibrium.
    sides : int
        Into how many chords circles are cut, at least 3; default 24.

    Raises
    ------
    ValueError
        Less than 3 sides.
    """
    if not sides >= 3:
        raise ValueError(f"sides: must be at least 3, got {sides}")
    parts = [
        _sweep(one, number, run, sides)
        for number, one in enumerate(result.rods)
        for run in _runs(outlines(one.rod))
    ]
    points, quads, caps, rod, vertex, edge = zip(*parts, strict=True)
    of_quads = [e[: len(q)] for e, q in zip(edge, quads, strict=True)]
    of_caps = [e[len(q) :] for e, q in zip(edge, quads, strict=True)]
    first = np.cumsum([0, *map(len, points[:-1])])
    return Swept(
        np.vstack(points),
        np.vstack([part + at for part, at in zip(quads, first, strict=True)]),
        np.vstack([part + at for part, at in zip(caps, first, strict=True)]),
        np.concatenate(rod),
        np.concatenate(vertex),
        np.concatenate(of_quads + of_caps),
    )


def _runs(ends: tuple[tuple[Outline, Outline], ...]) -> Iterator[Run]:
    run: Run = [(0, ends[0][0])]
    for edge, (start, end) in enumerate(ends):
        if not _continues(run[-1][1], start):
            yield run
            run = [(edge, start)]
        run.append((edge + 1, end))
    yield run


def _continues(a: Outline, b: Outline) -> bool:
    """Whether two outlines are one but for what a function of arc length changes at a point."""
    if a == b:
        return True
    one, other = a.loops(), b.loops()
    return list(map(len, one)) == list(map(len, other)) and np.allclose(
        np.vstack(one), np.vstack(other), rtol=0, atol=1e-6 * a.size
    )


def _sweep(rod: RodEquilibrium, number: int, run: Run, sides: int) -> Swept:
    """One closed surface; a row of points per vertex, for the loops one after the other."""
    loops = [outline.loops(sides) for _, outline in run]
    blocks = _blocks(loops[0])
    vertices = np.array([vertex for vertex, _ in run])
    points = _swept_to(rod, vertices, np.array([np.vstack(of) for of in loops]))
    index = np.arange(points[..., 0].size).reshape(points.shape[:2])
    turns = [_meeting(points[0, block], points[-1, block]) for block in blocks]
    met = [turn for turn in turns if turn is not None]
    caps = np.zeros((0, 3), dtype=np.int64)
    if len(met) < len(blocks):
        caps = np.vstack([index[0, triangles(loops[0])[:, ::-1]], index[-1, triangles(loops[-1])]])
    else:
        for block, turn in zip(blocks, met, strict=True):
            index[-1, block] = np.roll(index[0, block], turn)
        points = points[:-1]
    return Swept(
        points.reshape(-1, 3),
        np.vstack([_quads(index[:, block]) for block in blocks]),
        caps,
        np.full(points[..., 0].size, number),
        np.repeat(vertices[: len(points)], points.shape[1]),
        _edges(vertices, blocks, len(caps)),
    )


def _edges(vertices: Indices, blocks: list[slice], caps: int) -> Indices:
    """The edges of the faces: of the sides, of the caps at the start, of those at the end."""
    sides = [np.repeat(vertices[:-1], block.stop - block.start) for block in blocks]
    ends = [np.full(caps // 2, edge) for edge in (vertices[0], vertices[-1] - 1)]
    return np.concatenate(sides + ends)


def _blocks(loops: tuple[Array, ...]) -> list[slice]:
    """Where each loop is in a row of points."""
    ends = np.cumsum([0, *map(len, loops)]).tolist()
    return [slice(a, b) for a, b in pairwise(ends)]


def _swept_to(rod: RodEquilibrium, vertices: Indices, flat: Array) -> Array:
    """(v, p, 3) points in space of (v, p, 2) points in the plane of a1 and a2."""
    across = to_matrix(rod.vertex_frames[vertices])[:, :, :2]
    return rod.positions[vertices, None] + np.einsum("vij,vpj->vpi", across, flat)


def _quads(index: Indices) -> Indices:
    """Quads between neighbouring rows of points that go round."""
    following = np.roll(index, -1, axis=1)
    quads = np.stack([index[:-1], following[:-1], following[1:], index[1:]], axis=-1)
    return quads.reshape(-1, 4)


def _meeting(first: Array, last: Array) -> int | None:
    """By how many corners the first loop is to be turned to lie on the last; None: it does not.

    Half a side is let pass: circles meet whatever the angle between their frames.
    """
    distances = [np.linalg.norm(np.roll(first, k, axis=0) - last, axis=1) for k in range(len(last))]
    largest = np.max(distances, axis=1)
    turn = int(np.argmin(largest))
    side = np.linalg.norm(first - np.roll(first, 1, axis=0), axis=1).min()
    return turn if largest[turn] < 0.51 * side else None
