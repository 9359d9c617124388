"""Files of scenes: loading, saving, and errors with lines."""

from __future__ import annotations

import json
import pickle
import tomllib
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from support import ROUND

import pyrod
from pyrod import Clamp, Rod, Scene
from pyrod.document import files, load_file, units
from pyrod.document.lines import line_of
from pyrod.document.toml import dumps

SCENE = Scene(Rod.straight(1.0, 4, ROUND), Clamp(), pyrod.Force((1, 0, 0)))
TEXT = """\
# a comment with [brackets], "quotes" and ''' three
title = '''a text
[of]
four "lines"'''
[materials.steel]
E = "200 GPa" # ]

[sections]
wire.circle = { radius = "1 mm" }
wire.material = "steel"

[[rods]]
length = "1 m"
edges = 4
section = "wire"
curvature = [
  0,
  # between ]
  0, 0,
]
[[supports]]
kind = "clamp"
[[loads]]
kind = "force"
force = [1, 0, 0]

[[loads]]
kind = "force"

force = [
  1, 0,
  0]
[solve]
tol = 1e-6
max_iterations = 50
"""


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "scene.toml"


def refused(path: Path, text: str) -> pyrod.SceneFileError:
    """What a file with this text is refused for."""
    path.write_text(text, encoding="utf-8")
    with pytest.raises(pyrod.SceneFileError) as caught:
        pyrod.load(path)
    assert str(caught.value).startswith(str(path))
    return caught.value


# Loading and saving -------------------------------------------------------------------------------


def test_a_file_tells_scene_options_and_title(path: Path) -> None:
    path.write_text(TEXT)
    scene, options, title = load_file(str(path))
    assert scene == pyrod.load(path)
    assert title == 'a text\n[of]\nfour "lines"'
    assert options.pop("options") == pyrod.Options(max_iterations=50)
    assert options == {"tol": 1e-6}


def test_without_a_table_there_are_no_options(path: Path) -> None:
    path.write_text(TEXT.partition("[solve]")[0])
    assert load_file(path).options == {}


@pytest.mark.parametrize("suffix", [".toml", ".json"])
def test_scenes_are_saved_and_loaded(suffix: str, tmp_path: Path) -> None:
    path = tmp_path / f"scene{suffix}"
    SCENE.save(str(path))
    assert pyrod.load(str(path)) == SCENE
    pyrod.save(SCENE, path)
    assert pyrod.load(path) == SCENE


def test_json_is_strict_and_infinite_stiffnesses_are_in_it(tmp_path: Path) -> None:
    arrays = Rod.from_curve([[0, 0, 0], [0, 0, 1]], [[1, 0, 0, 0]], ROUND)
    Scene(arrays, Clamp()).save(tmp_path / "scene.json")
    text = (tmp_path / "scene.json").read_text()
    assert '"inf"' in text
    json.loads(text, parse_constant=pytest.fail)
    assert pyrod.load(tmp_path / "scene.json").rod == arrays


KEYS = st.text(st.characters(exclude_categories=["Cs"]), max_size=5)
LEAVES = st.text(st.characters(exclude_categories=["Cs"])) | st.booleans() | st.integers(-9, 9)
NUMBERS = st.floats(allow_nan=False)
VALUES = st.recursive(
    LEAVES | NUMBERS,
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(KEYS, inner, max_size=3),
    max_leaves=10,
)


@given(st.dictionaries(KEYS, VALUES, max_size=5))
def test_toml_is_read_as_it_was_written(document: dict[str, Any]) -> None:
    assert tomllib.loads(dumps(document)) == document


# Lines --------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("path", "line"),
    [
        (("title",), 2),
        (("materials", "steel"), 5),
        (("materials", "steel", "E"), 6),
        (("sections", "wire", "circle", "radius"), 9),
        (("sections", "wire", "material"), 10),
        (("rods", 0), 12),
        (("rods", 0, "missing"), 12),
        (("rods", 0, "curvature", 2), 16),
        (("supports", 0, "kind"), 22),
        (("loads", 0, "force"), 25),
        (("loads", 1, "force", 2), 30),
        (("solve", "max_iterations"), 35),
        (("nothing",), None),
        ((), None),
    ],
)
def test_lines_of_values(path: tuple[str | int, ...], line: int | None) -> None:
    assert line_of(TEXT, path) == line


def test_lines_of_texts_with_other_line_ends_and_without_the_last() -> None:
    assert line_of("a = 1\r\n\r\nb = 2\r\n", ("b",)) == 3
    assert line_of("a = 1\nb = 2", ("b",)) == 2
    assert line_of('a = """x\\"""\n"""\nb = 2', ("b",)) == 3


