"""Other vertices on the same curve."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from pyrod.base.arrays import whole, yes_or_no
from pyrod.curve._places import at_arc_lengths
from pyrod.curve._polyline import Polyline
from pyrod.curve._smooth import polyline_on, smooth_curve


def resampled(arc: Polyline, edges: int, *, smooth: bool = True) -> Polyline:
    """As many edges, equal along the curve.

    Parameters
    ----------
    arc : `Polyline`
    edges : int
    smooth : bool
        On the spline through the vertices (`Polyline.smooth_curve`, needs SciPy), of which
        curvature and torsion converge; default True. On the polygon they would be those of its
        corners; lengths and positions are near those of the curve either way.
    """
    n = whole(edges, "edges")
    if n < 1:
        raise ValueError(f"edges: must be at least 1, got {n}")
    if yes_or_no(smooth, "smooth"):
        made = polyline_on(smooth_curve(arc), n).positions
    else:
        steps = np.arange(n + (not arc.closed)) / n
        made = at_arc_lengths(arc, arc.length * steps)
    return Polyline(
        made, arc.closed, arc.start_tangent, arc.end_tangent, arc.straight, arc.resolution
    )


def smoothed(arc: Polyline, noise: ArrayLike, edges: int | None = None) -> Polyline:
    """The arc without the noise of its positions; open ends are held by their tangents.

    Needs SciPy. See `Polyline.smooth_curve`, which tells curvature and torsion themselves.

    Parameters
    ----------
    arc : `Polyline`
    noise : float, (3,), (k,) or (3, 3) array [m]
        As for `Polyline.smooth_curve`.
    edges : int
        Default: as many as it has.
    """
    return polyline_on(smooth_curve(arc, noise), arc.edges if edges is None else edges)
