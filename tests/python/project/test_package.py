"""The package: what it ships, what it imports, what its commands and its README do."""

from __future__ import annotations

import importlib
import inspect
import os
import re
import subprocess
import sys
from functools import cached_property
from importlib.metadata import version
from pathlib import Path
from types import ModuleType

import pytest

import pyrod
from pyrod import plot

pytestmark = pytest.mark.outside

PACKAGE = Path(pyrod.__path__[0])
ROOT = Path(__file__).parents[3]


def blocks(document: str) -> list[str]:
    """The Python code that a document shows."""
    text = (ROOT / document).read_text()
    return re.findall(r"^```python\n(.*?)^```", text, re.DOTALL | re.MULTILINE)


BLOCKS = blocks("README.md")
PAGES = [str(p.relative_to(ROOT)) for p in sorted((ROOT / "docs").rglob("*.md"))]


def python(*arguments: str, **more: str) -> str:
    """What a fresh interpreter prints."""
    run = subprocess.run(
        [sys.executable, *arguments],
        check=True,
        capture_output=True,
        text=True,
        env={**os.environ, **more},
    )
    return run.stdout.strip()


# What is shipped ----------------------------------------------------------------------------------


def test_types_are_shipped() -> None:
    assert (PACKAGE / "py.typed").is_file()
    assert (PACKAGE / "_core" / "__init__.pyi").is_file()


def test_stubs_are_those_of_the_compiled_part(tmp_path: Path) -> None:
    python("-m", "pybind11_stubgen", "--exit-code", "--output-dir", str(tmp_path), "pyrod._core")
    fresh = {p.name: p.read_text() for p in (tmp_path / "pyrod" / "_core").glob("*.pyi")}
    shipped = {p.name: p.read_text() for p in (PACKAGE / "_core").glob("*.pyi")}
    assert fresh
    assert shipped == fresh, "run `make stubs`"


def test_stubs_name_all_that_is_compiled() -> None:
    stub = (PACKAGE / "_core" / "__init__.pyi").read_text()
    for name in vars(pyrod._core):
        assert name.startswith("__") or re.search(rf"\b{name}\b", stub), name


# Commands -----------------------------------------------------------------------------------------


def test_version() -> None:
    assert python("-m", "pyrod", "--version") == pyrod.__version__ == version("pyrod")
    assert re.fullmatch(r"\d+\.\d+\.\d+", pyrod.__version__)


def test_cmakedir_is_a_folder_with_the_config() -> None:
    folder = Path(python("-m", "pyrod", "--cmakedir"))
    assert (folder / "pyrodConfig.cmake").is_file()
    header = next(folder.parents[2].rglob("pyrod.hpp"), None)
    assert header is not None


def test_without_a_command_help_is_shown() -> None:
    shown = python("-m", "pyrod")
    assert "--cmakedir" in shown
    assert "--version" in shown


# Imports ------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "module", ["matplotlib", "scipy", "mpmath", "hypothesis", "tqdm", "xarray"]
)
def test_import_needs_numpy_only(module: str) -> None:
    assert python("-c", f"import sys, pyrod; print({module!r} in sys.modules)") == "False"


def test_solving_needs_numpy_only() -> None:
    code = """
import sys
sys.modules.update(dict.fromkeys(["scipy", "matplotlib"]))  # any import of them fails
import pyrod
rod = pyrod.Rod.straight(1.0, 4, pyrod.Section(1, 1, 1))
print(pyrod.solve(pyrod.Scene(rod, pyrod.Clamp(), pyrod.Force((1, 0, 0)))).status)
"""
    assert python("-c", code) == "converged"


# Documentation ------------------------------------------------------------------------------------

PUBLIC = [(name, getattr(pyrod, name)) for name in pyrod.__all__]
MODULES = [pyrod.rotation, pyrod.curve]


def described() -> list[tuple[str, object]]:
    """Public functions, and what is public in public classes."""
    found: list[tuple[str, object]] = [("pyrod.solve", pyrod.solve)]
    for m in MODULES:
        found += [(f"{m.__name__}.{n}", f) for n, f in vars(m).items() if is_own(f, m, n)]
    for name, thing in [*PUBLIC, *((n, getattr(pyrod.curve, n)) for n in pyrod.curve.__all__)]:
        if inspect.isclass(thing) and thing.__module__.startswith("pyrod"):
            found += [
                (f"{name}.{member}", getattr(thing, member))
                for member, value in vars(thing).items()
                if not member.startswith("_") and tells(value)
            ]
    return found


def tells(member: object) -> bool:
    """A method or something computed; in contrast to a field, which its class describes."""
    kinds = (property, cached_property, classmethod, staticmethod)
    return inspect.isroutine(member) or isinstance(member, kinds)


def is_own(function: object, module: object, name: str) -> bool:
    """Of the module itself, or of the package that it is."""
    return (
        inspect.isfunction(function)
        and f"{function.__module__}.".startswith(f"{module.__name__}.")
        and name[0] != "_"
    )


def test_what_is_described_covers_the_curves() -> None:
    names = {name for name, _ in described()}
    assert {"pyrod.curve.strains", "pyrod.curve.without_repeats", "pyrod.rotation.exp"} <= names
    assert {"Polyline.curvature", "Polyline.tangents", "Polyline.edges"} <= names
    assert {"FramedCurve.sampled", "FramedCurve.K", "FramedCurve.twist", "Rod.straight"} <= names


