"""An equilibrium in a few lines, and as an object for programs."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from pyrod.base.immutable import Array
from pyrod.result.equilibrium import Equilibrium


def in_numbers(result: Equilibrium) -> dict[str, Any]:
    """What programs read: numbers in SI units."""
    return {
        "status": result.status,
        "converged": result.converged,
        "stable": result.stable,
        "index": result.index,
        "neutral": result.neutral,
        "lowest_eigenvalue": result.lowest_eigenvalue,
        "energy": result.energy,
        "iterations": result.iterations,
        "seconds": result.time,
        "tol": None if result.accuracy is None else result.accuracy.tol,
        "errors": result.errors,
        "model": [rod.rod.model for rod in result.rods],
        "choice": result.choice,
        "edges": [rod.rod.edges for rod in result.rods],
        "tips": [rod.tip for rod in result.rods],
        "largest_curvature": [rod.largest_K for rod in result.rods],
        "largest_force": [rod.largest_force for rod in result.rods],
        "largest_moment": [rod.largest_moment for rod in result.rods],
        "reactions": [
            {"support": type(support).__name__, "force": r.force, "moment": r.moment}
            for support, r in zip(result.scene.supports, result.reactions, strict=True)
        ],
        "tendons": [tendon._asdict() for tendon in result.tendons],
    }


def lines(result: Equilibrium) -> Iterator[str]:
    """What people read."""
    told = in_numbers(result)
    stable = {None: "unknown, the loads have no potential", True: "yes"}.get(
        result.stable, f"no: the energy falls in {result.index} directions"
    )
    yield f"status       {result.status} after {result.iterations} iterations, " + (
        f"{1e3 * result.time:.3g} ms"
    )
    if result.accuracy is not None:
        a = result.accuracy
        yield f"error        {a.reached:.1e} of {a.tol:.0e} allowed, on {a.grids} grids"
    if result.choice is not None:
        yield f"model        {result.choice}"
    yield f"stable       {stable}" + (f"; {result.free_motion}" if result.free_motion else "")
    if result.lowest_eigenvalue is not None:
        yield f"eigenvalue   {result.lowest_eigenvalue:.6g} N m"
    yield f"energy       {result.energy:.8g} J"
    for i, rod in enumerate(result.rods):
        name = "rod" if len(result.rods) == 1 else f"rod {i}"
        yield f"{name:12s} {rod.rod.model}, {rod.rod.edges} edges, end at {_vector(rod.tip)} m"
        yield " " * 13 + ", ".join(
            f"{what} up to {told[f'largest_{what}'][i]:.4g} {unit}"
            for what, unit in (("curvature", "1/m"), ("force", "N"), ("moment", "N m"))
        )
    for reaction in told["reactions"]:
        force, moment = _vector(reaction["force"]), _vector(reaction["moment"])
        yield f"{reaction['support']:12s} exerts {force} N, {moment} N m"
    for tendon in result.tendons:
        yield f"tendon       {tendon.tension:.6g} N, {tendon.length:.8g} m long"


def _vector(values: Array) -> str:
    return "({:.6g}, {:.6g}, {:.6g})".format(*(values + 0.0))
