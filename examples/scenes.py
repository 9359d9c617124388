"""A gallery of equilibria: supports, joints, many rods, and more than one shape for one scene.

Usage: scenes.py [FOLDER [NAME ...]]: writes a picture for each idea, or those that are named.
"""

from __future__ import annotations

import sys
from pathlib import Path

from gallery import held, structures
from gallery.style import save

PICTURES = {
    "elastica": held.elastica,
    "twist": held.twist,
    "ring": held.ring,
    "dome": structures.dome,
    "frame": structures.frame,
    "arch": structures.arch,
}


def main() -> None:
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else "docs/img/scenes")
    folder.mkdir(parents=True, exist_ok=True)
    for name in sys.argv[2:] or PICTURES:
        save(PICTURES[name](), folder / f"{name}.png")


if __name__ == "__main__":
    main()
