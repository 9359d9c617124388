"""How far a solution is from that of the continuous rod."""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite
from typing import Any

from pyrod._immutable import Immutable

TOLD_APART = ("edge_frames", "edge_forces", "strains", "extremes")


@dataclass(frozen=True, eq=False)
class Accuracy(Immutable):
    """What was asked for, what was reached, and how.

    The scene is solved on its edges, on these halved, and so on, and what the grids tend to is
    extrapolated (docs/theory.md, "The ladder"). Arrays belong to the vertices and edges of the
    coarsest grid. Errors are those of the discretisation, not of the model.
    """

    tol: float
    errors: dict[str, float]
    """Estimates of the largest errors: of ``positions`` relative to the longest rod, ``frames`` and
    ``edge_frames`` in radians, ``strains`` (Gamma) as they are, of all others relative to the
    largest value of their kind. ``tol`` is for all but those of the edges, and of the ``extremes``
    (``largest_K``, ``largest_force``, ``largest_moment``), which are told apart.
    """
    order: float  #: with which the grids converge, as observed; 2 is what it should be
    regular: bool  #: whether it is, so that extrapolation could be trusted
    grids: int  #: on which the scene was solved
    finest_edges: int  #: of all rods together, on the last of them
    neutral: bool = False
    """Whether the errors are those of all but the place along the free motion, which is chance."""

    @property
    def reached(self) -> float:
        """The largest of the errors that ``tol`` is for."""
        return max(value for name, value in self.errors.items() if name not in TOLD_APART)

    def __str__(self) -> str:
        reached = f"{self.reached:.1e}" if isfinite(self.reached) else "unknown"
        but = " but for the free motion" if self.neutral else ""
        return f"error {reached} on {self.grids} grids{but}"


def accuracy_of(
    tol: float | None, reached: tuple[Any, ...] | None, network: bool, neutral: bool
) -> Accuracy | None:
    """What the compiled ladder says of errors; of a cantilever it has no reactions."""
    if tol is None or reached is None:
        return None
    errors = dict(reached[0])
    errors["reactions"] = max(errors["reactions"], errors.pop("reaction_moments"))
    if not network:
        errors["reactions"] = max(errors["forces"], errors["moments"])
    order, regular, grids, finest = reached[1:]
    return Accuracy(tol, errors, order, regular, grids, finest, neutral)
