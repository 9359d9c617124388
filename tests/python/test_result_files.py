"""Files of results: exact ones come back equal, others hold the same values."""

from __future__ import annotations

import csv
import json
import zipfile
from collections.abc import Callable
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pytest

import pyrod
from pyrod import Clamp, DistributedForce, Force, Gravity, Joint, Material, Rod, Scene, Section
from pyrod._fields import KINDS, field
from pyrod._swept import swept

pyvista = pytest.importorskip("pyvista")
trimesh = pytest.importorskip("trimesh")

TUBE = Section.tube(0.02, 0.01, Material(1e7, density=1000.0))


@pytest.fixture(scope="module")
def one() -> pyrod.Equilibrium:
    """With all that a result may have."""
    rod = Rod.precurved(1.0, None, TUBE, (0.0, 1.0, 0.5))
    scene = Scene(rod, Clamp(), [Force((0.5, 1, 0.2), at=0.33), Gravity()])
    return pyrod.solve(scene, tol=1e-5, eigenvalue=True)


@pytest.fixture(scope="module")
def two() -> pyrod.Equilibrium:
    """Rods of different numbers of edges, joined."""
    post = Rod.straight(1.0, 6, TUBE)
    beam = Rod.straight(1.0, 4, TUBE).placed((0, 0, 1), tangent=(1, 0, 0), normal=(0, 0, 1))
    joint = Joint(((0, "end"), (1, "start")))
    return pyrod.solve(Scene([post, beam], Clamp(), Force((0, 0, -3), (1, "end")), joints=joint))


@pytest.fixture(params=["one", "two"])
def result(request: pytest.FixtureRequest) -> pyrod.Equilibrium:
    return request.getfixturevalue(request.param)


# Exact files --------------------------------------------------------------------------------------


@pytest.mark.parametrize("suffix", [".npz", ".json"])
def test_results_come_back_equal(result: pyrod.Equilibrium, suffix: str, tmp_path: Path) -> None:
    path = tmp_path / f"result{suffix}"
    result.save(path)
    back = pyrod.load(str(path))
    assert back == result
    assert back.time == result.time
    assert repr(back) == repr(result)
    for name in ("energy", "stable", "iterations", "balance", "free_motion", "errors"):
        assert getattr(back, name) == getattr(result, name), name
    for mine, its in zip(back.rods, result.rods, strict=True):
        for name in KINDS:
            np.testing.assert_array_equal(field(mine, name).values, field(its, name).values)
        assert not mine.positions.flags.writeable
    plt.close(back.plot().figure)


def test_what_is_loaded_serves_as_a_start_and_tells_effects(
    one: pyrod.Equilibrium, tmp_path: Path
) -> None:
    one.save(tmp_path / "result.npz")
    back = pyrod.load(tmp_path / "result.npz")
    assert pyrod.solve(back.scene, start=back, tol=1e-5).energy == pytest.approx(one.energy)
    assert back.effect("shear").energy == one.effect("shear").energy
    np.testing.assert_array_equal(back.along_mode(0.1), one.along_mode(0.1))


def test_results_that_have_not_converged(tmp_path: Path) -> None:
    """Not finite numbers among them."""
    scene = Scene(Rod.straight(1.0, 8, TUBE), Clamp(), Force((900, 0, 0)))
    failed = pyrod.solve(scene, pyrod.Options(max_iterations=2), tol=1e-6, strict=False)
    assert not np.isfinite(failed.accuracy.reached)
    for suffix in (".npz", ".json"):
        failed.save(tmp_path / f"result{suffix}")
        back = pyrod.load(tmp_path / f"result{suffix}")
        assert back.status == failed.status
        np.testing.assert_equal(back.errors, failed.errors)
    json.loads((tmp_path / "result.json").read_text(), parse_constant=pytest.fail)


def test_functions_are_there_as_their_values(tmp_path: Path) -> None:
    scene = Scene(Rod.straight(1.0, 4, TUBE), Clamp(), DistributedForce(lambda s: (s, 0, 0)))
    result = pyrod.solve(scene)
    result.save(tmp_path / "result.npz")
    back = pyrod.load(tmp_path / "result.npz")
    np.testing.assert_array_equal(back.positions, result.positions)
    assert back.scene.loads[0].force_per_length.shape == (4, 3)


