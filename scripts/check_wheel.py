"""Checks that wheels hold what they should and nothing else: python scripts/check_wheel.py WHEEL...

Prints a line for each wheel; ends with an error at the first that is not as it should be.
Needs the program nm, of binutils.
"""

from __future__ import annotations

import re
import subprocess
import sys
from email import message_from_bytes
from email.message import Message
from fnmatch import fnmatch
from pathlib import Path
from tempfile import TemporaryDirectory
from zipfile import ZipFile

from repair_wheel import ALL, LICENSES, only

ROOT = LICENSES.parent
LIBRARIES = ["libamd", "libcholmod", "libcolamd", "libsuitesparseconfig"]
ALLOWED = [
    "pyrod/*.py",
    "pyrod/*.pyi",
    "pyrod/py.typed",
    "pyrod/_core.*.so",
    "pyrod/_reference/*.json",
    "pyrod/include/pyrod/*.hpp",
    "pyrod/lib/cmake/pyrod/*.cmake",
    "pyrod.libs/lib*.so.*",
    "pyrod-*.dist-info/*",
]
SOURCES = [
    ("python/pyrod", "*.py", "pyrod"),
    ("python/pyrod", "*.pyi", "pyrod"),
    ("cpp/include/pyrod", "*.hpp", "pyrod/include/pyrod"),
    ("tests/reference", "*.json", "pyrod/_reference"),
]
# Of the modules Supernodal, Modify and MatrixOps.
GPL = re.compile(
    r"cholmod_(l_)?(super|updown|row(add|del)|drop|(horz|vert)cat|norm|scale|s[ds]mult"
    r"|submatrix|symmetry)"
)
BLAS = re.compile(r"[sdcz](gemm|syrk|trsm|potrf)_?(64_)?$")


class WrongWheel(Exception):
    """A wheel is not as it should be."""


def demand(fulfilled: bool, otherwise: str) -> None:
    if not fulfilled:
        raise WrongWheel(otherwise)


def symbols(library: Path) -> list[str]:
    """What a shared library offers and what it needs."""
    shown = subprocess.run(["nm", "-D", library], check=True, capture_output=True, text=True)
    return [line.split()[-1].partition("@")[0] for line in shown.stdout.splitlines()]


def foreign(library: Path) -> list[str]:
    """Symbols of GPL modules and of a BLAS."""
    return [name for name in symbols(library) if GPL.match(name) or BLAS.match(name)]


def check_files(names: list[str]) -> None:
    """Nothing is missing, and all has its place."""
    for name in names:
        demand(any(fnmatch(name, allowed) for allowed in ALLOWED), f"{name} does not belong there")
    for source, pattern, target in SOURCES:
        for file in (ROOT / source).rglob(pattern):
            name = f"{target}/{file.relative_to(ROOT / source).as_posix()}"
            demand(name in names, f"{name} is missing")
    for needed in ("pyrod/_core.*.so", "pyrod/lib/cmake/pyrod/pyrodConfig.cmake"):
        demand(any(fnmatch(name, needed) for name in names), f"{needed} is missing")


def check_licenses(metadata: Message, names: list[str]) -> None:
    demand(metadata["License-Expression"] == ALL, f"licence {metadata['License-Expression']}")
    expected = {"LICENSE", *(file.name for file in LICENSES.glob("*.txt"))}
    told = set(metadata.get_all("License-File", []))
    held = {name.rpartition("/")[2] for name in names if ".dist-info/licenses/" in name}
    demand(told == held == expected, f"licence texts {sorted(held)}, named {sorted(told)}")


def check_libraries(libraries: list[Path]) -> None:
    names = sorted(re.split(r"[-.]", library.name)[0] for library in libraries)
    demand(names == LIBRARIES, f"bundled libraries {names}")
    for library in libraries:
        demand(not foreign(library), f"{library.name} has {foreign(library)}")
    cholmod = next(library for library in libraries if library.name.startswith("libcholmod"))
    demand("cholmod_factorize_p" in symbols(cholmod), f"{cholmod.name} is no CHOLMOD")


def check(wheel: Path) -> None:
    """Raises `WrongWheel` if something is wrong with the repaired wheel."""
    with TemporaryDirectory() as folder, ZipFile(wheel) as archive:
        archive.extractall(folder)
        names = archive.namelist()
        info = only(Path(folder), "*.dist-info")
        check_files(names)
        check_licenses(message_from_bytes((info / "METADATA").read_bytes()), names)
        check_libraries(sorted((Path(folder) / "pyrod.libs").iterdir()))
    print(f"{wheel.name}: {wheel.stat().st_size / 1e6:.2f} MB, {len(names)} files, as it should be")


if __name__ == "__main__":
    for argument in sys.argv[1:]:
        check(Path(argument))
