"""What acts where: supports, loads, and the scene that holds them together."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import Any, Literal, Union

import numpy as np
from numpy.typing import ArrayLike

from pyrod import _core
from pyrod._immutable import Array, Immutable, frozen, vector
from pyrod._sampling import sampled
from pyrod.rod import Rod
from pyrod.rotation import as_frames, frame_along

Place = Union[Literal["start", "end"], float]
Space = Literal["planar", "spatial"]


@dataclass(frozen=True, eq=False, init=False)
class Clamp(Immutable):
    """Holds the start of the rod in position and frame.

    Parameters
    ----------
    position : (3,) [m]; default: where the rod is at rest, the origin unless made from a curve.
    frame : (4,) unit quaternion or (3, 3) matrix; or, instead,
    tangent, normal : directions of a3 and, as near as can be, of a1. Default: the frame that the
        start has at rest; a rod that is not made from a curve starts along z, with a1 along x.
    """

    position: Array | None
    frame: Array | None

    def __init__(
        self,
        position: ArrayLike | None = None,
        frame: ArrayLike | None = None,
        *,
        tangent: ArrayLike | None = None,
        normal: ArrayLike | None = None,
    ) -> None:
        if frame is not None and (tangent is not None or normal is not None):
            raise ValueError("frame: give either a frame or a tangent, not both")
        if normal is not None and tangent is None:
            raise ValueError("normal: needs a tangent, too")
        if tangent is not None:
            frame = frame_along(tangent, normal)
        elif frame is not None:
            frame = as_frames(np.asarray(frame, dtype=np.float64)[None], "frame")[0]
            if not abs(np.linalg.norm(frame) - 1) < 1e-6:
                raise ValueError(f"frame: expected a unit quaternion (w, x, y, z), got {frame}")
        self._set(
            position=None if position is None else vector(position, "position"),
            frame=None if frame is None else frozen(frame),
        )


@dataclass(frozen=True, eq=False)
class Force(Immutable):
    """A dead force (3,) [N], fixed in space, on one point of the rod.

    at : "end" (default), "start", or an arc length [m]. Between two vertices it is shared by them
        as by a lever.
    """

    force: Array
    at: Place = "end"

    def __post_init__(self) -> None:
        self._set(force=vector(self.force, "force"), at=_checked(self.at))

    def _apply(self, loads: _core.Loads, rod: Rod) -> None:
        loads.add_force(self.force, _arc_length(self.at, rod))


@dataclass(frozen=True, eq=False)
class Moment(Immutable):
    """A dead moment (3,) [N m], fixed in space, on one cross-section.

    at : as for `Force`. In space such a moment has no potential.
    """

    moment: Array
    at: Place = "end"

    def __post_init__(self) -> None:
        self._set(moment=vector(self.moment, "moment"), at=_checked(self.at))

    def _apply(self, loads: _core.Loads, rod: Rod) -> None:
        loads.add_moment(self.moment, _arc_length(self.at, rod))


@dataclass(frozen=True, eq=False)
class DistributedForce(Immutable):
    """A dead force per length at rest [N/m].

    force_per_length : (3,), (n, 3) one per edge, or a function of arc length, which is taken at the
        centres of the edges.
    """

    force_per_length: Array | Callable[[float], ArrayLike]

    def __post_init__(self) -> None:
        if not callable(self.force_per_length):
            self._set(force_per_length=frozen(self.force_per_length))

    def _apply(self, loads: _core.Loads, rod: Rod) -> None:
        loads.add_distributed_force(_on_edges(self.force_per_length, rod, "force_per_length"))


@dataclass(frozen=True, eq=False)
class DistributedMoment(Immutable):
    """A dead moment per length at rest [N]; values as for `DistributedForce`."""

    moment_per_length: Array | Callable[[float], ArrayLike]

    def __post_init__(self) -> None:
        if not callable(self.moment_per_length):
            self._set(moment_per_length=frozen(self.moment_per_length))

    def _apply(self, loads: _core.Loads, rod: Rod) -> None:
        loads.add_distributed_moment(_on_edges(self.moment_per_length, rod, "moment_per_length"))


Load = Union[Force, Moment, DistributedForce, DistributedMoment]


@dataclass(frozen=True, eq=False, repr=False, init=False)
class Scene(Immutable):
    """A rod, what holds it and what acts on it.

    Parameters
    ----------
    rod : the `Rod`.
    supports : one `Clamp`; the other end is free.
    loads : `Force`, `Moment`, `DistributedForce`, `DistributedMoment`, any number.
    space : "spatial" (default), or "planar": the rod stays in the plane of the clamp's directors a1
        and a3, which takes a third of the unknowns. Loads and rest curvature that leave the plane
        are refused.
    """

    rod: Rod
    supports: tuple[Clamp, ...]
    loads: tuple[Load, ...]
    space: Space
    _loads: _core.Loads = field(init=False, compare=False)

    def __init__(
        self,
        rod: Rod,
        supports: Clamp | Iterable[Clamp],
        loads: Load | Iterable[Load] = (),
        space: Space = "spatial",
    ) -> None:
        supports = _tuple(supports, Clamp, "supports")
        loads = _tuple(loads, Load.__args__, "loads")  # type: ignore[attr-defined]
        if not isinstance(rod, Rod):
            raise TypeError(f"rod: expected a Rod, got {type(rod).__name__}")
        if len(supports) != 1:
            raise ValueError(
                f"supports: expected one Clamp, got {len(supports)}; a rod that nothing holds has "
                "no equilibrium, and this version holds rods at their start only"
            )
        if space not in _core.Dimension.__members__:
            raise ValueError(f"space: expected 'planar' or 'spatial', got {space!r}")
        compiled = _core.Loads(rod._rod)
        for load in loads:
            load._apply(compiled, rod)
        self._set(rod=rod, supports=supports, loads=loads, space=space, _loads=compiled)

    def __getstate__(self) -> dict[str, Any]:
        """Functions of arc length are pickled as the values they had on the edges."""
        state = super().__getstate__()
        state["loads"] = tuple(_sampled_load(load, self.rod) for load in self.loads)
        return state

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__init__(**state)  # type: ignore[misc]

    @property
    def clamp_position(self) -> Array:
        """(3,) where the start of the rod is held."""
        position = self.supports[0].position
        return self.rod.placement[0] if position is None else position

    @property
    def clamp_frame(self) -> Array:
        """(4,) frame in which the start of the rod is held."""
        frame = self.supports[0].frame
        return self.rod.placement[1] if frame is None else frame

    def __repr__(self) -> str:
        loads = ", ".join(type(load).__name__ for load in self.loads) or "no loads"
        return f"Scene({self.rod!r}, clamped at its start, {loads}, {self.space})"


def _tuple(items: Any, kinds: Any, name: str) -> tuple[Any, ...]:
    items = (items,) if isinstance(items, kinds) else tuple(items)
    for item in items:
        if not isinstance(item, kinds):
            raise TypeError(f"{name}: cannot use a {type(item).__name__}")
    return items


def _checked(at: Place) -> Place:
    if at in ("start", "end"):
        return at
    if isinstance(at, str) or not np.isfinite(at):
        raise ValueError(f"at: expected 'start', 'end' or an arc length, got {at!r}")
    return float(at)


def _arc_length(at: Place, rod: Rod) -> float:
    if isinstance(at, str):
        return 0.0 if at == "start" else rod.length
    return at


def _centres(rod: Rod) -> Array:
    s = rod.arc_lengths
    return (s[1:] + s[:-1]) / 2


def _on_edges(values: Any, rod: Rod, name: str) -> Array:
    return sampled(values, _centres(rod), name, "edge")


def _sampled_load(load: Load, rod: Rod) -> Load:
    if isinstance(load, DistributedForce) and callable(load.force_per_length):
        return DistributedForce(_on_edges(load.force_per_length, rod, "force_per_length"))
    if isinstance(load, DistributedMoment) and callable(load.moment_per_length):
        return DistributedMoment(_on_edges(load.moment_per_length, rod, "moment_per_length"))
    return load
