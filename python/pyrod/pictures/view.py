"""Rods in space with pyvista, which is imported when they are shown."""

from __future__ import annotations

import os
import subprocess
import sys
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from pyrod.base.calls import spelled
from pyrod.base.immutable import Array
from pyrod.base.optional import need
from pyrod.pictures.measure import measure
from pyrod.pictures.swept import Swept, swept
from pyrod.result.equilibrium import Equilibrium
from pyrod.result.fields import field
from pyrod.result.rods import RodEquilibrium
from pyrod.result.tendons import ways
from pyrod.rod.place import on_rod

PALETTE = np.array(
    [(31, 119, 180), (255, 127, 14), (44, 160, 44), (148, 103, 189), (140, 86, 75)], dtype=np.uint8
)
"""Colours of rods, one after the other."""
BAR = {"title_font_size": 16, "label_font_size": 14, "width": 0.6, "position_x": 0.2}
DIRECTORS = {"a1": "red", "a2": "green", "a3": "blue"}
BACKGROUND = "white"
MOST_FILLED = 0.7  # of the width or height of the picture; below is the colour bar
SHARP = 30.0  # degrees between faces that are shaded as an edge
MOST_FRAMES = 60  # on each rod: more would hide it


@spelled
def solid(result: Equilibrium, sides: int = 24) -> Any:
    """The rods as a solid with their true cross-sections, for pyvista.

    Parameters
    ----------
    result : `Equilibrium`
        What to show.
    sides : int
        Into how many chords circles are cut, at least 3; default 24.

    Returns
    -------
    ``pyvista.PolyData``
        Closed surfaces, their quads and triangles seen from outside. Point data are the quantities
        of the vertices, cell data those of the edges, under the names they have in
        `RodEquilibrium`, besides the directors "a1", "a2", "a3" and "rod", the number of the rod.

    Raises
    ------
    ImportError
        pyvista is not installed: ``pip install 'pyrod[view]'``.
    """
    mesh = swept(result, sides)
    poly = _poly(mesh)
    at_points, on_faces = mesh.quantities(result)
    poly.point_data.update(at_points)
    poly.cell_data.update(on_faces)
    return poly


def _poly(mesh: Swept) -> Any:
    """The bare surface."""
    faces = [np.column_stack([np.full(len(f), f.shape[1]), f]) for f in (mesh.quads, mesh.caps)]
    pyvista = need("pyvista", "view")
    return pyvista.PolyData(mesh.points, np.concatenate([f.ravel() for f in faces]))


