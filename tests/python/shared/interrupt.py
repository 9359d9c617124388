"""Ctrl-C in the middle of a solve."""

from __future__ import annotations

import os
import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from time import sleep

import pytest

needs_ctrl_c = pytest.mark.skipif(
    signal.getsignal(signal.SIGINT) is not signal.default_int_handler,
    reason="Ctrl-C is not Python's",
)


@contextmanager
def ctrl_c_after(count: int, monkeypatch: pytest.MonkeyPatch) -> Iterator[list[str]]:
    """Presses Ctrl-C soon after so many lines were printed, and sees that it ends what goes on.

    Gives the lines.
    """
    lines: list[str] = []
    late = threading.Event()

    def listen(line: str, **_: object) -> None:
        lines.append(line)
        if len(lines) == count:
            late.set()

    def press() -> None:
        if late.wait(60):
            sleep(0.01)
            os.kill(os.getpid(), signal.SIGINT)

    monkeypatch.setattr("builtins.print", listen)
    thread = threading.Thread(target=press)
    thread.start()
    with pytest.raises(KeyboardInterrupt):
        yield lines
    thread.join()
