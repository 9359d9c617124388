"""Scenes: rods, what holds and joins them, and what acts on them."""

from __future__ import annotations

import operator
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Literal

import pyrod._core as _core
from pyrod.base.borrowed import borrowed
from pyrod.base.immutable import Array, Immutable, Once
from pyrod.base.words import shortly
from pyrod.rod.rod import Rod, rod_of
from pyrod.rod.section import Section
from pyrod.scene.actuators import Actuator, Tendon, sampled_tendon
from pyrod.scene.joints import Joint
from pyrod.scene.loads import Load, LoadAlong, on_cut_edges, sampled_load, stepwise_load
from pyrod.scene.supports import Clamp, Support

Space = Literal["planar", "spatial"]


@dataclass(frozen=True, eq=False, repr=False, init=False)
class Scene(Immutable):
    """Rods, what holds and joins them, and what acts on them.

    Parameters
    ----------
    rods : `Rod`, or several
        A `Rod`, or several. Supports and joints between two vertices get a vertex of their own, so
        the scene's rods may have more edges than those given. Where rods leave their edges to the
        solver, point loads get vertices, too.
    supports : supports
        `Clamp`, `Hinge`, `Slider`, `Sleeve`, `Pivot`, `Spring`; one or any number. Ends without one
        are free.
    loads : loads
        `Force`, `Moment`, `DistributedForce`, `DistributedMoment`, `Gravity`, `PointMass`; one or
        any number.
    space : "spatial" or "planar"
        In the plane (not default) the rods stay in that of the directors a1 and a3 of the first
        clamp (else of the first rod at rest), which takes a third of the unknowns. What leaves the
        plane is refused.
    joints : `Joint`, or several
        Any number.
    actuators : `Tendon`, or several
        Any number.

    Raises
    ------
    ValueError
        Places that are not on a rod, points that are held or joined twice, loads that nothing holds
        against.
    """

    rods: tuple[Rod, ...]
    supports: tuple[Support, ...]
    loads: tuple[Load, ...]
    space: Space
    joints: tuple[Joint, ...]
    actuators: tuple[Tendon, ...]

    def __init__(
        self,
        rods: Rod | Sequence[Rod],
        supports: Support | Iterable[Support] = (),
        loads: Load | Iterable[Load] = (),
        space: Space = "spatial",
        joints: Joint | Iterable[Joint] = (),
        actuators: Tendon | Iterable[Tendon] = (),
    ) -> None:
        rods, supports = _tuple(rods, Rod, "rods"), _tuple(supports, Support, "supports")
        loads, joints = _tuple(loads, Load, "loads"), _tuple(joints, Joint, "joints")
        actuators = _tuple(actuators, Actuator, "actuators")
        if not isinstance(space, str) or space not in ("planar", "spatial"):
            raise ValueError(
                f"space: expected 'planar' or 'spatial', got {shortly(space)}{_belonging(space)}"
            )
        for load in loads:
            if isinstance(load, LoadAlong):
                load.refuse_shape(rods)
        for actuator in actuators:
            actuator.refuse_shape(rods)
        self._set(rods=rods, supports=supports, loads=loads, space=space, joints=joints)
        self._set(actuators=actuators)
        cut = _on_grid(rods, self._compiled.rods([rod._compiled for rod in rods]))
        if cut is not rods:
            self._set(rods=cut, loads=tuple(on_cut_edges(load, rods, cut) for load in loads))
            self._set(actuators=tuple(one.on(rods, cut) for one in actuators))
            self._set(given=(rods, loads, actuators))

    def as_given(self) -> tuple[tuple[Rod, ...], tuple[Load, ...], tuple[Tendon, ...]]:
        """Rods, loads and actuators without vertices of places, if they are known still."""
        return self.__dict__.get("given", (self.rods, self.loads, self.actuators))

    @Once
    def _compiled(self) -> _core.Scene:
        """The compiled scene; it says what cannot be solved."""
        return compiled_of(self)

    def refined(self, level: int) -> Scene:
        """The same scene with every edge cut in 2^level, and no choice of edges left."""
        rods = tuple(rod.refined(level) for rod in self.rods)
        if all(map(operator.is_, rods, self.rods)):
            return self
        actuators = tuple(one.on(self.rods, rods) for one in self.actuators)
        loads = self._loads_on_any_grid() if level else self.loads
        return replace(self, rods=rods, loads=loads, actuators=actuators)

    @Once
    def _climbing(self) -> Scene:
        """The scene as a solve with a tolerance has it; compiled only if it is solved itself.

        It has more vertices where loads act, and where functions jump or have kinks.
        """
        given = [rod._compiled for rod in self.rods]
        rods = _on_grid(self.rods, self._compiled.climbing_rods(given))
        if rods is self.rods:
            return self
        made, loads = object.__new__(Scene), self._loads_on_any_grid()
        parts = {"rods": rods, "supports": self.supports, "loads": loads, "joints": self.joints}
        actuators = tuple(one.on(self.rods, rods) for one in self.actuators)
        made.__dict__.update(parts, actuators=actuators, space=self.space, _climbing=made)
        return made

    def _loads_on_any_grid(self) -> tuple[Load, ...]:
        return tuple(stepwise_load(load, self.rods) for load in self.loads)

    def __getstate__(self) -> dict[str, Any]:
        """Functions of arc length are pickled as the values they had on the edges."""
        state = super().__getstate__()
        state["loads"] = tuple(sampled_load(load, self.rods) for load in self.loads)
        state["actuators"] = tuple(sampled_tendon(one, self.rods) for one in self.actuators)
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
        if len(self.rods) != 1 or self.joints or len(self.supports) != 1:
            return False
        (support,) = self.supports
        clamped = isinstance(support, Clamp) and support.turns == 0
        at_start = clamped and self._compiled.vertex(support.at) == (0, 0)
        return at_start and not any(load.follower for load in self.loads)

    @property
    def clamp_position(self) -> Array:
        """(3,) where the first support holds its point."""
        return self._compiled.held(0)[0]

    @property
    def clamp_frame(self) -> Array:
        """(4,) frame in which the first support holds its cross-section."""
        return self._compiled.held(0)[1]

    @property
    def plane(self) -> tuple[Array, Array]:
        """Origin and frame of the plane of a planar scene, spanned by the frame's a1 and a3."""
        return self._compiled.plane

    @borrowed("pyrod.files:save")
    def save(self, path: str | Path, **options: Any) -> None:
        """Writes this to a file whose suffix tells the format; see `pyrod.save`."""

    @borrowed("pyrod.notebook.views:scene_html")
    def _repr_html_(self) -> str:  # type: ignore[empty-body]
        """What notebooks show."""

    def __repr__(self) -> str:
        rods = repr(self.rods[0]) if len(self.rods) == 1 else f"{len(self.rods)} rods"
        if self.is_cantilever:
            held = "clamped at its start"
        else:
            names = [type(x).__name__ for x in (*self.supports, *self.joints)]
            held = _counted(names)
        loads = ", ".join(type(load).__name__ for load in self.loads) or "no loads"
        if self.actuators:
            loads += f", {_counted([type(one).__name__ for one in self.actuators])}"
        return f"Scene({rods}, {held}, {loads}, {self.space})"


