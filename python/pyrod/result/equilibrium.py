"""What there is to know of an equilibrium."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from pyrod.base.arrays import number
from pyrod.base.borrowed import borrowed
from pyrod.base.immutable import Array, Immutable, Lazy, lazily, made_later
from pyrod.base.words import meant
from pyrod.result.accuracy import Accuracy, Untold
from pyrod.result.rods import OfTheOnlyRod, Reaction, RodEquilibrium, TendonEquilibrium, longest
from pyrod.result.told import Largest, RodAt
from pyrod.rod.place import Place
from pyrod.rotation import exp, multiply, rotate
from pyrod.scene.scene import Scene

if TYPE_CHECKING:
    from matplotlib.figure import Figure


_TUPLES: dict[str, Callable[..., Any]] = {"reactions": Reaction, "tendons": TendonEquilibrium}


@dataclass(frozen=True, eq=False, repr=False)
class Equilibrium(Lazy, Immutable, OfTheOnlyRod):
    """Equilibrium of a scene: its ``rods``, and how it was found.

    Of a scene with one rod, all that `RodEquilibrium` knows is to be had directly: ``positions``,
    ``frames``, ``K``, ``force``, ``moment``, ``tip`` and so on.
    """

    scene: Scene
    rods: tuple[RodEquilibrium, ...]
    reactions: tuple[Reaction, ...]  #: of the scene's supports, in their order
    tendons: tuple[TendonEquilibrium, ...]  #: of the scene's actuators, in their order
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

    if not TYPE_CHECKING:  # who would find every name

        def __getattr__(self, name: str) -> Any:
            return _found_later(self, name)

    def __dir__(self) -> list[str]:
        """With what is known of the only rod."""
        of_rod = dir(self.rods[0]) if len(self.rods) == 1 else ()
        return sorted({*super().__dir__(), *of_rod})

    @property
    def errors(self) -> dict[str, float]:
        """Estimates of the errors, if a tolerance was given, else none; see `Accuracy`."""
        return Untold() if self.accuracy is None else self.accuracy.errors

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

    @property
    def bending_radius(self) -> float:
        """Smallest radius to which a rod is bent [m], between vertices, too; inf if straight."""
        return min(rod.bending_radius for rod in self.rods)

    @borrowed("pyrod.result.places:at_place")
    def at(self, place: Place | ArrayLike, before: bool = False) -> RodAt:  # type: ignore[empty-body]
        """A rod at a place, or at several, between its vertices, too."""

    @borrowed("pyrod.result.places:largest_of_all")
    def largest(self, quantity: str, rod: int | None = None) -> Largest:  # type: ignore[empty-body]
        """The largest value of a quantity along all rods, and where it is."""

    @borrowed("pyrod.result.places:largest_sag")
    def sag(self, direction: ArrayLike | None = None) -> Largest:  # type: ignore[empty-body]
        """How far a rod hangs off the chord between its ends."""

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
            return f"everything turns about the direction {_direction_in_words(turns.mean(axis=0))}"
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
        for at, reaction in zip(self.support_positions, self.reactions, strict=True):
            forces.append(reaction.force)
            moments += [np.cross(at, reaction.force), reaction.moment]
        force = _sum_of_lengths(forces) + max(longest(rod.force) for rod in self.rods)
        moment = _sum_of_lengths(moments) + max(longest(rod.moment) for rod in self.rods)
        if self.tendons:  # sums may be nothing beside their parts
            force += max(longest(rod.backbone_force) for rod in self.rods)
            moment += max(longest(rod.material_moment) for rod in self.rods)
        length = max(rod.rod.length for rod in self.rods)
        return (
            _sum_of_lengths([np.sum(forces, axis=0)]) / (force or 1.0),
            _sum_of_lengths([np.sum(moments, axis=0)]) / (moment + length * force or 1.0),
        )

    @property
    def support_positions(self) -> list[Array]:
        """Where the points are that supports hold."""
        vertices = (self.scene._compiled.vertex(support.at) for support in self.scene.supports)
        return [self.rods[rod].positions[vertex] for rod, vertex in vertices]

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


def _found_later(result: Equilibrium, name: str) -> Any:
    """What is made when it is asked for, and what is known of the only rod."""
    state = result.__dict__
    if name in OfTheOnlyRod.__annotations__:
        if len(result.rods) != 1:
            raise AttributeError(
                f"{name}: the scene has {len(result.rods)} rods; see rods[i].{name}"
            )
        return getattr(result.rods[0], name)
    made: Any
    if name == "rods" and "_made_of" in state:
        found = state["_compiled"]
        known = {"accuracy": result.accuracy}
        made = tuple(
            [
                lazily(RodEquilibrium, found.rod(i), rod=rod, **known)
                for i, rod in enumerate(state["_made_of"])
            ]
        )
    elif name == "scene" and "_make_scene" in state:
        made = state["_make_scene"]()
    else:
        try:
            made = made_later(result, name)
        except AttributeError:
            several = name[0] != "_" and len(result.rods) > 1
            guess = meant(name, OfTheOnlyRod.__annotations__) if several else ""
            if not guess:
                raise
            guess = guess.replace("mean ", "mean rods[i].")
            raise AttributeError(f"Equilibrium has no {name!r}{guess}", obj=None) from None
        kind = _TUPLES.get(name)
        if kind is None:
            return made
        made = tuple([kind(*one) for one in made])
    state[name] = made
    return made


def _direction_in_words(vector: Array) -> str:
    return "({:.3g}, {:.3g}, {:.3g})".format(*vector / np.linalg.norm(vector))


def _sum_of_lengths(vectors: list[Array]) -> float:
    return float(np.linalg.norm(vectors, axis=1).sum())
