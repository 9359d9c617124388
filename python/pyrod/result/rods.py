"""What there is to know of one rod in equilibrium, and of one support."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import inf
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from pyrod.base.borrowed import borrowed
from pyrod.base.immutable import Array, Immutable, Lazy
from pyrod.result.accuracy import Accuracy
from pyrod.result.told import Largest, RodAt
from pyrod.rod.rod import Rod
from pyrod.rotation import conjugate, log, multiply


class Reaction(NamedTuple):
    """What a support exerts on the rods, in space."""

    force: Array  #: (3,) [N]
    moment: Array  #: (3,) [N m], about the point that is held


class TendonEquilibrium(NamedTuple):
    """A tendon in equilibrium."""

    tension: float  #: [N]
    length: float  #: along its way [m]
    force_on_base: Array
    """(3,) what it exerts where it begins, in space [N]."""
    slack: bool = False  #: of given length, and longer than its way, which ``length`` is


@dataclass(frozen=True, eq=False, repr=False)
class RodEquilibrium(Lazy, Immutable):
    """One rod of n edges in equilibrium; arrays have a row per vertex (n + 1) or per edge (n).

    Positions, forces and moments are spatial; strains and whatever is called material have the
    components of the frames. Section forces and moments act from the part behind on the part
    before.

    Where a support, a joint or a load acts on an inner vertex, or stiffness or the curvature at
    rest jumps there, curvature, section force and moment may have two values. Arrays hold those
    just behind the vertex; ``K_before``, ``vertex_force_before`` and ``moment_before`` hold those
    just before it, and everywhere else the same.
    """

    rod: Rod
    positions: Array  #: (n + 1, 3) r_j [m]
    frames: Array  #: (n, 4) of the edges; signs are continued along the rod
    vertex_frames: Array  #: (n + 1, 4) between the edges' frames; at the ends, of the ends
    K: Array  #: (n + 1, 3) material curvature, Linn (48) [1/m]; where it jumps, just behind
    K_before: Array  #: (n + 1, 3) the same; where it jumps, just before
    Gamma: Array  #: (n, 3) shear and stretch, Linn (50)
    force: Array  #: (n, 3) section force of the edges, in exact balance with the loads [N]
    vertex_force: Array
    """(n + 1, 3) section force at the vertices, inside the rod at its ends [N].

    Where a point force acts on an inner vertex, or a support, just behind it.
    """
    vertex_force_before: Array  #: (n + 1, 3) the same; where it jumps, just before
    material_force: Array  #: (n, 3) the same in the components of the frames
    moment: Array  #: (n + 1, 3) section moment, in balance with the loads [N m]; where it jumps,
    #: just behind
    moment_before: Array  #: (n + 1, 3) the same; where it jumps, just before
    material_moment: Array  #: (n + 1, 3) C_bt (K - K0)
    backbone_force: Array
    """(n + 1, 3) section force without the tensions of tendons, what the rod itself carries [N].

    Its moment is ``material_moment``, where ``moment`` is that of all that a section transmits.
    """
    load: Array  #: (n + 1, 3) what acts on the vertices [N]
    load_moment: Array  #: (3,) sum of the moments that act on the rod [N m]
    bend_twist_energy: float  #: Linn (49) [J]
    stretch_shear_energy: float  #: Linn (51) [J]
    largest_K: float
    """Largest ``|K|`` along the rod [1/m], between vertices too.

    Of a solve with a tolerance that of the continuous rod, with the error that ``errors`` tells of
    ``extremes``; else of a smooth curve through the values at the vertices. So are the next two.
    """
    largest_force: float  #: largest section force [N]
    largest_moment: float  #: largest section moment [N m]
    accuracy: Accuracy | None = field(default=None, compare=False)
    """What is known of the errors of the equilibrium, if a tolerance was given."""

    @property
    def s(self) -> Array:
        """(n + 1,) arc length at rest of the vertices [m]."""
        return self.rod.arc_lengths

    @property
    def energy(self) -> float:
        """Elastic energy [J]."""
        return self.bend_twist_energy + self.stretch_shear_energy

    @property
    def tip(self) -> Array:
        """(3,) position of the end."""
        return self.positions[-1]

    @property
    def tip_frame(self) -> Array:
        """(4,) frame of the end."""
        return self.vertex_frames[-1]

    @property
    def rotation_vectors(self) -> Array:
        """(n + 1, 3) frames of the vertices as rotation vectors [rad]."""
        return log(self.vertex_frames)

    @property
    def bending_radius(self) -> float:
        """Smallest radius to which the rod is bent [m], between vertices, too; inf if straight."""
        bent = self.largest("bending").value
        return 1 / bent if bent > 0 else inf

    @borrowed("pyrod.result.between:state_at")
    def at(self, s: ArrayLike | str, before: bool = False) -> RodAt:  # type: ignore[empty-body]
        """The rod at arc lengths, between its vertices, too."""

    @borrowed("pyrod.result.peaks:largest_of_rod")
    def largest(self, quantity: str) -> Largest:  # type: ignore[empty-body]
        """The largest value of a quantity along the rod, and where it is."""

    @borrowed("pyrod.result.peaks:sag_of_rod")
    def sag(self, direction: ArrayLike | None = None) -> Largest:  # type: ignore[empty-body]
        """How far the rod hangs off the chord between its ends."""

    @borrowed("pyrod.notebook.views:rod_equilibrium_html")
    def _repr_html_(self) -> str:  # type: ignore[empty-body]
        """What notebooks show."""

    def __repr__(self) -> str:
        tip = ", ".join(f"{x:.6g}" for x in self.tip)
        return f"RodEquilibrium({self.rod!r}, energy={self.energy:.6g}, tip=({tip}))"


class OfTheOnlyRod:
    """What an equilibrium has directly if its scene has one rod, told to editors.

    It is that of the `RodEquilibrium`, which says what it is.
    """

    positions: Array
    frames: Array
    vertex_frames: Array
    K: Array
    K_before: Array
    Gamma: Array
    force: Array
    vertex_force: Array
    vertex_force_before: Array
    material_force: Array
    moment: Array
    moment_before: Array
    material_moment: Array
    backbone_force: Array
    load: Array
    load_moment: Array
    rod: Rod
    s: Array
    tip: Array
    tip_frame: Array
    rotation_vectors: Array


def longest(vectors: Array) -> float:
    """The largest Euclidean norm of the rows."""
    return float(np.linalg.norm(vectors, axis=1).max())


def largest_turn(a: RodEquilibrium, b: RodEquilibrium) -> float:
    """The largest angle between the frames of two shapes at the same vertex [rad]."""
    turn = multiply(conjugate(a.vertex_frames), b.vertex_frames)
    return float(2 * np.arctan2(np.linalg.norm(turn[:, 1:], axis=1), np.abs(turn[:, 0])).max())
