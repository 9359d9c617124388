"""What commands print: text for people or one JSON object for programs; errors either way."""

from __future__ import annotations

import json
import math
import sys
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np


class Output:
    """Standard output and standard error of a command.

    json : people's text is dropped, and `result` prints a JSON object.
    """

    def __init__(self, json: bool) -> None:
        self.json = json
        self.warnings: list[str] = []

    def text(self, line: str = "") -> None:
        """A line for people."""
        if not self.json:
            print(line, flush=True)

    def result(self, values: dict[str, Any]) -> None:
        """The object for programs; numbers that are not finite become null."""
        if self.json:
            warned = {"warnings": self.warnings} if self.warnings else {}
            print(json.dumps(_for_json({**values, **warned}), allow_nan=False), flush=True)

    def error(self, kind: str, message: str) -> None:
        """Why the command ends without its result."""
        self.result({"error": {"kind": kind, "message": message}})
        print(f"pyrod: error: {message}", file=sys.stderr)

    @contextmanager
    def heeding(self) -> Iterator[None]:
        """Warnings are printed as lines on standard error, and told in the result."""
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            try:
                yield
            finally:  # also of what ends with an error
                self._heed([str(warning.message) for warning in caught])

    def _heed(self, messages: list[str]) -> None:
        self.warnings += messages
        for message in messages:
            print(f"pyrod: warning: {message}", file=sys.stderr)


def _for_json(value: Any) -> Any:
    """Numbers, strings, lists and dicts that JSON knows."""
    if isinstance(value, dict):
        return {str(key): _for_json(one) for key, one in value.items()}
    if isinstance(value, np.ndarray):
        return _for_json(value.tolist())
    if isinstance(value, (list, tuple)):
        return [_for_json(one) for one in value]
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value
