"""The pictures of an equilibrium as its methods."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from pyrod.plot._draw import What
    from pyrod.result.equilibrium import Equilibrium


class Pictures:
    """Mixin of `Equilibrium`: what draws it. The libraries are imported when they are needed."""

    @property
    def _drawn(self) -> Equilibrium:
        return cast("Equilibrium", self)

    def plot(
        self, ax: Any = None, *, what: What = "shape", colour_by: str | None = None, **style: Any
    ) -> Any:
        """Draws the shape, "strains", "forces" or "stability" with matplotlib.

        Parameters and what is returned: see `pyrod.plot.draw`.
        """
        from pyrod.plot import draw

        return draw(self._drawn, ax, what=what, colour_by=colour_by, **style)

    def overview(self) -> Figure:
        """All that is known in one matplotlib figure; see `pyrod.plot.overview`."""
        from pyrod.plot import overview

        return overview(self._drawn)

    def to_pyvista(self, sides: int = 24) -> Any:
        """The rods as a solid with their true cross-sections, for pyvista.

        Parameters
        ----------
        sides : into how many chords circles are cut, at least 3; default 24.

        Returns
        -------
        ``pyvista.PolyData``: closed surfaces, their quads and triangles seen from outside. Point
        data are the quantities of the vertices, cell data those of the edges, under the names they
        have in `RodEquilibrium`, besides the directors "a1", "a2", "a3" and "rod", the number of
        the rod.

        Raises
        ------
        ImportError : pyvista is not installed: ``pip install 'pyrod[view]'``.
        """
        from pyrod.pictures.view import solid

        return solid(self._drawn, sides)

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
        """Shows the rods in space with pyvista: in a window, or as an image without one.

        Supports are drawn as cubes where they hold the frame, else as balls; loads as arrows.

        Parameters
        ----------
        colour_by : a quantity, as for `plot`; default: a colour for each rod.
        frames : draw the directors a1, a2, a3 at the vertices as red, green and blue arrows.
        off_screen : open no window.
        screenshot : file for the image (.png); implies ``off_screen``.
        sides : into how many chords circles are cut; default 24.
        size : width and height of the window or image in pixels; default (1024, 768).

        Returns
        -------
        (height, width, 3) the image if no window was opened, else None once it is closed.

        Raises
        ------
        ValueError : an unknown quantity.
        ImportError : pyvista is not installed: ``pip install 'pyrod[view]'``.
        """
        from pyrod.pictures.view import show

        return show(self._drawn, colour_by, frames, off_screen, screenshot, sides, size)

    def to_html(self, path: str | Path, colour_by: str | None = None, *, sides: int = 16) -> None:
        """Writes an interactive picture as one HTML file that needs no network.

        The solid can be turned and coloured by any quantity out of a list; pointing at it tells
        arc length and value. Values of edges are shown as means at the vertices.

        Parameters
        ----------
        path : of the file.
        colour_by : the quantity shown at first, as for `plot`; default: "moment".
        sides : into how many chords circles are cut; default 16.

        Raises
        ------
        ValueError : an unknown quantity.
        ImportError : plotly is not installed: ``pip install 'pyrod[html]'``.
        """
        from pyrod.pictures.page import write_html

        write_html(self._drawn, path, colour_by, sides)
