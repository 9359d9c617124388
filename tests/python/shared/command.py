"""The command ``pyrod``, run as a shell does, and a scene for it."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from typing import Any

CANTILEVER = """
[sections.wire]
EI1 = 1.0
EI2 = 1.0
GJ = 0.7

[[rods]]
length = 1.0
edges = 64
section = "wire"

[[supports]]
kind = "clamp"

[[loads]]
kind = "force"
force = [10.0, 0.0, 0.0]
"""
TIP = 0.8106090248802964  # of the elastica, F L^2/EI = 10
FAILED, WRONG, STOPPED = 1, 2, 130


def pyrod_command(*arguments: object, cwd: Path, **more: Any) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-m", "pyrod", *map(str, arguments)],
        check=False,
        capture_output=True,
        text=True,
        cwd=cwd,
        timeout=120,
        **more,
    )
