"""Curves in single precision, with masks, and with points that repeat."""

from __future__ import annotations

import re

import numpy as np
import pytest

import pyrod
from pyrod import CurveWarning
from pyrod.curve import Polyline, without_repeats

TURN = np.array([[0.36, -0.8, -0.48], [0.48, 0.6, -0.64], [0.8, 0.0, 0.6]])
S = np.linspace(0, 4, 41)
HELIX = Polyline(np.column_stack([np.cos(S), np.sin(S), 0.3 * S]))
BISHOP = HELIX.bishop()


def knot(n: int = 100) -> np.ndarray:
    t = 2 * np.pi * np.arange(n) / n
    x, y = np.sin(t) + 2 * np.sin(2 * t), np.cos(t) - 2 * np.cos(2 * t)
    return np.column_stack([x, y, -np.sin(3 * t)])


def square() -> np.ndarray:
    """Three edges to a side."""
    x, o = np.arange(3) / 3, np.zeros(3)
    sides = np.column_stack([np.r_[x, 1 + o, 1 - x, o], np.r_[o, x, 1 + o, 1 - x], np.zeros(12)])
    return sides @ TURN.T


def stadium(n: int, radius: float = 0.3) -> np.ndarray:
    """Two straight sides of length 1 and two half circles, in an oblique plane."""
    u = np.arange(n) * (2 + 2 * np.pi * radius) / n
    side = u % (1 + np.pi * radius)
    angle = np.maximum(side - 1, 0) / radius
    x, y = np.minimum(side, 1) - 0.5 + radius * np.sin(angle), -radius * np.cos(angle)
    half = np.where(u < 1 + np.pi * radius, 1, -1)
    return np.column_stack([half * x, half * y, np.zeros(n)]) @ TURN.T


# Single precision ---------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", ["f8", "f4"])
def test_a_square_is_plane_in_either_precision(kind: str) -> None:
    arc = Polyline(square().astype(kind), closed=True)
    assert arc.frenet_link() == 0
    assert np.abs(arc.torsion()).max() < 1e-6


@pytest.mark.parametrize("far", [0.0, 100.0])
def test_a_coil_in_single_precision_has_no_link(far: float) -> None:
    """0.03 rad per vertex, which rounding 100 m off the origin turns by 6e-3 rad."""
    arc = Polyline((stadium(400) + far).astype(np.float32), closed=True)
    assert arc.frenet_link() == 0
    double = Polyline(stadium(400) + far, closed=True)
    assert double.frenet_link() == 0
    assert np.abs(double.torsion()).max() < 1e-5


def test_a_straight_line_in_single_precision_is_straight() -> None:
    line = Polyline((np.arange(501)[:, None] * 0.1 * TURN[0]).astype(np.float32))
    assert np.abs(line.dihedral_angles).sum() < 1e-6


def test_edges_that_fold_back_in_single_precision() -> None:
    fold = np.array([[0, 0, 0], [1, 0, 0], [0.5, 1e-8, 0]])
    Polyline(fold)  # the plane of the turn is known
    with pytest.raises(ValueError, match=r"positions\[1\].*antiparallel within the resolution"):
        Polyline(fold.astype(np.float32))


def test_a_resolution_of_positions_is_told_in_metres() -> None:
    noise = 1e-4 * np.random.default_rng(3).uniform(-0.5, 0.5, (400, 3))
    rough = stadium(400) + noise
    assert np.abs(Polyline(rough, closed=True).torsion()).max() > 50
    arc = Polyline(rough, closed=True, resolution=1e-4)
    straight = np.abs(arc.positions @ TURN[:, 1]) > 0.2999
    assert straight.sum() > 100
    inside = straight & np.roll(straight, 1) & np.roll(straight, -1) & np.roll(straight, -2)
    assert np.abs(arc.torsion()[inside]).max() < 0.02
    with pytest.raises(ValueError, match="resolution: must be finite and not negative, got -1"):
        Polyline(rough, resolution=-1)


def test_precision_is_kept_in_copies() -> None:
    import pickle

    arc = Polyline(square().astype(np.float32), closed=True)
    again = pickle.loads(pickle.dumps(arc))
    assert again == arc
    assert np.array_equal(again.torsion(), arc.torsion())


def test_short_edges_are_not_the_measure_of_long_ones() -> None:
    """Each vertex has the tolerance of its own edges: the long ones turn by less than what the
    short ones hide, and still bend."""
    ends = np.cumsum([0, 1, 1, 1, 1, 3e-5, 3e-5, 1, 1, 1, 1])
    turns = np.zeros(len(ends))
    turns[1:5] = 3e-4
    tangents = np.cumsum(turns)[:-1]
    steps = np.diff(ends)[:, None] * np.column_stack([np.cos(tangents), np.sin(tangents)])
    arc = Polyline(np.vstack([[0, 0], np.cumsum(steps, axis=0)]).astype(np.float32))
    np.testing.assert_allclose(np.abs(arc.binormals[1:5, 2]), 1, rtol=1e-12)


# Masks, repeats -----------------------------------------------------------------------------------


def masked() -> np.ma.MaskedArray:
    return np.ma.masked_values([[0, 0, 0], [1, 0, 0], [-9999, -9999, -9999], [2, 1, 0.0]], -9999)


@pytest.mark.parametrize("take", [Polyline, without_repeats])
def test_masked_points_are_refused(take: type) -> None:
    with pytest.raises(ValueError, match=r"positions\[2, 0\]: is masked.*compress_rows"):
        take(masked())


def test_without_the_masked_row_it_is_right() -> None:
    assert Polyline(np.ma.compress_rows(masked())).length == pytest.approx(1 + np.sqrt(2))
    assert Polyline(np.ma.asarray(HELIX.positions)) == HELIX  # nothing is masked


def test_masked_points_of_a_rod() -> None:
    r = np.ma.asarray(HELIX.positions.copy())
    r[3] = np.ma.masked
    with pytest.raises(ValueError, match=r"positions\[3, 0\]: is masked"):
        pyrod.Rod.from_curve(r, BISHOP.frames, pyrod.Section(1, 1, 1))


def test_a_point_told_twice_with_other_digits() -> None:
    points = np.vstack([knot(), knot()[:1] + 1e-7])
    with pytest.warns(
        CurveWarning, match=r"positions\[0\] nearly repeats positions\[100\]"
    ) as told:
        Polyline(points, closed=True)
    assert told[0].filename == __file__
    distance = re.search(r"distance=([0-9.e-]+)", str(told[0].message))
    assert distance is not None
    kept, _ = without_repeats(points, closed=True, distance=float(distance[1]))
    arc = Polyline(kept, closed=True)
    assert arc.curvature().max() == pytest.approx(0.77355, rel=1e-4)
    assert np.abs(arc.torsion()).max() == pytest.approx(0.35186, rel=1e-4)
    assert arc.writhe() == pytest.approx(-3.35423, rel=1e-5)


@pytest.mark.parametrize("place", [0, 17, 40])
def test_near_repeats_on_open_curves(place: int) -> None:
    points = np.insert(HELIX.positions, place + 1, HELIX.positions[place] + [0, 0, -1e-6], axis=0)
    with pytest.warns(CurveWarning, match=f"nearly repeats positions.{place}."):
        Polyline(points)


def test_short_edges_along_the_curve_are_none() -> None:
    """A small chamfer, and points of uneven sampling."""
    Polyline([[0, 0], [1, 0], [1.0001, 0.0001], [1.0001, 1]])
    s = np.sort(np.append(S, S[10] + 1e-6))
    Polyline(np.column_stack([np.cos(s), np.sin(s), 0.3 * s]))
