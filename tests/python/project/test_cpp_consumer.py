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

SOURCE = Path(__file__).parents[3]
EXAMPLE = SOURCE / "examples" / "cpp"
BENCHMARKS = SOURCE / "benchmarks"
ONE_FILE = """
#include <pyrod/sparse/ldlt.hpp>
#include <cstdio>
int main() {
  pyrod::SymmetricMatrix A;  // [2 1; 1 -4]
  A.starts = {0, 1, 3}, A.rows = {0, 0, 1}, A.values = {2, 1, -4};
  pyrod::Ldlt factor(A);
  const int negative = factor.factorise().negative;
  pyrod::Vector x(2);
  x << 4, -7;
  factor.solve(x, x);
  std::printf("%d %.15g %.15g", negative, x[0], x[1]);
}
"""
"""Needs Eigen and CHOLMOD, as all of pyrod does, but compiles fast."""
PROJECT = """
cmake_minimum_required(VERSION 3.25)
project(user LANGUAGES CXX)
include(CTest)
{find}
add_executable(program program.cpp)
target_link_libraries(program PRIVATE pyrod::pyrod)
install(TARGETS program)
"""
WAYS = {
    "find_package": "find_package(pyrod REQUIRED)",
    "add_subdirectory": f'add_subdirectory("{SOURCE}" pyrod)',
    "FetchContent": f"""
        include(FetchContent)
        FetchContent_Declare(pyrod SOURCE_DIR "{SOURCE}")
        FetchContent_MakeAvailable(pyrod)""",
}
WARNINGS = ["-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Wconversion", "-Werror"]
"""Those of our tests. Clang counts signs to -Wconversion, g++ does not."""


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


def project(folder: Path, find: str) -> Path:
    """Builds a program of somebody else in a folder of its own."""
    (folder / "CMakeLists.txt").write_text(PROJECT.format(find=find))
    (folder / "program.cpp").write_text(ONE_FILE)
    build = folder / "build"
    output("cmake", "-S", folder, "-B", build, f"-Dpyrod_DIR={pyrod.get_cmake_dir()}")
    output("cmake", "--build", build)
    return build


@pytest.mark.parametrize(
    "way", ["FetchContent", *(pytest.param(w, marks=pytest.mark.long) for w in list(WAYS)[:2])]
)
@needs("cmake", os.environ.get("CXX", "c++"))
def test_as_a_dependency_it_brings_nothing_unasked(way: str, tmp_path: Path) -> None:
    """No files, no tests, no flags, no library that is compiled."""
    build = project(tmp_path, WAYS[way])
    assert output(build / "program") == "1 1 2"
    output("cmake", "--install", build, "--prefix", tmp_path / "prefix")
    files = [p for p in (tmp_path / "prefix").rglob("*") if p.is_file()]
    assert [p.name for p in files] == ["program"]
    assert "Total Tests: 0" in output("ctest", "--test-dir", build, "-N")
    (flags,) = build.rglob("program.dir/flags.make")
    assert not re.search(r"FLAGS = .*-(W|O|f)", flags.read_text())
    assert not list(build.rglob("*.a"))


@needs("cmake", os.environ.get("CXX", "c++"))
def test_a_static_cholmod_is_linked_with_all_it_needs(tmp_path: Path, compiler: str) -> None:
    if "/" not in output(compiler, "-print-file-name=libcholmod.a"):
        pytest.skip("there is none here")
    build = project(tmp_path, f"set(CMAKE_FIND_LIBRARY_SUFFIXES .a)\n{WAYS['find_package']}")
    found = re.search(r"CHOLMOD_LIBRARY:\w+=(.*)", (build / "CMakeCache.txt").read_text())
    if not found:
        pytest.skip("SuiteSparse's own CMake package decides here")
    assert found[1].endswith("libcholmod.a")
    assert output(build / "program") == "1 1 2"
    assert "libcholmod" not in output("ldd", build / "program")


def folders() -> list[str]:
    """Where headers are found."""
    system = [f"-isystem/usr/include/{name}" for name in ("eigen3", "suitesparse")]
    return [f"-I{pyrod.get_include()}", *system]


@pytest.mark.long
@pytest.mark.parametrize("standard", ["c++20", "c++23"])
@pytest.mark.parametrize("compiler", ["g++", "clang++"])
def test_headers_compile_without_warnings(compiler: str, standard: str, tmp_path: Path) -> None:
    if not shutil.which(compiler):
        pytest.skip(f"there is no {compiler} here")
    source = tmp_path / "program.cpp"
    source.write_text("#include <pyrod/pyrod.hpp>\n" + ONE_FILE)
    warnings = [*WARNINGS, *(["-Wno-sign-conversion"] if compiler == "clang++" else [])]
    # Old compilers know C++23 by its working name.
    version = standard.replace("c++23", "c++2b")
    output(compiler, f"-std={version}", *folders(), *warnings, "-fsyntax-only", source)


@pytest.mark.long
@pytest.mark.parametrize("program", sorted(p.name for p in BENCHMARKS.glob("*.cpp")))
def test_benchmarks_compile(program: str, compiler: str) -> None:
    output(compiler, "-std=c++20", *folders(), "-fsyntax-only", BENCHMARKS / program)


@pytest.mark.long
@pytest.mark.parametrize("program", ["wire", "frame"])
@needs("cmake", os.environ.get("CXX", "c++"))
def test_headers_alone_solve_scenes(program: str, tmp_path: Path) -> None:
    output("cmake", "-S", EXAMPLE, "-B", tmp_path, f"-Dpyrod_DIR={pyrod.get_cmake_dir()}")
    output("cmake", "--build", tmp_path, "--target", program)
    output(tmp_path / program)  # tells whether its numbers are right


@pytest.mark.long
@needs("cmake", os.environ.get("CXX", "c++"))
def test_cmake_builds_the_example(tmp_path: Path) -> None:
    output("cmake", "-S", EXAMPLE, "-B", tmp_path, f"-Dpyrod_DIR={pyrod.get_cmake_dir()}")
    output("cmake", "--build", tmp_path, "--target", "cantilever")
    told = output(tmp_path / "cantilever")
    assert re.match(r"converged in \d+ iterations, tip \(0\.8106\d* 0\.445\d*\)", told)
