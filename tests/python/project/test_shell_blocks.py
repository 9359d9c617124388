"""What README and documentation tell to type into a shell, typed.

A TOML block that begins with a comment such as ``# wire.toml`` is that file. Lines of console
blocks that begin with ``$ pyrod`` are run one after the other, in one folder per page.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.outside

ROOT = Path(__file__).parents[3]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
BLOCK = re.compile(r"^```(toml|console)\n(.*?)^```", re.DOTALL | re.MULTILINE)


def steps(page: Path) -> list[tuple[str, str]]:
    """Files and commands in their order."""
    out = []
    for kind, text in BLOCK.findall(page.read_text()):
        named = re.match(r"# (\S+\.toml)\n", text)
        if kind == "toml" and named:
            out.append((named[1], text))
        elif kind == "console":
            out += [("", line[2:]) for line in text.splitlines() if line.startswith("$ pyrod")]
    return out


WITH_COMMANDS = [page for page in PAGES if any(not file for file, _ in steps(page))]


@pytest.mark.parametrize("page", WITH_COMMANDS, ids=lambda page: page.name)
def test_commands_of_a_page_work(page: Path, tmp_path: Path) -> None:
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    for file, text in steps(page):
        if file:
            (tmp_path / file).write_text(text)
            continue
        run = subprocess.run(
            ["bash", "-o", "pipefail", "-c", text],
            check=False,
            capture_output=True,
            text=True,
            cwd=tmp_path,
            env={**os.environ, "PATH": path},
        )
        assert run.returncode == 0, f"{text}\n{run.stdout}\n{run.stderr}"
        for written in re.findall(r"(?:-o|--output|--plot) (\S+)", text):
            assert (tmp_path / written).stat().st_size > 0


def test_there_are_commands() -> None:
    assert {page.name for page in WITH_COMMANDS} >= {"command_line.md"}
