"""Scenes: rods, what holds and joins them, and what acts on them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, Literal

from pyrod import _core
from pyrod._immutable import Array, Immutable
from pyrod._ladder import Ladder
from pyrod._network import Network
from pyrod._places import Place, on_rod, with_vertices
from pyrod._rest import Rest, carrier
from pyrod._savable import Savable
from pyrod.joints import Joint
from pyrod.loads import Load, load_places, sampled_load, stepwise_load
from pyrod.rod import Rod
from pyrod.supports import Clamp, Support

Space = Literal["planar", "spatial"]


@dataclass(frozen=True, eq=False, repr=False, init=False)
class Scene(Immutable, Savable):
    """Rods, what holds and joins them, and what acts on them.

    Parameters
    ----------
    rods : a `Rod`, or several. Supports and joints between two vertices get a vertex of their own,
        so the scene's rods may have more edges than those given. Where rods leave their edges to
        the solver, point loads get vertices, too.
    supports : `Clamp`, `Hinge`, `Slider`, `Sleeve`, `Pivot`, `Spring`; any number. Ends without one
        are free.
    loads : `Force`, `Moment`, `DistributedForce`, `DistributedMoment`, `Gravity`; any number.
    space : "spatial" (default), or "planar": the rods stay in the plane of the directors a1 and a3
        of the first clamp (else of the first rod at rest), which takes a third of the unknowns.
        What leaves the plane is refused.
    joints : `Joint`, any number.

    Raises
    ------
    ValueError : places that are not on a rod, points that are held or joined twice, loads that
        nothing holds against.
    """

    rods: tuple[Rod, ...]
    supports: tuple[Support, ...]
    loads: tuple[Load, ...]
    space: Space
    joints: tuple[Joint, ...]
    _loads: tuple[_core.Loads, ...] = field(init=False, compare=False)
    _coarsest: Scene | None = field(init=False, compare=False, default=None)
    """Of a level of a climb, the scene whose edges it has cut."""

    def __init__(
        self,
        rods: Rod | Sequence[Rod],
        supports: Support | Iterable[Support] = (),
        loads: Load | Iterable[Load] = (),
        space: Space = "spatial",
        joints: Joint | Iterable[Joint] = (),
    ) -> None:
        rods = _tuple(rods, Rod, "rods")
        supports = _tuple(supports, Support, "supports")
        loads = _tuple(loads, Load.__args__, "loads")  # type: ignore[attr-defined]
        joints = _tuple(joints, Joint, "joints")
        if not rods:
            raise ValueError("rods: expected at least one")
        if not isinstance(space, str) or space not in _core.Dimension.__members__:
            raise ValueError(
                f"space: expected 'planar' or 'spatial', got {space!r}{_belonging(space)}"
            )
        if not supports and not joints:
            raise ValueError(
                "supports: nothing holds the rod, so it has no equilibrium; give a Clamp or "
                "another support"
            )
        places = [s.at for s in supports] + [p for joint in joints for p in joint.points]
        cut = with_vertices(rods, places + _free_of(rods, load_places(loads)))
        compiled = tuple(_core.Loads(rod._rod) for rod in cut)
        for load in loads:
            load._apply(compiled, cut)
        self._set(
            rods=cut, supports=supports, loads=loads, space=space, joints=joints, _loads=compiled
        )
        if not self.is_cantilever:
            self._network  # noqa: B018  refuses what cannot be joined or held

    def _refined(self, level: int) -> Scene:
        """The same scene with every edge cut in 2^level, and no choice of edges left.

        Its places are the vertices that they are here, by number: arc lengths are off by rounding.
        """
        rods = tuple(rod._refined(level) for rod in self.rods)
        loads = tuple(stepwise_load(load, self.rods) for load in self.loads)
        pairs = zip(rods, self._loads, strict=True)
        compiled = tuple(_core.Loads(rod._rod, coarse) for rod, coarse in pairs)
        for load in loads:
            load._apply(compiled, rods)
        made = object.__new__(type(self))
        made._set(rods=rods, supports=self.supports, loads=loads, space=self.space)
        made._set(joints=self.joints, _loads=compiled, _coarsest=self)
        return made

    def _vertex(self, at: Place) -> tuple[int, int]:
        """The number of the rod, and of its vertex nearest to a place."""
        coarse = self._coarsest or self
        number, s = on_rod(at, coarse.rods)
        if s == 0.0:
            return number, 0
        vertex = int(abs(coarse.rods[number].arc_lengths - s).argmin())
        return number, vertex * (self.rods[number].edges // coarse.rods[number].edges)

    @cached_property
    def _network(self) -> Network:
        return Network(self)

    @cached_property
    def _ladder(self) -> Ladder:
        return Ladder(self)

    @property
    def _chooses_edges(self) -> bool:
        """Whether a rod leaves its edges to the solver."""
        return any(rod._breaks is not None for rod in self.rods)

    def __getstate__(self) -> dict[str, Any]:
        """Functions of arc length are pickled as the values they had on the edges."""
        state = super().__getstate__()
        state["loads"] = tuple(sampled_load(load, self.rods) for load in self.loads)
        return state

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__init__(**state)  # type: ignore[misc]

    @property
    def rod(self) -> Rod:
        """The rod of a scene that has one."""
        if len(self.rods) != 1:
            raise ValueError(f"rod: the scene has {len(self.rods)}, see its rods")
        return self.rods[0]

    @property
    def is_cantilever(self) -> bool:
        """One rod, clamped at its start, free at its end, under loads that do not follow it."""
        return (
            len(self.rods) == 1
            and not self.joints
            and len(self.supports) == 1
            and isinstance(self.supports[0], Clamp)
            and self.supports[0].turns == 0
            and on_rod(self.supports[0].at, self.rods) == (0, 0.0)
            and not any(load.follower for load in self.loads)
        )

    @property
    def clamp_position(self) -> Array:
        """(3,) where the first support holds its point."""
        return self._held(0)[0]

    @property
    def clamp_frame(self) -> Array:
        """(4,) frame in which the first support holds its cross-section."""
        return self._held(0)[1]

    @property
    def plane(self) -> tuple[Array, Array]:
        """Origin and frame of the plane of a planar scene, spanned by the frame's a1 and a3."""
        if self.supports and isinstance(self.supports[0], Clamp):
            return self._held(0)
        return self.rods[0].placement

    def _held(self, number: int) -> tuple[Array, Array]:
        support = self.supports[number]
        i, vertex = self._vertex(support.at)
        rod = self.rods[i]
        position, frame = support.position, support.frame
        if position is not None and frame is not None:
            return position, frame
        by = carrier(i, self.supports, self.rods) if len(self.supports) > 1 else None
        at_start = by is None and vertex == 0
        rest = rod.placement if at_start else Rest(rod, by).place(vertex)
        return (rest[0] if position is None else position, rest[1] if frame is None else frame)

    def __repr__(self) -> str:
        rods = repr(self.rods[0]) if len(self.rods) == 1 else f"{len(self.rods)} rods"
        if self.is_cantilever:
            held = "clamped at its start"
        else:
            names = [type(x).__name__ for x in (*self.supports, *self.joints)]
            held = _counted(names)
        loads = ", ".join(type(load).__name__ for load in self.loads) or "no loads"
        return f"Scene({rods}, {held}, {loads}, {self.space})"


