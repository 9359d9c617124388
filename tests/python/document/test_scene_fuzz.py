"""Whatever a document says, it is a scene or refused by `SceneFileError`."""

from __future__ import annotations

import copy
import importlib.util
import tomllib
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import pyrod
from pyrod.document import read, schema
from pyrod.document.schema import LOADS, ROD, SCENE, SUPPORTS

ROOT = Path(__file__).parents[3]
SEEDS = [tomllib.loads(p.read_text()) for p in sorted((ROOT / "examples/scenes").glob("*.toml"))]

WORDS = st.sampled_from(
    [
        *sorted({*SCENE.keys, *ROD.keys, *SUPPORTS.kinds, *LOADS.kinds}),
        *("start", "end", "kind", "at", "spatial", "auto", "inf"),
        *("1 m", "-2 N", "1e300 m", "30 deg/m", "9**9**9", "1 kg m^-9"),
    ]
)
NUMBERS = st.one_of(
    st.integers(-3, 20),
    st.floats(),
    st.sampled_from([1e-300, 1e300, -0.0, 5e-324, 10**30, -1.7e308]),
)
LEAVES = st.one_of(WORDS, NUMBERS, st.booleans(), st.text(max_size=8), st.none())
VALUES = st.recursive(
    LEAVES,
    lambda inner: (
        st.lists(inner, max_size=4)
        | st.dictionaries(WORDS | st.text(max_size=4), inner, max_size=4)
    ),
    max_leaves=12,
)
PLAIN = settings(suppress_health_check=list(HealthCheck))


def places(document: Any, path: tuple[Any, ...] = ()) -> list[tuple[Any, ...]]:
    """Paths of all values."""
    items: Any = ()
    if isinstance(document, dict):
        items = document.items()
    elif isinstance(document, list):
        items = enumerate(document)
    return [(*path, k) for k, _ in items] + [p for k, v in items for p in places(v, (*path, k))]


@pytest.fixture(autouse=True)
def small(monkeypatch: pytest.MonkeyPatch) -> None:
    """Rods of many edges are no errors, but take time."""
    monkeypatch.setattr("pyrod.document.rods.MOST_EDGES", 2000)
    edges = schema.Key(schema.whole_number(1, 2000))
    monkeypatch.setitem(ROD.keys, "edges", edges)


def check(document: Any) -> None:
    """Refused, or a scene."""
    try:
        read(document)
    except pyrod.SceneFileError as error:
        str(error)


@st.composite
def mutants(draw: Any) -> dict[str, Any]:
    """Examples in which some values are others, gone or doubled."""
    document = copy.deepcopy(draw(st.sampled_from(SEEDS)))
    for _ in range(draw(st.integers(1, 4))):
        *path, key = draw(st.sampled_from(places(document)))
        around = document
        for step in path:
            around = around[step]
        act = draw(st.sampled_from(["change", "number", "number", "delete", "add", "double"]))
        if act == "delete":
            del around[key]
        elif act == "add" and isinstance(around, dict):
            around[draw(WORDS)] = draw(VALUES)
        elif act == "double" and isinstance(around, list):
            around.append(copy.deepcopy(around[key]))
        else:
            around[key] = draw(NUMBERS if act == "number" else VALUES)
        if not document:
            break
    return document


@settings(PLAIN, max_examples=100)
@given(mutants())
def test_mutants_of_examples_are_read_or_refused(document: dict[str, Any]) -> None:
    check(document)


@pytest.mark.long
@settings(PLAIN, max_examples=1500)
@given(mutants())
def test_many_mutants_of_examples_are_read_or_refused(document: dict[str, Any]) -> None:
    check(document)


@settings(PLAIN, max_examples=100)
@given(st.dictionaries(WORDS, VALUES, max_size=5))
def test_any_values_are_read_or_refused(document: dict[str, Any]) -> None:
    check(document)


@settings(PLAIN, max_examples=100)
@given(st.sampled_from(sorted((ROOT / "examples/scenes").glob("*.toml"))), st.data())
def test_torn_files_are_read_or_refused(torn: Any, seed: Path, data: Any) -> None:
    text = seed.read_bytes()
    a, b = sorted(data.draw(st.integers(0, len(text))) for _ in range(2))
    torn(text[:a] + data.draw(st.binary(max_size=6)) + text[b:])


@pytest.fixture
def torn(tmp_path: Path) -> Any:
    """What the target for atheris does with some bytes."""
    path = ROOT / "tests/fuzz/scene_file.py"
    spec = importlib.util.spec_from_file_location("scene_file", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return lambda data: module.check(data, tmp_path / "scene.toml")
