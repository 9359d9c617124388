"""The elastic energy of a rod in a given shape."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from pyrod.base.immutable import Array, Immutable


@dataclass(frozen=True, eq=False)
class Energy(Immutable):
    """Value and derivatives of a rod's energy.

    The unknowns are numbered station by station, r_0, q_{1/2}, r_1, q_{3/2}, ..., r_n; frames move
    as R <- R exp(phi), phi in the components of the frame.
    """

    bend_twist: float  #: Linn (49) [J]
    stretch_shear: float  #: Linn (51) [J]
    gradient: Array  #: by the unknowns, 3 numbers each
    _hessian: tuple[Array, Any, Any] = field(repr=False)

    @property
    def total(self) -> float:
        """Bending, twisting, stretching and shearing together [J]."""
        return self.bend_twist + self.stretch_shear

    @property
    def hessian(self) -> Any:
        """Second derivatives, a symmetric `scipy.sparse.csc_array`. Needs SciPy."""
        from scipy.sparse import csc_array

        return csc_array(self._hessian, shape=(len(self.gradient),) * 2)
