"""Curves looked at, and written to files."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from numpy.typing import ArrayLike

from pyrod.base.borrowed import borrowed


class Shown:
    """What polylines and framed curves have in common: pictures and files."""

    @borrowed("pyrod.plot._curves:draw_curve")
    def plot(
        self,
        ax: Any = None,
        *,
        colour_by: ArrayLike | None = None,
        label: str = "",
        **style: Any,
    ) -> Any:
        """Draws the curve with matplotlib."""

    @borrowed("pyrod.pictures.curves:curve_poly")
    def to_pyvista(
        self, *, radius: float | None = None, width: float | None = None, sides: int = 24
    ) -> Any:
        """The curve as a line, a tube or a ribbon, for pyvista."""

    @borrowed("pyrod.files.curves:save_curve")
    def save(self, path: str | Path, **options: Any) -> None:
        """Writes the curve to a file, whose suffix tells the format."""
