"""Solving a scene."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator
from time import perf_counter
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from pyrod import _core
from pyrod._core import Options
from pyrod._immutable import Array, sealed
from pyrod.equilibrium import Equilibrium, Reaction, RodEquilibrium
from pyrod.errors import NotConverged, StrainWarning, UnstableWarning
from pyrod.rotation import as_frames, continued
from pyrod.scene import Scene

Trace = Callable[[float, float, float, float, float], Any]


def solve(
    scene: Scene,
    options: Options | None = None,
    *,
    start: Equilibrium | ArrayLike | None = None,
    strict: bool = True,
    verbose: bool = False,
    stable: bool = True,
    eigenvalue: bool = False,
) -> Equilibrium:
    """Static equilibrium of a scene.

    Parameters
    ----------
    scene : the rods, their supports, joints and loads.
    options : tolerances and limits; see `Options`.
    start : an equilibrium of a similar scene with as many edges, or frames (n, 4) or (n, 3, 3) of
        the edges of all rods, to start from; default: the shape at rest, bent into the supports. A
        start is trusted to be near.
    strict : raise `NotConverged` if no equilibrium is found; otherwise look at ``status``.
    verbose : print a line per iteration.
    stable : look for a stable equilibrium, and leave saddles along their unstable modes. Otherwise
        take the equilibrium that Newton's method leads to.
    eigenvalue : find the lowest eigenvalue of the second variation, too.

    Raises
    ------
    NotConverged : with the last iterate in ``.result``.
    KeyboardInterrupt : Ctrl-C is looked for once per iteration.

    Warns
    -----
    UnstableWarning : the equilibrium found is a saddle of the energy, though a stable one was
        wanted.
    StrainWarning : an edge is turned inside out, or neighbours turn by more than pi.
    """
    began = perf_counter()
    trace = _print_iteration if verbose else None
    if scene.is_cantilever and stable and not eigenvalue:
        out = _solve_cantilever(scene, options or Options(), start, trace)
        if out["index"] > 0:  # a saddle, to be left
            frames = out["rods"][0].frames
            out = _solve_network(scene, options or Options(), frames, True, False, trace)
    else:
        out = _solve_network(scene, options or Options(), start, stable, eigenvalue, trace)
    result = Equilibrium(scene=scene, time=perf_counter() - began, **out)
    if result.converged:
        _refuse_drift(result)
    if verbose:
        print(
            f"{result.status}: {result.iterations} iterations, {result.unknowns} unknowns of which "
            f"{result.multipliers} multipliers, fill {result.fill:.2f}",
            flush=True,
        )
    if strict and not result.converged:
        raise NotConverged(result)
    for category, message in _doubts(result, stable):
        warnings.warn(message, category, stacklevel=2)
    return result


def _solve_cantilever(
    scene: Scene, options: Options, start: Any, trace: Trace | None
) -> dict[str, Any]:
    """One rod whose section forces the loads tell: frames are the only unknowns."""
    rod = scene.rods[0]
    out = _core.solve(
        rod._rod,
        _core.Dimension.__members__[scene.space],
        _core.Model.__members__[rod.model],
        scene.clamp_position,
        scene.clamp_frame,
        scene._loads[0],
        _start_frames(start, scene),
        options,
        trace,
    )
    rods = _rods(out, scene)
    loads = scene._loads[0]
    force, moment = -loads.force.sum(axis=0), -rods[0].moment[0] - loads.start_moment
    out.update(rods=rods, reactions=(Reaction(*sealed((force, moment))),))
    out["unknowns"] = rod.edges * (3 if scene.space == "spatial" else 1)
    return sealed(out)


def _solve_network(
    scene: Scene,
    options: Options,
    start: Any,
    stable: bool,
    eigenvalue: bool,
    trace: Trace | None,
) -> dict[str, Any]:
    network = scene._network
    given = None
    if start is not None:
        frames = _start_frames(start, scene)
        nodes = start._nodes if isinstance(start, Equilibrium) else None
        given = (frames, *(nodes or (np.zeros((0, 3)), np.zeros((0, 4)))))
    out = network.compiled.solve(
        _core.Dimension.__members__[scene.space],
        *scene.plane,
        given,
        options,
        stable,
        eigenvalue,
        trace,
    )
    forces, moments = out.pop("reaction_forces"), out.pop("reaction_moments")
    nodes = (out.pop("node_positions"), out.pop("node_frames"))
    reactions = tuple(Reaction(forces[v], moments[v]) for v in network.support_nodes())
    if not eigenvalue:
        out["lowest_eigenvalue"] = None
    out["mode"] = out["mode"] if len(out["mode"]) else None
    out.update(rods=_rods(out, scene), reactions=sealed(reactions), _nodes=nodes)
    return sealed(out)


def _rods(out: dict[str, Any], scene: Scene) -> tuple[RodEquilibrium, ...]:
    return tuple(
        RodEquilibrium(rod=rod, _shares=(loads.start_share, loads.end_share), **sealed(values))
        for rod, loads, values in zip(scene.rods, scene._loads, out["rods"], strict=True)
    )


def _doubts(result: Equilibrium, stable: bool) -> Iterator[tuple[type[Warning], str]]:
    """What a user should know before trusting an equilibrium."""
    if result.index > 0 and stable:
        message = (
            f"the equilibrium is unstable (index {result.index}): a disturbed rod leaves it; "
            "start from a shape on the side that it would fall to"
        )
        yield UnstableWarning, message
    for number, rod in enumerate(result.rods):
        of = f" of rod {number}" if len(result.rods) > 1 else ""
        stretch = rod.Gamma[:, 2]
        if stretch.min() <= 0:
            message = (
                f"edge {int(stretch.argmin())}{of} is compressed to {stretch.min():.3g} of its "
                "length, turned inside out: the loads exceed what EA allows"
            )
            yield StrainWarning, message
        turns = rod.rod.cell_lengths * np.linalg.norm(rod.K, axis=1)
        if turns.max() > np.pi:
            message = (
                f"the rod turns by {turns.max():.3g} rad at vertex {int(turns.argmax())}{of}: more "
                "edges are needed for the shape to mean anything"
            )
            yield StrainWarning, message


def _refuse_drift(result: Equilibrium) -> None:
    """Forces that follow the rods, in directions in which nothing holds these: no equilibrium.

    Of dead forces it is known before the solve. A ring under pressure may drift, but need not.
    """
    scene = result.scene
    if not any(load.follower for load in scene.loads):
        return
    acting = np.vstack([rod.load for rod in result.rods] + [r.force for r in result.reactions])
    left = acting.sum(axis=0)
    for number, support in enumerate(scene.supports):
        if support._springs[0] == 0:
            free = support._free(scene._held(number)[1])
            left = left - (result.reactions[number].force @ free.T) @ free
    if np.linalg.norm(left) > 1e-6 * np.abs(acting).sum():
        raise ValueError(
            f"supports: nothing holds the rods against the force {left} of the loads that follow "
            "them; hold a point of them"
        )


def _start_frames(start: Equilibrium | ArrayLike | None, scene: Scene) -> Array | None:
    if start is None:
        return None
    if isinstance(start, Equilibrium):
        return np.vstack([rod.frames for rod in start.rods])
    frames = as_frames(start, "start")
    if len(scene.rods) > 1:
        return frames
    first = scene.clamp_frame if scene.supports else frames[0]
    return continued(np.vstack([first, frames]))[1:]


def _print_iteration(
    energy: float, residual: float, step: float, part: float, shift: float
) -> None:
    notes = (f"  part {part:.2g}" if part < 1 else "") + (f"  shift {shift:.2e}" if shift else "")
    print(f"energy {energy:+.9e}  residual {residual:.2e}  step {step:.2e} rad{notes}", flush=True)