def test_errors_tell_file_line_key_and_remedy(path: Path) -> None:
    error = refused(path, TEXT.replace('"1 m"', '"1 kg"').replace('"200 GPa"', "-1"))
    assert (error.file, error.line, error.key) == (str(path), 13, "rods[0].length")
    assert str(error).endswith(
        'line 13, rods[0].length: expected a length such as "2 mm" or a number in m; "kg" is a '
        'unit of mass, got "1 kg"'
    )
    error = refused(path, TEXT.replace('"200 GPa"', "-1"))
    assert (error.line, error.key) == (6, "materials.steel.E")
    copy = pickle.loads(pickle.dumps(error))
    assert (str(copy), copy.line) == (str(error), 6)


def test_errors_of_json_tell_the_key(tmp_path: Path) -> None:
    path = tmp_path / "scene.json"
    error = refused(path, json.dumps({"rods": [{"length": "1 kg", "section": "x"}]}))
    assert [(p.line, p.key) for p in error.problems] == [
        (None, "rods[0].length"),
        (None, "rods[0].section"),
    ]


# Files that are none ------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "line", "what"),
    [
        ("", None, "empty"),
        (" \n\n", None, "empty"),
        ("a = 1\nb = = 2", 2, "cannot be parsed"),
        ("a = 1\na = 2", 2, "cannot be parsed"),
        ("a = " + "[" * 9999, None, "nested too deep"),
        ("a = " + "9" * 9999, None, "cannot be parsed"),
    ],
)
def test_what_is_no_toml(path: Path, text: str, line: int | None, what: str) -> None:
    error = refused(path, text)
    assert error.line == line
    assert what in error.what


@pytest.mark.parametrize(
    ("text", "line", "what"),
    [
        ("", None, "empty"),
        ('{"a": 1,\n', 2, "cannot be parsed"),
        ('{"a": 1, "a": 2}', None, 'key "a" is given twice'),
        ("[" * 99999, None, "nested too deep"),
        ("[1]", None, "expected an object"),
    ],
)
def test_what_is_no_json(tmp_path: Path, text: str, line: int | None, what: str) -> None:
    error = refused(tmp_path / "scene.json", text)
    assert error.line == line
    assert what in error.what


def test_other_encodings_folders_and_large_files(
    path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path.write_bytes("title = 'é'".encode("latin-1"))
    with pytest.raises(pyrod.SceneFileError, match="not UTF-8"):
        pyrod.load(path)
    monkeypatch.setattr(files, "MOST_BYTES", 3)
    with pytest.raises(pyrod.SceneFileError, match="larger than"):
        pyrod.load(path)
    with pytest.raises(FileNotFoundError):
        pyrod.load(path.with_name("none.toml"))
    folder = path.with_name("folder.toml")
    folder.mkdir()
    with pytest.raises(pyrod.SceneFileError, match="folder"):
        pyrod.load(folder)


# Units --------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "dimension", "value"),
    [
        ("10.03 mm", units.LENGTH, 10.03e-3),
        ("  2mm ", units.LENGTH, 2e-3),
        ("-1.5e-3 km", units.LENGTH, -1.5),
        ("1 inch", units.LENGTH, 0.0254),
        ("200 GPa", units.PRESSURE, 200e9),
        ("1 g/cm^3", units.DENSITY, 1000.0),
        ("1 g cm^-3", units.DENSITY, 1000.0),
        ("0.5 1/cm", units.CURVATURE, 50.0),
        ("0.5/cm", units.CURVATURE, 50.0),
        ("3 N·mm", units.MOMENT, 3e-3),
        ("3 N*mm", units.MOMENT, 3e-3),
        ("2 N m²", units.BENDING_STIFFNESS, 2.0),
        ("2 kN m**2", units.BENDING_STIFFNESS, 2000.0),
        ("180 deg/m", units.CURVATURE, 3.141592653589793),
        (".5 µm", units.LENGTH, 5e-7),
        ("inf", units.FORCE, float("inf")),
    ],
)
def test_quantities(text: str, dimension: units.Dimension, value: float) -> None:
    """To the last bit."""
    assert units.quantity(text, dimension) == value


@pytest.mark.parametrize(
    "text",
    [
        "1 m + 1 m",
        "1 m^99",
        "__import__('os')",
        "1 (m)",
        "1 m m m m" * 20,
        "1e99999 m",
        "nan m",
        "m",
    ],
)
def test_what_is_no_quantity_does_not_reach_the_library(
    text: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(units, "_registry", pytest.fail)
    with pytest.raises(units.Misread, match="expected a length"):
        units.quantity(text, units.LENGTH)


@pytest.mark.parametrize("text", ["1 dB/m", "1 Np/m"])
def test_units_on_other_scales_are_refused(text: str) -> None:
    with pytest.raises(units.Misread, match="expected a curvature"):
        units.quantity(text, units.CURVATURE)


def test_without_pint_the_remedy_is_told(monkeypatch: pytest.MonkeyPatch, path: Path) -> None:
    import sys

    units._registry.cache_clear()
    monkeypatch.setitem(sys.modules, "pint", None)
    path.write_text(TEXT)
    with pytest.raises(ImportError, match=r"pip install 'pyrod\[files\]'"):
        pyrod.load(path)
    SCENE.save(path)
    assert pyrod.load(path) == SCENE  # numbers alone need no units
