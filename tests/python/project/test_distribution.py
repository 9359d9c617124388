"""What is released: the source distribution, and wheels with what they bundle."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import tarfile
import tomllib
from email import message_from_bytes, message_from_string
from email.message import Message
from pathlib import Path

import pytest
import yaml

import pyrod

sys.path.insert(0, str(Path(__file__).parents[3] / "scripts"))

import check_wheel
import repair_wheel
from check_wheel import WrongWheel

pytestmark = pytest.mark.outside

ROOT = Path(__file__).parents[3]
PYPROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())
METADATA = "Name: pyrod\nLicense-Expression: BSD-3-Clause\nLicense-File: LICENSE\n\nText\n"
PYTHONS = ["3.11", "3.12", "3.13", "3.14"]


def run(*command: str | Path, cwd: Path = ROOT, **more: str) -> str:
    done = subprocess.run(
        command, cwd=cwd, env={**os.environ, **more}, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


# Source distribution ------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def sdist(tmp_path_factory: pytest.TempPathFactory) -> Path:
    code = "import sys, scikit_build_core.build as b; b.build_sdist(sys.argv[1])"
    folder = tmp_path_factory.mktemp("sdist")
    run(sys.executable, "-c", code, folder)
    (path,) = folder.iterdir()
    return path


@pytest.fixture(scope="module")
def held(sdist: Path) -> dict[str, int]:
    """The files of the source distribution, without its own folder, and their sizes."""
    with tarfile.open(sdist) as archive:
        return {m.name.partition("/")[2]: m.size for m in archive.getmembers() if m.isfile()}


def visible(names: set[str]) -> set[str]:
    return {name for name in names if name[0] != "."}


@pytest.mark.skipif(not (ROOT / ".git").exists(), reason="this is no git checkout")
def test_the_sdist_is_the_repository(held: dict[str, int]) -> None:
    listed = run("git", "ls-files", "--cached", "--others", "--exclude-standard").splitlines()
    expected = {name for name in listed if (ROOT / name).is_file()}
    assert visible(set(held)) == {"PKG-INFO", *visible(expected)}


def test_the_sdist_builds_and_tests(held: dict[str, int]) -> None:
    for name in ("CMakeLists.txt", "cpp/include/pyrod/pyrod.hpp", "LICENSE", "README.md"):
        assert name in held
    assert sum(name.startswith("tests/reference/") for name in held) > 100
    assert not any(name.endswith((".so", ".o", ".pyc")) for name in held)


def test_the_sdist_is_small(sdist: Path, held: dict[str, int]) -> None:
    assert sdist.stat().st_size < 4e6
    assert max(held.values()) < 5e5, max(held, key=held.__getitem__)


def test_versions_agree(sdist: Path) -> None:
    with tarfile.open(sdist) as archive:
        file = archive.extractfile(f"pyrod-{pyrod.__version__}/PKG-INFO")
        assert file
        metadata = message_from_bytes(file.read())
    assert metadata["Version"] == pyrod.__version__
    assert metadata["License-Expression"] == PYPROJECT["project"]["license"] == repair_wheel.OWN
    assert metadata["Requires-Python"] == PYPROJECT["project"]["requires-python"]


# Wheels -------------------------------------------------------------------------------------------


def test_wheels_are_built_for_the_pythons_that_are_named() -> None:
    said = [c.rpartition(" ")[2] for c in PYPROJECT["project"]["classifiers"] if ":: 3." in c]
    built = [name[2:-2] for name in PYPROJECT["tool"]["cibuildwheel"]["build"]]
    workflow = yaml.safe_load((ROOT / ".github" / "workflows" / "wheels.yml").read_text())
    tried = workflow["jobs"]["try"]["strategy"]["matrix"]["python"]
    assert said == tried == PYTHONS
    assert built == [p.replace(".", "") for p in PYTHONS]
    assert PYPROJECT["project"]["requires-python"] == f">={PYTHONS[0]}"


def test_all_licences_are_named() -> None:
    text = repair_wheel.with_licenses(METADATA, ["AMD.txt", "LGPL-2.1.txt"])
    metadata = message_from_string(text)
    expression = "BSD-3-Clause AND LGPL-2.1-or-later AND MPL-2.0"
    assert metadata["License-Expression"] == expression
    files = ["AMD.txt", "LGPL-2.1.txt", "LICENSE"]
    assert sorted(metadata.get_all("License-File", [])) == files
    assert metadata.get_payload() == "Text\n"


def test_licences_are_added_once() -> None:
    once = repair_wheel.with_licenses(METADATA, [])
    with pytest.raises(ValueError, match="License-Expression is not BSD-3-Clause"):
        repair_wheel.with_licenses(once, [])


def test_the_list_of_what_is_bundled_names_all_texts() -> None:
    text = (repair_wheel.LICENSES / "BUNDLED.txt").read_text()
    for file in repair_wheel.LICENSES.glob("*.txt"):
        assert file.name == "BUNDLED.txt" or re.search(rf"\b{re.escape(file.name)}\b", text)
    for library in check_wheel.LIBRARIES:
        assert re.search(rf"^ *{library} ", text, re.M)
    script = (ROOT / "scripts" / "build-cholmod.sh").read_text()
    version = re.search(r"^version=(.*)$", script, re.M)
    assert version
    assert f"SuiteSparse {version[1]}\n" in text


@pytest.fixture
def names() -> list[str]:
    """The files of a wheel as it should be."""
    shipped = [
        f"{target}/{path.relative_to(ROOT / source).as_posix()}"
        for source, pattern, target in check_wheel.SOURCES
        for path in (ROOT / source).rglob(pattern)
    ]
    return [*shipped, "pyrod/_core.x.so", "pyrod/lib/cmake/pyrod/pyrodConfig.cmake"]


def test_files_of_wheels_are_checked(names: list[str]) -> None:
    assert len(names) > 200
    check_wheel.check_files(names)
    for name in [*names[::40], *names[-2:]]:
        missing = name.replace("_core.x.so", "_core.*.so")
        with pytest.raises(WrongWheel, match=f"^{re.escape(missing)} is missing$"):
            check_wheel.check_files([n for n in names if n != name])
    for name in ("tests/a.py", "pyrod.libs/libopenblas.a", "pyrod/x.cpp"):
        with pytest.raises(WrongWheel, match="does not belong there"):
            check_wheel.check_files([*names, name])


def licensed(expression: str, files: list[str]) -> Message:
    metadata = Message()
    metadata["License-Expression"] = expression
    for file in files:
        metadata["License-File"] = file
    return metadata


def test_licences_of_wheels_are_checked() -> None:
    files = ["LICENSE", *(path.name for path in repair_wheel.LICENSES.glob("*.txt"))]
    held = [f"pyrod-1.dist-info/licenses/{name}" for name in files]
    check_wheel.check_licenses(licensed(repair_wheel.ALL, files), held)
    with pytest.raises(WrongWheel, match=r"licence BSD-3-Clause$"):
        check_wheel.check_licenses(licensed("BSD-3-Clause", files), held)
    with pytest.raises(WrongWheel, match="licence texts"):
        check_wheel.check_licenses(licensed(repair_wheel.ALL, files[1:]), held)
    with pytest.raises(WrongWheel, match="licence texts"):
        check_wheel.check_licenses(licensed(repair_wheel.ALL, files), held[:-1])


def library(path: Path, *functions: str) -> Path:
    """A shared library with these functions and nothing in them."""
    source = "".join(f"void {name}(void) {{}}\n" for name in functions)
    subprocess.run(
        [os.environ.get("CC", "cc"), "-shared", "-fPIC", "-x", "c", "-", "-o", path],
        input=source,
        text=True,
        check=True,
    )
    return path


@pytest.mark.skipif(not shutil.which("nm"), reason="there is no nm here")
@pytest.mark.skipif(not shutil.which(os.environ.get("CC", "cc")), reason="there is no cc here")
def test_libraries_of_wheels_are_checked(tmp_path: Path) -> None:
    others = [tmp_path / f"lib{name}-1a2b.so.3" for name in ("amd", "colamd", "suitesparseconfig")]
    for path in others:
        library(path, "f")
    name = tmp_path / "libcholmod-1a2b.so.5.3.1"
    good = ("cholmod_factorize_p", "cholmod_metis", "cholmod_l_solve2", "cholmod_copy_dense")
    check_wheel.check_libraries([*others, library(name, *good)])
    with pytest.raises(WrongWheel, match="bundled libraries"):
        check_wheel.check_libraries(others)
    with pytest.raises(WrongWheel, match="bundled libraries"):
        check_wheel.check_libraries([*others, name, tmp_path / "libopenblas.so.0"])
    bad = ["cholmod_l_updown", "cholmod_sdmult", "cholmod_super_numeric", "dgemm_"]
    assert sorted(check_wheel.foreign(library(name, *good, *bad))) == bad
    with pytest.raises(WrongWheel, match=rf"^{name.name} has \["):
        check_wheel.check_libraries([*others, name])
    with pytest.raises(WrongWheel, match="is no CHOLMOD"):
        check_wheel.check_libraries([*others, library(name, "cholmod_start")])


@pytest.mark.long
def test_a_wheel_is_built_from_the_sdist_and_stands_alone(sdist: Path, tmp_path: Path) -> None:
    """Fetches SuiteSparse and build tools. The environment is new, if not the system."""
    with tarfile.open(sdist) as archive:
        archive.extractall(tmp_path, filter="data")
    (tree,) = tmp_path.iterdir()
    run(tree / "scripts" / "build-wheel.sh", sys.executable, cwd=tree)
    (wheel,) = (tree / "dist").iterdir()
    fresh = tmp_path / "venv" / "bin" / "python"
    run(sys.executable, "-m", "venv", tmp_path / "venv")
    run(fresh, "-m", "pip", "install", "--quiet", wheel)
    script = tree / "scripts" / "try_wheel.py"
    assert f"pyrod {pyrod.__version__}: tip" in run(fresh, script, cwd=tmp_path, PYTHONPATH="")
