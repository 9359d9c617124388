"""Packages that only some parts of pyrod need; they are imported when such a part is used."""

from __future__ import annotations

from importlib import import_module
from typing import Any


def need(module: str, extra: str) -> Any:
    """The module, imported; ``extra`` is the part of pyrod's dependencies that brings it."""
    try:
        return import_module(module)
    except ModuleNotFoundError as error:
        if error.name != module.partition(".")[0]:
            raise
        raise ImportError(
            f"{error.name} is not installed, which this needs: pip install 'pyrod[{extra}]'"
        ) from None
