"""What acts on rods: forces and moments, fixed in space or following the rod.

Each kind says here what it consists of, as its compiled counterpart does; that is all that the rest
knows of it. ``at`` is a point that it acts on, ``rod`` the number of a rod along which it acts.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import inf
from typing import TYPE_CHECKING, Any, Union

import numpy as np
from numpy.typing import ArrayLike

import pyrod._core as _core
from pyrod.base.arrays import finite, number, whole, yes_or_no
from pyrod.base.immutable import Array, frozen, vector
from pyrod.curve._sampling import along, sampled
from pyrod.rod.place import Place, checked
from pyrod.rod.rod import Rod
from pyrod.scene.part import Part

Along = Union[Array, Callable[[float], ArrayLike]]
GivenAlong = Union[ArrayLike, Callable[[float], ArrayLike]]


class Load(Part):
    """Base of all loads: the first field of each kind is what acts, and grows with a factor."""

    follower = False
    grows = True
    """Whether there is more of it under larger loads."""
    down: Array | None = None
    """(3,) which way it pulls all that has a mass; of loads that do so."""

    @property
    def acting(self) -> Any:
        """What acts, (3,), or along a rod (n, 3), one per edge, or a function of arc length."""
        return getattr(self, self._kind.fields[0])

    def with_acting(self, values: Any) -> Load:
        """The same load with something else that acts."""
        return self if values is self.acting else replace(self, **{self._kind.fields[0]: values})  # type: ignore[type-var]

    def __post_init__(self) -> None:
        name = self._kind.fields[0]
        self.__dict__[name] = vector(self.acting, name)


class PointLoad(Load):
    """Base of what acts on one point."""

    at: Place

    def __post_init__(self) -> None:
        super().__post_init__()
        self._set(at=checked(self.at), follower=yes_or_no(self.follower, "follower"))


class LoadAlong(Load):
    """Base of what acts along a rod."""

    rod: int

    def __post_init__(self) -> None:
        self._set(rod=whole(self.rod, "rod"), follower=yes_or_no(self.follower, "follower"))
        name = self._kind.fields[0]
        if not callable(self.acting):
            self.__dict__[name] = frozen(self.acting, name)

    def _given(self) -> list[Any]:
        """With a function, one whose values are looked at."""
        acting, *others = super()._given()
        if callable(acting):
            acting = along(acting, 1, self._kind.fields[0], "edge")
        return [acting, *others]

    def on_edges(self, rods: tuple[Rod, ...]) -> Array:
        """(n, 3) what acts at the centres of the edges."""
        s = rods[self.rod].arc_lengths
        return sampled(self.acting, (s[1:] + s[:-1]) / 2, self._kind.fields[0], "edge")

    def refuse_shape(self, rods: tuple[Rod, ...]) -> None:
        """Refuses an array that is neither (3,) nor rows of three."""
        if not callable(self.acting) and self.acting.shape[1:] != (3,) and self.rod < len(rods):
            along(self.acting, rods[self.rod].edges, self._kind.fields[0], "edge")


@dataclass(frozen=True, eq=False)
class Force(PointLoad):
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
    _kind = _core.Force

    if TYPE_CHECKING:  # what is taken is more than what is kept

        def __init__(self, force: ArrayLike, at: Place = "end", follower: bool = False) -> None: ...


@dataclass(frozen=True, eq=False)
class Moment(PointLoad):
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
    _kind = _core.Moment

    if TYPE_CHECKING:  # what is taken is more than what is kept

        def __init__(
            self, moment: ArrayLike, at: Place = "end", follower: bool = False
        ) -> None: ...


@dataclass(frozen=True, eq=False)
class DistributedForce(LoadAlong):
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
    _kind = _core.DistributedForce

    if TYPE_CHECKING:  # what is taken is more than what is kept

        def __init__(
            self, force_per_length: GivenAlong, rod: int = 0, follower: bool = False
        ) -> None: ...


@dataclass(frozen=True, eq=False)
class DistributedMoment(LoadAlong):
    """A moment per length at rest [N].

    Parameters
    ----------
    moment_per_length, rod, follower : as for `DistributedForce`
    """

    moment_per_length: Along
    rod: int = 0
    follower: bool = False
    _kind = _core.DistributedMoment

    if TYPE_CHECKING:  # what is taken is more than what is kept

        def __init__(
            self, moment_per_length: GivenAlong, rod: int = 0, follower: bool = False
        ) -> None: ...


@dataclass(frozen=True, eq=False)
class Gravity(Load):
    """The weight of all rods whose sections have a mass per length, and of point masses.

    Parameters
    ----------
    acceleration : (3,) array [m/s^2]
        Default: 9.81 along -z.
    """

    acceleration: Array = (0.0, 0.0, -9.81)  # type: ignore[assignment]
    _kind = _core.Gravity

    if TYPE_CHECKING:  # what is taken is more than what is kept

        def __init__(self, acceleration: ArrayLike = (0.0, 0.0, -9.81)) -> None: ...

    @property
    def down(self) -> Array:  # type: ignore[override]
        """(3,) which way all masses are pulled."""
        return self.acceleration


@dataclass(frozen=True, eq=False)
class PointMass(Load):
    """A body whose centre of mass is on the axis of a rod, fixed to one cross-section.

    It acts by its weight, where there is `Gravity`, and vibrates with the rod (`Linearised.modes`).

    Parameters
    ----------
    mass : float [kg]
        Positive.
    at : as for `Force`
    inertia : (3,) or (3, 3) array [kg m^2]
        Moments of inertia about the directors a1, a2, a3 there, or their matrix; default: none. In
        vibrations only.
    """

    mass: float
    at: Place = "end"
    inertia: Array | None = None
    grows = False
    _kind = _core.PointMass

    if TYPE_CHECKING:  # what is taken is more than what is kept

        def __init__(
            self, mass: float, at: Place = "end", inertia: ArrayLike | None = None
        ) -> None: ...

    def __post_init__(self) -> None:
        mass = number(self.mass, "mass")
        if not 0 < mass < inf:
            raise ValueError(f"mass: must be positive and finite, got {mass}")
        inertia = None if self.inertia is None else _inertia(self.inertia)
        self._set(mass=mass, at=checked(self.at), inertia=inertia)


def _inertia(values: ArrayLike) -> Array:
    """That of a body, as given."""
    made = frozen(finite(values, "inertia"))
    if made.shape not in ((3,), (3, 3)):
        raise ValueError(f"inertia: expected 3 numbers, or 3 x 3, got shape {made.shape}")
    matrix = made if made.ndim == 2 else np.diag(made)
    size = float(np.abs(matrix).max())
    if np.abs(matrix - matrix.T).max() > 1e-9 * size:
        raise ValueError("inertia: expected a symmetric matrix")
    least = np.linalg.eigvalsh(matrix)
    if least[0] < -1e-9 * size or least[2] > (least[0] + least[1]) * (1 + 1e-9):
        raise ValueError(
            "inertia: no body has it; moments of inertia are not negative, and none is larger than "
            "the sum of the other two"
        )
    return made


def on_cut_edges(load: Load, given: tuple[Rod, ...], cut: tuple[Rod, ...]) -> Load:
    """The load whose rows belong to the edges of the given rods, on these cut."""
    if not isinstance(load, LoadAlong) or np.ndim(load.acting) != 2:
        return load
    before, now = given[load.rod], cut[load.rod]
    if now is before or len(load.acting) != before.edges:
        return load
    centres = (now.arc_lengths[1:] + now.arc_lengths[:-1]) / 2
    return load.with_acting(load.acting[np.searchsorted(before.arc_lengths[1:-1], centres)])


def sampled_load(load: Load, rods: tuple[Rod, ...]) -> Load:
    """The same load with a function replaced by the values it has on the edges."""
    return load.with_acting(load.on_edges(rods)) if isinstance(load, LoadAlong) else load


def stepwise_load(load: Load, rods: tuple[Rod, ...]) -> Load:
    """The same load on any grid: values that are given edge by edge hold for all of the edge."""
    if not isinstance(load, LoadAlong) or np.ndim(load.acting) != 2:
        return load
    return load.with_acting(_Steps(load.on_edges(rods), rods[load.rod].arc_lengths))


@dataclass(frozen=True, eq=False)
class _Steps:
    values: Array
    ends: Array

    def __call__(self, s: float) -> Array:
        edge = int(np.searchsorted(self.ends, s, "right")) - 1
        return self.values[min(max(edge, 0), len(self.values) - 1)]
