"""The code of README and pages passes mypy, as that of readers should; wrong names do not."""

from __future__ import annotations

import ast
import inspect
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

import pyrod

pytest.importorskip("mypy")

pytestmark = pytest.mark.outside

ROOT = Path(__file__).parents[3]
PAGES = sorted((ROOT / "docs").rglob("*.md"))
UNTYPED = ("--allow-untyped-defs", "--allow-untyped-calls", "--check-untyped-defs")
"""Functions of pages are short, and have no annotations; all else is strict."""

WRONG = """
import pyrod

rod = pyrod.Rod.straight(1.0, 8, pyrod.Section(1.0, 1.0, 1.0))
result = pyrod.solve(pyrod.Scene(rod, pyrod.Clamp(), pyrod.Force((0, 0, -2))))
result.nonsense
result.scene.nonsense
rod.nonsense
pyrod.nonsense
pyrod.Force((0, 0, -2), follow=True)
pyrod.Force("up", at=0.3, follower=3.5)
pyrod.solve(rod)
"""


@pytest.fixture(scope="module")
def cache(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """What is known of NumPy and the like is found out once."""
    return tmp_path_factory.mktemp("mypy")


def blocks(page: Path) -> list[str]:
    return re.findall(r"^```python\n(.*?)^```", page.read_text(), re.DOTALL | re.MULTILINE)


def mypy(folder: Path, cache: Path, *options: str) -> list[str]:
    """What is wrong with the programs of a folder."""
    run = subprocess.run(
        [
            *(sys.executable, "-m", "mypy", "--strict", "--ignore-missing-imports"),
            *("--follow-imports=silent", "--cache-dir", str(cache), *options),
            *sorted(str(path) for path in folder.glob("*.py")),
        ],
        cwd=folder,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},  # where this pyrod is
        capture_output=True,
        text=True,
    )
    assert run.returncode < 2, run.stderr + run.stdout
    return [line for line in run.stdout.splitlines() if ": error: " in line]


def test_the_readme_is_strict(tmp_path: Path, cache: Path) -> None:
    for number, block in enumerate(blocks(ROOT / "README.md")):
        (tmp_path / f"block_{number}.py").write_text(block)
    assert len(list(tmp_path.glob("*.py"))) > 5
    assert mypy(tmp_path, cache) == []


def test_pages_pass(tmp_path: Path, cache: Path) -> None:
    for page in PAGES:
        if code := blocks(page):
            (tmp_path / f"{page.parent.name}_{page.stem}.py").write_text("\n".join(code))
    assert len(list(tmp_path.glob("*.py"))) > 20
    assert mypy(tmp_path, cache, *UNTYPED) == []


def test_wrong_names_are_seen(tmp_path: Path, cache: Path) -> None:
    (tmp_path / "wrong.py").write_text(WRONG)
    found = mypy(tmp_path, cache)
    seen = [line.split(":")[1] for line in found]
    assert sorted(set(seen), key=int) == [str(line) for line in range(6, 13)], found


DECLARED = [
    (name, thing)
    for name, thing in vars(pyrod).items()
    if inspect.isclass(thing) and issubclass(thing, pyrod.scene.part.Part)
]


@pytest.mark.parametrize(("name", "kind"), DECLARED, ids=[name for name, _ in DECLARED])
def test_what_type_checkers_are_told_is_what_is_taken(name: str, kind: type) -> None:
    """An ``__init__`` for type checkers alone has the names and defaults of that which runs."""
    (tree,) = ast.parse(inspect.getsource(kind)).body
    (told,) = [
        one.args
        for one in ast.walk(tree)
        if isinstance(one, ast.FunctionDef) and one.name == "__init__"
    ] or [None]
    if told is None:  # it has that of its base
        assert "__init__" not in vars(kind)
        return
    takes = inspect.signature(kind).parameters
    assert [one.arg for one in (*told.args, *told.kwonlyargs)][1:] == list(takes)
    defaults = [ast.literal_eval(one) for one in (*told.defaults, *told.kw_defaults) if one]
    assert defaults == [p.default for p in takes.values() if p.default is not p.empty]