def damages(text: str) -> dict[str, str]:
    """Files in JSON that are no results of this version."""
    return {
        "other format": text.replace("pyrod result 1", "pyrod result 99"),
        "no arrays": text.replace('"arrays"', '"array"'),
        "other type": text.replace('"float64"', '"object"'),
        "other shape": text.replace('"shape": [5, 3]', '"shape": [3, 5]'),
        "no scene": text.replace('"supports"', '"suports"'),
    }


@pytest.mark.parametrize("damage", damages(""))
def test_damaged_json_is_refused(damage: str, tmp_path: Path) -> None:
    path = tmp_path / "result.json"
    pyrod.solve(Scene(Rod.straight(1.0, 4, TUBE), Clamp())).save(path)
    text = path.read_text()
    assert damages(text)[damage] != text
    path.write_text(damages(text)[damage])
    with pytest.raises(ValueError, match=r'result.json: no "pyrod result 1", or damaged'):
        pyrod.load(path)


def test_damaged_archives_are_refused(one: pyrod.Equilibrium, tmp_path: Path) -> None:
    path = tmp_path / "result.npz"
    one.save(path)
    data = path.read_bytes()
    with zipfile.ZipFile(path) as archive:
        start = archive.infolist()[3].header_offset + 60
    objects = tmp_path / "objects.npz"
    np.savez(objects, head=np.array([{}], dtype=object))
    damaged = [b"", b"text", data[: len(data) // 2], objects.read_bytes()]
    damaged.append(data[:start] + b"\0" * 40 + data[start + 40 :])
    for bad in damaged:
        path.write_bytes(bad)
        with pytest.raises(ValueError, match=r"result.npz: no .* or damaged .*; save it again"):
            pyrod.load(path)
    with pytest.raises(FileNotFoundError):
        pyrod.load(tmp_path / "none.npz")


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
    two: pyrod.Equilibrium, suffix: str, tmp_path: Path
) -> None:
    path = tmp_path / f"result{suffix}"
    two.save(path, solid=True, sides=12)
    mesh = pyvista.read(path)
    surface = swept(two, 12)
    np.testing.assert_array_equal(mesh.points, surface.points)
    np.testing.assert_array_equal(mesh.point_data["moment"], surface.values(two, "moment"))
    np.testing.assert_array_equal(mesh.point_data["rod"], surface.rod)
    assert mesh.n_cells == len(surface.quads) + len(surface.caps)
    closed = mesh if suffix == ".vtp" else mesh.extract_surface(algorithm="dataset_surface")
    area = 12 / 2 * np.sin(2 * np.pi / 12) * (0.02**2 - 0.01**2)
    assert closed.volume == pytest.approx(2 * area, rel=0.02)


# Solids -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("suffix", [".stl", ".obj", ".ply", ".glb"])
def test_solids_are_closed_and_have_the_volume_of_the_rods(
    two: pyrod.Equilibrium, suffix: str, tmp_path: Path
) -> None:
    path = tmp_path / f"result{suffix}"
    two.save(path, sides=16)
    mesh = trimesh.load_mesh(path)
    assert mesh.is_watertight
    area = 16 / 2 * np.sin(2 * np.pi / 16) * (0.02**2 - 0.01**2)
    assert mesh.volume == pytest.approx(2 * area, rel=0.02)
    assert [p.name for p in tmp_path.iterdir()] == [path.name]


@pytest.mark.parametrize("suffix", [".ply", ".glb", ".obj"])
@pytest.mark.parametrize("quantity", ["moment", "s"])
def test_solids_are_coloured_by_a_quantity(
    two: pyrod.Equilibrium, suffix: str, quantity: str, tmp_path: Path
) -> None:
    path = tmp_path / f"result{suffix}"
    two.save(path, colour_by=quantity)
    mesh = trimesh.load_mesh(path, process=False)
    values = swept(two).values(two, quantity)
    size = values if values.ndim == 1 else np.linalg.norm(values, axis=1)
    colours = np.asarray(mesh.visual.vertex_colors)[:, :3]
    ends = [colours[size.argmin()], colours[size.argmax()]]
    np.testing.assert_array_equal(ends, [(68, 1, 84), (253, 231, 36)])  # of viridis


def test_an_even_quantity_has_one_colour(tmp_path: Path) -> None:
    still = pyrod.solve(Scene(Rod.straight(1.0, 4, TUBE), Clamp()))
    still.save(tmp_path / "result.ply", colour_by="moment")
    mesh = trimesh.load_mesh(tmp_path / "result.ply")
    assert len(np.unique(mesh.visual.vertex_colors, axis=0)) == 1


# Pictures -----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("suffix", "start"), [(".png", b"\x89PNG"), (".svg", b"<?xml"), (".pdf", b"%PDF")]
)
def test_pictures_are_those_of_plot(
    two: pyrod.Equilibrium, suffix: str, start: bytes, tmp_path: Path
) -> None:
    before = plt.get_fignums()
    two.save(tmp_path / f"result{suffix}", color="red")
    assert (tmp_path / f"result{suffix}").read_bytes().startswith(start)
    assert plt.get_fignums() == before


