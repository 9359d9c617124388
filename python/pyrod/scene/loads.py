"""What acts on rods: forces and moments, fixed in space or following the rod."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from functools import cached_property
from typing import Any, Union

import numpy as np
from numpy.typing import ArrayLike

import pyrod._core as _core
from pyrod.base.arrays import whole
from pyrod.base.immutable import Array, Immutable, frozen, vector
from pyrod.curve._sampling import along, sampled
from pyrod.rod.place import Place, checked
from pyrod.rod.rod import Rod

Along = Union[Array, Callable[[float], ArrayLike]]


@dataclass(frozen=True, eq=False)
class Force(Immutable):
    """A force on one point of a rod.

    Parameters
    ----------
    force : (3,) array [N]
    at : "start", "end", float [m], or (int, one of these)
        An end (default "end"), an arc length, or these with the number of the rod. Between two
        vertices it is shared by them as by a lever.
    follower : bool
        It turns with the rod, and its components are those of the frame there; default: it is dead,
        fixed in space. A follower has no potential.
    """

    force: Array
    at: Place = "end"
    follower: bool = False

    def __post_init__(self) -> None:
        self._set(force=vector(self.force, "force"), at=checked(self.at))

    @cached_property
    def _compiled(self) -> _core.Force:
        return _core.Force(self.force, self.at, self.follower)


@dataclass(frozen=True, eq=False)
class Moment(Immutable):
    """A moment on one cross-section.

    Parameters
    ----------
    moment : (3,) array [N m]
    at, follower : as for `Force`
        In space neither a dead moment nor a follower has a potential.
    """

    moment: Array
    at: Place = "end"
    follower: bool = False

    def __post_init__(self) -> None:
        self._set(moment=vector(self.moment, "moment"), at=checked(self.at))

    @cached_property
    def _compiled(self) -> _core.Moment:
        return _core.Moment(self.moment, self.at, self.follower)


@dataclass(frozen=True, eq=False)
class DistributedForce(Immutable):
    """A force per length at rest [N/m].

    Parameters
    ----------
    force_per_length : (3,) or (n, 3) array [N/m], or function
        One for all, one per edge, or a function of arc length, which is taken at the centres of the
        edges.
    rod : int
        Number of the rod it acts on.
    follower : bool
        As for `Force`.
    """

    force_per_length: Along
    rod: int = 0
    follower: bool = False

    def __post_init__(self) -> None:
        self._set(rod=whole(self.rod, "rod"))
        if not callable(self.force_per_length):
            self._set(force_per_length=frozen(self.force_per_length, "force_per_length"))

    @cached_property
    def _compiled(self) -> _core.DistributedForce:
        values = _along(self.force_per_length, "force_per_length")
        return _core.DistributedForce(values, self.rod, self.follower)


@dataclass(frozen=True, eq=False)
class DistributedMoment(Immutable):
    """A moment per length at rest [N].

    Parameters
    ----------
    moment_per_length, rod, follower : as for `DistributedForce`
    """

    moment_per_length: Along
    rod: int = 0
    follower: bool = False

    def __post_init__(self) -> None:
        self._set(rod=whole(self.rod, "rod"))
        if not callable(self.moment_per_length):
            self._set(moment_per_length=frozen(self.moment_per_length, "moment_per_length"))

    @cached_property
    def _compiled(self) -> _core.DistributedMoment:
        values = _along(self.moment_per_length, "moment_per_length")
        return _core.DistributedMoment(values, self.rod, self.follower)


@dataclass(frozen=True, eq=False)
class Gravity(Immutable):
    """The weight of all rods whose sections have a mass per length.

    Parameters
    ----------
    acceleration : (3,) array [m/s^2]
        Default: 9.81 along -z.
    """

    acceleration: Array = (0.0, 0.0, -9.81)  # type: ignore[assignment]

    follower = False

    def __post_init__(self) -> None:
        self._set(acceleration=vector(self.acceleration, "acceleration"))

    @cached_property
    def _compiled(self) -> _core.Gravity:
        return _core.Gravity(self.acceleration)


Load = Union[Force, Moment, DistributedForce, DistributedMoment, Gravity]


def any_function(loads: tuple[Load, ...]) -> bool:
    """Whether a load is told by a function of arc length."""
    return any(
        callable(load.force_per_length) for load in loads if isinstance(load, DistributedForce)
    ) or any(
        callable(load.moment_per_length) for load in loads if isinstance(load, DistributedMoment)
    )


def _along(values: Any, name: str) -> Any:
    """(3,), a row per edge, or a function of arc length; how many rows, the rod tells."""
    return along(values, 1, name, "edge") if callable(values) else values


def refuse_shapes(loads: tuple[Load, ...], rods: tuple[Rod, ...]) -> None:
    """Refuses arrays along rods that are neither (3,) nor rows of three."""
    for load in loads:
        if isinstance(load, (DistributedForce, DistributedMoment)) and load.rod < len(rods):
            name = fields(load)[0].name
            values = getattr(load, name)
            if not callable(values) and values.shape[1:] != (3,):
                along(values, rods[load.rod].edges, name, "edge")


def on_cut_edges(load: Load, given: tuple[Rod, ...], cut: tuple[Rod, ...]) -> Load:
    """The load whose rows belong to the edges of the given rods, on these cut."""

    def rows(values: Any, name: str) -> Any:
        before, now = given[load.rod], cut[load.rod]  # type: ignore[union-attr]
        if now is before or np.ndim(values) != 2 or len(values) != before.edges:
            return values
        centres = (now.arc_lengths[1:] + now.arc_lengths[:-1]) / 2
        return values[np.searchsorted(before.arc_lengths[1:-1], centres)]

    return _with_values(load, rods=cut, new=rows)


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

    def __call__(self, s: float) -> Array:
        edge = int(np.searchsorted(self.ends, s, "right")) - 1
        return self.values[min(max(edge, 0), len(self.values) - 1)]


def scaled_load(load: Load, factor: float) -> Load:
    """The same load, so many times as large; one that has been `sampled_load`."""
    name = fields(load)[0].name
    return replace(load, **{name: factor * getattr(load, name)})


def _with_values(load: Load, rods: tuple[Rod, ...], new: Callable[[Any, str], Any]) -> Load:
    if not isinstance(load, (DistributedForce, DistributedMoment)):
        return load
    name = fields(load)[0].name
    before = getattr(load, name)
    values = new(before, name)
    return load if values is before else type(load)(values, load.rod, load.follower)
