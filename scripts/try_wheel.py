"""Solves a scene with an installed wheel, and checks that only what it bundles is loaded.

For a clean environment, without SuiteSparse: python scripts/try_wheel.py
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

import pyrod
from pyrod import reference

TIP = [0.8106090248802964, 0.0, 0.4450044022462487]
"""Of an elastica clamped at one end under a force F L²/EI = 10 at the other."""


def main() -> None:
    rod = pyrod.Rod.straight(1.0, 256, pyrod.Section(1.0, 1.0, 1.0))
    result = pyrod.solve(pyrod.Scene(rod, pyrod.Clamp(), pyrod.Force((10.0, 0.0, 0.0))))
    np.testing.assert_allclose(result.positions[-1], TIP, atol=1e-5)

    mapped = Path("/proc/self/maps").read_text()
    loaded = set(re.findall(r"/\S*lib(?:amd|cholmod|colamd|suitesparseconfig)\S*\.so\S*", mapped))
    bundled = Path(pyrod.__path__[0]).with_name("pyrod.libs")
    if {Path(path).parent for path in loaded} != {bundled} or len(loaded) != 4:
        raise SystemExit(f"loaded, instead of what is in {bundled}: {sorted(loaded)}")

    for name, path in {
        "C++ headers": Path(pyrod.get_include(), "pyrod", "pyrod.hpp"),
        "CMake package": Path(pyrod.get_cmake_dir(), "pyrodConfig.cmake"),
    }.items():
        if not path.is_file():
            raise SystemExit(f"{name}: there is no {path}")
    cases = reference.load(reference.folder())
    print(f"pyrod {pyrod.__version__}: tip {result.positions[-1]}, {len(cases)} exact solutions")
    print("\n".join(sorted(loaded)))


if __name__ == "__main__":
    main()