@pytest.mark.parametrize("module", [pyrod, pyrod.curve], ids=["pyrod", "pyrod.curve"])
def test_all_is_sorted_and_there(module: ModuleType) -> None:
    assert sorted(module.__all__) == module.__all__
    star: dict[str, object] = {}
    exec(f"from {module.__name__} import *", star)
    assert set(module.__all__) <= set(star)


@pytest.mark.parametrize(("name", "thing"), PUBLIC, ids=pyrod.__all__)
def test_public_names_are_documented(name: str, thing: object) -> None:
    doc = inspect.getdoc(thing)
    assert doc is not None
    assert len(doc) > 20
    assert not doc.startswith(f"{name}(")  # what a dataclass makes up


@pytest.mark.parametrize(("name", "function"), described(), ids=[name for name, _ in described()])
def test_public_functions_are_documented(name: str, function: object) -> None:
    assert len(inspect.getdoc(function) or "") > 10, name


@pytest.mark.parametrize(
    "function",
    [
        pyrod.solve,
        pyrod.sweep,
        pyrod.critical_load,
        pyrod.curve.strains,
        pyrod.curve.bishop_from_frenet,
        pyrod.curve.frenet_from_bishop,
        pyrod.curve.without_repeats,
        pyrod.curve.Polyline.bishop,
        pyrod.curve.Polyline.derivative,
        pyrod.Rod.energy,
        pyrod.Rod.outline,
        pyrod.Outline.polygon,
        pyrod.Outline.loops,
        pyrod.Equilibrium.show,
        pyrod.Equilibrium.to_html,
        pyrod.Equilibrium.to_pyvista,
        plot.draw,
        plot.overview,
    ],
)
def test_parameters_are_described(function: object) -> None:
    doc = inspect.getdoc(function)
    for parameter in inspect.signature(function).parameters:
        assert parameter == "self" or re.search(rf"^.*\b{parameter}\b.* : ", doc, re.MULTILINE), (
            parameter
        )


CLASSES = [
    pyrod.Rod,
    pyrod.Scene,
    pyrod.Clamp,
    pyrod.Hinge,
    pyrod.Slider,
    pyrod.Sleeve,
    pyrod.Pivot,
    pyrod.Spring,
    pyrod.Joint,
    pyrod.Material,
    pyrod.Section,
    pyrod.Force,
    pyrod.Moment,
    pyrod.DistributedForce,
    pyrod.DistributedMoment,
    pyrod.Gravity,
    pyrod.curve.Polyline,
    pyrod.curve.FramedCurve,
]


@pytest.mark.parametrize("made", CLASSES, ids=lambda c: c.__name__)
def test_fields_are_described(made: type) -> None:
    doc = inspect.getdoc(made)
    for parameter in inspect.signature(made).parameters:
        if not parameter.startswith("_"):
            assert re.search(rf"\b{parameter}\b", doc), parameter


@pytest.mark.parametrize(
    "made",
    [pyrod.Equilibrium, pyrod.RodEquilibrium, pyrod.Sweep, pyrod.Critical],
    ids=lambda c: c.__name__,
)
def test_results_explain_their_fields(made: type) -> None:
    """Beside the field or above it, in the source: they are read from there by editors."""
    source = inspect.getsource(made)
    plain = {"scene", "rod", "rods"}  # these explain themselves
    for name in inspect.signature(made).parameters:
        line = re.search(rf"^    {name}: .*\n(    \"\"\")?", source, re.MULTILINE)
        assert name in plain or name[0] == "_" or (line and ("#:" in line[0] or line[1])), name


def test_modules_are_documented() -> None:
    for path in PACKAGE.rglob("*.py"):
        module = ".".join(path.relative_to(PACKAGE.parent).with_suffix("").parts)
        if path.stem != "__main__":
            assert importlib.import_module(module).__doc__, path


# README -------------------------------------------------------------------------------------------


def test_the_readme_shows_python() -> None:
    assert len(BLOCKS) > 0


@pytest.mark.parametrize("block", BLOCKS, ids=[f"block {i}" for i in range(len(BLOCKS))])
def test_the_readme_runs_as_printed(
    block: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    exec(compile(block, "README.md", "exec"), {"__name__": "__main__"})
    for picture in re.findall(r'savefig\("(.*?)"\)', block):
        assert (tmp_path / picture).stat().st_size > 1000


@pytest.mark.parametrize("page", [p for p in PAGES if blocks(p)])
def test_the_code_of_a_page_runs_in_order(
    page: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As a reader would type it: each block knows the names of those before it."""
    monkeypatch.chdir(tmp_path)
    names: dict[str, object] = {"__name__": "__main__"}
    for block in blocks(page):
        exec(compile(block, page, "exec"), names)


def test_some_page_shows_code() -> None:
    assert any(blocks(page) for page in PAGES)


@pytest.mark.parametrize("page", ["README.md", *PAGES])
def test_links_lead_somewhere(page: str) -> None:
    for target in re.findall(r"\]\(([^)#:]+?)(?:#[^)]*)?\)", (ROOT / page).read_text()):
        assert ((ROOT / page).parent / target).exists(), target
