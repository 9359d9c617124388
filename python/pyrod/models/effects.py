"""What a scene leaves out, and what that would change: strains, and the third dimension."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Literal, get_args

import numpy as np

from pyrod._core import Options
from pyrod.base.calls import spelled
from pyrod.base.immutable import Array, Immutable, frozen
from pyrod.base.words import shortly
from pyrod.result.equilibrium import Equilibrium
from pyrod.result.rods import largest_turn
from pyrod.rod.models import STRAINS
from pyrod.rod.rod import Rod
from pyrod.rod.section import Model
from pyrod.scene.planarity import is_planar
from pyrod.scene.scene import Scene
from pyrod.solving.run import solved

Of = Literal["extension", "shear", "strains", "space"]
Quantity = Callable[[Equilibrium], "float | Array"]

_ADDED = {
    "extension": (False, False, True),
    "shear": (True, True, False),
    "strains": (True, True, True),
    "space": (False, False, False),
}


@dataclass(frozen=True, eq=False, repr=False)
class Effect(Immutable):
    """What would change in an equilibrium if its scene modelled more."""

    of: Of  #: what is modelled besides
    result: Equilibrium  #: the equilibrium of the scene as it is
    predicted: Equilibrium  #: the state of the richer scene
    quantity: Array | None  #: change of the quantity that was asked for
    first_order: bool
    """Whether ``predicted`` is one Newton step from ``result``, exact but for the square of the
    change. Where the change is too large for that, it is the equilibrium of the richer scene."""
    _before: Equilibrium
    """What changes are counted from, ``result`` after a Newton step without any change. The step
    moves a taut, straight rod a little, and a result that was extrapolated back to its grid."""

    @property
    def positions(self) -> Array:
        """(n + 1, 3) change of the positions of the only rod [m]."""
        return self.predicted.positions - self._before.positions

    @property
    def tip(self) -> Array:
        """(3,) change of the position of the only rod's end [m]."""
        return self.positions[-1]

    @property
    def energy(self) -> float:
        """Change of the elastic energy [J]."""
        return self.predicted.energy - self._before.energy

    @property
    def turn(self) -> float:
        """Largest turn of a frame [rad]."""
        return self.sizes["frames"]

    @cached_property
    def sizes(self) -> dict[str, float]:
        """Largest changes, of positions by the length of the longest rod; of frames [rad]; of
        section forces and moments by the largest there is; of energy by the larger of the two."""
        return _changes(self._before, self.predicted)

    @property
    def size(self) -> float:
        """The largest of the `sizes`."""
        return max(self.sizes.values())

    def __repr__(self) -> str:
        most = max(self.sizes, key=lambda key: self.sizes[key])
        what = f"{self.of}: {self.size:.2g} in {most}"
        if len(self.result.rods) == 1:
            what += f", tip by ({', '.join(f'{x:.3g}' for x in self.tip)})"
        what += f", energy by {self.energy:.3g}"
        if self.quantity is not None:
            what += f", quantity by {np.array2string(self.quantity, precision=3)}"
        return f"Effect({what}{'' if self.first_order else '; solved, not small'})"


@spelled
def effect(result: Equilibrium, of: Of, quantity: Quantity | None = None) -> Effect:
    """What modelling more would change in an equilibrium, to first order.

    Parameters
    ----------
    result : `Equilibrium`
        An equilibrium.
    of : "extension", "shear", "strains" or "space"
        "extension": rods stretch; "shear": they shear, and stretch only if they do already;
        "strains": both; "space": a planar scene may leave its plane. Stiffnesses are those of the
        sections; where they are infinite, or the rods have the strain already, nothing changes.
    quantity : function
        A function of an `Equilibrium` that returns a number or an array, whose change is wanted.

    Raises
    ------
    ValueError
        The result is no equilibrium, or its scene is spatial already.
    NotConverged
        The change is too large for the first order, and no equilibrium is found.
    """
    if of not in get_args(Of):
        raise ValueError(f"of: expected one of {', '.join(get_args(Of))}, got {shortly(of)}")
    if not result.converged:
        raise ValueError(f"result: it is no equilibrium, but {result.status}")
    richer = _in_space(result.scene) if of == "space" else _with_strains(result.scene, of)
    before, predicted, first_order = _predicted(richer, result)
    change = None
    if quantity is not None:
        change = frozen(np.subtract(quantity(predicted), quantity(before)))
    return Effect(of, result, predicted, change, first_order, before)


