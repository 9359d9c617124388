"""What ends a climb before its tolerance is reached, what is told of it, and while it runs."""

from __future__ import annotations

import re
from time import perf_counter

import numpy as np
import pytest

import pyrod
from pyrod import Clamp, DistributedForce, Force, NotConverged, Options, Rod, Scene, Section

ROUND = Section(EI1=1.0, EI2=1.0, GJ=0.7)


def rough(n: int | None = None) -> Scene:
    """A load that is noise to every grid, so that a climb goes on to its limits."""
    load = DistributedForce(lambda s: (1 + 0.3 * np.sin(1e9 * s * s), 0, 0))
    return Scene(Rod.straight(1.0, n, ROUND), Clamp(), load)


def smooth() -> Scene:
    return Scene(Rod.straight(1.0, 16, ROUND), Clamp(), Force((8, 3, -2)))


def test_the_limit_of_edges_is_named_with_what_is_left() -> None:
    with pytest.raises(NotConverged) as caught:
        pyrod.solve(smooth(), Options(max_edges=64), tol=1e-12)
    result, text = caught.value.result, str(caught.value)
    assert result.accuracy.ended == "edges"
    assert result.accuracy.finest_edges == 64
    assert "tol=1e-12 was not reached within max_edges" in text
    assert "3 grids of up to 64 edges" in text
    worst = max(("positions", "frames", "moments"), key=lambda name: result.errors[name])
    assert f"{worst} {result.errors[worst]:.1e}" in text
    assert "jump" not in text  # nothing does
    assert "vertex" not in text
    exact = pyrod.solve(smooth(), tol=1e-10)
    assert exact.accuracy.ended == "reached"
    assert np.abs(result.positions - exact.positions).max() <= result.errors["positions"]


def test_rounding_is_named() -> None:
    with pytest.raises(NotConverged, match="tol=1e-15 was not reached above rounding"):
        pyrod.solve(smooth(), tol=1e-15)


def test_time_ends_a_climb_between_grids() -> None:
    """With the best answer, and its errors."""
    options = Options(max_time=0.2, max_edges=2**26)
    began = perf_counter()
    result = pyrod.solve(rough(), options, tol=1e-12, strict=False)
    assert perf_counter() - began < 20
    assert result.status == "not_accurate"
    assert result.accuracy.ended == "time"
    assert "within max_time" in str(NotConverged(result))
    assert result.accuracy.finest_edges < 2**26
    assert np.isfinite(result.positions).all()


def test_a_climb_that_has_no_time_has_the_first_grid() -> None:
    result = pyrod.solve(smooth(), Options(max_time=1e-9), tol=1e-6, strict=False)
    assert result.accuracy.grids == 1
    assert result.accuracy.ended == "time"
    plain = pyrod.solve(smooth())
    assert np.abs(result.positions - plain.positions).max() < 1e-12
    assert "the errors are unknown" in str(NotConverged(result))


@pytest.mark.parametrize("value", [0, -1.0, float("nan")])
def test_times_that_mean_nothing_are_refused(value: float) -> None:
    with pytest.raises(ValueError, match="max_time: must be positive"):
        Options(max_time=value)


def test_progress_shows_grids_edges_and_errors(capfd: pytest.CaptureFixture[str]) -> None:
    """Of a climb that takes longer than half a second."""
    fine = Rod.straight(1.0, 2**14, ROUND)
    scene = Scene(fine, [Clamp(), Clamp((0, 0, 0.5), at="end")], Force((3, 1, 0), at=0.3))
    pyrod.solve(scene, Options(max_edges=2**18), tol=1e-14, strict=False, progress=True)
    told = capfd.readouterr().err
    assert "grids=" in told
    assert re.search(r"edges=[1-9]\d{4,5}\b", told)
    assert "error=" in told
