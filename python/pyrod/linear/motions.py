"""What modes of all kinds have in common: their shapes, pictures and animations."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pyrod.base.arrays import whole
from pyrod.base.immutable import Immutable
from pyrod.base.words import shortly
from pyrod.files.atomic import replacing
from pyrod.pictures.displaced import Motion, displaced
from pyrod.pictures.view import show
from pyrod.plot._mode import draw_motion
from pyrod.plot._moving import write_moving
from pyrod.result.equilibrium import Equilibrium

AnyArray = NDArray[Any]


@dataclass(frozen=True, eq=False)
class Motions(Immutable):
    """Small motions about an equilibrium, the first modes of some kind."""

    result: Equilibrium = field(repr=False)  #: about which they are
    shapes: tuple[AnyArray, ...] = field(repr=False)
    """Of each rod (k, n + 1, 3) displacements of the vertices, in space."""
    frames: tuple[AnyArray, ...] = field(repr=False)
    """Of each rod (k, n, 3) rotation vectors of the edges, in the components of their frames."""

    def title(self, number: int) -> str:
        """A mode in a few words."""
        raise NotImplementedError

    def motion(self, number: int) -> Motion:
        """One mode, as pictures take it."""
        number, count = whole(number, "number"), len(self.shapes[0])
        if not 0 <= number < count:
            raise ValueError(f"number: there are {count} modes, from 0; got {number}")
        moves = tuple(shape[number] for shape in self.shapes)
        turns = tuple(frame[number] for frame in self.frames)
        return Motion(self.result, moves, turns, f"mode {number}: {self.title(number)}")

    def plot(self, number: int = 0, ax: Any = None, **style: Any) -> Any:
        """Draws the shape displaced both ways along a mode with matplotlib.

        Parameters
        ----------
        number : int
            Of the mode, from 0.
        ax : Axes
            Axes to draw on; made if not given. Flat for a planar scene, else three-dimensional.
        style : object
            Passed to ``Axes.plot``.

        Returns
        -------
        Axes
            With the mode in words as its title.

        Raises
        ------
        ImportError
            matplotlib is not installed: ``pip install 'pyrod[plot]'``.
        """
        return draw_motion(self.motion(number), ax, style)

    def show(self, number: int = 0, colour_by: str | None = None, **options: Any) -> Any:
        """Shows the rods displaced along a mode in space with pyvista.

        Parameters
        ----------
        number : int
            Of the mode, from 0.
        colour_by : str
            A quantity of the equilibrium, as for `Equilibrium.show`.
        options : object
            Those of `Equilibrium.show`: ``off_screen``, ``screenshot``, ``sides``, ``size`` ...

        Returns
        -------
        (height, width, 3) array or None
            As `Equilibrium.show`.
        """
        return show(displaced(self.motion(number), 0.0), colour_by, **options)

    def animate(
        self, number: int, path: str | Path, *, frames: int = 40, seconds: float = 2.0
    ) -> None:
        """Writes one period of a mode, which goes on for ever, as a moving picture.

        Parameters
        ----------
        number : int
            Of the mode, from 0.
        path : str or Path
            A file: .gif, .mp4 (needs ffmpeg) or .html, which needs no network.
        frames : int
            Pictures in a period, at least 2.
        seconds : float [s]
            That a period takes in the picture.

        Raises
        ------
        ValueError
            Another suffix, a mode that is not there.
        RuntimeError
            There is no ffmpeg.
        ImportError
            matplotlib is not installed: ``pip install 'pyrod[plot]'``.
        """
        motion = self.motion(number)
        with replacing(Path(path)) as temporary:
            write_moving(motion, temporary, frames, seconds)


def by_rod(told: Sequence[Mapping[str, Any]], rods: int, name: str) -> tuple[AnyArray, ...]:
    """Of each rod (k, ...) what several answers tell of a quantity."""
    return tuple(np.array([one[f"rods.{i}.{name}"] for one in told]) for i in range(rods))


def checked_count(count: int, name: str) -> int:
    """How many modes are asked for."""
    if isinstance(count, bool) or not isinstance(count, (int, np.integer)) or count < 1:
        raise ValueError(f"{name}: expected a number of them, 1 or more, got {shortly(count)}")
    return int(count)
