"""The documentation site: it builds without a warning, names what is public, needs no network."""

from __future__ import annotations

import inspect
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from types import ModuleType

import pytest

import pyrod
from pyrod import plot, reference

pytest.importorskip("sphinx_gallery", reason="the site is built where pyrod[docs] is")
pytest.importorskip("pydata_sphinx_theme", reason="the site is built where pyrod[docs] is")

from sphinx.util.inventory import InventoryFile

pytestmark = pytest.mark.outside

ROOT = Path(__file__).parents[3]
SHARED = ("benchmarks", "cpp", "examples", "tests")
MODULES = [pyrod, pyrod.rotation, pyrod.curve, reference, plot]


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The site, built from a copy, as the gallery writes beside its sources."""
    copy = tmp_path_factory.mktemp("docs")
    shutil.copytree(ROOT / "docs", copy / "docs")
    shutil.rmtree(copy / "docs" / "gallery", ignore_errors=True)
    for name in SHARED:
        (copy / name).symlink_to(ROOT / name)
    arguments = ["-W", "--keep-going", "-q", "-b", "html", "docs", "site"]
    built = subprocess.run(
        [sys.executable, "-m", "sphinx", *arguments],
        cwd=copy,
        capture_output=True,
        text=True,
        env={**os.environ, "MPLBACKEND": "Agg"},
    )
    assert built.returncode == 0, built.stderr
    return copy / "site"


def public(module: ModuleType) -> list[str]:
    """What a module is for: its ``__all__``, else what it defines itself."""
    names = getattr(module, "__all__", None) or [
        name
        for name, value in vars(module).items()
        if name[0] != "_" and getattr(value, "__module__", None) == module.__name__
    ]
    things = [(name, getattr(module, name)) for name in names]
    return [f"{module.__name__}.{name}" for name, thing in things if not inspect.ismodule(thing)]


def test_everything_public_is_in_the_reference(site: Path) -> None:
    found = InventoryFile.loads((site / "objects.inv").read_bytes(), uri="").data
    described = {name for kind, names in found.items() if kind.startswith("py:") for name in names}
    wanted = {name for module in MODULES for name in public(module)}
    assert len(wanted) > 50
    assert wanted - described == set()


def test_members_are_in_the_reference(site: Path) -> None:
    text = (site / "api" / "solving.html").read_text()
    for name in ("Equilibrium.along_mode", "RodEquilibrium.K", "Options.max_iterations"):
        assert f'id="pyrod.{name}"' in text


def test_fields_are_set_apart_from_what_they_mean(site: Path) -> None:
    text = (site / "api" / "scenes.html").read_text()
    for field, kind, meaning in (
        ("EI1, EI2", "float [N m^2]", "Bending stiffness"),
        ("follower", "bool", "It turns with the rod"),
    ):
        assert f"<strong>{field}</strong> (<em>{kind}</em>) – {meaning}" in text
    assert "_law" not in text  # no parameter that is nobody's business


def test_every_page_has_a_place(site: Path) -> None:
    for source in (ROOT / "docs").rglob("*.md"):
        page = source.relative_to(ROOT / "docs").with_suffix(".html")
        assert (site / page).is_file(), page


def test_the_gallery_has_pictures(site: Path) -> None:
    scripts = sorted((ROOT / "examples" / "plot").glob("plot_*.py"))
    assert len(scripts) > 8
    for script in scripts:
        picture = site / "_images" / f"sphx_glr_{script.stem}_001.png"
        assert picture.stat().st_size > 10_000, script.stem


def test_nothing_is_loaded_from_elsewhere(site: Path) -> None:
    loaded = r'<(?:script|img|iframe)[^>]*src="(?:https?:)?//|<link[^>]*href="(?:https?:)?//'
    for page in site.rglob("*.html"):
        assert not re.search(loaded, page.read_text()), page
    for style in site.rglob("*.css"):
        assert not re.search(r"(?:url\(|@import)\s*['\"]?https?:", style.read_text()), style


def test_programs_of_the_cpp_page_are_compiled() -> None:
    shown = re.findall(r"literalinclude} \.\./(\S+\.cpp)", (ROOT / "docs" / "cpp.md").read_text())
    assert "examples/cpp/cantilever.cpp" in shown
    assert "}/examples/cpp" in (ROOT / "tests" / "cpp" / "CMakeLists.txt").read_text()
    targets = (ROOT / "examples" / "cpp" / "CMakeLists.txt").read_text()
    for path in map(Path, shown):
        assert path.stem in re.findall(r"\w+", targets), path


def test_the_search_knows_the_pages(site: Path) -> None:
    index = (site / "searchindex.js").read_text()
    assert "howto/spring" in index
    assert "helix" in index