@spelled
def show(
    result: Equilibrium,
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
    result : `Equilibrium`
        What to show.
    colour_by : str
        A quantity, as for `Equilibrium.plot`; default: a colour for each rod.
    frames : bool
        Draw the directors a1, a2, a3 at the vertices as red, green and blue arrows.
    off_screen : bool
        Open no window.
    screenshot : str or Path
        File for the image (.png); implies ``off_screen``.
    sides : int
        Into how many chords circles are cut; default 24.
    size : (int, int)
        Width and height of the window or image in pixels; default (1024, 768).

    Returns
    -------
    (height, width, 3) array or None
        The image if no window was opened, else None once it is closed.

    Raises
    ------
    ValueError
        An unknown quantity.
    ImportError
        pyvista is not installed: ``pip install 'pyrod[view]'``.
    """
    hidden = off_screen or screenshot is not None
    if hidden and sys.platform.startswith("linux") and "DISPLAY" not in os.environ:
        check_drawing_without_display()
    with need("pyvista", "view").vtk_verbosity("error"):  # VTK warns that there is no display
        plotter = scene(result, colour_by, frames, hidden, sides, size)
        if not hidden:
            plotter.show()
            return None
        image = plotter.screenshot(None if screenshot is None else str(screenshot))
        plotter.close()
    return image


@cache
def check_drawing_without_display() -> None:
    """Refuses where VTK would end the program, as it does without EGL or its drivers: tried out in
    another one.

    Raises
    ------
    RuntimeError
        It did; with what may be missing.
    """
    need("pyvista", "view")
    code = "import pyvista; pyvista.Plotter(off_screen=True).screenshot()"
    if subprocess.run([sys.executable, "-c", code], capture_output=True).returncode != 0:
        raise RuntimeError(
            "VTK cannot draw on this machine, which has no display, without EGL and a driver for "
            "it: apt-get install libegl1 libgl1-mesa-dri, or the like"
        )


def scene(
    result: Equilibrium,
    colour_by: str | None,
    frames: bool,
    off_screen: bool,
    sides: int,
    size: tuple[int, int],
) -> Any:
    """A plotter with all that is to be seen."""
    plotter = need("pyvista", "view").Plotter(off_screen=off_screen, window_size=list(size))
    plotter.set_background(BACKGROUND)
    _add_rods(plotter, result, colour_by, sides)
    _add_tendons(plotter, result)
    _add_supports(plotter, result)
    _add_loads(plotter, result)
    if frames:
        _add_frames(plotter, result)
    plotter.add_axes(color="black")
    _fit(plotter, size)
    return plotter


def _fit(plotter: Any, size: tuple[int, int]) -> None:
    """Looks along (-1, -1, -1), z upwards, in parallel projection, at all that was added."""
    points = np.vstack([mesh.points for mesh in plotter.meshes])
    towards = np.ones(3) / np.sqrt(3)
    right = np.array([-1.0, 1.0, 0.0]) / np.sqrt(2)
    axes = np.array([right, np.cross(towards, right), towards])
    seen = points @ axes.T
    low, high = seen.min(axis=0), seen.max(axis=0)
    centre = (low + high) / 2 @ axes
    away = 2 * np.linalg.norm(high - low)
    plotter.camera_position = [centre + away * towards, centre, (0.0, 0.0, 1.0)]
    plotter.enable_parallel_projection()
    width, height = (high - low)[:2] / MOST_FILLED
    plotter.camera.parallel_scale = max(height, width * size[1] / size[0]) / 2
    plotter.reset_camera_clipping_range()


def _add_rods(plotter: Any, result: Equilibrium, colour_by: str | None, sides: int) -> None:
    mesh = swept(result, sides)
    poly = _poly(mesh)
    look: dict[str, Any] = {"scalars": "colours", "smooth_shading": True}
    if colour_by is None:
        poly.point_data["colours"] = PALETTE[mesh.rod % len(PALETTE)]
        look["rgb"] = True
    else:
        by = measure(result, colour_by)
        at_vertices = by.place == "vertex"
        data = poly.point_data if at_vertices else poly.cell_data
        data["colours"] = (mesh.at_points if at_vertices else mesh.on_faces)(by.values)
        label = by.label.replace("Γ", "Gamma")  # not in the fonts of VTK
        bar = {"title": label, "color": "black", "fmt": "%.3g", **BAR}
        look |= {"scalar_bar_args": bar, "cmap": "viridis", "clim": by.limits}
    normals = {"cell_normals": False, "consistent_normals": False, "split_vertices": True}
    plotter.add_mesh(poly.compute_normals(feature_angle=SHARP, **normals), name="rods", **look)


def _add_tendons(plotter: Any, result: Equilibrium) -> None:
    for way in ways(result):
        pieces = np.repeat(way, 2, axis=0)[1:-1]
        plotter.add_lines(pieces, color="dimgrey", width=2)


def _add_supports(plotter: Any, result: Equilibrium) -> None:
    pyvista = need("pyvista", "view")
    for support, at in zip(result.scene.supports, result.support_positions, strict=True):
        number, s = on_rod(support.at, [rod.length for rod in result.scene.rods])
        size = 1.5 * result.scene.rods[number].outline(s).size
        if support.holds_frame:
            glyph = pyvista.Cube(center=at, x_length=size, y_length=size, z_length=size)
        else:
            glyph = pyvista.Sphere(radius=size / 2, center=at)
        plotter.add_mesh(glyph, color="grey", opacity=0.5)


def _add_loads(plotter: Any, result: Equilibrium) -> None:
    """Arrows outside of the rods: where a load pushes on an end, up to it, else away from it."""
    loads = np.vstack([rod.load for rod in result.rods])
    largest = np.linalg.norm(loads, axis=1).max()
    if largest == 0:
        return
    arrows = 0.2 * max(rod.rod.length for rod in result.rods) / largest * loads
    outward = np.vstack([_outward(rod) for rod in result.rods])
    pushes = (outward * loads).sum(axis=1) < 0
    starts = np.vstack([rod.positions for rod in result.rods]) - np.where(
        pushes[:, None], arrows, 0.0
    )
    acting = np.linalg.norm(loads, axis=1) > 1e-6 * largest
    plotter.add_arrows(starts[acting], arrows[acting], color="crimson", show_scalar_bar=False)


def _outward(rod: RodEquilibrium) -> Array:
    """(n + 1, 3) the directions out of the ends; zero in between."""
    directions = np.zeros_like(rod.positions)
    directions[[0, -1]] = field(rod, "a3").values[[0, -1]] * [[-1.0], [1.0]]
    return directions


def _add_frames(plotter: Any, result: Equilibrium) -> None:
    for name, colour in DIRECTORS.items():
        for rod in result.rods:
            every = -(-len(rod.s) // MOST_FRAMES)
            length = 0.03 * rod.rod.length + rod.rod.outline("start").size
            arrows = length * field(rod, name).values
            plotter.add_arrows(
                rod.positions[::every], arrows[::every], color=colour, show_scalar_bar=False
            )
