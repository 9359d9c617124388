"""The program that follows a target in real time does."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

PROGRAM = Path(__file__).parents[3] / "examples" / "realtime.py"


@pytest.mark.skipif(not PROGRAM.is_file(), reason="needs the sources")
def test_the_tip_stays_with_its_target() -> None:
    done = subprocess.run(
        [sys.executable, str(PROGRAM), "300"], capture_output=True, text=True, check=True
    )
    numbers = [float(x) for x in re.findall(r"[\d.]+(?:e-\d+)?", done.stdout)]
    median, most, longest, residual, off = (numbers[i] for i in (0, 2, 3, 4, 5))
    assert 0 < median <= most <= longest
    assert residual < 1e-10
    assert off < 0.1
