"""What an equilibrium says between the vertices of a rod; see docs/accuracy.md."""

from __future__ import annotations

from dataclasses import fields
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from pyrod.base.arrays import finite
from pyrod.base.calls import spelled
from pyrod.base.immutable import Array, sealed
from pyrod.result.nearest import Near, Numbers, rows_near, screwed, taken
from pyrod.result.rods import RodEquilibrium
from pyrod.result.told import RodAt
from pyrod.rod.place import checked, on_rod
from pyrod.rotation import conjugate, exp, log, multiply, rotate

PLAIN, EXACT = 4, 8
"""Vertices that a value between two is taken from: on a grid as it is, and of a tolerance."""
PARTS = 4
"""In which the way from a vertex is gone."""
_GAUSS = (0.5 - np.sqrt(3) / 6, 0.5 + np.sqrt(3) / 6)


@spelled
def state_at(rod: RodEquilibrium, s: ArrayLike | str, before: bool = False) -> RodAt:
    """The rod between its vertices.

    Section forces, moments and curvatures are polynomials through those of the nearest vertices, on
    the same side of all places where something jumps; frames and positions go from vertex to vertex
    along the curvature and the strain (docs/accuracy.md). So they are of the order of the
    solution, and of a solve with a tolerance of order 8 in the distance of the vertices; what that
    leaves is told as ``interpolation``. At a vertex they are what the arrays say.

    Parameters
    ----------
    rod : `RodEquilibrium`
        The rod.
    s : "start", "end", float or (k,) array [m]
        Arc lengths at rest.
    before : bool
        Where something jumps, tell what is just before; default: just behind, as arrays do.

    Returns
    -------
    RodAt

    Raises
    ------
    ValueError
        An arc length that is not on the rod.
    """
    if isinstance(s, str):
        s = on_rod(checked(s), [rod.rod.length])[1]
    wanted = finite(s, "s")
    if wanted.ndim > 1:
        raise ValueError(f"s: expected an arc length, or (k,) of them, got shape {wanted.shape}")
    low, high, slack = rod.s[0], rod.s[-1], 1e-12 * rod.s[-1]
    off = (wanted < low - slack) | (wanted > high + slack)
    if off.any():
        raise ValueError(
            f"s: must be an arc length on the rod, in [0, {high:g}], got {wanted[off].flat[0]:g}"
        )
    fine, places = Between(rod), np.atleast_1d(np.clip(wanted, low, high))
    found = fine.at(places, before)
    missed = apart(found, fine.of_fewer().at(places, before))
    names = [f.name for f in fields(RodAt) if f.name != "interpolation"]
    told = [np.array(getattr(found, name)) for name in names]
    return RodAt(*sealed((*(told if wanted.ndim else [one[0] for one in told]), missed)))


class Between:
    """The values of a rod as functions of arc length; ``points``: that one is taken from."""

    def __init__(self, rod: RodEquilibrium, points: int | None = None) -> None:
        self.rod = rod
        self.points = points or (PLAIN if rod.accuracy is None else EXACT)
        self.breaks = breaks(rod)

    def of_fewer(self) -> Between:
        """The same from two vertices fewer, by which errors are told."""
        return Between(self.rod, max(2, self.points - 2))

    def at(self, s: Array, before: bool = False) -> Station:
        """The rod at (k,) arc lengths on it; of a vertex behind it, or before."""
        edge = np.searchsorted(self.rod.s, s, "left" if before else "right") - 1
        return Station(self, s, np.clip(edge, 0, len(self.rod.s) - 2))

    def piece(self, edge: Numbers) -> tuple[Numbers, Numbers]:
        """The vertices at which what is smooth on these edges begins and ends."""
        behind = np.searchsorted(self.breaks, edge, "right")
        return self.breaks[behind - 1], self.breaks[behind]