def _counted(names: list[str]) -> str:
    return ", ".join(
        name if names.count(name) == 1 else f"{names.count(name)} {name}s"
        for name in dict.fromkeys(names)
    )


def _tuple(items: Any, kind: type, name: str) -> tuple[Any, ...]:
    if type(items) is not tuple:
        one = isinstance(items, kind) or not isinstance(items, Iterable)
        items = (items,) if one else tuple(items)
    for item in items:
        if not isinstance(item, kind):
            raise TypeError(f"{name}: cannot use a {type(item).__name__}{_belonging(item)}")
    return items


def compiled_of(scene: Scene) -> _core.Scene:
    """The compiled scene, of the rods as the scene has them now."""
    return _core.Scene(
        [rod._compiled for rod in scene.rods],
        [support._compiled for support in scene.supports],
        [joint._compiled for joint in scene.joints],
        [load._compiled for load in scene.loads],
        [actuator._compiled for actuator in scene.actuators],
        scene.space,
    )


def _belonging(item: Any) -> str:
    """Where a thing belongs that was given for another argument."""
    kinds: dict[str, type] = {
        "rods": Rod,
        "supports": Support,
        "loads": Load,
        "joints": Joint,
        "actuators": Actuator,
    }
    for name, kind in kinds.items():
        if isinstance(item, kind):
            return (
                f"; a {type(item).__name__} belongs to {name}: "
                "Scene(rods, supports, loads, joints=...)"
            )
    if isinstance(item, Section):
        return "; make a rod of it: Rod.straight(length, edges, section)"
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
    elif isinstance(getattr(scene, "scene", None), Scene):
        hint = "; it has one, its scene"
    kind = type(scene).__name__
    a = "an" if kind[0] in "AEIOU" else "a"
    raise TypeError(f"scene: expected a Scene, got {a} {kind}{hint}")


def _on_grid(rods: tuple[Rod, ...], made: list[_core.Rod | None]) -> tuple[Rod, ...]:
    """The rods, those that the compiled scene gave more vertices as these are."""
    if made.count(None) == len(made):
        return rods
    pairs = zip(rods, made, strict=True)
    return tuple(rod if now is None else rod_of(now, rod._law, rod.placement) for rod, now in pairs)
