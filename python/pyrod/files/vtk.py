"""Results for ParaView and PyVista: VTK's XML, written without VTK."""

from __future__ import annotations

from base64 import b64encode
from pathlib import Path
from typing import Any, NamedTuple
from xml.etree import ElementTree as xml

import numpy as np

from pyrod.base.immutable import Array
from pyrod.pictures.swept import swept
from pyrod.result.equilibrium import Equilibrium
from pyrod.result.fields import KINDS, fields

_TYPES = {"float64": "Float64", "int64": "Int64", "uint8": "UInt8"}
_SHAPES = {2: 3, 3: 5, 4: 9}
"""Numbers of VTK for lines, triangles and quads, by their points."""


class Mesh(NamedTuple):
    """Points and cells with values."""

    points: Array  #: (p, 3)
    cells: tuple[np.ndarray, ...]  #: (c, k) points of cells with k points each
    at_points: dict[str, np.ndarray]
    at_cells: dict[str, np.ndarray]


def save_vtp(
    result: Equilibrium, path: Path, *, solid: bool = False, sides: int = 24, title: str = ""
) -> None:
    """As poly data."""
    mesh = _solid(result, sides) if solid else _line_mesh(result)
    count = str(sum(map(len, mesh.cells)))
    empty = dict.fromkeys(
        ("NumberOfVerts", "NumberOfStrips", "NumberOfLines", "NumberOfPolys"), "0"
    )
    kind = "Polys" if solid else "Lines"
    piece = xml.Element("Piece", {**empty, f"NumberOf{kind}": count})
    _add_cells(xml.SubElement(piece, kind), mesh)
    _write("PolyData", piece, mesh, _about(result, title), path)


def save_vtu(
    result: Equilibrium, path: Path, *, solid: bool = False, sides: int = 24, title: str = ""
) -> None:
    """As an unstructured grid."""
    mesh = _solid(result, sides) if solid else _line_mesh(result)
    piece = xml.Element("Piece", {"NumberOfCells": str(sum(map(len, mesh.cells)))})
    cells = xml.SubElement(piece, "Cells")
    _add_cells(cells, mesh)
    shapes = [np.full(len(c), _SHAPES[c.shape[1]], dtype=np.uint8) for c in mesh.cells]
    _add_array(cells, "types", np.concatenate(shapes))
    _write("UnstructuredGrid", piece, mesh, _about(result, title), path)


def _line_mesh(result: Equilibrium) -> Mesh:
    """Centrelines: a line for each edge."""
    counts = [len(rod.positions) for rod in result.rods]
    first = np.cumsum([0, *counts])
    edges = [np.arange(n - 1) + at for n, at in zip(counts, first[:-1], strict=True)]
    start = np.concatenate(edges)
    known = [fields(rod) for rod in result.rods]
    values: dict[str, np.ndarray] = {
        name: np.concatenate([f[name].values for f in known]) for name in KINDS
    }
    points = values.pop("positions")
    vertex = {name: v for name, v in values.items() if KINDS[name].place == "vertex"}
    edge = {name: v for name, v in values.items() if KINDS[name].place == "edge"}
    numbers = np.arange(len(counts))
    vertex["rod"] = np.repeat(numbers, counts)
    edge["rod"] = np.repeat(numbers, [n - 1 for n in counts])
    return Mesh(points, (np.column_stack([start, start + 1]),), vertex, edge)


def _solid(result: Equilibrium, sides: int) -> Mesh:
    """The surface, with the quantities of the vertices and edges to which it belongs."""
    surface = swept(result, sides)
    return Mesh(surface.points, (surface.quads, surface.caps), *surface.quantities(result))


def _about(result: Equilibrium, title: str) -> dict[str, Any]:
    return {
        "title": title,
        "status": result.status,
        "energy": np.array([result.energy]),
        "index": np.array([result.index]),
    }


# XML ----------------------------------------------------------------------------------------------


def _write(kind: str, piece: xml.Element, mesh: Mesh, about: dict[str, Any], path: Path) -> None:
    root = xml.Element(
        "VTKFile", type=kind, version="1.0", byte_order="LittleEndian", header_type="UInt64"
    )
    data = xml.SubElement(root, kind)
    field = xml.SubElement(data, "FieldData")
    for name, value in about.items():
        (_add_text if isinstance(value, str) else _add_array)(field, name, value)
    data.append(piece)
    piece.set("NumberOfPoints", str(len(mesh.points)))
    _add_array(xml.SubElement(piece, "Points"), "Points", mesh.points)
    for place, values in (("PointData", mesh.at_points), ("CellData", mesh.at_cells)):
        element = xml.SubElement(piece, place)
        for name, array in values.items():
            _add_array(element, name, array)
    xml.ElementTree(root).write(path, encoding="utf-8", xml_declaration=True)


def _add_cells(element: xml.Element, mesh: Mesh) -> None:
    sizes = np.concatenate([np.full(len(cells), cells.shape[1]) for cells in mesh.cells])
    _add_array(element, "connectivity", np.concatenate([cells.ravel() for cells in mesh.cells]))
    _add_array(element, "offsets", np.cumsum(sizes))


def _add_array(parent: xml.Element, name: str, values: np.ndarray) -> None:
    """Base64 of the number of bytes and these; components have the names of the table."""
    kind = KINDS.get(name)
    names = {f"ComponentName{i}": c for i, c in enumerate(kind.components if kind else ())}
    element = xml.SubElement(parent, "DataArray", names, type=_TYPES[str(values.dtype)], Name=name)
    columns = values.shape[1] if values.ndim > 1 else 1
    element.set("NumberOfComponents", str(columns))
    if parent.tag == "FieldData":
        element.set("NumberOfTuples", str(len(values)))
    element.set("format", "binary")
    data = values.astype(values.dtype.newbyteorder("<")).tobytes()
    element.text = b64encode(len(data).to_bytes(8, "little") + data).decode()


def _add_text(parent: xml.Element, name: str, text: str) -> None:
    """VTK's strings are lists of their bytes, and a zero."""
    element = xml.SubElement(parent, "DataArray", type="String", Name=name, NumberOfTuples="1")
    element.set("format", "ascii")
    element.text = " ".join(map(str, [*text.encode(), 0]))
