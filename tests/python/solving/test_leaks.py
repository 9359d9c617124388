"""Ten thousand solves leave no memory behind."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.outside

HERE = Path(__file__).parent
ONE_HEAP = {
    "PYTHONMALLOC": "malloc",  # Python's own objects are counted, too
    "MALLOC_ARENA_MAX": "1",  # for all threads
    "GLIBC_TUNABLES": "glibc.malloc.tcache_count=0",  # nothing is kept for later
}
LEAST = 32  # bytes that malloc takes for anything


def kept(kind: str) -> float:
    """Bytes per solve that were not given back."""
    run = subprocess.run(
        [sys.executable, str(HERE / "leaks.py"), kind],
        check=True,
        capture_output=True,
        text=True,
        env={**os.environ, **ONE_HEAP},
    )
    return float(run.stdout)


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="asks glibc what is in use")
@pytest.mark.parametrize(
    "kind", ["cantilever", "span", "frame", "ladder", "not_converged", "refused", "many", "threads"]
)
def test_nothing_is_left_behind(kind: str) -> None:
    assert abs(kept(kind)) < LEAST / 2


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="asks glibc what is in use")
def test_a_leak_would_be_seen() -> None:
    assert kept("leaking") >= LEAST
