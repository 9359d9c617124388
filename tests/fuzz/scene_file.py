"""Fuzzes the reader of scene files: whatever the bytes, it loads or raises `SceneFileError`.

Usage: python tests/fuzz/scene_file.py FOLDER examples/scenes [-max_total_time=600]
Finds are kept in FOLDER; the examples are the seeds. Needs atheris (pip install atheris).
"""

from __future__ import annotations

import sys
from pathlib import Path
from tempfile import TemporaryDirectory

LARGEST = 64
"""Edges of a rod: more would only take time."""


def check(data: bytes, path: Path) -> None:
    """Loads a file with these bytes; anything but a scene or `SceneFileError` is a find."""
    import pyrod

    path.write_bytes(data)
    try:
        pyrod.load(path)
    except pyrod.SceneFileError as error:
        str(error)


def main() -> None:
    """Runs until something is found or the time is over."""
    import atheris

    with atheris.instrument_imports():
        from pyrod.document import rods, schema

    rods.MOST_EDGES = LARGEST
    schema.ROD.keys["edges"] = schema.Key(schema.whole(1, LARGEST))
    with TemporaryDirectory() as folder:
        path = Path(folder) / "scene.toml"
        atheris.Setup(sys.argv, lambda data: check(data, path))
        atheris.Fuzz()


if __name__ == "__main__":
    main()
