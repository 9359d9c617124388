"""Curves in files: tables, and what pyvista writes and reads."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple, Union

import numpy as np
from numpy.typing import NDArray

from pyrod.base.immutable import Array
from pyrod.base.optional import need
from pyrod.curve import FramedCurve, Polyline, split_at_gaps, without_repeats
from pyrod.files.atomic import replacing

_MESHES = (".vtp", ".vtk", ".ply", ".stl", ".obj")
_LINES = (3, 4)
"""Numbers of VTK for lines and polylines."""
Indices = NDArray[np.intp]
_HEADER = "s,x,y,z,curvature"
_FRAMES = ",w,qx,qy,qz"


class LoadedCurve(NamedTuple):
    """A curve of a file, and what the file tells of its points."""

    polyline: Polyline  #: the curve
    columns: dict[str, Array]  #: values of its vertices by name


def save_curve(curve: Union[Polyline, FramedCurve], path: str | Path, **options: Any) -> None:
    """Writes the curve to a file, whose suffix tells the format.

    Parameters
    ----------
    curve : `Polyline` or `FramedCurve`
    path : str or Path
        A table (.csv) with s, x, y, z, the curvature and, of framed curves, the frames w, qx, qy,
        qz at the vertices; for ParaView (.vtp, .vtk); a surface (.ply, .stl,
        .obj; radius or width needed). A file that is there is replaced, but only if nothing fails.
    options : float or int
        Of all but tables: ``radius``, ``width`` and ``sides``, as for `to_pyvista`.

    Raises
    ------
    ValueError
        An unknown suffix; a surface without a size.
    TypeError
        An option that the format does not have.
    ImportError
        The format needs pyvista, which is not installed.
    """
    path = Path(path)
    writers: dict[str, Callable[..., None]] = {".csv": _save_table}
    writers |= dict.fromkeys(_MESHES, _save_mesh)
    if path.suffix not in writers:
        raise ValueError(
            f"{path}: the suffix tells the format, for curves one of {', '.join(writers)}"
        )
    known = ("radius", "width", "sides") if path.suffix in _MESHES else ()
    for name in options:
        if name not in known:
            there = ", ".join(known) or "none"
            raise TypeError(f"{name}: {path.suffix} files of curves have the options: {there}")
    if path.suffix in (".ply", ".stl", ".obj") and not {"radius", "width"} & {*options}:
        raise ValueError(f"radius: {path.suffix} files hold surfaces; give it, or the width")
    with replacing(path) as temporary:
        writers[path.suffix](curve, temporary, **options)


def _arc_and_frames(curve: Union[Polyline, FramedCurve]) -> tuple[Polyline, Array | None]:
    if isinstance(curve, FramedCurve):
        return curve.polyline, curve.vertex_frames
    return curve, None


def _save_table(curve: Union[Polyline, FramedCurve], path: Path) -> None:
    arc, frames = _arc_and_frames(curve)
    columns = [arc.arc_lengths, arc.positions, arc.curvature(ends="continued")]
    columns += [] if frames is None else [frames]
    header = _HEADER + ("" if frames is None else _FRAMES)
    np.savetxt(
        path, np.column_stack(columns), fmt="%.17g", delimiter=",", header=header, comments=""
    )


def _save_mesh(curve: Union[Polyline, FramedCurve], path: Path, **options: Any) -> None:
    mesh = curve.to_pyvista(**options)
    if path.suffix in (".ply", ".stl", ".obj"):
        mesh = mesh.triangulate()
    mesh.save(path)


def load_curves(path: str | Path, *, closed: bool | None = None) -> list[LoadedCurve]:
    """The curves in a file of lines, with the columns of their points.

    Reads with pyvista what has lines: .vtp, .vtk, .vtu, .ply, .obj and more, those of other
    programs (.msh, .xdmf) through meshio if it is installed. Lines that go on where the one before
    them ends are one curve; points that repeat the one before are left out, missing ones (NaN) part
    it. For tables, .swc, .trk and .pdb see docs/measured_curves.md.

    Parameters
    ----------
    path : str or Path
    closed : bool
        Whether the curves are; default: those whose last point is the first again.

    Returns
    -------
    list
        Of ``(polyline, columns)``; columns are the point data of the file, by name.

    Raises
    ------
    ValueError
        There is no curve in it.
    FileNotFoundError
        There is no such file.
    ImportError
        pyvista is not installed: ``pip install 'pyrod[view]'``.
    """
    path = Path(path)
    if not path.is_file():
        raise FileNotFoundError(f"{path}: there is no such file")
    mesh = need("pyvista", "view").read(path)
    points, data = np.asarray(mesh.points), {k: np.asarray(x) for k, x in mesh.point_data.items()}
    curves = [
        one
        for order in _joined(_lines(mesh))
        for _, index in split_at_gaps(points[order])
        for one in _curves_through(points, data, order[index], closed)
    ]
    if not curves:
        raise ValueError(f"{path}: there is no curve in it")
    return curves


def _lines(mesh: Any) -> list[Indices]:
    """Numbers of the points of each line of a mesh of any kind."""
    if hasattr(mesh, "lines"):
        cells = np.asarray(mesh.lines)
        found, at = [], 0
        while at < len(cells):
            found.append(cells[at + 1 : at + 1 + cells[at]])
            at += 1 + int(cells[at])
        return found
    types = getattr(mesh, "celltypes", ())
    return [np.array(mesh.get_cell(i).point_ids) for i, t in enumerate(types) if t in _LINES]


def _joined(lines: list[Indices]) -> list[Indices]:
    """Lines that go on where the one before them ends, as one."""
    chains: list[list[Indices]] = []
    for line in lines:
        if chains and chains[-1][-1][-1] == line[0]:
            chains[-1].append(line[1:])
        else:
            chains.append([line])
    return [np.concatenate(chain) for chain in chains]


def _curves_through(
    points: Array, data: dict[str, Array], order: Indices, closed: bool | None
) -> list[LoadedCurve]:
    """The curve through so many points, if there are two."""
    again = len(order) > 3 and bool((points[order[0]] == points[order[-1]]).all())
    is_closed = again if closed is None else closed
    _, kept = without_repeats(points[order], closed=is_closed)
    if len(kept) < 2 + is_closed:
        return []
    order = order[kept]
    columns = {name: x[order] for name, x in data.items()}
    return [LoadedCurve(Polyline(points[order], closed=is_closed), columns)]
