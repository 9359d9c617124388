"""What can be saved to files."""

from __future__ import annotations

from pathlib import Path
from typing import Any


class Savable:
    """Mixin of scenes and results."""

    def save(self, path: str | Path, **options: Any) -> None:
        """Writes this to a file whose suffix tells the format; see `pyrod.save`."""
        from pyrod.files import save

        save(self, path, **options)  # type: ignore[arg-type]
