"""The benchmark of gradients runs, and its ways agree."""

from __future__ import annotations

import re
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import pytest

PROGRAM = Path(__file__).parents[3] / "benchmarks" / "gradient.py"


@pytest.mark.outside
def test_all_ways_find_the_same_gradient() -> None:
    """In a process of its own: JAX has threads, which make later forks of a process warn."""
    run = subprocess.run(
        [sys.executable, PROGRAM, "12", "1"], capture_output=True, text=True, check=True
    )
    rows = dict(re.findall(r"^(\w.*?) {2,}.* ms .* (\S+)$", run.stdout, re.MULTILINE))
    ways = ["vjp", "differences of solves", *(["JAX, dense"] if find_spec("jax") else [])]
    assert list(rows) == ways, run.stdout
    assert float(rows.pop("vjp")) == 0
    assert all(float(off) < 1e-6 for off in rows.values()), run.stdout
