"""Where equilibria of one rod or several are asked: at a place, for the largest, for the sag."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from pyrod.base.arrays import whole
from pyrod.base.calls import spelled
from pyrod.result.between import state_at
from pyrod.result.equilibrium import Equilibrium
from pyrod.result.peaks import largest_along, sag_along
from pyrod.result.told import Largest, RodAt
from pyrod.rod.place import Place


@spelled
def at_place(result: Equilibrium, place: Place | ArrayLike, before: bool = False) -> RodAt:
    """A rod at a place, or the only rod at several arc lengths, between vertices, too.

    Parameters
    ----------
    result : `Equilibrium`
        The equilibrium.
    place : "start", "end", float or (k,) array [m], or (int, one of these)
        Arc lengths at rest; of several rods with the number of the rod.
    before : bool
        Where something jumps, tell what is just before; default: just behind, as arrays do.

    Returns
    -------
    RodAt
        See ``RodEquilibrium.at``, which tells how it is found.

    Raises
    ------
    ValueError
        A place that is not on a rod, or on which is not told.
    """
    number, s = 0, place
    if isinstance(place, tuple) and len(place) == 2 and isinstance(place[0], (int, np.integer)):
        number, s = place
        if not 0 <= number < len(result.rods):
            raise ValueError(f"place: there is no rod {number}, the scene has {len(result.rods)}")
    elif len(result.rods) > 1:
        raise ValueError(
            f"place: the scene has {len(result.rods)} rods; say which, as at((0, 0.3)), or "
            "rods[0].at(0.3)"
        )
    return state_at(result.rods[number], s, before)


@spelled
def largest_of_all(result: Equilibrium, quantity: str, rod: int | None = None) -> Largest:
    """The largest value of a quantity along all rods, between vertices too, and where it is.

    Parameters
    ----------
    result : `Equilibrium`
        The equilibrium.
    quantity : str
        See ``RodEquilibrium.largest``.
    rod : int
        Number of the rod that is asked; default: all.

    Returns
    -------
    Largest
        With an error if a tolerance was given.

    Raises
    ------
    ValueError
        As by a rod.
    """
    scales = {
        "curvatures": result.largest_K,
        "forces": result.largest_force,
        "moments": result.largest_moment,
        "strains": 1.0,
    }
    if rod is None:
        return _first(result, lambda one, number: largest_along(one, quantity, number, scales))
    if not 0 <= whole(rod, "rod") < len(result.rods):
        raise ValueError(f"rod: there is no rod {rod}, the scene has {len(result.rods)}")
    return largest_along(result.rods[rod], quantity, rod, scales)


@spelled
def largest_sag(result: Equilibrium, direction: ArrayLike | None = None) -> Largest:
    """How far a rod hangs off the chord between its ends, and where; of several the one with most.

    Parameters
    ----------
    result : `Equilibrium`
        The equilibrium.
    direction : (3,) array
        Along which it is measured; default: where all has weight, along that; else
        across the chord, whichever way the rod goes.

    Returns
    -------
    Largest

    Raises
    ------
    ValueError
        The ends of a rod are in one place, or the direction is along its chord.
    """
    if direction is None:
        weights = [load.down for load in result.scene.loads if load.down is not None]
        direction = sum(weights) if weights else None
    longest = max(rod.rod.length for rod in result.rods)
    return _first(result, lambda rod, number: sag_along(rod, direction, number, longest))


def _first(result: Equilibrium, of: Callable[[Any, int], Largest]) -> Largest:
    return max((of(rod, i) for i, rod in enumerate(result.rods)), key=float)
