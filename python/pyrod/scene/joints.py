"""What joins rods to each other, and the ends of one rod to a ring."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from numpy.typing import ArrayLike

import pyrod._core as _core
from pyrod.base.arrays import yes_or_no
from pyrod.base.immutable import Array
from pyrod.base.words import shortly
from pyrod.rod.place import Place, checked
from pyrod.scene.part import Part
from pyrod.scene.supports import unit, whole_turns


@dataclass(frozen=True, eq=False)
class Joint(Part):
    """Joins points of rods, or the two ends of one rod to a ring.

    Parameters
    ----------
    points : sequence of places
        Two places or more, each as for `Clamp`.
    kind : "rigid", "hinge" or "ball"
        "rigid" (default): the cross-sections keep the angles to each other that they have at rest;
        "hinge": all others may turn about one axis against the first; "ball": they share the point
        only.
    turns : int
        Full turns about a3 that the rod of the last point makes from its support before, besides
        what the frames tell: the twist that is put into a ring.
    aligned : bool
        For a ring: the frames of the ends become one, whatever they are at rest. Default: where the
        points of a rigid joint are not in one place at rest.
    axis : (3,) array
        Of a hinge, in space where the rods are at rest; it goes with the first rod.
    """

    points: tuple[Place, ...]
    kind: Literal["rigid", "hinge", "ball"] = "rigid"
    turns: int = 0
    aligned: bool | None = None
    axis: Array | None = None
    _kind = _core.Joint

    if TYPE_CHECKING:  # what is taken is more than what is kept

        def __init__(
            self,
            points: Iterable[Place],
            kind: Literal["rigid", "hinge", "ball"] = "rigid",
            turns: int = 0,
            aligned: bool | None = None,
            axis: ArrayLike | None = None,
        ) -> None: ...

    def __post_init__(self) -> None:
        given: object = self.points
        if isinstance(given, (str, int, float)):
            raise TypeError(
                'points: expected places in one tuple, as ((0, "end"), (1, "start")), got '
                f"{shortly(self.points)}"
            )
        points = tuple(checked(p) for p in self.points)
        if len(points) < 2:
            raise ValueError(f"points: a joint needs two or more, got {len(points)}")
        if self.kind not in ("rigid", "hinge", "ball"):
            raise ValueError(f"kind: expected 'rigid', 'hinge' or 'ball', got {shortly(self.kind)}")
        if (self.kind == "hinge") != (self.axis is not None):
            raise ValueError("axis: a hinge needs one, other joints have none")
        if self.aligned is not None:
            self._set(aligned=yes_or_no(self.aligned, "aligned"))
        self._set(points=points, turns=whole_turns(self.turns), axis=unit(self.axis, "axis"))
