"""C++ programs beside an installed pyrod: built by CMake, and by a compiler alone."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest

import pyrod.reference

pytestmark = pytest.mark.outside

EXAMPLE = Path(__file__).parents[2] / "examples" / "cpp"
ONE_FILE = """
#include <pyrod/sparse/cholesky.hpp>
#include <cstdio>
int main() {
  pyrod::SymmetricMatrix A;  // [2 1; 1 -4]
  A.starts = {0, 1, 3}, A.rows = {0, 0, 1}, A.values = {2, 1, -4};
  pyrod::Cholesky factor(A);
  const int negative = factor.factorise().negative;
  pyrod::Vector x(2);
  x << 4, -7;
  factor.solve(x, x);
  std::printf("%d %.15g %.15g", negative, x[0], x[1]);
}
"""
"""Needs Eigen and CHOLMOD, as all of pyrod does, but compiles fast."""


def output(*command: str | Path) -> str:
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stdout + run.stderr
    return run.stdout


def needs(*programs: str) -> pytest.MarkDecorator:
    missing = [name for name in programs if not shutil.which(name)]
    return pytest.mark.skipif(bool(missing), reason=f"there is no {' and no '.join(missing)} here")


@pytest.fixture
def compiler(monkeypatch: pytest.MonkeyPatch) -> str:
    """Without the variables that would name other headers."""
    for name in ("CPATH", "CPLUS_INCLUDE_PATH"):
        monkeypatch.delenv(name, raising=False)
    return os.environ.get("CXX", "c++")


# Where things are ---------------------------------------------------------------------------------


def test_headers_are_where_get_include_says() -> None:
    assert (Path(pyrod.get_include()) / "pyrod" / "pyrod.hpp").is_file()
    assert Path(pyrod.get_include()).is_absolute()


def test_the_cmake_package_is_of_this_version() -> None:
    told = (Path(pyrod.get_cmake_dir()) / "pyrodConfigVersion.cmake").read_text()
    assert f'set(PACKAGE_VERSION "{pyrod.__version__}")' in told


def test_folders_may_be_in_any_part_of_the_package(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """In an editable install the first part has no headers."""
    (tmp_path / "first").mkdir()
    (tmp_path / "second" / "include").mkdir(parents=True)
    monkeypatch.setattr(pyrod, "__path__", [str(tmp_path / "first"), str(tmp_path / "second")])
    assert pyrod.get_include() == str(tmp_path / "second" / "include")


@pytest.mark.parametrize(
    ("function", "name"),
    [
        (pyrod.get_include, "include"),
        (pyrod.get_cmake_dir, "lib/cmake/pyrod"),
        (pyrod.reference.folder, "_reference"),
    ],
)
def test_a_source_folder_is_not_an_installation(
    function: object, name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(pyrod, "__path__", [str(tmp_path)])
    with pytest.raises(FileNotFoundError, match=rf"no folder {name}: install it"):
        function()  # type: ignore[operator]


def test_the_reference_folder_is_found(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "_reference").mkdir()
    monkeypatch.setattr(pyrod, "__path__", [str(tmp_path)])
    assert pyrod.reference.folder() == tmp_path / "_reference"


# Programs -----------------------------------------------------------------------------------------


@needs(os.environ.get("CXX", "c++"))
def test_a_compiler_alone_builds_a_program(tmp_path: Path, compiler: str) -> None:
    """With what the docstring of `get_include` says."""
    told = re.search(r"^ +(-I.*) program\.cpp (-l.*)$", pyrod.get_include.__doc__ or "", re.M)
    assert told
    source, program = tmp_path / "program.cpp", tmp_path / "program"
    source.write_text(ONE_FILE)
    arguments = ["-std=c++20", f"-I{pyrod.get_include()}", *told[1].split()]
    output(compiler, *arguments, source, *told[2].split(), "-o", program)
    assert output(program) == "1 1 2"


@pytest.mark.long
@needs("cmake", os.environ.get("CXX", "c++"))
def test_cmake_builds_the_example(tmp_path: Path) -> None:
    output("cmake", "-S", EXAMPLE, "-B", tmp_path, f"-Dpyrod_DIR={pyrod.get_cmake_dir()}")
    output("cmake", "--build", tmp_path, "--target", "cantilever")
    told = output(tmp_path / "cantilever")
    assert re.match(r"converged in \d+ iterations, tip \(0\.8106\d* 0\.445\d*\)", told)
