"""What there is to know of an equilibrium."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np

import pyrod._core as _core
from pyrod.base.arrays import number
from pyrod.base.borrowed import borrowed
from pyrod.base.immutable import Array, Immutable, Lazy
from pyrod.result.accuracy import Accuracy
from pyrod.rod.rod import Rod
from pyrod.rotation import conjugate, exp, multiply, rotate
from pyrod.scene.scene import Scene
from pyrod.scene.supports import Support

if TYPE_CHECKING:
    from matplotlib.figure import Figure


class Reaction(NamedTuple):
    """What a support exerts on the rods, in space."""

    force: Array  #: (3,) [N]
    moment: Array  #: (3,) [N m], about the point that is held


@dataclass(frozen=True, eq=False, repr=False)
class RodEquilibrium(Lazy, Immutable):
    """One rod of n edges in equilibrium; arrays have a row per vertex (n + 1) or per edge (n).

    Positions, forces and moments are spatial; strains and whatever is called material have the
    components of the frames. Section forces and moments act from the part behind on the part
    before.

    Where a support, a joint or a load acts on an inner vertex, or stiffness or the curvature at
    rest jumps there, curvature, section force and moment may have two values. Arrays hold those
    just behind the vertex; ``K_before``, ``vertex_force_before`` and ``moment_before`` hold those
    just before it, and everywhere else the same.
    """

    rod: Rod
    positions: Array  #: (n + 1, 3) r_j [m]
    frames: Array  #: (n, 4) of the edges; signs are continued along the rod
    vertex_frames: Array  #: (n + 1, 4) between the edges' frames; at the ends, of the ends
    K: Array  #: (n + 1, 3) material curvature, Linn (48) [1/m]; where it jumps, just behind
    K_before: Array  #: (n + 1, 3) the same; where it jumps, just before
    Gamma: Array  #: (n, 3) shear and stretch, Linn (50)
    force: Array  #: (n, 3) section force of the edges, in exact balance with the loads [N]
    vertex_force: Array
    """(n + 1, 3) section force at the vertices, inside the rod at its ends [N].

    Where a point force acts on an inner vertex, or a support, just behind it.
    """
    vertex_force_before: Array  #: (n + 1, 3) the same; where it jumps, just before
    material_force: Array  #: (n, 3) the same in the components of the frames
    moment: Array  #: (n + 1, 3) section moment, in balance with the loads [N m]; where it jumps,
    #: just behind
    moment_before: Array  #: (n + 1, 3) the same; where it jumps, just before
    material_moment: Array  #: (n + 1, 3) C_bt (K - K0)
    load: Array  #: (n + 1, 3) what acts on the vertices [N]
    load_moment: Array  #: (3,) sum of the moments that act on the rod [N m]
    bend_twist_energy: float  #: Linn (49) [J]
    stretch_shear_energy: float  #: Linn (51) [J]
    largest_K: float
    """Largest ``|K|`` along the rod [1/m], between vertices too.

    Of a solve with a tolerance that of the continuous rod, with the error that ``errors`` tells of
    ``extremes``; else of a smooth curve through the values at the vertices. So are the next two.
    """
    largest_force: float  #: largest section force [N]
    largest_moment: float  #: largest section moment [N m]

    @classmethod
    def _of(cls, rod: Rod, source: _core.RodSolution) -> RodEquilibrium:
        self = object.__new__(cls)
        self.__dict__.update(rod=rod, _source=source)
        return self

    @property
    def s(self) -> Array:
        """(n + 1,) arc length at rest of the vertices [m]."""
        return self.rod.arc_lengths

    @property
    def energy(self) -> float:
        """Elastic energy [J]."""
        return self.bend_twist_energy + self.stretch_shear_energy

    @property
    def tip(self) -> Array:
        """(3,) position of the end."""
        return self.positions[-1]

    @property
    def tip_frame(self) -> Array:
        """(4,) frame of the end."""
        return self.vertex_frames[-1]

    @borrowed("pyrod.notebook.views:rod_equilibrium_html")
    def _repr_html_(self) -> str:  # type: ignore[empty-body]
        """What notebooks show."""

    def __repr__(self) -> str:
        tip = ", ".join(f"{x:.6g}" for x in self.tip)
        return f"RodEquilibrium({self.rod!r}, energy={self.energy:.6g}, tip=({tip}))"


@dataclass(frozen=True, eq=False, repr=False)
class Equilibrium(Lazy, Immutable):
    """Equilibrium of a scene: its ``rods``, and how it was found.

    Of a scene with one rod, all that `RodEquilibrium` knows is to be had directly: ``positions``,
    ``frames``, ``K``, ``force``, ``moment``, ``tip`` and so on.
    """

    scene: Scene
    rods: tuple[RodEquilibrium, ...]
    reactions: tuple[Reaction, ...]  #: of the scene's supports, in their order
    status: str  #: "converged", or why not
    advice: str  #: the status in a sentence, with what to try
    index: int
    """Stability index, the directions in which the energy falls; -1 if there is no potential."""
    residual: float  #: largest unbalanced moment on an edge, or its like [N m]
    load_steps: int  #: in which the loads were brought on; 0 if all at once
    record: dict[str, Array]  #: an entry per iteration, of step [rad], residual, energy, ...
    time: float = field(compare=False)  #: of the solve [s]
    descents: int  #: saddles that the search has left along their unstable modes
    unknowns: int  #: of the last linear system, with the multipliers
    multipliers: int  #: components of section forces among them
    fill: float  #: entries of the factor over those of the matrix
    lowest_eigenvalue: float | None
    """Of the second variation on the constraints, for modes with ``int |phi|^2 ds/L = 1`` [N m]."""
    neutral: bool
    """It can move along ``mode`` without a change of energy, as a mechanism, or one of a family."""
    mode: Array | None
    """(edges of all rods, 3) turns of the edges in their frames [rad] in the lowest mode.

    The largest component is 1. Known if it was asked for, or if the equilibrium is neutral.
    """
    accuracy: Accuracy | None = None
    """What is known of the errors, if a tolerance was given."""
    choice: str | None = None
    """Which model was chosen and why, if that was left to the solver."""

    @classmethod
    def _of(cls, source: _core.Equilibrium, **known: Any) -> Equilibrium:
        self = object.__new__(cls)
        self.__dict__.update(_source=source, **known)
        return self

    def __getattr__(self, name: str) -> Any:
        """What is made when it is asked for, and what is known of the only rod."""
        if name.startswith("_") or not (hasattr(RodEquilibrium, name) or name in _ROD_FIELDS):
            return Lazy.__getattr__(self, name)
        rods = self.__dict__["rods"]
        if len(rods) != 1:
            raise AttributeError(f"{name}: the scene has {len(rods)} rods; see rods[i].{name}")
        return getattr(rods[0], name)

    def __dir__(self) -> list[str]:
        """With what is known of the only rod."""
        rods = self.__dict__["rods"]
        return sorted({*super().__dir__(), *(dir(rods[0]) if len(rods) == 1 else ())})

    @property
    def errors(self) -> dict[str, float] | None:
        """Estimates of the errors, if a tolerance was given; see `Accuracy`."""
        return None if self.accuracy is None else self.accuracy.errors

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
        """Linear systems solved, on all grids."""
        return len(self.record["step"])

    @property
    def bend_twist_energy(self) -> float:
        """Bending and twisting energy of all rods, Linn (49) [J]."""
        return sum(rod.bend_twist_energy for rod in self.rods)

    @property
    def stretch_shear_energy(self) -> float:
        """Stretching and shearing energy of all rods, Linn (51) [J]."""
        return sum(rod.stretch_shear_energy for rod in self.rods)

    @property
    def energy(self) -> float:
        """Elastic energy of all rods [J]."""
        return self.bend_twist_energy + self.stretch_shear_energy

    @property
    def largest_K(self) -> float:
        """Largest curvature of all rods [1/m], between vertices too; see `RodEquilibrium`."""
        return max(rod.largest_K for rod in self.rods)

    @property
    def largest_force(self) -> float:
        """Largest section force of all rods [N], between vertices too."""
        return max(rod.largest_force for rod in self.rods)

    @property
    def largest_moment(self) -> float:
        """Largest section moment of all rods [N m], between vertices too."""
        return max(rod.largest_moment for rod in self.rods)

    @property
    def reaction(self) -> Reaction:
        """What the only support exerts."""
        if len(self.reactions) != 1:
            raise ValueError(
                f"reaction: the scene has {len(self.reactions)} supports, see reactions"
            )
        return self.reactions[0]

    @borrowed("pyrod.models.effects:effect")
    def effect(
        self,
        of: Literal["extension", "shear", "strains", "space"],
        quantity: Callable[[Equilibrium], float | Array] | None = None,
    ) -> Any:
        """What "extension", "shear", "strains" or "space" would change, an `Effect`."""

    @property
    @borrowed("pyrod.models.effects:out_of_plane_index")
    def out_of_plane_index(self) -> int | None:
        """Directions out of the plane in which the energy falls; see `pyrod.out_of_plane_index`."""

    def along_mode(self, amplitude: float) -> Array:
        """(edges of all rods, 4) frames displaced along the mode: a start for other equilibria.

        ``amplitude`` [rad] is the largest turn, of either sign. Needs a solve with
        ``eigenvalue=True``.
        """
        if self.mode is None:
            raise ValueError("along_mode: there is no mode; solve with eigenvalue=True")
        amplitude = number(amplitude, "amplitude")
        frames = np.vstack([rod.frames for rod in self.rods])
        return multiply(frames, exp(amplitude * self.mode))

    @property
    def free_motion(self) -> str | None:
        """The motion that costs no energy, in words; None if there is none."""
        if not self.neutral or self.mode is None:
            return None
        frames = np.vstack([rod.frames for rod in self.rods])
        turns = rotate(frames, self.mode)
        if np.abs(turns - turns.mean(axis=0)).max() < 1e-3:
            return f"everything turns about the direction {_direction(turns.mean(axis=0))}"
        if np.abs(self.mode[:, :2]).max() < 1e-3:
            return "rods turn about their own axes"
        return "the shape goes over into others of the same energy"

    @cached_property
    def balance(self) -> tuple[float, float]:
        """What is missing to the balance of all forces and of all moments, relative to their sizes
        and to the section forces and moments.

        Computed from positions, loads and reactions alone, by no formula of the solver: in an
        equilibrium both are rounding.
        """
        forces, moments = [], []
        for rod in self.rods:
            forces += list(rod.load)
            moments += [*np.cross(rod.positions, rod.load), rod.load_moment]
        for support, reaction in zip(self.scene.supports, self.reactions, strict=True):
            forces.append(reaction.force)
            at = self._support_position(support)
            moments += [np.cross(at, reaction.force), reaction.moment]
        force = _size(forces) + max(longest(rod.force) for rod in self.rods)
        moment = _size(moments) + max(longest(rod.moment) for rod in self.rods)
        length = max(rod.rod.length for rod in self.rods)
        return (
            _size([np.sum(forces, axis=0)]) / (force or 1.0),
            _size([np.sum(moments, axis=0)]) / (moment + length * force or 1.0),
        )

    def _support_position(self, support: Support) -> Array:
        rod, vertex = self.scene._vertex(support.at)
        return self.rods[rod].positions[vertex]

    # Pictures and files ---------------------------------------------------------------------------

    @borrowed("pyrod.plot:draw")
    def plot(
        self,
        ax: Any = None,
        *,
        what: Literal["shape", "strains", "forces", "stability"] = "shape",
        directors: bool = True,
        colour_by: str | None = None,
        **style: Any,
    ) -> Any:
        """Draws the shape, "strains", "forces" or "stability" with matplotlib."""

    @borrowed("pyrod.plot:overview")
    def overview(self) -> Figure:  # type: ignore[empty-body]
        """All that is known in one matplotlib figure."""

    @borrowed("pyrod.pictures.view:solid")
    def to_pyvista(self, sides: int = 24) -> Any:
        """The rods as a solid with their true cross-sections, for pyvista."""

    @borrowed("pyrod.pictures.view:show")
    def show(
        self,
        colour_by: str | None = None,
        *,
        frames: bool = False,
        off_screen: bool = False,
        screenshot: str | Path | None = None,
        sides: int = 24,
        size: tuple[int, int] = (1024, 768),
    ) -> Any:
        """Shows the rods in space with pyvista: in a window, or as an image without one."""

    @borrowed("pyrod.pictures.page:write_html")
    def to_html(self, path: str | Path, colour_by: str | None = None, *, sides: int = 16) -> None:
        """Writes an interactive picture as one HTML file that needs no network."""

    @borrowed("pyrod.files:save")
    def save(self, path: str | Path, **options: Any) -> None:
        """Writes this to a file whose suffix tells the format; see `pyrod.save`."""

    @borrowed("pyrod.notebook.views:equilibrium_html")
    def _repr_html_(self) -> str:  # type: ignore[empty-body]
        """What notebooks show."""

    def __repr__(self) -> str:
        how = "" if self.converged else f", {self.status}"
        stable = {None: "no potential", True: "stable", False: f"index {self.index}"}[self.stable]
        stable += ", neutral" if self.neutral else ""
        what = f"{self.scene.rods[0]!r}" if len(self.rods) == 1 else f"{len(self.rods)} rods"
        tip = ""
        if len(self.rods) == 1:
            tip = f"tip=({', '.join(f'{x:.6g}' for x in self.rods[0].tip)}), "
        tip += f"{self.accuracy}, " if self.accuracy else ""
        return (
            f"Equilibrium({what}, {self.iterations} iterations{how}, {stable}, "
            f"energy={self.energy:.6g}, {tip}{1e3 * self.time:.2g} ms)"
        )


_ROD_FIELDS = frozenset(RodEquilibrium.__dataclass_fields__)


def _direction(vector: Array) -> str:
    return "({:.3g}, {:.3g}, {:.3g})".format(*vector / np.linalg.norm(vector))


def _size(vectors: list[Array]) -> float:
    return float(np.linalg.norm(vectors, axis=1).sum())


def longest(vectors: Array) -> float:
    """The largest Euclidean norm of the rows."""
    return float(np.linalg.norm(vectors, axis=1).max())


def largest_turn(a: RodEquilibrium, b: RodEquilibrium) -> float:
    """The largest angle between the frames of two shapes at the same vertex [rad]."""
    turn = multiply(conjugate(a.vertex_frames), b.vertex_frames)
    return float(2 * np.arctan2(np.linalg.norm(turn[:, 1:], axis=1), np.abs(turn[:, 0])).max())
