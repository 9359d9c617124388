"""Pictures of equilibria for the pages, each by the program of its name in ``examples/plot``.

Usage: pictures.py [FOLDER [NAME ...]]: writes the pictures, or those that are named.
"""

from __future__ import annotations

import sys
from pathlib import Path

from gallery.style import drawn, save

PICTURES = {
    "scenes": ("elastica", "twist", "ring", "dome", "frame", "arch"),
    "howto": ("catheter", "cable", "column", "spring", "modes", "dna"),
}


def main() -> None:
    root = Path(sys.argv[1] if len(sys.argv) > 1 else "docs/img")
    for folder, names in PICTURES.items():
        (root / folder).mkdir(parents=True, exist_ok=True)
        for name in names:
            if name in sys.argv[2:] or len(sys.argv) < 3:
                save(drawn(name), root / folder / f"{name}.png")


if __name__ == "__main__":
    main()