def test_pages_are_those_of_to_html(
    two: pyrod.Equilibrium, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def to_html(self: pyrod.Equilibrium, path: Path, title: str) -> None:
        Path(path).write_text(f"{title}: {len(self.rods)} rods")

    monkeypatch.setattr(pyrod.Equilibrium, "to_html", to_html, raising=False)
    two.save(tmp_path / "result.html", title="frame")
    assert (tmp_path / "result.html").read_text() == "frame: 2 rods"


# All formats --------------------------------------------------------------------------------------


def test_a_file_is_whole_or_as_it_was(
    two: pyrod.Equilibrium, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "result.csv"
    path.write_text("before")

    def fails(*_: object) -> None:
        raise OSError("the disk is full")

    with monkeypatch.context() as patch:
        patch.setattr("pyrod._files.sheet.fields", fails)
        with pytest.raises(OSError, match="disk is full"):
            two.save(path)
    assert path.read_text() == "before"
    assert list(tmp_path.iterdir()) == [path]
    two.save(path)
    assert path.read_text().startswith("rod,s [m],")


REFUSED: list[tuple[Callable[[pyrod.Equilibrium, Path], None], type[Exception], str]] = [
    (lambda e, p: e.save(p / "x.abc"), ValueError, r"x.abc: .* Equilibrium, one of .npz, .json"),
    (lambda e, p: e.save(p / "x"), ValueError, "the suffix tells the format"),
    (lambda e, p: e.save(p / "x.toml"), ValueError, "format of a Equilibrium"),
    (lambda e, p: e.scene.save(p / "x.csv"), ValueError, r"Scene, one of .toml, .json"),
    (lambda e, p: pyrod.save("text", p / "x.toml"), TypeError, "got a str"),
    (lambda e, p: e.save(p / "x.csv", solid=True), TypeError, r"solid: .csv .* options: none"),
    (lambda e, p: e.save(p / "x.stl", colour_by="s"), TypeError, r"options: sides"),
    (lambda e, p: e.save(p / "x.ply", colour_by="colour"), ValueError, "quantity: expected one"),
    (lambda e, p: e.save(p / "no" / "x.csv"), FileNotFoundError, "no folder .*no; make it"),
    (lambda e, p: e.save(folder(p / "x.csv")), IsADirectoryError, "it is a folder"),
    (lambda e, p: pyrod.load(p / "x.csv"), ValueError, "other formats hold too little"),
]


def folder(path: Path) -> Path:
    path.mkdir()
    return path


@pytest.mark.parametrize(("act", "error", "what"), REFUSED, ids=[what for _, _, what in REFUSED])
def test_what_is_refused(
    act: Callable[[pyrod.Equilibrium, Path], None],
    error: type[Exception],
    what: str,
    two: pyrod.Equilibrium,
    tmp_path: Path,
) -> None:
    with pytest.raises(error, match=what):
        act(two, tmp_path)
    assert not [path for path in tmp_path.iterdir() if path.is_file()]


def test_without_trimesh_the_remedy_is_told(
    two: pyrod.Equilibrium, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    import sys

    monkeypatch.setitem(sys.modules, "trimesh", None)
    with pytest.raises(ImportError, match=r"pip install 'pyrod\[files\]'"):
        two.save(tmp_path / "result.stl")
