"""Solving a scene, and what there is to know of the equilibrium found."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from time import perf_counter
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from pyrod import _core
from pyrod._core import Options
from pyrod._immutable import Array, Immutable, sealed
from pyrod.errors import NotConverged, StrainWarning, UnstableWarning
from pyrod.rotation import as_frames
from pyrod.scene import Scene

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Trace = Callable[[float, float, float, float, float], Any]


@dataclass(frozen=True, eq=False, repr=False)
class Equilibrium(Immutable):
    """Equilibrium of a scene with n edges; arrays have a row per vertex (n + 1) or per edge (n).

    Positions, forces and moments are spatial; strains and whatever is called material have the
    components of the frames. Section forces and moments act from the part behind on the part
    before.
    """

    scene: Scene
    positions: Array  #: (n + 1, 3) r_j [m]
    frames: Array  #: (n, 4) of the edges; signs are continued from the clamp
    vertex_frames: Array  #: (n + 1, 4) between the edges' frames; at the ends, of the ends
    K: Array  #: (n + 1, 3) material curvature, Linn (48) [1/m]
    Gamma: Array  #: (n, 3) shear and stretch, Linn (50)
    force: Array  #: (n, 3) section force of the edges, in exact balance with the loads [N]
    material_force: Array  #: (n, 3) the same in the components of the frames
    moment: Array  #: (n + 1, 3) section moment, in balance with the loads [N m]
    material_moment: Array  #: (n + 1, 3) C_bt (K - K0)
    bend_twist_energy: float  #: Linn (49) [J]
    stretch_shear_energy: float  #: Linn (51) [J]
    status: str  #: "converged", or why not
    advice: str  #: the status in a sentence, with what to try
    index: (
        int  #: stability index: directions in which the energy falls; -1 if there is no potential
    )
    residual: float  #: largest unbalanced moment on an edge [N m]
    load_steps: int  #: 0: all loads at once; else steps in which the forces were brought on
    record: dict[str, Array]  #: one entry per iteration: step [rad], residual, energy, shift, ...
    time: float = field(compare=False)  #: of the solve [s]

    @property
    def s(self) -> Array:
        """(n + 1,) arc length at rest of the vertices [m]."""
        return self.scene.rod.arc_lengths

    @property
    def converged(self) -> bool:
        """Whether this is an equilibrium."""
        return self.status == "converged"

    @property
    def stable(self) -> bool | None:
        """Whether the energy has a minimum here, among shapes of the scene's space.

        None if the loads have no potential.
        """
        return None if self.index < 0 else self.index == 0

    @property
    def iterations(self) -> int:
        """Linear systems solved."""
        return len(self.record["step"])

    @property
    def energy(self) -> float:
        """Elastic energy [J]."""
        return self.bend_twist_energy + self.stretch_shear_energy

    @property
    def tip(self) -> Array:
        """(3,) position of the free end."""
        return self.positions[-1]

    @property
    def tip_frame(self) -> Array:
        """(4,) frame of the free end."""
        return self.vertex_frames[-1]

    @property
    def vertex_force(self) -> Array:
        """(n + 1, 3) section force at the vertices, inside the rod at its ends [N].

        Where a point force acts on a vertex, a value between those on its two sides.
        """
        return self.scene._loads.vertex_forces

    @property
    def reaction(self) -> tuple[Array, Array]:
        """Force (3,) [N] and moment (3,) [N m] that the clamp exerts on the rod."""
        loads = self.scene._loads
        return -loads.force.sum(axis=0), -self.moment[0] - loads.start_moment

    def plot(self, ax: Axes | None = None, **style: Any) -> Axes:
        """Draws the centreline and the directors a1 with matplotlib; see `pyrod.plot.draw`."""
        from pyrod.plot import draw

        return draw(self, ax, **style)

    def __repr__(self) -> str:
        how = "" if self.converged else f", {self.status}"
        stable = {None: "no potential", True: "stable", False: f"index {self.index}"}[self.stable]
        return (
            f"Equilibrium({self.scene.rod!r}, {self.iterations} iterations{how}, {stable}, "
            f"energy={self.energy:.6g}, tip=({', '.join(f'{x:.6g}' for x in self.tip)}), "
            f"{1e3 * self.time:.2g} ms)"
        )


def solve(
    scene: Scene,
    options: Options | None = None,
    *,
    start: Equilibrium | ArrayLike | None = None,
    strict: bool = True,
    verbose: bool = False,
) -> Equilibrium:
    """Static equilibrium of a scene.

    Parameters
    ----------
    scene : the rod, its clamp and its loads.
    options : tolerances and limits; see `Options`.
    start : an equilibrium of a similar scene with as many edges, or frames (n, 4) or (n, 3, 3), to
        start from; default: the shape at rest. A start is trusted to be near.
    strict : raise `NotConverged` if no equilibrium is found; otherwise look at ``status``.
    verbose : print a line per iteration.

    Raises
    ------
    NotConverged : with the last iterate in ``.result``.
    KeyboardInterrupt : Ctrl-C is looked for once per iteration.

    Warns
    -----
    UnstableWarning : the equilibrium found is a saddle of the energy.
    StrainWarning : an edge is turned inside out, or neighbours turn by more than pi.
    """
    rod = scene.rod
    began = perf_counter()
    out = _core.solve(
        rod._rod,
        _core.Dimension.__members__[scene.space],
        _core.Model.__members__[rod.model],
        scene.clamp_position,
        scene.clamp_frame,
        scene._loads,
        _start_frames(start, scene),
        options or Options(),
        _print_iteration if verbose else None,
    )
    time = perf_counter() - began
    result = Equilibrium(scene=scene, time=time, **sealed(out))
    if strict and not result.converged:
        raise NotConverged(result)
    for category, message in _doubts(result):
        warnings.warn(message, category, stacklevel=2)
    return result


def _doubts(result: Equilibrium) -> Iterator[tuple[type[Warning], str]]:
    """What a user should know before trusting an equilibrium."""
    if result.index > 0:
        message = (
            f"the equilibrium is unstable (index {result.index}): a disturbed rod leaves it; "
            "start from a shape on the side that it would fall to"
        )
        yield UnstableWarning, message
    stretch = result.Gamma[:, 2]
    if stretch.min() <= 0:
        message = (
            f"edge {int(stretch.argmin())} is compressed to {stretch.min():.3g} of its length, "
            "turned inside out: the loads exceed what EA allows"
        )
        yield StrainWarning, message
    turns = result.scene.rod.cell_lengths * np.linalg.norm(result.K, axis=1)
    if turns.max() > np.pi:
        message = (
            f"the rod turns by {turns.max():.3g} rad at vertex {int(turns.argmax())}: more edges "
            "are needed for the shape to mean anything"
        )
        yield StrainWarning, message


def _start_frames(start: Equilibrium | ArrayLike | None, scene: Scene) -> Array | None:
    if start is None:
        return None
    if isinstance(start, Equilibrium):
        return start.frames
    from pyrod.rotation import continued

    frames = as_frames(start, "start")
    return continued(np.vstack([scene.clamp_frame, frames]))[1:]


def _print_iteration(
    energy: float, residual: float, step: float, part: float, shift: float
) -> None:
    notes = (f"  part {part:.2g}" if part < 1 else "") + (f"  shift {shift:.2e}" if shift else "")
    print(f"energy {energy:+.9e}  residual {residual:.2e}  step {step:.2e} rad{notes}", flush=True)
