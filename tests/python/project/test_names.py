"""Names of the package: what is private stays in its file, and one name has one meaning."""

from __future__ import annotations

import ast
import re
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from support import FLAT, X, Y, Z

import pyrod
from pyrod import Clamp, DistributedForce, Force, Rod, Scene
from pyrod.rod.place import Place
from pyrod.scene.loads import Along, LoadAlong, PointLoad

ROOT = Path(__file__).parents[3]
SOURCE = ROOT / "python" / "pyrod"
HEADERS = ROOT / "cpp" / "include" / "pyrod"

SHARED = {
    "_compiled": "the C++ object that one of Python holds",
    "_law": "what a rod was made of, which its outlines and its document need",
    "_climbing": "the scene as a solve with a tolerance has it",
}
"""Private names that the whole package may read, and no others."""
TUPLES = {"_asdict", "_fields", "_replace"}
"""Of named tuples: public, in spite of their names."""
TWICE = {
    "add_arguments": "each command of the command line",
    "run": "each command of the command line",
    "solver": "of JAX, and of PyTorch",
    "load": "pyrod.load of files, and pyrod.reference.load of cases",
    "folder": "public in pyrod.reference, of one folder of the package",
}
"""Names of several functions, each of one idea."""
LOADS = ("DistributedForce", "DistributedMoment", "Gravity")
"""Kinds of loads whose names are no words of anything else."""


def trees() -> dict[str, ast.Module]:
    paths = [p for p in SOURCE.rglob("*.py") if not {"_core", "_reference"} & {*p.parts}]
    return {str(p.relative_to(SOURCE)): ast.parse(p.read_text(encoding="utf-8")) for p in paths}


TREES = trees()


def own(tree: ast.Module) -> set[str]:
    """Names that a file itself gives to methods, fields, attributes of self or keywords."""
    names = set()
    for node in ast.walk(tree):
        match node:
            case ast.FunctionDef(name=name) | ast.ClassDef(name=name):
                names.add(name)
            case ast.AnnAssign(target=ast.Name(id=name)):
                names.add(name)
            case ast.Attribute(value=ast.Name(id="self"), attr=name, ctx=ast.Store()):
                names.add(name)
    return names


def read_of_others(tree: ast.Module) -> Iterator[str]:
    """Private attributes that are read of objects of other files."""
    mine = own(tree)
    for node in ast.walk(tree):
        match node:
            case ast.Attribute(value=ast.Name(id="self" | "cls" | "_core")):
                pass
            case ast.Attribute(attr=name) if name.startswith("_") and not name.endswith("__"):
                if name not in mine | TUPLES:
                    yield name


def test_private_names_of_others_are_a_handful() -> None:
    read = {(file, name) for file, tree in TREES.items() for name in read_of_others(tree)}
    assert {name for _, name in read} == {*SHARED}, sorted(read)


def test_private_names_of_others_are_seen() -> None:
    tree = ast.parse("class A:\n    def _a(self): self._b = x._a, x._c, y.z._d, t._asdict()")
    assert set(read_of_others(tree)) == {"_c", "_d"}


def test_a_name_has_one_meaning() -> None:
    files = defaultdict(set)
    for file, tree in TREES.items():
        for node in tree.body:
            if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
                files[node.name].add(file)
    assert {name for name, where in files.items() if len(where) > 1} == {*TWICE}


def test_a_kind_of_load_is_one_idea() -> None:
    """One file knows it; besides it is exported, and scene files and reference cases have it."""
    python = {
        file
        for file, tree in TREES.items()
        for node in ast.walk(tree)
        if isinstance(node, (ast.Name, ast.ClassDef, ast.alias))
        and (node.id if isinstance(node, ast.Name) else node.name) in LOADS
    }
    told = {"scene/__init__.py", "__init__.py", "document/schema.py", "reference/_cases.py"}
    assert python == {"scene/loads.py", *told}


@pytest.mark.skipif(not HEADERS.is_dir(), reason="needs the sources")
@pytest.mark.parametrize("kind", LOADS)
def test_a_kind_of_load_is_one_idea_in_cpp(kind: str) -> None:
    sources = [p for p in (ROOT / "cpp").rglob("*.?pp") if re.search(rf"\b{kind}\b", p.read_text())]
    assert [p.name for p in sources] == ["load.hpp"]


# A kind of load that nobody has heard of ---------------------------------------------------------


@dataclass(frozen=True, eq=False)
class Push(PointLoad):
    """On the middle of a rod."""

    force: np.ndarray
    at: Place = 0.5
    follower: bool = False
    _kind = pyrod._core.Force


@dataclass(frozen=True, eq=False)
class Wind(LoadAlong):
    """Along a rod, as another says."""

    force_per_length: Along
    rod: int = 0
    follower: bool = False
    _kind = pyrod._core.DistributedForce


def rising(s: float) -> np.ndarray:
    return s * X


@pytest.mark.parametrize(
    ("new", "known"),
    [
        (Push(X - Z), Force(X - Z, at=0.5)),
        (Wind(rising), DistributedForce(rising)),
        (Wind(np.outer(np.arange(8), X)), DistributedForce(np.outer(np.arange(8), X))),
    ],
    ids=["on a point", "function", "list"],
)
def test_the_rest_knows_new_kinds_of_loads(new: pyrod.scene.Load, known: pyrod.scene.Load) -> None:
    """Without a tolerance, with one, on cut edges, in the check for a plane."""
    rod = Rod.straight(1.0, 8, FLAT)
    for supports in (Clamp(), [Clamp(), pyrod.Spring(5.0, at=0.3)]):
        ours, theirs = (Scene(rod, supports, load) for load in (new, known))
        np.testing.assert_array_equal(ours.loads[0].acting, theirs.loads[0].acting)
        for tol in (None, 1e-4):
            found, exact = (pyrod.solve(scene, tol=tol).positions for scene in (ours, theirs))
            np.testing.assert_array_equal(found, exact)
    assert pyrod.is_planar(Scene(rod, Clamp(), new))
    aslant = pyrod.is_planar(Scene(rod, Clamp(), [new, Push(Y)]))
    assert aslant.why == "load 1 (Force) has a component 1 along a2"
