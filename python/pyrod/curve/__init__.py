"""The difference geometry of framed curves (Linn 2020): polylines, frames, strains, knots.

Needs no mechanics. `Polyline` holds vertices, open or closed, and tells lengths, tangents, Frenet
curvature and torsion, parallel transport, writhe and link; `FramedCurve` adds a frame to each edge
and tells its strains and its twist, and rebuilds the curve from them. Frames are unit quaternions
``(w, x, y, z)`` or rotation matrices with the columns a1, a2, a3; a3 points along the curve.

Arrays have one row per vertex or one per edge. Edge j leads from vertex j to vertex j + 1 (on a
closed curve the last one leads back to vertex 0), so an open curve of n edges has n + 1 vertices
and a closed one has n.
"""

from pyrod.curve._conversions import bishop_from_frenet, frenet_from_bishop, without_repeats
from pyrod.curve._crossings import average_crossing_number, crossings, gauss_integral
from pyrod.curve._framed import FramedCurve
from pyrod.curve._gaps import split_at_gaps
from pyrod.curve._knots import Approach, Nearest
from pyrod.curve._link import linking_number
from pyrod.curve._polyline import Polyline
from pyrod.curve._poses import from_poses
from pyrod.curve._spline import SmoothCurve
from pyrod.curve._strains import Measure, reconstruct, strains

__all__ = [
    "Approach",
    "FramedCurve",
    "Measure",
    "Nearest",
    "Polyline",
    "SmoothCurve",
    "average_crossing_number",
    "bishop_from_frenet",
    "crossings",
    "frenet_from_bishop",
    "from_poses",
    "gauss_integral",
    "linking_number",
    "reconstruct",
    "split_at_gaps",
    "strains",
    "without_repeats",
]
