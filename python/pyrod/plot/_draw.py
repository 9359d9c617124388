"""The pictures by name."""

from __future__ import annotations

from typing import Any, Literal

from pyrod.base.optional import need
from pyrod.base.words import meant, shortly
from pyrod.plot._along import PANELS, draw_along
from pyrod.plot._mode import draw_mode
from pyrod.plot._shape import draw_shape
from pyrod.result.equilibrium import Equilibrium

What = Literal["shape", "strains", "forces", "stability"]


def draw(
    result: Equilibrium,
    ax: Any = None,
    *,
    what: What = "shape",
    directors: bool = True,
    colour_by: str | None = None,
    **style: Any,
) -> Any:
    """Draws an equilibrium with matplotlib.

    Values of edges are drawn as steps, those of vertices as lines between them; where the shape is
    coloured, a vertex colours its two half edges. Several rods have a colour each.

    Parameters
    ----------
    result : `pyrod.Equilibrium`
        What to draw.
    ax : Axes
        Axes to draw on; made if not given. Shapes are drawn on flat axes for a planar scene, else
        on three-dimensional ones; "strains" and "forces" take a sequence of two, one below the
        other.
    what : "shape", "strains", "forces" or "stability"
        "shape" (default): the centrelines, with a fringe along director a1 that shows how the rod
        is twisted; "strains": K - K0 and Gamma - e3 along the rod, the latter if a model has it;
        "forces": section forces and moments along the rod; "stability": the shape displaced both
        ways along the lowest mode, with stability index and lowest eigenvalue.
    directors : bool
        Draw the fringe (of shapes in space only); default True.
    colour_by : str
        Colour the shape by a quantity, with a colour bar: a name out of `pyrod.RodEquilibrium` for
        its magnitude ("moment"), or with a component ("moment.x", "material_moment.1").
    style : object
        Passed to ``Axes.plot``, of values of edges to ``Axes.stairs``.

    Returns
    -------
    Axes
        An array of two for "strains" and "forces". Shapes have equal scales and are labelled with
        coordinates in metres.

    Raises
    ------
    ValueError
        An unknown picture or quantity, axes that do not fit, "stability" of an equilibrium without
        a mode: solve with ``eigenvalue=True``.
    ImportError
        matplotlib is not installed: ``pip install 'pyrod[plot]'``.
    """
    need("matplotlib.pyplot", "plot")
    if "color_by" in style:
        raise TypeError("color_by: it is written colour_by")
    if isinstance(ax, str):
        raise TypeError(f"ax: expected axes of matplotlib, got {ax!r}; pictures go by what={ax!r}")
    if what not in ("shape", "stability", *PANELS):
        raise ValueError(
            f"what: expected one of shape, {', '.join(PANELS)}, stability, got {shortly(what)}"
            f"{meant(str(what), ('shape', *PANELS, 'stability'))}"
        )
    if colour_by is not None and what != "shape":
        raise ValueError(f"colour_by: only the shape can be coloured, not what={shortly(what)}")
    if what in PANELS:
        return draw_along(result, PANELS[what], ax, style)
    if what == "stability":
        return draw_mode(result, ax, style)
    return draw_shape(result, ax, directors, colour_by, style)
