"""Frenet's and Bishop's numbers of one curve, and vertices that repeat."""

from __future__ import annotations

import numpy as np
import pytest
from support import UNKNOT

from pyrod.curve import bishop_from_frenet, frenet_from_bishop, without_repeats


def test_bishop_curvatures_of_an_arc() -> None:
    """The strains of its Bishop frames, which start as Frenet's: exact at any coarseness."""
    arc = UNKNOT.polyline(UNKNOT.even(7))
    start = arc.frenet().frames[0]
    K = bishop_from_frenet(arc.curvature(), arc.dihedral_angles)
    framed = arc.bishop(frame=start)
    half = arc.dihedral_angles[0] / 2  # edge 0 stands half-way from binormal 0 to binormal 1
    seen = framed.turned(-half)
    np.testing.assert_allclose(seen.K[1:], K[1:], rtol=0, atol=1e-13)
    assert (K[:, 2] == 0).all()


@pytest.mark.parametrize("n", [1, 2, 50])
def test_there_and_back(n: int) -> None:
    rng = np.random.default_rng(n)
    kappa, alpha = rng.uniform(0.1, 2, n + 1), rng.uniform(-np.pi, np.pi, n)
    K = bishop_from_frenet(kappa, alpha)
    found = frenet_from_bishop(K)
    np.testing.assert_allclose(found[0], kappa, rtol=4e-16)
    np.testing.assert_allclose(found[1], alpha, rtol=0, atol=2e-15 * n)
    turned = np.array([[0.6, 0.8, 0], [-0.8, 0.6, 0], [0, 0, 1]])  # the start is not in them
    np.testing.assert_allclose(frenet_from_bishop(K @ turned)[1], alpha, rtol=0, atol=2e-15 * n)


def test_where_nothing_bends_the_angle_waits_for_the_next_bent_vertex() -> None:
    K = np.array([[0, 0, 5.0], [0, 2, 0], [0, 0, 0], [0, 0, 0], [-3, 0, 0], [0, 0, 0]])
    kappa, alpha = frenet_from_bishop(K)
    np.testing.assert_array_equal(kappa, [0, 2, 0, 0, 3, 0])
    np.testing.assert_allclose(alpha, [0, 0, 0, np.pi / 2, 0], rtol=0, atol=1e-16)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (
            lambda: bishop_from_frenet([1, 2, 3], [1]),
            "dihedral_angles: expected one per edge for 3",
        ),
        (lambda: bishop_from_frenet([1, np.nan], [1]), r"curvature\[1\]: expected finite"),
        (lambda: bishop_from_frenet([1, 2], [np.inf]), r"dihedral_angles\[0\]: expected finite"),
        (lambda: bishop_from_frenet([[1, 2]], [1]), "curvature: expected one number each"),
        (lambda: frenet_from_bishop([[1, 2, 0]]), "K: expected at least two vertices, got 1"),
        (lambda: frenet_from_bishop([[1, 2], [1, 2]]), r"K: expected an array of shape \(n, 3\)"),
        (lambda: frenet_from_bishop([[1, 2, 0], [1, np.nan, 0]]), r"K\[1\]: expected finite"),
        (lambda: without_repeats(np.zeros(3)), r"positions: expected shape .*got \(3,\)"),
        (lambda: without_repeats(np.zeros((2, 4))), r"positions: expected shape .*got \(2, 4\)"),
        (lambda: without_repeats([[0, 0], [np.nan, 0]]), r"positions\[1\]: expected finite"),
        (lambda: without_repeats(np.zeros((2, 3)), distance=-1), "distance: must not be negative"),
        (lambda: without_repeats(np.zeros((2, 3)), distance=np.nan), "distance: must not be"),
    ],
)
def test_refusals(call: object, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        call()


def test_repeats_are_left_out() -> None:
    r = np.array(
        [[0, 0, 0], [0, 0, 0], [1, 0, 0], [1, 0, 1e-3], [1, 2, 0], [0, 1e-3, 0], [0, 0, 0]]
    )
    for closed, distance, indices in [
        (False, 0.0, [0, 2, 3, 4, 5, 6]),
        (True, 0.0, [0, 2, 3, 4, 5]),
        (False, 2e-3, [0, 2, 4, 5]),
        (True, 2e-3, [0, 2, 4]),
        (True, np.inf, [0]),
    ]:
        kept, which = without_repeats(r, closed, distance)
        np.testing.assert_array_equal(which, indices)
        np.testing.assert_array_equal(kept, r[indices])
    np.testing.assert_array_equal(without_repeats(r[:, :2])[1], [0, 2, 4, 5, 6])
