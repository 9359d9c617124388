"""Files of results: exact ones come back equal, damaged ones are refused."""

from __future__ import annotations

import json
import zipfile
from collections.abc import Callable
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pytest
from support import ROUND

import pyrod
from pyrod import Clamp, DistributedForce, Force, Rod, Scene
from pyrod.result.fields import KINDS, field

pytest_plugins = ["shared_results"]

pyvista = pytest.importorskip("pyvista")
trimesh = pytest.importorskip("trimesh")

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
    bent: pyrod.Equilibrium, tmp_path: Path
) -> None:
    bent.save(tmp_path / "result.npz")
    back = pyrod.load(tmp_path / "result.npz")
    assert pyrod.solve(back.scene, start=back, tol=1e-5).energy == pytest.approx(bent.energy)
    assert back.effect("shear").energy == bent.effect("shear").energy
    np.testing.assert_array_equal(back.along_mode(0.1), bent.along_mode(0.1))


def test_results_that_have_not_converged(tmp_path: Path) -> None:
    """Not finite numbers among them."""
    scene = Scene(Rod.straight(1.0, 8, ROUND), Clamp(), Force((900, 0, 0)))
    few = pyrod.Options(max_iterations=2, max_edges=2**10)
    failed = pyrod.solve(scene, few, tol=1e-6, strict=False)
    assert not np.isfinite(failed.accuracy.reached)
    for suffix in (".npz", ".json"):
        failed.save(tmp_path / f"result{suffix}")
        back = pyrod.load(tmp_path / f"result{suffix}")
        assert back.status == failed.status
        np.testing.assert_equal(back.errors, failed.errors)
    json.loads((tmp_path / "result.json").read_text(), parse_constant=pytest.fail)


def test_functions_are_there_as_their_values(tmp_path: Path) -> None:
    scene = Scene(Rod.straight(1.0, 4, ROUND), Clamp(), DistributedForce(lambda s: (s, 0, 0)))
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
    pyrod.solve(Scene(Rod.straight(1.0, 4, ROUND), Clamp())).save(path)
    text = path.read_text()
    assert damages(text)[damage] != text
    path.write_text(damages(text)[damage])
    with pytest.raises(ValueError, match=r'result.json: no "pyrod result 1", or damaged'):
        pyrod.load(path)


def test_damaged_archives_are_refused(bent: pyrod.Equilibrium, tmp_path: Path) -> None:
    path = tmp_path / "result.npz"
    bent.save(path)
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


# All formats --------------------------------------------------------------------------------------


def test_a_file_is_whole_or_as_it_was(
    joined: pyrod.Equilibrium, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "result.csv"
    path.write_text("before")

    def fails(*_: object) -> None:
        raise OSError("the disk is full")

    with monkeypatch.context() as patch:
        patch.setattr("pyrod.files.sheet.fields", fails)
        with pytest.raises(OSError, match="disk is full"):
            joined.save(path)
    assert path.read_text() == "before"
    assert list(tmp_path.iterdir()) == [path]
    joined.save(path)
    assert path.read_text().startswith("rod,s [m],")


REFUSED: list[tuple[Callable[[pyrod.Equilibrium, Path], None], type[Exception], str]] = [
    (lambda e, p: e.save(p / "x.abc"), ValueError, r"x.abc: .* for Equilibrium one of .npz, .json"),
    (lambda e, p: e.save(p / "x"), ValueError, "the suffix tells the format"),
    (lambda e, p: e.save(p / "x.toml"), ValueError, "for Equilibrium one of"),
    (lambda e, p: e.scene.save(p / "x.csv"), ValueError, r"for Scene one of .toml, .json"),
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
    joined: pyrod.Equilibrium,
    tmp_path: Path,
) -> None:
    with pytest.raises(error, match=what):
        act(joined, tmp_path)
    assert not [path for path in tmp_path.iterdir() if path.is_file()]


def test_without_trimesh_the_remedy_is_told(
    joined: pyrod.Equilibrium, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    import sys

    monkeypatch.setitem(sys.modules, "trimesh", None)
    with pytest.raises(ImportError, match=r"pip install 'pyrod\[files\]'"):
        joined.save(tmp_path / "result.stl")
