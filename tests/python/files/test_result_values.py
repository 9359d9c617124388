"""Files of results for other programs: read back by these, they hold the same values."""

from __future__ import annotations

import csv
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pytest
from support import ROUND

import pyrod
from pyrod import Clamp, Rod, Scene
from pyrod.pictures.measure import measure
from pyrod.pictures.swept import swept
from pyrod.result.fields import KINDS, field

pytest_plugins = ["shared_results"]

pyvista = pytest.importorskip("pyvista")
trimesh = pytest.importorskip("trimesh")

# Tables -------------------------------------------------------------------------------------------


def test_tables_have_a_row_per_vertex(result: pyrod.Equilibrium, tmp_path: Path) -> None:
    result.save(tmp_path / "result.csv")
    with (tmp_path / "result.csv").open(newline="") as file:
        header, *rows = csv.reader(file)
    assert header[:5] == ["rod", "s [m]", "x [m]", "y [m]", "z [m]"]
    assert {"K_1 [1/m]", "force_x [N]", "moment_z [N m]", "a1_x", "Gamma_3"} <= set(header)
    assert len(set(header)) == len(header)
    table = np.array(rows, dtype=float)
    assert len(table) == sum(rod.edges + 1 for rod in result.scene.rods)

    def column(name: str, number: int) -> np.ndarray:
        return table[table[:, 0] == number, header.index(name)]

    for number, rod in enumerate(result.rods):
        np.testing.assert_array_equal(column("x [m]", number), rod.positions[:, 0])
        np.testing.assert_array_equal(
            column("material_moment_2 [N m]", number), rod.material_moment[:, 1]
        )
        force = column("force_z [N]", number)
        assert force[0] == rod.force[0, 2]
        np.testing.assert_array_equal(force[1:-1], (rod.force[1:, 2] + rod.force[:-1, 2]) / 2)


# VTK ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("suffix", [".vtp", ".vtu"])
def test_centrelines_carry_all_values(
    result: pyrod.Equilibrium, suffix: str, tmp_path: Path
) -> None:
    path = tmp_path / f"result{suffix}"
    result.save(path, title="a title, ü")
    mesh = pyvista.read(path)
    assert mesh.field_data["title"][0] == "a title, ü"
    assert mesh.field_data["status"][0] == "converged"
    assert mesh.field_data["energy"][0] == result.energy
    assert mesh.field_data["index"][0] == result.index
    assert mesh.n_cells == sum(rod.edges for rod in result.scene.rods)
    r = np.vstack([rod.positions for rod in result.rods])
    np.testing.assert_array_equal(mesh.points, r)
    for name, kind in KINDS.items():
        if name == "positions":
            continue
        place = mesh.point_data if kind.place == "vertex" else mesh.cell_data
        values = np.concatenate([field(rod, name).values for rod in result.rods])
        np.testing.assert_array_equal(place[name], values)
    for number, rod in enumerate(result.rods):
        cells = np.flatnonzero(mesh.cell_data["rod"] == number)
        assert (mesh.point_data["rod"] == number).sum() == rod.rod.edges + 1
        ends = [mesh.get_cell(cell).points for cell in cells]
        np.testing.assert_array_equal(ends, np.stack([rod.positions[:-1], rod.positions[1:]], 1))


@pytest.mark.parametrize("suffix", [".vtp", ".vtu"])
def test_solids_carry_the_values_at_the_vertices(
    joined: pyrod.Equilibrium, suffix: str, tmp_path: Path
) -> None:
    path = tmp_path / f"result{suffix}"
    joined.save(path, solid=True, sides=12)
    mesh = pyvista.read(path)
    surface = swept(joined, 12)
    np.testing.assert_array_equal(mesh.points, surface.points)
    for place, values in zip(
        (mesh.point_data, mesh.cell_data), surface.quantities(joined), strict=True
    ):
        assert set(place.keys()) == set(values)
        for name, array in values.items():
            np.testing.assert_array_equal(place[name], array)
    assert "force" in mesh.cell_data
    assert mesh.n_cells == len(surface.quads) + len(surface.caps)
    closed = mesh if suffix == ".vtp" else mesh.extract_surface(algorithm="dataset_surface")
    area = 12 / 2 * np.sin(2 * np.pi / 12) * (0.02**2 - 0.01**2)
    assert closed.volume == pytest.approx(2 * area, rel=0.02)


# Solids -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("suffix", [".stl", ".obj", ".ply", ".glb"])
def test_solids_are_closed_and_have_the_volume_of_the_rods(
    joined: pyrod.Equilibrium, suffix: str, tmp_path: Path
) -> None:
    path = tmp_path / f"result{suffix}"
    joined.save(path, sides=16)
    mesh = trimesh.load_mesh(path)
    assert mesh.is_watertight
    area = 16 / 2 * np.sin(2 * np.pi / 16) * (0.02**2 - 0.01**2)
    assert mesh.volume == pytest.approx(2 * area, rel=0.02)
    assert [p.name for p in tmp_path.iterdir()] == [path.name]


@pytest.mark.parametrize("suffix", [".ply", ".glb", ".obj"])
@pytest.mark.parametrize("quantity", ["moment", "moment.y", "Gamma", "s"])
def test_solids_are_coloured_by_a_quantity(
    joined: pyrod.Equilibrium, suffix: str, quantity: str, tmp_path: Path
) -> None:
    path = tmp_path / f"result{suffix}"
    joined.save(path, colour_by=quantity)
    mesh = trimesh.load_mesh(path, process=False)
    size = swept(joined).at_points(measure(joined, quantity).at_vertices)
    colours = np.asarray(mesh.visual.vertex_colors)[:, :3]
    ends = [colours[size.argmin()], colours[size.argmax()]]
    np.testing.assert_array_equal(ends, [(68, 1, 84), (253, 231, 36)])  # of viridis


def test_an_even_quantity_has_one_colour(tmp_path: Path) -> None:
    still = pyrod.solve(Scene(Rod.straight(1.0, 4, ROUND), Clamp()))
    still.save(tmp_path / "result.ply", colour_by="moment")
    mesh = trimesh.load_mesh(tmp_path / "result.ply")
    assert len(np.unique(mesh.visual.vertex_colors, axis=0)) == 1


# Pictures -----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("suffix", "start"), [(".png", b"\x89PNG"), (".svg", b"<?xml"), (".pdf", b"%PDF")]
)
def test_pictures_are_those_of_plot(
    joined: pyrod.Equilibrium, suffix: str, start: bytes, tmp_path: Path
) -> None:
    before = plt.get_fignums()
    joined.save(tmp_path / f"result{suffix}", color="red")
    assert (tmp_path / f"result{suffix}").read_bytes().startswith(start)
    assert plt.get_fignums() == before


def test_pages_are_those_of_to_html(
    joined: pyrod.Equilibrium, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def to_html(self: pyrod.Equilibrium, path: Path, title: str) -> None:
        Path(path).write_text(f"{title}: {len(self.rods)} rods")

    monkeypatch.setattr(pyrod.Equilibrium, "to_html", to_html, raising=False)
    joined.save(tmp_path / "result.html", title="frame")
    assert (tmp_path / "result.html").read_text() == "frame: 2 rods"
