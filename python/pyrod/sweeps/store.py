"""A file of finished cases, from which a sweep that was stopped goes on."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable, Mapping
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from pyrod.sweeps.cases import Cases
from pyrod.sweeps.work import Record, Work


class Store:
    """JSON, a line per case behind a line that tells of which sweep they are.

    Lines are only ever added, a chunk at a time. One that was cut off when the process was killed
    is taken away.

    Raises
    ------
    ValueError
        The file is of another sweep, or no such file at all.
    """

    def __init__(self, path: str | PathLike[str], identity: Mapping[str, Any]) -> None:
        self._path = Path(path)
        self._header = _line({"pyrod": "sweep", **identity})
        self.records = self._read()

    def _read(self) -> dict[int, Record]:
        """The records by case; of those that are there twice the later one."""
        content = self._path.read_bytes() if self._path.exists() else b""
        if self._header.startswith(content):  # none, or killed while it was begun
            self._path.write_bytes(self._header)
            return {}
        whole = content[: content.rfind(b"\n") + 1]
        header, *lines = whole.splitlines(keepends=True) or [content]
        if header != self._header:
            raise ValueError(f"store: {self._path} {self._difference(header)}")
        if len(whole) < len(content):
            with self._path.open("r+b") as file:
                file.truncate(len(whole))
        return {record.case: record for record in map(self._record, lines)}

    def _difference(self, header: bytes) -> str:
        try:
            found = json.loads(header)
        except ValueError:
            found = None
        if not isinstance(found, dict) or found.get("pyrod") != "sweep":
            return "is not the store of a sweep; give another path"
        wanted = json.loads(self._header)
        names = [name for name in wanted if found.get(name) != wanted[name]]
        return f"is of another sweep: {', '.join(names)} differ; give another path, or delete it"

    def _record(self, line: bytes) -> Record:
        try:
            entries = json.loads(line)
            values = entries.pop("values")
            if values is not None:
                values = {key: _back(value) for key, value in values.items()}
            return Record(**entries, values=values)
        except (ValueError, TypeError, KeyError, AttributeError) as error:
            what = type(error).__name__
            raise ValueError(f"store: {self._path} is damaged at {line[:60]!r} ({what})") from None

    def add(self, records: Iterable[Record]) -> None:
        """Writes what came of some cases."""
        lines = (_line({k: v for k, v in r._asdict().items() if k != "result"}) for r in records)
        with self._path.open("ab") as file:
            file.write(b"".join(lines))


def identity(cases: Cases, work: Work, start: str | None) -> dict[str, Any]:
    """What tells a sweep from others: functions by their names, all else by what it holds."""
    return {
        "cases": len(cases.rows),
        "parameters": _digest([cases.names, cases.axes, cases.rows]),
        "scene": _named(work.build),
        "measure": _named(work.measure),
        "options": repr(work.how),
        "model": work.model,
        "start": start,
    }


def _named(function: Any) -> str:
    document = getattr(function, "document", None)
    if document is not None:
        return _digest(document)
    if not hasattr(function, "__qualname__"):
        raise ValueError(
            f"store: {function!r} has no name by which it could be told from others; write it with "
            "def"
        )
    module = function.__module__
    if module.startswith("pyrod."):
        module = "pyrod"  # wherever it stands in it
    return f"{module}.{function.__qualname__}"


def _digest(values: Any) -> str:
    text = json.dumps(values, default=_listed)
    return hashlib.sha256(text.encode()).hexdigest()


def _listed(value: Any) -> Any:
    if isinstance(value, np.ndarray):
        return value.tolist()
    raise TypeError(
        f"store: a {type(value).__name__} among the parameters cannot be told from others; use "
        "numbers, text or arrays"
    )


def _line(entries: Mapping[str, Any]) -> bytes:
    return json.dumps(entries, default=_listed).encode() + b"\n"


def _back(value: Any) -> Any:
    return np.array(value) if isinstance(value, list) else value
