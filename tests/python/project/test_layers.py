"""The packages stand in storeys and import downwards only; methods that call up say where to."""

from __future__ import annotations

import ast
import inspect
import tomllib
from collections.abc import Iterator
from graphlib import CycleError, TopologicalSorter
from pathlib import Path
from types import FunctionType, MethodType
from typing import Any, get_type_hints

import pytest

import pyrod
from pyrod.base.borrowed import Borrowed

ROOT = Path(__file__).parents[3]
SOURCE = ROOT / "python" / "pyrod"
CONTRACT = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["importlinter"]
LAYERS = [layer.split(" | ") for layer in CONTRACT["contracts"][0]["layers"]]
"""From the highest to the lowest."""
STOREY = {package: i for i, layer in enumerate(reversed(LAYERS)) for package in layer}
Graph = dict[str, set[str]]


def modules() -> dict[str, Path]:
    found = {}
    for path in SOURCE.rglob("*.py"):
        *parts, name = path.relative_to(SOURCE.parent).with_suffix("").parts
        found[".".join(parts if name == "__init__" else [*parts, name])] = path
    return found


def imported(tree: ast.AST, known: set[str]) -> Iterator[str]:
    """The modules, wherever in the file, by the names that they are imported by."""
    for node in ast.walk(tree):
        names: list[str] = []
        if isinstance(node, ast.Import):
            names = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            assert not node.level, "relative imports are not followed"
            names = [f"{node.module}.{alias.name}" for alias in node.names]
        for name in names:
            if name == "pyrod._core" or name.startswith("pyrod._core."):
                continue  # what is compiled imports nothing
            while name and name not in known:
                name = name.rpartition(".")[0]
            if name:
                yield name


@pytest.fixture(scope="module")
def graph() -> Graph:
    known = modules()
    return {
        name: set(imported(ast.parse(path.read_text(encoding="utf-8")), set(known))) - {name}
        for name, path in known.items()
    }


def circle(graph: Graph) -> list[str]:
    """Modules each of which imports the next, the last the first; none if there is no circle."""
    try:
        TopologicalSorter(graph).prepare()
    except CycleError as error:
        return list(error.args[1])
    return []


def test_circles_are_seen() -> None:
    code = "if TYPE_CHECKING:\n    from a.c import X\ndef f():\n    import a.d\n    from a import e"
    known = {"a", "a.c", "a.d", "a.e"}
    assert set(imported(ast.parse(code), known)) == {"a.c", "a.d", "a.e"}
    assert circle({"a": {"b"}, "b": {"c"}, "c": set()}) == []
    assert set(circle({"a": {"b"}, "b": {"c"}, "c": {"b"}})) == {"b", "c"}


def test_nothing_imports_itself_by_way_of_others(graph: Graph) -> None:
    assert len(graph) > 100
    assert sum(map(len, graph.values())) > 300
    assert circle(graph) == []


def test_every_package_has_a_storey(graph: Graph) -> None:
    packages = {name.split(".")[1] for name in graph if "." in name}
    assert packages == {*STOREY, "__main__"}


def test_arrows_run_downwards(graph: Graph) -> None:
    """Within a package, or to a lower storey; the whole of pyrod is for the command line."""
    upwards = [
        f"{name} -> {other}"
        for name, others in graph.items()
        for other in others
        if not runs_downwards(name, other)
    ]
    assert upwards == []


def runs_downwards(name: str, other: str) -> bool:
    if name in ("pyrod", "pyrod.__main__"):
        return other != "pyrod.__main__"
    package = name.split(".")[1]
    if other == "pyrod":
        return package == "cli"
    below = other.split(".")[1]
    return package == below or STOREY[below] < STOREY[package]


def test_ways_up_are_seen() -> None:
    assert runs_downwards("pyrod.scene.loads", "pyrod.rod.rod")
    assert not runs_downwards("pyrod.rod.rod", "pyrod.scene.loads")
    assert not runs_downwards("pyrod.plot._draw", "pyrod.files.vtk")  # side by side
    assert not runs_downwards("pyrod.rod.rod", "pyrod")


# Methods that are functions of modules above ------------------------------------------------------


BORROWING = (
    pyrod.Equilibrium,
    pyrod.RodEquilibrium,
    pyrod.Scene,
    pyrod.Rod,
    pyrod.curve.Polyline,
    pyrod.curve.FramedCurve,
    pyrod.curve.SmoothCurve,
    *pyrod.curve.Polyline.__bases__,
)


def borrowed() -> dict[str, Borrowed]:
    found = {}
    for kind in BORROWING:
        for name, member in vars(kind).items():
            member = member.fget if isinstance(member, property) else member
            if isinstance(member, Borrowed):
                found[f"{kind.__name__}.{name}"] = member
    return found


BORROWED = borrowed()


def test_all_of_them_are_compared() -> None:
    told = sum(
        path.read_text(encoding="utf-8").count("@borrowed(") for path in SOURCE.rglob("*.py")
    )
    assert len(BORROWED) == told >= 10


def parts(function: Any) -> list[tuple[Any, ...]]:
    """Names, kinds, defaults and types of the parameters but for the first."""
    _, *parameters = inspect.signature(function).parameters.values()
    types = hints(function)
    return [(p.name, p.kind, p.default, types[p.name]) for p in parameters]


def hints(function: Any) -> dict[str, Any]:
    """``Figure`` is matplotlib's, which need not be there."""
    return get_type_hints(function, localns={"Figure": object})


@pytest.mark.parametrize("name", BORROWED)
def test_declarations_are_those_of_the_functions(name: str) -> None:
    declared, function = BORROWED[name].__wrapped__, BORROWED[name].function  # type: ignore[attr-defined]
    assert isinstance(function, FunctionType)
    assert parts(declared) == parts(function)
    told, true = hints(declared)["return"], hints(function)["return"]
    cannot_be_told = told is Any and true.__module__.startswith("pyrod.")  # it is above
    assert cannot_be_told or told == true


def test_functions_are_methods() -> None:
    polyline = pyrod.curve.Polyline([(0, 0, 0), (0, 0, 1), (0, 1, 2)])
    assert isinstance(polyline.bishop, MethodType)
    assert list(inspect.signature(polyline.bishop).parameters) == ["normal", "angles", "frame"]
    for asked in (polyline.bishop, pyrod.curve.Polyline.bishop):
        assert "Linn 6.2.1" in (inspect.getdoc(asked) or "")
    assert isinstance(polyline.bishop(), pyrod.curve.FramedCurve)
