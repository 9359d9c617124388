"""The solid that rods fill, in the formats of CAD and of 3D graphics."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from pyrod.base.optional import need
from pyrod.pictures.measure import measure
from pyrod.pictures.swept import Swept, swept
from pyrod.result.equilibrium import Equilibrium


def save_stl(result: Equilibrium, path: Path, *, sides: int = 24) -> None:
    """As triangles alone."""
    _mesh(swept(result, sides)).export(path)


def save_painted(
    result: Equilibrium, path: Path, *, sides: int = 24, colour_by: str | None = None
) -> None:
    """As triangles whose corners may have the colours of a quantity."""
    surface = swept(result, sides)
    if colour_by is None:
        _mesh(surface).export(path)
        return
    values = surface.at_points(measure(result, colour_by).at_vertices)
    _mesh(surface, vertex_colors=_colours(values)).export(path)


def _mesh(surface: Swept, **colours: Any) -> Any:
    trimesh = need("trimesh", "files")
    return trimesh.Trimesh(surface.points, surface.triangles, process=False, **colours)


def _colours(values: np.ndarray) -> np.ndarray:
    """(p, 4) bytes: the least value is dark blue, the largest yellow."""
    part = (values - values.min()) / (np.ptp(values) or 1.0)
    return need("matplotlib", "plot").colormaps["viridis"](part, bytes=True)
