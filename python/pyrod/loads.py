"""What acts on rods: forces and moments, fixed in space or following the rod."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, fields, replace
from typing import TYPE_CHECKING, Any, Union

import numpy as np
from numpy.typing import ArrayLike

from pyrod import _core
from pyrod._arrays import whole
from pyrod._immutable import Array, Immutable, frozen, vector
from pyrod._places import Place, checked, on_rod
from pyrod._sampling import sampled

if TYPE_CHECKING:
    from pyrod.rod import Rod

Along = Union[Array, Callable[[float], ArrayLike]]


@dataclass(frozen=True, eq=False)
class Force(Immutable):
    """A force (3,) [N] on one point of a rod.

    at : "end" (default), "start", an arc length [m], or (number of the rod, one of these). Between
        two vertices it is shared by them as by a lever.
    follower : it turns with the rod, and its components are those of the frame there; default: it
        is dead, fixed in space. A follower has no potential.
    """

    force: Array
    at: Place = "end"
    follower: bool = False

    def __post_init__(self) -> None:
        self._set(force=vector(self.force, "force"), at=checked(self.at))

    def _apply(self, loads: tuple[_core.Loads, ...], rods: tuple[Rod, ...]) -> None:
        i, s = on_rod(self.at, rods)
        (loads[i].add_following_force if self.follower else loads[i].add_force)(self.force, s)


@dataclass(frozen=True, eq=False)
class Moment(Immutable):
    """A moment (3,) [N m] on one cross-section.

    at, follower : as for `Force`. In space neither a dead moment nor a follower has a potential.
    """

    moment: Array
    at: Place = "end"
    follower: bool = False

    def __post_init__(self) -> None:
        self._set(moment=vector(self.moment, "moment"), at=checked(self.at))

    def _apply(self, loads: tuple[_core.Loads, ...], rods: tuple[Rod, ...]) -> None:
        i, s = on_rod(self.at, rods)
        (loads[i].add_following_moment if self.follower else loads[i].add_moment)(self.moment, s)


@dataclass(frozen=True, eq=False)
class DistributedForce(Immutable):
    """A force per length at rest [N/m].

    force_per_length : (3,), (n, 3) one per edge, or a function of arc length, which is taken at the
        centres of the edges.
    rod : number of the rod it acts on.
    follower : as for `Force`.
    """

    force_per_length: Along
    rod: int = 0
    follower: bool = False

    def __post_init__(self) -> None:
        self._set(rod=whole(self.rod, "rod"))
        if not callable(self.force_per_length):
            self._set(force_per_length=frozen(self.force_per_length, "force_per_length"))

    def _apply(self, loads: tuple[_core.Loads, ...], rods: tuple[Rod, ...]) -> None:
        on = loads[_number(self.rod, rods)]
        values = on_edges(self.force_per_length, rods[self.rod], "force_per_length")
        (on.add_following_distributed_force if self.follower else on.add_distributed_force)(values)


@dataclass(frozen=True, eq=False)
class DistributedMoment(Immutable):
    """A moment per length at rest [N].

    moment_per_length, rod, follower : as for `DistributedForce`.
    """

    moment_per_length: Along
    rod: int = 0
    follower: bool = False

    def __post_init__(self) -> None:
        self._set(rod=whole(self.rod, "rod"))
        if not callable(self.moment_per_length):
            self._set(moment_per_length=frozen(self.moment_per_length, "moment_per_length"))

    def _apply(self, loads: tuple[_core.Loads, ...], rods: tuple[Rod, ...]) -> None:
        on = loads[_number(self.rod, rods)]
        values = on_edges(self.moment_per_length, rods[self.rod], "moment_per_length")
        (on.add_following_distributed_moment if self.follower else on.add_distributed_moment)(
            values
        )


@dataclass(frozen=True, eq=False)
class Gravity(Immutable):
    """The weight of all rods whose sections have a mass per length.

    acceleration : (3,) [m/s^2]; default: 9.81 along -z.
    """

    acceleration: Array = (0.0, 0.0, -9.81)  # type: ignore[assignment]

    follower = False

    def __post_init__(self) -> None:
        self._set(acceleration=vector(self.acceleration, "acceleration"))

    def _apply(self, loads: tuple[_core.Loads, ...], rods: tuple[Rod, ...]) -> None:
        if not any(rod.mass_per_length.any() for rod in rods):
            raise ValueError(
                "Gravity: no rod has a mass; give its material a density, or its section a "
                "mass_per_length"
            )
        for on, rod in zip(loads, rods, strict=True):
            on.add_distributed_force(rod.mass_per_length[:, None] * self.acceleration)


Load = Union[Force, Moment, DistributedForce, DistributedMoment, Gravity]


def any_function(loads: tuple[Load, ...]) -> bool:
    """Whether a load is told by a function of arc length."""
    return any(
        callable(load.force_per_length) for load in loads if isinstance(load, DistributedForce)
    ) or any(
        callable(load.moment_per_length) for load in loads if isinstance(load, DistributedMoment)
    )


def load_places(loads: tuple[Load, ...]) -> list[Place]:
    """Where point loads act."""
    return [load.at for load in loads if isinstance(load, (Force, Moment))]


def load_steps(loads: tuple[Load, ...], rods: tuple[Rod, ...]) -> Iterator[tuple[int, Array]]:
    """Of values given edge by edge: the number of the rod, and where along it they change."""
    for load in loads:
        if isinstance(load, (DistributedForce, DistributedMoment)):
            kept = stepwise_load(load, rods)
            along = getattr(kept, "force_per_length", getattr(kept, "moment_per_length", None))
            if isinstance(along, _Steps):
                yield load.rod, along.steps


def _number(rod: int, rods: tuple[Rod, ...]) -> int:
    if not 0 <= rod < len(rods):
        raise ValueError(f"rod: there is no rod {rod}, the scene has {len(rods)}")
    return rod


def on_edges(values: Any, rod: Rod, name: str) -> Array:
    """Values along a rod at the centres of its edges, (n, 3)."""
    s = rod.arc_lengths
    return sampled(values, (s[1:] + s[:-1]) / 2, name, "edge")


def sampled_load(load: Load, rods: tuple[Rod, ...]) -> Load:
    """The same load with functions replaced by the values they have on the edges."""
    return _with_values(load, rods, lambda values, name: on_edges(values, rods[load.rod], name))  # type: ignore[union-attr]


def stepwise_load(load: Load, rods: tuple[Rod, ...]) -> Load:
    """The same load on any grid: values that are given edge by edge hold for all of the edge."""

    def function(values: Any, name: str) -> Any:
        if callable(values) or np.ndim(values) == 1:
            return values
        return _Steps(on_edges(values, rods[load.rod], name), rods[load.rod].arc_lengths)  # type: ignore[union-attr]

    return _with_values(load, rods, function)


@dataclass(frozen=True, eq=False)
class _Steps:
    values: Array
    ends: Array

    @property
    def steps(self) -> Array:
        """Arc lengths at which the value changes."""
        return self.ends[1:-1][(self.values[1:] != self.values[:-1]).any(axis=1)]

    def __call__(self, s: float) -> Array:
        edge = int(np.searchsorted(self.ends, s, "right")) - 1
        return self.values[min(max(edge, 0), len(self.values) - 1)]


def scaled_load(load: Load, factor: float) -> Load:
    """The same load, so many times as large; one that has been `sampled_load`."""
    name = fields(load)[0].name
    return replace(load, **{name: factor * getattr(load, name)})


def _with_values(load: Load, rods: tuple[Rod, ...], new: Callable[[Any, str], Any]) -> Load:
    if isinstance(load, DistributedForce):
        values = new(load.force_per_length, "force_per_length")
        return DistributedForce(values, load.rod, load.follower)
    if isinstance(load, DistributedMoment):
        values = new(load.moment_per_length, "moment_per_length")
        return DistributedMoment(values, load.rod, load.follower)
    return load
