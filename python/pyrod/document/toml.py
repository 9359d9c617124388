"""Writing documents as TOML; reading is done by the standard library."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from typing import Any


def dumps(document: dict[str, Any]) -> str:
    """The text of a document: tables and lists of tables on top have headers, others are inline."""
    tables = {key: list(_headed_tables(_key(key), value)) for key, value in document.items()}
    lines = _assignments({key: value for key, value in document.items() if not tables[key]})
    for header, table in (one for many in tables.values() for one in many):
        lines += ["", header, *_assignments(table)]
    return "\n".join(lines).lstrip("\n") + "\n"


def _headed_tables(name: str, value: Any) -> Iterator[tuple[str, dict[str, Any]]]:
    """Headers and their tables; nothing for a value that needs none."""
    if isinstance(value, list) and all(isinstance(one, dict) for one in value):
        yield from ((f"[[{name}]]", one) for one in value)
    elif isinstance(value, dict) and all(isinstance(one, dict) for one in value.values()):
        yield from ((f"[{name}.{_key(key)}]", one) for key, one in value.items())
    elif isinstance(value, dict):
        yield f"[{name}]", value


def _assignments(table: dict[str, Any]) -> list[str]:
    return [f"{_key(key)} = {_value(value)}" for key, value in table.items()]


def _key(key: str) -> str:
    return key if re.fullmatch(r"[A-Za-z0-9_-]+", key) else _text(key)


def _text(text: str) -> str:
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def _value(value: Any) -> str:
    if isinstance(value, dict):
        return f"{{ {', '.join(_assignments(value))} }}" if value else "{}"
    if isinstance(value, list) and value and isinstance(value[0], list):
        return "[\n" + "".join(f"  {_value(row)},\n" for row in value) + "]"
    if isinstance(value, list):
        return f"[{', '.join(map(_value, value))}]"
    if isinstance(value, str):
        return _text(value)
    return str(value).lower() if isinstance(value, bool) else repr(value)
