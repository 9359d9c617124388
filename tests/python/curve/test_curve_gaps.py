"""Points that are missing: pieces between gaps."""

from __future__ import annotations

import numpy as np
import pytest

from pyrod.curve import Polyline, split_at_gaps

LINE = np.column_stack([np.arange(8.0), np.zeros(8), np.zeros(8)])


def indices(*given: object, **options: object) -> list[list[int]]:
    pieces = split_at_gaps(*given, **options)  # type: ignore[arg-type]
    points = np.ma.filled(np.ma.asarray(given[0]), np.nan)
    for r, index in pieces:
        np.testing.assert_array_equal(r[:, :2], points[index][:, :2])
        Polyline(r)
    return [index.tolist() for _, index in pieces]


def test_nothing_is_missing() -> None:
    assert indices(LINE) == [[0, 1, 2, 3, 4, 5, 6, 7]]
    assert indices(LINE[:, :2]) == [[0, 1, 2, 3, 4, 5, 6, 7]]


def test_missing_points_part_a_curve() -> None:
    r = LINE.copy()
    r[3, 1] = np.nan
    assert indices(r) == [[0, 1, 2], [4, 5, 6, 7]]
    r[5] = np.nan  # leaves point 4 alone
    assert indices(r) == [[0, 1, 2], [6, 7]]
    r[[0, 7]] = np.inf
    assert indices(r) == [[1, 2]]
    assert indices(np.full((4, 3), np.nan)) == []


def test_masked_points_are_missing() -> None:
    r = np.ma.masked_values(
        [[0, 0, 0], [1, 0, 0], [-9999, -9999, -9999], [2, 1, 0.0], [3, 1, 0]], -9999.0
    )
    assert indices(r) == [[0, 1], [3, 4]]
    whole = np.ma.array([[0, 0, 0], [1, 0, 0], [2, 0, 0.0]], mask=[[0] * 3, [0, 1, 0], [0] * 3])
    assert indices(whole) == []


def test_long_steps_are_gaps() -> None:
    r = LINE.copy()
    r[4:, 0] += 10
    assert indices(r) == [[0, 1, 2, 3, 4, 5, 6, 7]]
    assert indices(r, gap=1.5) == [[0, 1, 2, 3], [4, 5, 6, 7]]
    with pytest.raises(ValueError, match="gap: must be positive, got 0"):
        split_at_gaps(r, gap=0)


def test_a_closed_curve_goes_on_at_its_seam() -> None:
    t = 2 * np.pi * np.arange(8) / 8
    ring = np.column_stack([np.cos(t), np.sin(t), 0 * t])
    assert indices(ring, closed=True) == [[0, 1, 2, 3, 4, 5, 6, 7]]
    ring[3] = np.nan
    assert indices(ring, closed=True) == [[4, 5, 6, 7, 0, 1, 2]]
    ring[6] = np.nan
    assert indices(ring, closed=True) == [[4, 5], [7, 0, 1, 2]]
    assert indices(ring) == [[0, 1, 2], [4, 5]]


def test_a_point_that_is_missing_is_told() -> None:
    r = LINE.copy()
    r[3, 1] = np.nan
    with pytest.raises(ValueError, match=r"positions\[3\]: expected finite numbers.*split_at_gaps"):
        Polyline(r)
