"""Folds, bifurcations and branches against references by shooting and closed forms."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from frames_that_snap import DOWN, arch, column, lee
from scipy.special import ellipe, ellipk
from support import extrapolated, orders

import pyrod
from pyrod import follow


def path(scene: pyrod.Scene, down: Any, stop: float, **more: Any) -> pyrod.Branch:
    return follow((scene, "loads.0.force", down), 0.0, stop, **more)


def kinds(branch: pyrod.Branch) -> list[str]:
    return [point.kind for point in branch.special]


def test_the_deep_arch_goes_through_its_folds() -> None:
    """DaDeppo & Schmidt 1975: 8.97. On each grid to rounding; the grids with order 2."""
    upper, lower = [], []
    for n in (32, 64, 128, 256):
        branch = path(arch(n), DOWN["arch"], 12.0)
        assert branch.ended == "reached"
        assert kinds(branch) == ["fold", "fold"]
        first, second = branch.special
        assert (first.index_before, first.index_behind, second.index_behind) == (0, 1, 0)
        assert max(first.error, second.error) < 1e-11
        upper.append(first.value)
        lower.append(second.value)
    exact = 8.97308996972
    assert orders(np.abs(np.array(upper) - exact)) == pytest.approx(2.0, abs=0.02)
    assert extrapolated(upper, (2, 4, 6)) == pytest.approx(exact, abs=1e-8)
    assert orders(np.abs(np.array(lower) + 0.7305513)) == pytest.approx(2.0, abs=0.05)
    assert extrapolated(lower, (2, 4, 6)) == pytest.approx(-0.7305513, abs=1e-6)


def test_lees_frame() -> None:
    found = []
    for n in (20, 40, 80, 160):
        branch = path(lee(n), DOWN["lee"], 30.0)
        assert kinds(branch)[:2] == ["fold", "fold"]
        found.append(branch.special[0].value)
    exact = 18.55874653948
    assert orders(np.abs(np.array(found) - exact)) == pytest.approx(2.0, abs=0.02)
    assert extrapolated(found, (2, 4, 6)) == pytest.approx(exact, abs=1e-7)


def test_the_hinged_semicircle_goes_to_the_side_before_it_snaps() -> None:
    sides, folds = [], []
    for n in (32, 64, 128, 256):
        branch = path(arch(n, np.pi, clamped=False), DOWN["arch"], 14.0)
        assert branch.special[0].kind.endswith("pitchfork")
        assert "fold" in kinds(branch)
        sides.append(branch.special[0].value)
        folds.append(next(point.value for point in branch.special if point.kind == "fold"))
        # the mode is antisymmetric: turns are symmetric
        mode = branch.special[0].mode[:, 1]
        assert mode[::-1] == pytest.approx(mode, abs=1e-8)
    assert orders(np.abs(np.array(sides) - 5.86053763451)) == pytest.approx(2.0, abs=0.02)
    assert extrapolated(sides, (2, 4, 6)) == pytest.approx(5.86053763451, abs=1e-9)
    assert extrapolated(folds, (2, 4, 6)) == pytest.approx(10.15034386367, abs=1e-7)


@pytest.mark.parametrize("space", ["planar", "spatial"])
def test_a_column_buckles_in_all_its_modes(space: str) -> None:
    """Frames that turn as cos(k pi s) solve the difference equation: P = (2 n sin(k pi/2n))^2."""
    n = 32
    branch = path(column(n, space), DOWN["column"], 165.0)
    assert branch.ended == "reached"
    assert kinds(branch) == 4 * ["supercritical pitchfork"]
    s = (np.arange(n) + 0.5) / n
    for k, point in enumerate(branch.special, 1):
        exact = (2 * n * np.sin(k * np.pi / (2 * n))) ** 2
        assert point.value == pytest.approx(exact, rel=1e-12)
        assert abs(point.value - exact) <= point.error + 1e-13 * exact
        assert (point.index_before, point.index_behind) == (k - 1, k)
        shape = np.cos(k * np.pi * s)
        shape *= np.sign(point.mode[0, 1]) / np.abs(shape).max()
        assert point.mode[:, 1] == pytest.approx(shape, abs=1e-9)


@pytest.mark.parametrize("k", [1, 2, 3])
def test_post_buckling_is_the_elastica(k: int) -> None:
    """lambda = (2 k K(sin a/2))^2 for the turn a at the ends, with a^2/8 more than at buckling."""
    errors = []
    for n in (64, 128):
        trivial = path(column(n), DOWN["column"], 130.0)
        off = []
        for side in (1, -1):
            branch = trivial.special[k - 1].switch(side)
            assert branch.ended == "reached"
            assert set(branch.indices[:5]) == {k - 1}
            for point in branch.points[:: max(1, len(branch) // 8)]:
                angle = _end_angle(point.equilibrium)
                off.append(point.value / (2 * k * ellipk(np.sin(angle / 2) ** 2)) ** 2 - 1)
            first = _end_angle(branch.points[0].equilibrium)
            rise = branch.values[0] / trivial.special[k - 1].value - 1
            coarse = 2 * (k * np.pi / (2 * n)) ** 2
            assert rise / (first**2 / 8) == pytest.approx(1.0, abs=1e-3 + coarse)
        errors.append(np.abs(off).max())
    assert errors[1] < errors[0] / 3.5


def _end_angle(result: pyrod.Equilibrium) -> float:
    frame = result.vertex_frames[0]
    return float(abs(2 * np.arctan2(frame[2], frame[0])))


def test_the_height_of_the_buckled_column() -> None:
    """At 1.5 pi^2, by elliptic integrals."""
    heights = []
    for n in (32, 64, 128):
        branch = path(column(n), DOWN["column"], 1.5 * np.pi**2)
        buckled = branch.special[0].switch(1)
        assert buckled.values[-1] == 1.5 * np.pi**2
        heights.append(buckled.points[-1].equilibrium.tip[2])
    exact = 0.36358822492179
    assert orders(np.abs(np.array(heights) - exact)) == pytest.approx(2.0, abs=0.02)
    assert extrapolated(heights, (2, 4)) == pytest.approx(exact, abs=1e-8)
    m = 0.5  # checked: the height is 2 E/K - 1 where (2 K)^2 is the load
    for _ in range(60):
        m -= (ellipk(m) - np.pi / 2 * np.sqrt(1.5)) / ((ellipe(m) / (1 - m) - ellipk(m)) / (2 * m))
    assert 2 * ellipe(m) / ellipk(m) - 1 == pytest.approx(exact, abs=1e-12)
