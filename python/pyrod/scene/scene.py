"""Scenes: rods, what holds and joins them, and what acts on them."""

from __future__ import annotations

import operator
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any, Literal

import pyrod._core as _core
from pyrod.base.borrowed import borrowed
from pyrod.base.immutable import Array, Immutable, sealed
from pyrod.base.words import shortly
from pyrod.rod.place import Place
from pyrod.rod.rod import Rod
from pyrod.scene.joints import Joint
from pyrod.scene.loads import Load, on_cut_edges, refuse_shapes, sampled_load, stepwise_load
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
        `Force`, `Moment`, `DistributedForce`, `DistributedMoment`, `Gravity`; one or any number.
    space : "spatial" or "planar"
        In the plane (not default) the rods stay in that of the directors a1 and a3 of the first
        clamp (else of the first rod at rest), which takes a third of the unknowns. What leaves the
        plane is refused.
    joints : `Joint`, or several
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
    _core: _core.Scene = field(init=False, compare=False)

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
                f"space: expected 'planar' or 'spatial', got {shortly(space)}{_belonging(space)}"
            )
        if not supports and not joints:
            raise ValueError(
                "supports: nothing holds the rod, so it has no equilibrium; give a Clamp or "
                "another support"
            )
        refuse_shapes(loads, rods)
        compiled = _core.Scene(
            [rod._rod for rod in rods],
            [support._compiled for support in supports],
            [joint._compiled for joint in joints],
            [load._compiled for load in loads],
            _core.Dimension.__members__[space],
        )
        cut = _on_grid(rods, compiled.rods([rod._rod for rod in rods]))
        loads = tuple(on_cut_edges(load, rods, cut) for load in loads)
        self._set(rods=cut, supports=supports, loads=loads, space=space, joints=joints)
        self._set(_core=compiled)

    def _refined(self, level: int) -> Scene:
        """The same scene with every edge cut in 2^level, and no choice of edges left."""
        loads = [stepwise_load(load, self.rods) for load in self.loads]
        rods = [rod._refined(level) for rod in self.rods]
        return Scene(rods, self.supports, loads, self.space, self.joints)

    @cached_property
    def _climbing(self) -> Scene:
        """The scene as a solve with a tolerance has it.

        It has more vertices where loads act, and where functions jump or have kinks.
        """
        rods = _on_grid(self.rods, self._core.climbing_rods([rod._rod for rod in self.rods]))
        if all(map(operator.is_, rods, self.rods)):
            return self
        loads = [stepwise_load(load, self.rods) for load in self.loads]
        made = Scene(rods, self.supports, loads, self.space, self.joints)
        made.__dict__["_climbing"] = made
        return made

    def _vertex(self, at: Place) -> tuple[int, int]:
        """The number of the rod, and of its vertex nearest to a place."""
        return self._core.vertex(at)

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
        if len(self.rods) != 1 or self.joints or len(self.supports) != 1:
            return False
        (support,) = self.supports
        clamped = isinstance(support, Clamp) and support.turns == 0
        at_start = clamped and self._core.vertex(support.at) == (0, 0)
        return at_start and not any(load.follower for load in self.loads)

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
        return sealed(self._core.plane)

    def _held(self, number: int) -> tuple[Array, Array]:
        return sealed(self._core.held(number))

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


def on_its_grid(scene: Scene) -> Scene:
    """The scene on the edges that it has: none are left to the solver."""
    return rebuilt(scene, tuple(rod._refined(0) for rod in scene.rods), scene.space)


def rebuilt(scene: Scene, rods: tuple[Rod, ...], space: Space) -> Scene:
    """The scene with other rods of the same shapes, in a space."""
    return Scene(rods, scene.supports, scene.loads, space, scene.joints)


def _on_grid(rods: tuple[Rod, ...], made: list[_core.Rod | None]) -> tuple[Rod, ...]:
    """The rods, those that the compiled scene gave more vertices as these are."""
    pairs = zip(rods, made, strict=True)
    return tuple(rod if now is None else rod._with(now) for rod, now in pairs)
