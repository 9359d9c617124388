"""Files appear whole or not at all."""

from __future__ import annotations

import os
import secrets
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


@contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """A path beside ``path`` to write to; it takes its place if nothing fails, else it is removed.

    Raises
    ------
    FileNotFoundError
        There is no such folder.
    IsADirectoryError
        The path is a folder.
    """
    check_place(path)
    temporary = path.with_name(f".{path.stem[:100]}.{secrets.token_hex(4)}{path.suffix}")
    try:
        yield temporary
        os.replace(temporary, path)
    finally:
        temporary.unlink(missing_ok=True)


def check_place(path: Path) -> None:
    """Refuses paths at which no file can be, with the errors of `replacing`."""
    if path.is_dir():
        raise IsADirectoryError(f"{path}: it is a folder; give a file")
    if not path.parent.is_dir():
        raise FileNotFoundError(f"{path}: there is no folder {path.parent}; make it first")