def _counted(names: list[str]) -> str:
    return ", ".join(
        name if names.count(name) == 1 else f"{names.count(name)} {name}s"
        for name in dict.fromkeys(names)
    )


def _tuple(items: Any, kinds: Any, name: str) -> tuple[Any, ...]:
    one = isinstance(items, kinds) or not isinstance(items, Iterable)
    items = (items,) if one else tuple(items)
    for item in items:
        if not isinstance(item, kinds):
            raise TypeError(f"{name}: cannot use a {type(item).__name__}{_belonging(item)}")
    return items


def _belonging(item: Any) -> str:
    """Where a thing belongs that was given for another argument."""
    kinds = {"rods": Rod, "supports": Support, "loads": Load.__args__, "joints": Joint}  # type: ignore[attr-defined]
    for name, kind in kinds.items():
        if isinstance(item, kind):
            return (
                f"; a {type(item).__name__} belongs to {name}: "
                "Scene(rods, supports, loads, joints=...)"
            )
    return ""


def checked_scene(scene: Any) -> Scene:
    """A scene; says what to do with what is none."""
    if isinstance(scene, Scene):
        return scene
    hint = ""
    if isinstance(scene, Rod):
        hint = "; hold it: Scene(rod, Clamp(), loads)"
    elif isinstance(scene, (list, tuple)):
        hint = "; for several there is solve_many"
    raise TypeError(f"scene: expected a Scene, got a {type(scene).__name__}{hint}")


def _free_of(rods: tuple[Rod, ...], places: list[Any]) -> list[Any]:
    """Places on rods that leave their edges to the solver."""
    return [place for place in places if rods[on_rod(place, rods)[0]]._breaks is not None]
