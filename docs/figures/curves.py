"""A gallery of the geometry of framed curves.

Usage: curves.py [FOLDER [NAME ...]]: writes a picture for each idea, or those that are named.
"""

from __future__ import annotations

import sys
from pathlib import Path

from gallery import frenet, knots, orders
from gallery.style import drawn, save

PICTURES = {
    "holonomy": knots.holonomy,
    "inflection": frenet.inflection,
    "torsion": frenet.torsion,
    "measures": frenet.measures,
    "link": lambda: drawn("knot"),
    "reconstruction": orders.reconstruction,
    "convergence": orders.convergence,
}


def main() -> None:
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else "docs/img/curves")
    folder.mkdir(parents=True, exist_ok=True)
    for name in sys.argv[2:] or PICTURES:
        save(PICTURES[name](), folder / f"{name}.png")


if __name__ == "__main__":
    main()
