"""What equilibria answer where they are asked: at a place, for the largest."""

from __future__ import annotations

from dataclasses import dataclass

from pyrod.base.immutable import Array, Immutable
from pyrod.rotation import log


@dataclass(frozen=True, eq=False, repr=False)
class RodAt(Immutable):
    """A rod in equilibrium at one arc length or at several, between its vertices, too.

    Arrays have a row for each arc length that was asked for; of one number, they are that row. What
    they mean is told by `RodEquilibrium`.
    """

    s: Array  #: () or (k,) arc length at rest [m]
    positions: Array  #: (k, 3) [m]
    frames: Array  #: (k, 4)
    K: Array  #: (k, 3) material curvature [1/m]
    Gamma: Array  #: (k, 3) shear and stretch
    force: Array  #: (k, 3) section force, in space [N]
    material_force: Array  #: (k, 3) the same in the components of the frames [N]
    moment: Array  #: (k, 3) section moment, in space [N m]
    material_moment: Array  #: (k, 3) C_bt (K - K0) [N m]
    backbone_force: Array  #: (k, 3) section force without the tensions of tendons, in space [N]
    interpolation: dict[str, float]
    """What comes to the errors of the solve between vertices, the largest at these places, of
    ``positions`` [m], ``frames`` [rad], ``K``, ``force``, ``moment``: twice what two vertices
    fewer change. It falls with more edges, whatever the tolerance."""

    @property
    def rotation_vectors(self) -> Array:
        """(k, 3) frames as rotation vectors [rad]."""
        return log(self.frames)

    def __repr__(self) -> str:
        where = f"s={self.s:.6g}" if self.s.ndim == 0 else f"{len(self.s)} places"
        return f"RodAt({where})"


@dataclass(frozen=True, eq=False, repr=False)
class Largest(Immutable):
    """The largest value of a quantity along a rod."""

    quantity: str  #: its name
    value: float  #: in its unit
    unit: str  #: SI, empty of what has none
    s: float  #: arc length at rest where it is [m]
    rod: int  #: number of the rod in its scene
    error: float | None
    """Estimate of the error of the value; None without a tolerance, whose grid is as it is."""

    def __float__(self) -> float:
        return self.value

    def __repr__(self) -> str:
        told = "" if self.error is None else f" ± {self.error:.1e}"
        unit = f" {self.unit}" if self.unit else ""
        where = f"s={self.s:.6g} m, rod {self.rod}"
        return f"Largest({self.quantity}, {self.value:.8g}{told}{unit} at {where})"
