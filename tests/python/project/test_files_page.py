"""The page on files: its tables are those of the schema."""

from __future__ import annotations

import json
import re
import tomllib
from pathlib import Path

import pyrod
from pyrod.document import read, schema
from pyrod.document.tables import REQUIRED, Form, Key
from pyrod.files import _RESULTS

PAGE = (Path(__file__).parents[3] / "docs" / "files.md").read_text()
KINDS: list[Form] = [
    schema.SCENE,
    schema.MATERIAL,
    schema.SECTION,
    *schema.SHAPES.values(),
    schema.ROD,
    schema.JUMP,
    *schema.SUPPORTS.kinds.values(),
    *schema.LOADS.kinds.values(),
    schema.JOINT,
    *schema.ACTUATORS.kinds.values(),
    schema.SOLVE,
]


def row(name: str, key: Key) -> list[str]:
    """What the page says of a key."""
    default = "" if key.default in (None, float("inf")) else f"`{json.dumps(key.default)}`"
    return [f"`{name}`", key.type.text, default]


def needed(name: str, key: Key) -> list[str]:
    """The same of a key that has no default."""
    return [f"`{name}`", key.type.text, "needed"]


def test_tables_are_those_of_the_schema() -> None:
    tables = re.findall(r"^\| key \| value .*\n\|---.*\n((?:\|.*\n)+)", PAGE, re.MULTILINE)
    shown = [[re.split(r" *\| *", line)[1:4] for line in t.splitlines()] for t in tables]
    assert shown == [
        [(needed if key.default is REQUIRED else row)(name, key) for name, key in kind.keys.items()]
        for kind in KINDS
    ]


def test_options_are_explained_as_by_the_solver() -> None:
    for name in schema.OPTIONS:
        (meaning,) = re.findall(rf"^\| `{name}` \|.*\| (.*) \|$", PAGE, re.MULTILINE)
        assert meaning == getattr(pyrod.Options, name).__doc__


def test_the_scene_on_the_page_can_be_read() -> None:
    (text,) = re.findall(r"^```toml\n(.*?)^```", PAGE, re.DOTALL | re.MULTILINE)
    assert isinstance(read(tomllib.loads(text)), pyrod.Scene)


def test_all_formats_of_results_are_on_the_page() -> None:
    table = PAGE.partition("| suffix |")[2].partition("\n\n")[0]
    assert set(re.findall(r"`(\.\w+)`", table)) == set(_RESULTS)
