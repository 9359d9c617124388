"""How far a solution is from that of the continuous rod."""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite
from typing import Any

from pyrod.base.arrays import number_as
from pyrod.base.immutable import Immutable
from pyrod.base.words import shortly

TOLD_APART = ("edge_frames", "edge_forces", "strains", "extremes")
_LIMITS = {
    "edges": " within max_edges (Options)",
    "time": " within max_time (Options)",
    "rounding": " above rounding",
    "failed": ", as the next grid did not converge",
}


@dataclass(frozen=True, eq=False)
class Accuracy(Immutable):
    """What was asked for, what was reached, and how.

    The scene is solved on its edges, on these halved, and so on, and what the grids tend to is
    extrapolated (docs/theory.md, section 12). Arrays belong to the vertices and edges of the
    coarsest grid. Errors are those of the discretisation, not of the model.
    """

    tol: float
    errors: dict[str, float]
    """Estimates of the largest errors, of ``positions`` relative to the longest rod, ``frames`` and
    ``edge_frames`` in radians, ``strains`` (Gamma) as they are, of all others relative to the
    largest value of their kind. ``tol`` is for all but those of the edges, and of the ``extremes``
    (``largest_K``, ``largest_force``, ``largest_moment``), which are told apart.
    """
    order: float  #: with which the grids converge, as observed; 2 is what it should be
    regular: bool  #: whether it is, so that extrapolation could be trusted
    grids: int  #: on which the scene was solved
    finest_edges: int  #: of all rods together, on the last of them
    ended: str = "reached"
    """What ended the climb, "reached" (``tol``); else a limit, "edges" (``Options.max_edges``),
    "time" (``Options.max_time``), "rounding": finer grids were no better; "interrupted"."""
    neutral: bool = False
    """Whether the errors are those of all but the place along the free motion, which is chance."""
    reason: str = ""
    """What may be why, if the grids do not converge as they should, in words."""

    @property
    def reached(self) -> float:
        """The largest of the errors that ``tol`` is for."""
        return max(value for name, value in self.errors.items() if name not in TOLD_APART)

    @property
    def shortfall(self) -> str:
        """Why ``tol`` was not reached, and which errors are larger, in words."""
        names = sorted(self.errors, key=lambda name: -self.errors[name])
        judged = [name for name in names if name not in TOLD_APART and self.errors[name] > self.tol]
        if not isfinite(self.reached):
            left = "the errors are unknown"
        else:
            left = ", ".join(f"{name} {self.errors[name]:.1e}" for name in judged)
            left = f"the errors left are {left}"
        limit = _LIMITS.get(self.ended, "")
        grids = f"on {self.grids} grids of up to {self.finest_edges} edges"
        return f"tol={self.tol:g} was not reached{limit}; {left}, {grids}"

    def __str__(self) -> str:
        reached = f"{self.reached:.1e}" if isfinite(self.reached) else "unknown"
        but = " but for the free motion" if self.neutral else ""
        return f"error {reached} on {self.grids} grids{but}"


class Untold(dict[str, float]):
    """Errors of a solve without a tolerance: there are none."""

    def __missing__(self, name: str) -> float:
        raise KeyError(f"{name}: errors are told where one is asked for, solve(scene, tol=...)")

    def __repr__(self) -> str:
        return "{}: no tolerance was given, solve(scene, tol=...)"


def accuracy_of(told: tuple[Any, ...], neutral: bool) -> Accuracy:
    """What the compiled ladder says of errors."""
    tol, errors, order, regular, grids, finest, ended, reason = told
    errors["reactions"] = max(errors["reactions"], errors.pop("reaction_moments"))
    return Accuracy(tol, errors, order, regular, grids, finest, ended, neutral, reason)


def checked_tolerance(tol: float | None) -> float | None:
    """The tolerance, if it is one."""
    if tol is None:
        return None
    wanted = "must be a number in (0, 0.1]"
    value = 0.0 if isinstance(tol, bool) else number_as(tol, "tol", wanted)
    if not 0 < value <= 0.1:
        raise ValueError(f"tol: {wanted}, got {shortly(tol)}")
    return value
