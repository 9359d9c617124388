"""The folders of the C++ headers: which may include which, and how deep includes go."""

from __future__ import annotations

import functools
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3] / "cpp" / "include"
pytestmark = pytest.mark.skipif(not ROOT.is_dir(), reason="needs the sources")

BELOW = {
    "core": set(),
    "rotation": {"core"},
    "curve": {"core", "rotation"},
    "rod": {"core", "rotation", "curve"},
    "scene": {"core", "rotation", "curve", "rod"},
    "sparse": {"core"},
    "solve": {"core", "sparse"},
    "statics": {"core", "rotation", "curve", "rod", "scene", "sparse", "solve"},
    "linear": {"core", "rotation", "curve", "rod", "scene", "sparse", "solve", "statics"},
    "paths": {"core", "rotation", "curve", "rod", "scene", "sparse", "solve", "statics"},
}
"""Folders, and those that they may include besides themselves."""
ROOMS = ("unknowns", "equations", "solution", "start", "solving", "ladder", "")
"""Of statics, from the lowest; the last are the headers that are in no room."""
DEEPEST = 28
"""The longest chain of headers of which each includes the next. Fewer are better."""


@functools.cache
def includes(header: str) -> tuple[str, ...]:
    """Without those that depend on a macro."""
    always, *_ = (ROOT / header).read_text().partition("\n#if")
    return tuple(re.findall(r"^#include <(pyrod/.+?)>", always, re.M))


@functools.cache
def depth(header: str) -> int:
    return 1 + max(map(depth, includes(header)), default=0)


def headers() -> list[str]:
    return [str(path.relative_to(ROOT)) for path in ROOT.rglob("*.hpp")]


def test_folders_only_include_those_below() -> None:
    up = set()
    for header in headers():
        folder = header.split("/")[1]
        if folder in BELOW:
            allowed = BELOW[folder] | {folder}
            up |= {(header, h) for h in includes(header) if h.split("/")[1] not in allowed}
        else:  # the umbrellas
            assert folder.endswith(".hpp"), f"a folder of no level: {header}"
    assert not up


def test_rooms_of_statics_only_include_those_below() -> None:
    def room(header: str) -> int:
        *_, name, _ = ("", *header.removeprefix("pyrod/statics/").split("/"))
        return ROOMS.index(name)

    inside = [header for header in headers() if header.startswith("pyrod/statics/")]
    for header in inside:
        for other in filter(inside.__contains__, includes(header)):
            assert room(other) <= room(header), f"{header} includes {other}"


def test_no_header_includes_itself_in_a_circle() -> None:
    open_: list[str] = []

    @functools.cache
    def visit(header: str) -> None:
        assert header not in open_, f"a circle: {open_}"
        open_.append(header)
        for other in includes(header):
            visit(other)
        open_.pop()

    for header in headers():
        visit(header)


def test_includes_are_not_deeper_than_they_were() -> None:
    assert max(map(depth, headers())) <= DEEPEST


def test_the_umbrella_has_all() -> None:
    """Where the solvers are not compiled already."""
    reached: set[str] = set()
    todo = ["pyrod/pyrod.hpp"]
    while todo:
        header = todo.pop()
        if header not in reached:
            reached.add(header)
            text = (ROOT / header).read_text()
            todo += includes(header)
            for part in re.findall(r"^#ifndef PYROD_COMPILED\n(.+?)^#endif", text, re.M | re.S):
                todo += re.findall(r"^#include <(pyrod/.+?)>", part, re.M)
    assert set(headers()) - reached == {"pyrod/statics/ladder/compiled.hpp"}
