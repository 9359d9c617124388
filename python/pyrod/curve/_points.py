"""What points can tell: the positions given, what their rounding hides, what repeats."""

from __future__ import annotations

import warnings

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pyrod.base.arrays import Array, array, transposed
from pyrod.base.calls import users_level
from pyrod.base.immutable import vector
from pyrod.curve._arc import Arc
from pyrod.curve._warning import CurveWarning

NEAR = 1e-3
"""An edge so short beside both neighbours joins what may be one point, told twice."""
JOG = 0.1
"""[rad] Turn to and fro at its ends, beside that of its neighbours, that makes it suspect."""


def positions_of(positions: ArrayLike, name: str = "positions") -> tuple[Array, bool]:
    """(n, 3), and whether they had two columns, as points of the plane z = 0 have."""
    r = array(positions, name)
    flat = r.ndim == 2 and r.shape[1] == 2
    if flat:
        r = np.column_stack([r, np.zeros(len(r))])
    if r.ndim != 2 or r.shape[1] != 3:
        hint = transposed(r, 2, 3)
        raise ValueError(f"{name}: expected shape (n, 3) or (n, 2), got {r.shape}{hint}")
    return r, flat


def refuse_gaps(r: Array) -> None:
    """Points that are no numbers, as files have them where one is missing."""
    there = np.isfinite(r).all(axis=1)
    if not there.all():
        j = int(np.argmin(there))
        raise ValueError(
            f"positions[{j}]: expected finite numbers, got {r[j]}; split_at_gaps(positions) gives "
            "the pieces between the points that are missing"
        )


def direction(values: ArrayLike | None, name: str, flat: bool) -> Array | None:
    """(3,), or (2,) of a curve in the plane z = 0."""
    if values is None:
        return None
    made = array(values, name)
    return vector(np.append(made, 0.0) if flat and made.shape == (2,) else made, name)


def straight_angles(arc: Arc) -> Array:
    """Most turn [rad] at each vertex that counts as none, `Polyline.straight` at the least."""
    near = _inverse_lengths(arc)
    size = np.abs(arc.positions).max(axis=1)
    angles = np.maximum(arc.straight, 8 * arc.precision * (1 + size * near))
    if arc.resolution is not None:
        angles = np.maximum(angles, 2 * arc.resolution * near)
    return angles


def _inverse_lengths(arc: Arc) -> Array:
    """1/l of the edge before plus that of the edge behind each vertex."""
    inverse = 1 / arc.edge_lengths
    if arc.closed:
        return inverse + np.roll(inverse, 1)
    return np.append(inverse, 0.0) + np.append(0.0, inverse)


def refuse_folds(arc: Arc) -> None:
    """Edges that fold back within the resolution; within that of doubles the core refuses them."""
    folded = np.pi - arc.turning_angles <= straight_angles(arc) - arc.straight
    if folded.any():
        raise ValueError(
            f"positions[{int(np.argmax(folded))}]: the edges before and behind are antiparallel "
            "within the resolution of the positions, so that the plane of their turn is lost; put "
            "a vertex aside of the fold or leave one out"
        )


def warn_of_near_repeats(arc: Arc) -> None:
    """Points that a file tells twice with other last digits: curvature and torsion there are those
    of the digits."""
    h = arc.edge_lengths
    if len(h) < 3:
        return
    beside = np.minimum(np.roll(h, 1), np.roll(h, -1))
    if not arc.closed:
        beside[[0, -1]] = h[[1, -2]]
    for j in np.flatnonzero(h < NEAR * beside):
        if _jogs(arc, int(j)):
            end = (int(j) + 1) % len(arc.positions)
            warnings.warn(
                f"positions[{end}] nearly repeats positions[{j}]: their distance {h[j]:.3g} is "
                f"{h[j] / beside[j]:.1g} of that to the next, so curvature and torsion there are "
                f"those of rounding; if it is one point, take without_repeats(positions, closed, "
                f"distance={_round_up(h[j]):g})",
                CurveWarning,
                stacklevel=users_level(),
            )
            return


def _jogs(arc: Arc, edge: int) -> bool:
    """Whether the turns at the ends of an edge are more than the curve needs without it."""
    n, t = arc.edges, arc.tangents
    ends = [edge, (edge + 1) % len(arc.positions)]
    turns = float(arc.turning_angles[ends].sum())
    if arc.closed or 0 < edge < n - 1:
        cosine = t[edge - 1] @ t[(edge + 1) % n]
        turns -= float(np.arccos(np.clip(cosine, -1, 1)))
    return turns > JOG


def _round_up(x: float) -> float:
    """One digit, larger."""
    power = 10.0 ** np.floor(np.log10(x))
    return float((np.floor(x / power) + 1) * power)


def inflections(arc: Arc) -> NDArray[np.intp]:
    """Edges on which the binormal turns by pi within rounding: to which side is not told."""
    alpha, theta = arc.dihedral_angles, arc.turning_angles
    rounding = straight_angles(arc) - arc.straight
    bent = theta > np.maximum(rounding, arc.straight)
    if not bent.any():
        return np.array([], dtype=np.intp)
    error = np.divide(rounding, theta, out=np.zeros_like(theta), where=bent)
    last = np.maximum.accumulate(np.where(bent, np.arange(len(bent)), -1))
    error = error[np.where(last < 0, last[-1], last)]  # straight vertices have it from before
    behind = np.roll(error, -1)[: len(alpha)]
    return np.flatnonzero(np.pi - np.abs(alpha) <= error[: len(alpha)] + behind)
