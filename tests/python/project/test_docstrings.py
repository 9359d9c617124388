"""Docstrings of all that is public are as NumPy's tools read them, and name what there is."""

from __future__ import annotations

import ast
import builtins
import inspect
import re
import textwrap
from collections.abc import Iterator
from dataclasses import is_dataclass
from typing import Any, NamedTuple

import pytest

import pyrod
from pyrod import plot, reference
from pyrod.base.borrowed import Borrowed

SECTIONS = ("Parameters", "Returns", "Raises", "Warns")
ENTRY = re.compile(r"(?P<names>\*{0,2}\w+(, \*{0,2}\w+)*)(?: : (?P<type>\S.*))?")
FEW = 2
"""Parameters that the summary may tell of, without a list."""


class Entry(NamedTuple):
    names: list[str]
    type: str | None


def sections(doc: str) -> dict[str, list[str]]:
    """Lines of each section, without the line below its name."""
    found: dict[str, list[str]] = {}
    lines, name = doc.splitlines(), ""
    for line, below in zip(lines, [*lines[1:], ""], strict=True):
        if below and set(below) == {"-"}:
            assert line in SECTIONS, f"unknown section {line!r}"
            assert len(line) == len(below), f"the line below {line} has another length"
            assert list(found) == [s for s in SECTIONS if s in found], "sections out of order"
            assert line not in found
            name = line
            found[name] = []
        elif name and not (line and set(line) == {"-"}):
            found[name].append(line)
    return found


def entries(lines: list[str]) -> list[Entry]:
    """Names and types; everything else must be indented."""
    found = []
    for line in lines:
        if line and not line.startswith("    "):
            match = ENTRY.fullmatch(line)
            assert match, f"neither an entry nor indented: {line!r}"
            found.append(Entry(match["names"].split(", "), match["type"]))
        else:
            assert found or not line, f"a description of nothing: {line!r}"
    return found


def public() -> Iterator[tuple[str, Any]]:
    """Functions, classes and their methods and properties, by name."""
    for module in (pyrod, pyrod.curve, pyrod.rotation, reference, plot):
        names = getattr(module, "__all__", None) or [
            name
            for name, value in vars(module).items()
            if name[0] != "_" and getattr(value, "__module__", None) == module.__name__
        ]
        for name in names:
            thing = getattr(module, name)
            if inspect.isclass(thing) and not thing.__module__.endswith("._core"):
                yield f"{module.__name__}.{name}", thing
                yield from members(f"{module.__name__}.{name}", thing)
            elif inspect.isfunction(thing):
                yield f"{module.__name__}.{name}", thing


def members(of: str, kind: type) -> Iterator[tuple[str, Any]]:
    for base in kind.__mro__:
        if not base.__module__.startswith("pyrod"):
            continue
        for name, member in vars(base).items():
            if isinstance(member, (classmethod, staticmethod)):
                member = member.__func__
            if isinstance(member, Borrowed):
                member = member.function
            if name[0] != "_" and (inspect.isfunction(member) or is_property(member)):
                yield f"{of}.{name}", member


def is_property(member: Any) -> bool:
    return isinstance(member, property) or type(member).__name__ == "cached_property"


PUBLIC = dict(public())
CALLABLE = {name: thing for name, thing in PUBLIC.items() if callable(thing)}
PROPERTIES = {name: thing for name, thing in PUBLIC.items() if is_property(thing)}


def parameters(thing: Any) -> list[str]:
    names = [name for name in inspect.signature(thing).parameters if name not in ("self", "cls")]
    return [name for name in names if name[0] != "_"]


def is_result(thing: Any) -> bool:
    """A class that users do not make: its docstring lists no parameters, its fields are told."""
    fields = is_dataclass(thing) or (inspect.isclass(thing) and issubclass(thing, tuple))
    return fields and "Parameters" not in sections(inspect.getdoc(thing) or "")


def test_all_are_looked_at() -> None:
    assert len(CALLABLE) > 130
    assert len(PROPERTIES) > 60


@pytest.mark.parametrize("name", CALLABLE)
def test_every_parameter_is_named_in_order_with_its_type(name: str) -> None:
    thing = CALLABLE[name]
    doc = inspect.getdoc(thing)
    assert doc, "no docstring"
    found = sections(doc)
    if "Parameters" not in found:
        is_error = inspect.isclass(thing) and issubclass(thing, Exception)
        assert is_error or is_result(thing) or len(parameters(thing)) <= FEW
        return
    told = entries(found["Parameters"])
    assert [name for entry in told for name in entry.names] == parameters(thing)
    assert all(entry.type for entry in told)
    assert not any(re.search(r"\s:|\.$", entry.type or "") for entry in told)


@pytest.mark.parametrize("name", CALLABLE)
def test_what_is_raised_is_an_exception(name: str) -> None:
    found = sections(inspect.getdoc(CALLABLE[name]) or "")
    for section, kind in (("Raises", BaseException), ("Warns", Warning)):
        for entry in entries(found.get(section, [])):
            assert entry.type is None, "the meaning stands below the name"
            for one in entry.names:
                known = getattr(pyrod, one, getattr(builtins, one, None))
                assert isinstance(known, type)
                assert issubclass(known, kind)


@pytest.mark.parametrize("name", PROPERTIES)
def test_properties_begin_with_no_type(name: str) -> None:
    """Tools take what stands before a colon in the first line for the type."""
    first = (inspect.getdoc(PROPERTIES[name]) or "").partition("\n")[0]
    assert first
    assert ": " not in first


@pytest.mark.parametrize("name", [n for n, thing in CALLABLE.items() if is_result(thing)])
def test_fields_of_results_are_told(name: str) -> None:
    source = textwrap.dedent(inspect.getsource(CALLABLE[name]))
    (kind,) = ast.parse(source).body
    assert isinstance(kind, ast.ClassDef)
    lines = source.splitlines()
    for field, behind in zip(kind.body, [*kind.body[1:], ast.Pass()], strict=True):
        if not isinstance(field, ast.AnnAssign) or ast.unparse(field.target)[0] == "_":
            continue
        if ast.unparse(field.target) in SELF_TOLD:
            continue
        doc = behind.value if isinstance(behind, ast.Expr) else None
        text = doc.value if isinstance(doc, ast.Constant) else None
        if text is None:
            text = lines[field.lineno - 1].partition("#: ")[2]
        assert text, ast.unparse(field.target)
        assert ": " not in str(text).partition("\n")[0]


SELF_TOLD = ("tol", "scene", "rods", "rod")
"""Fields of which the class tells."""


def test_what_is_no_section_is_seen() -> None:
    good = (
        "Does.\n\nParameters\n----------\na, b : int\n    What.\n*c : str\n\n"
        "Raises\n------\nE\n    If."
    )
    told = entries(sections(good)["Parameters"])
    assert told == [Entry(["a", "b"], "int"), Entry(["*c"], "str")]
    for bad in (
        good.replace("Raises\n------", "Raised\n------"),
        good.replace("------\nE", "-----\nE"),
        good.replace("    What.", "What is it."),
    ):
        with pytest.raises(AssertionError):
            entries(sections(bad)["Parameters"])
