"""Values as messages tell them: in few words, whatever they are."""

from __future__ import annotations

from reprlib import Repr
from typing import Any

_SHORT = Repr()
_SHORT.maxstring = _SHORT.maxother = 80


def shortly(value: Any) -> str:
    """Its ``repr``; of long ones the beginning and the end, on one line."""
    return " ".join(_SHORT.repr(value).split())


def listed(names: Any, most: int = 30) -> str:
    """Names behind each other; of many the first, and how many more there are."""
    names = list(map(str, names))
    more = f" and {len(names) - most} more" if len(names) > most else ""
    return ", ".join(names[:most]) + more