class Station:
    """Of a rod at (k,) arc lengths, each on an edge; what is not asked for is not computed."""

    def __init__(self, of: Between, s: Array, edge: Numbers) -> None:
        self.of, self.s, self.edge = of, s, edge
        self.rod = of.rod

    @cached_property
    def _near(self) -> list[Near]:
        """The vertices that values are taken from."""
        return rows_near(self.rod.s, self.s, self.edge, *self.of.piece(self.edge), self.of.points)

    @cached_property
    def _near_edges(self) -> list[Near]:
        centres = (self.rod.s[1:] + self.rod.s[:-1]) / 2
        first, last = self.of.piece(self.edge)
        return rows_near(centres, self.s, self.edge, first, last - 1, self.of.points - 1)

    @cached_property
    def K(self) -> Array:
        """(k, 3) curvature."""
        return taken(self._near, self.rod.K, self.rod.K_before)

    @cached_property
    def Gamma(self) -> Array:
        """(k, 3) strain."""
        values = self.rod.Gamma
        if (values == values[0]).all():
            return np.tile(values[0], (len(self.s), 1))
        return taken(self._near_edges, values, values)

    @cached_property
    def force(self) -> Array:
        """(k, 3) section force."""
        return taken(self._near, self.rod.vertex_force, self.rod.vertex_force_before)

    @cached_property
    def material_force(self) -> Array:
        """(k, 3) the same in the frames, which are known better than it would be by itself."""
        return rotate(conjugate(self.frames), self.force)

    @cached_property
    def moment(self) -> Array:
        """(k, 3) section moment."""
        return taken(self._near, self.rod.moment, self.rod.moment_before)

    @cached_property
    def material_moment(self) -> Array:
        """(k, 3) moment of the strains."""
        rod, jump = self.rod, self.rod.moment_before - self.rod.moment
        before = rod.material_moment
        if jump.any():
            before = before + rotate(conjugate(rod.vertex_frames), jump)
        return taken(self._near, rod.material_moment, before)

    @cached_property
    def backbone_force(self) -> Array:
        """(k, 3) force of the rod alone."""
        return taken(self._near, self.rod.backbone_force, self._backbone_before)

    @cached_property
    def material_backbone_force(self) -> Array:
        """(k, 3) the same in the frames."""
        return rotate(conjugate(self.frames), self.backbone_force)

    @property
    def _backbone_before(self) -> Array:
        rod = self.rod
        return rod.backbone_force + (rod.vertex_force_before - rod.vertex_force)

    @property
    def positions(self) -> Array:
        """(k, 3) positions."""
        return self._placed[0]

    @property
    def frames(self) -> Array:
        """(k, 4) frames."""
        return self._placed[1]

    @cached_property
    def _placed(self) -> tuple[Array, Array]:
        """Positions and frames: the way from the vertex before, and what it misses the next by."""
        rod, edge = self.rod, self.edge
        start, end = rod.s[edge], rod.s[edge + 1]
        edges, which = np.unique(edge, return_inverse=True)
        there_r, there_q = self._gone(edges, rod.s[edges + 1])
        turn = multiply(conjugate(there_q), rod.vertex_frames[edges + 1])
        missed_q = log(np.where(turn[:, :1] < 0, -turn, turn))
        missed_r = rod.positions[edges + 1] - there_r
        part = (self.s - start) / (end - start)
        share = (part**2 * (3 - 2 * part))[:, None]
        r, q = self._gone(edge, self.s)
        return r + share * missed_r[which], multiply(q, exp(share * missed_q[which]))

    def _gone(self, edge: Numbers, s: Array) -> tuple[Array, Array]:
        """Along curvature and strain from the start of each edge, in steps of order four."""
        rod, start = self.rod, self.rod.s[edge]
        r, q = rod.positions[edge], rod.vertex_frames[edge]
        step = ((s - start) / PARTS)[:, None]
        for part in range(PARTS):
            one, two = (Station(self.of, start + (part + x) * step[:, 0], edge) for x in _GAUSS)
            (K1, G1), (K2, G2) = (one.K, one.Gamma), (two.K, two.Gamma)
            turn = step / 2 * (K1 + K2) + np.sqrt(3) / 12 * step**2 * np.cross(K1, K2)
            along = step / 2 * (G1 + G2)
            along += np.sqrt(3) / 12 * step**2 * (np.cross(K1, G2) - np.cross(K2, G1))
            r = r + rotate(q, screwed(turn, along))
            q = multiply(q, exp(turn))
        return r, q


def apart(one: Station, other: Station) -> dict[str, float]:
    """Twice the largest difference of each kind, in its unit."""
    turn = log(multiply(conjugate(one.frames), other.frames))
    rows = {"positions": one.positions - other.positions, "frames": turn}
    for name in ("K", "force", "moment"):
        rows[name] = getattr(one, name) - getattr(other, name)
    return {n: 2 * float(np.linalg.norm(r, axis=1).max(initial=0.0)) for n, r in rows.items()}


def breaks(rod: RodEquilibrium) -> Numbers:
    """Vertices between which nothing jumps, with both ends of the rod."""
    jumps = np.zeros(len(rod.s), dtype=bool)
    for now, before in (
        (rod.K, rod.K_before),
        (rod.vertex_force, rod.vertex_force_before),
        (rod.moment, rod.moment_before),
    ):
        if now is not before:
            scale = np.abs(now).max() + np.abs(before).max()
            jumps |= (np.abs(now - before) > 1e-9 * scale).any(axis=1)
    for mark in rod.rod._compiled.marks:
        jumps |= np.abs(rod.s - mark) < 1e-9 * rod.s[-1]
    jumps[[0, -1]] = True
    return np.flatnonzero(jumps)
