"""The benchmark of gradients runs, and its ways agree."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[3] / "benchmarks"))

import gradient as benchmark


def test_all_ways_find_the_same_gradient() -> None:
    adjoint, *others = benchmark.measured(12, 1)
    assert adjoint.name == "vjp"
    assert np.abs(adjoint.gradient).max() > 0.01
    for other in others:
        assert other.gradient == pytest.approx(adjoint.gradient, abs=1e-6), other.name


def test_it_prints_a_table(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "argv", ["gradient.py", "6", "1"])
    benchmark.main()
    assert "differences of solves" in capsys.readouterr().out
