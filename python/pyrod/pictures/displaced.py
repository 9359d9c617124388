"""How points move in the lowest mode, to first order."""

from __future__ import annotations

import numpy as np

from pyrod.base.immutable import Array
from pyrod.result.equilibrium import Equilibrium
from pyrod.rotation import rotate

LARGEST = 0.1  # displacement in pictures over the extent of the rods


def shown_mode(result: Equilibrium, sign: int = 1) -> list[Array]:
    """(n + 1, 3) positions of each rod, displaced along the mode so far that it is seen."""
    shapes = [rod.positions for rod in result.rods]
    moves = mode_displacements(result)
    extent = np.ptp(np.vstack(shapes), axis=0).max()
    largest = np.linalg.norm(np.vstack(moves), axis=1).max()
    scale = sign * LARGEST * extent / largest if largest > 1e-9 * extent else 0.0
    return [r + scale * u for r, u in zip(shapes, moves, strict=True)]


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
