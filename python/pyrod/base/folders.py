"""Folders that an installed pyrod brings along, for C++ programs and for checks of itself."""

from __future__ import annotations

import sys
from pathlib import Path


def folder(*parts: str) -> Path:
    """The folder of that name inside the installed package.

    An editable install has its Python files in one place and what CMake installs in another.
    """
    for root in sys.modules["pyrod"].__path__:
        found = Path(root, *parts)
        if found.is_dir():
            return found
    raise FileNotFoundError(
        f"this pyrod has no folder {'/'.join(parts)}: install it (pip install pyrod, or "
        "pip install . in its source) instead of importing its source folder"
    )


def get_include() -> str:
    """The folder for a C++ compiler's ``-I``, so that ``#include <pyrod/pyrod.hpp>`` works.

    pyrod's headers include those of Eigen (3.4 or later) and CHOLMOD, which no wheel brings: on
    Debian and Ubuntu ``apt-get install libeigen3-dev libsuitesparse-dev``. Compile as C++20 and
    link CHOLMOD and threads, for instance::

        g++ -std=c++20 -O2 -I$(python -c "import pyrod; print(pyrod.get_include())") \\
            -I/usr/include/eigen3 -I/usr/include/suitesparse program.cpp -lcholmod -pthread

    With CMake, `get_cmake_dir` does all that.

    Returns
    -------
    str
        An absolute path.

    Raises
    ------
    FileNotFoundError
        pyrod is not installed but imported from its source folder.
    """
    return str(folder("include").absolute())


def get_cmake_dir() -> str:
    """The folder of pyrod's CMake package, for ``cmake -Dpyrod_DIR=...``.

    A project then says ``find_package(pyrod REQUIRED)`` and links ``pyrod::pyrod``, which brings
    the headers, C++20, Eigen, CHOLMOD and threads along; Eigen and CHOLMOD must be installed (see
    `get_include`).

    Returns an absolute path; raises `FileNotFoundError` as `get_include` does.
    """
    return str(folder("lib", "cmake", "pyrod").absolute())