@spelled
def out_of_plane_index(result: Equilibrium) -> int | None:
    """Directions out of its plane in which the energy of a planar equilibrium falls.

    0 if it is stable against leaving the plane; None if the loads have no potential in space.

    Raises
    ------
    ValueError
        The scene is spatial, or in space this is no equilibrium.
    """
    spatial = _in_space(result.scene)
    if why := is_planar(result.scene).why:
        raise ValueError(f"result: in space it is no equilibrium, since {why}")
    planar = result.scene.refined(0)
    inside, free = (solved(x, start=result, stable=False).index for x in (planar, spatial))
    return None if free < 0 or inside < 0 else free - inside


def _predicted(richer: Scene | None, result: Equilibrium) -> tuple[Equilibrium, Equilibrium, bool]:
    """The poorer and the richer scene after one Newton step from the poorer one's equilibrium."""
    if richer is None:
        return result, result, True
    options = Options(max_iterations=1)
    scenes = result.scene.refined(0), richer
    steps = [solved(x, options, start=result, strict=False, stable=False) for x in scenes]
    if all(map(_is_whole, steps)):
        return steps[0], steps[1], True
    before, after = (solved(x, start=result, stable=False) for x in scenes)
    return before, after, False


def _is_whole(step: Equilibrium) -> bool:
    """Whether the last Newton step was taken as it was."""
    found = step.status in ("converged", "out_of_iterations")
    return found and step.record["fraction"][-1] == 1 and step.record["shift"][-1] == 0


def _in_space(scene: Scene) -> Scene:
    if scene.space == "spatial":
        raise ValueError("result: its scene is spatial already")
    return replace(scene.refined(0), space="spatial")


def _with_strains(scene: Scene, of: Of) -> Scene | None:
    """The scene with more strains; None if that makes no difference."""
    poorer = scene.refined(0)
    rods = tuple(_richer(rod, _ADDED[of]) for rod in poorer.rods)
    if all(new is old for new, old in zip(rods, poorer.rods, strict=True)):
        return None
    return replace(poorer, rods=rods)


def _richer(rod: Rod, added: tuple[bool, ...]) -> Rod:
    now = np.array(STRAINS[rod.model])
    then = now | added
    stiffness = np.where(then, rod.stretching, np.inf)
    if np.array_equal(stiffness, np.where(now, rod.stretching, np.inf)):
        return rod
    model: Model = "extensible" if tuple(then) == STRAINS["extensible"] else "cosserat"
    return replace(rod, model=model, stretching=stiffness)


# How large a change is --------------------------------------------------------------------------


def _changes(before: Equilibrium, after: Equilibrium) -> dict[str, float]:
    pairs = list(zip(before.rods, after.rods, strict=True))
    length = max(rod.rod.length for rod in before.rods)
    # below a billionth of what bends a rod noticeably, forces and moments are rounding
    moment = 1e-9 * max(rod.rod.bending.max() for rod in before.rods) / length
    energies = abs(before.energy), abs(after.energy), 1e-9 * moment
    force, moment = moment / length, moment
    for rod in before.rods:
        force, moment = max(force, _largest(rod.vertex_force)), max(moment, _largest(rod.moment))
    return {
        "positions": max(_largest(b.positions - a.positions) for a, b in pairs) / length,
        "frames": max(largest_turn(a, b) for a, b in pairs),
        "forces": max(_largest(b.vertex_force - a.vertex_force) for a, b in pairs) / force,
        "moments": max(_largest(b.moment - a.moment) for a, b in pairs) / moment,
        "energy": abs(after.energy - before.energy) / max(energies),
    }


def _largest(values: Array) -> float:
    return float(np.abs(values).max())
