"""How points move in a mode, to first order."""

from __future__ import annotations

from typing import Any, NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from pyrod.base.immutable import Array
from pyrod.result.equilibrium import Equilibrium
from pyrod.result.fields import between_edges
from pyrod.rotation import exp, multiply, rotate

Kind = TypeVar("Kind")

LARGEST = 0.1  # displacement in pictures over the extent of the rods


class Motion(NamedTuple):
    """A small motion of an equilibrium, to be drawn; complex numbers tell phases, too."""

    result: Equilibrium
    moves: tuple[NDArray[Any], ...]  #: (n + 1, 3) displacements of the vertices of each rod
    turns: tuple[NDArray[Any], ...]  #: (n, 3) rotation vectors of the edges in their components
    title: str

    def shapes(self, phase: float) -> list[Array]:
        """(n + 1, 3) positions of each rod at a part of the period, moved so far that it is seen.

        Half a period later they are on the other side.
        """
        factor = self._factor(phase)
        pairs = zip(self.result.rods, self.moves, strict=True)
        return [rod.positions + (factor * u).real for rod, u in pairs]

    def frames(self, phase: float) -> list[Array]:
        """(n + 1, 4) frames of the vertices there."""
        factor, out = self._factor(phase), []
        for rod, turns in zip(self.result.rods, self.turns, strict=True):
            in_space = between_edges(rotate(rod.frames, (factor * turns).real))
            out.append(multiply(exp(in_space), rod.vertex_frames))
        return out

    def _factor(self, phase: float) -> complex:
        shapes = np.vstack([rod.positions for rod in self.result.rods])
        return np.exp(2j * np.pi * phase) * _scale(shapes, np.vstack(self.moves))


def displaced(motion: Motion, phase: float) -> Equilibrium:
    """What pictures take for an equilibrium, moved; all but positions and frames is as it was."""
    result = motion.result
    places = zip(result.rods, motion.shapes(phase), motion.frames(phase), strict=True)
    rods = tuple(_with(rod, positions=r, vertex_frames=q) for rod, r, q in places)
    return _with(result, scene=result.scene, rods=rods)


def _with(thing: Kind, **values: Any) -> Kind:
    made = object.__new__(type(thing))
    made.__dict__.update({**thing.__dict__, **values})
    return made


def shown_mode(result: Equilibrium, sign: int = 1) -> list[Array]:
    """(n + 1, 3) positions of each rod, displaced along the mode so far that it is seen."""
    shapes = [rod.positions for rod in result.rods]
    moves = mode_displacements(result)
    scale = sign * _scale(np.vstack(shapes), np.vstack(moves))
    return [r + scale * u for r, u in zip(shapes, moves, strict=True)]


def _scale(positions: Array, moves: NDArray[Any]) -> float:
    extent = np.ptp(positions, axis=0).max()
    largest = np.linalg.norm(moves, axis=1).max()
    return float(LARGEST * extent / largest) if largest > 1e-9 * extent else 0.0


def mode_displacements(result: Equilibrium) -> list[Array]:
    """(n + 1, 3) displacements of the vertices of each rod in the lowest mode [m/rad].

    The edges turn as ``mode`` says, with the strains they have. Where a rod as a whole moves to
    follows from its supports and joints; what these leave open does not move.

    Raises
    ------
    ValueError
        The mode is not known.
    """
    if result.mode is None:
        raise ValueError("stability: there is no mode; solve with eigenvalue=True")
    ends = np.cumsum([rod.rod.edges for rod in result.rods])[:-1]
    relative = []
    for rod, turns in zip(result.rods, np.split(result.mode, ends), strict=True):
        steps = rod.rod.edge_lengths[:, None] * rotate(rod.frames, np.cross(turns, rod.Gamma))
        relative.append(np.vstack([np.zeros((1, 3)), np.cumsum(steps, axis=0)]))
    return [u + start for u, start in zip(relative, _starts(result, relative), strict=True)]


def _starts(result: Equilibrium, relative: list[Array]) -> Array:
    """(rods, 3) displacements of the starts: the least that supports and joints allow."""
    compiled, count = result.scene._compiled, len(result.rods)
    rows: list[Array] = [np.zeros((0, 3 * count))]
    right: list[Array] = [np.zeros(0)]
    for number, support in enumerate(result.scene.supports):
        rod, vertex = compiled.vertex(support.at)
        frame = result.rods[rod].vertex_frames[vertex]
        held = _held(compiled.free_directions(number, frame))
        rows.append(np.kron(np.eye(count)[rod], held))
        right.append(-held @ relative[rod][vertex])
    for joint in result.scene.joints:
        (first, at), *others = [compiled.vertex(point) for point in joint.points]
        for rod, vertex in others:
            rows.append(np.kron(np.eye(count)[rod] - np.eye(count)[first], np.eye(3)))
            right.append(relative[first][at] - relative[rod][vertex])
    found = np.linalg.lstsq(np.vstack(rows), np.concatenate(right), rcond=None)[0]
    return found.reshape(count, 3)


def _held(free: Array) -> Array:
    """(3, 3) projector on the directions in which a point may not move."""
    return np.eye(3) - np.linalg.pinv(free) @ free if len(free) else np.eye(3)
