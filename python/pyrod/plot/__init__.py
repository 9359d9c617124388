"""Pictures of equilibria with matplotlib, which is imported when one is drawn."""

from pyrod.plot._draw import draw
from pyrod.plot._overview import overview

__all__ = ["draw", "overview"]
