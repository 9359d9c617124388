"""Whether a scene lies in one plane, and if not, what leaves it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from pyrod.base.calls import spelled
from pyrod.scene.scene import Scene, checked_scene


@dataclass(frozen=True)
class Planarity:
    """The plane in which a scene lies; it is true if there is one.

    Planar scenes are solved in the plane of a1 and a3; where a scene lies in that of a2 and a3,
    exchange the names of the directors to have it solved there.
    """

    plane: Literal["a1-a3", "a2-a3"] | None
    """Directors of the first clamp (else of the first rod at rest) that span it."""
    why: str
    """What leaves the plane of a1 and a3; empty if nothing does."""

    def __bool__(self) -> bool:
        return self.plane is not None


@spelled
def is_planar(scene: Scene) -> Planarity:
    """Whether rods, supports, joints and loads lie in one plane and look the same in its mirror.

    The planar solution of such a scene is an equilibrium in space, too. Solving with
    ``space="planar"`` asks for a little less: of a support that could move aslant to the plane it
    takes what is left in the plane.
    """
    compiled = checked_scene(scene)._compiled
    why = compiled.leaving_plane(across=1)
    if not why:
        return Planarity("a1-a3", "")
    return Planarity(None if compiled.leaving_plane(across=0) else "a2-a3", why)
