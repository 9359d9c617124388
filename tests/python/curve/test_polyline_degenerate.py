"""Polygonal arcs at their limits: what is refused, and what is defined though nothing bends."""

from __future__ import annotations

import numpy as np
import pytest
from support import UNKNOT
from test_polyline import values_of

from pyrod.curve import Polyline

LINE = np.arange(5.0)[:, None] * [1.0, 2.0, 2.0]
BENT = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [1, 1, 1]])


# Refusals -----------------------------------------------------------------------------------------


def at(place: int, value: object) -> np.ndarray:
    out = BENT.copy()
    out[place] = value
    return out


REFUSED = [
    (
        {"positions": np.zeros((4, 4))},
        r"positions: expected shape \(n, 3\) or \(n, 2\), got \(4, 4",
    ),
    ({"positions": np.zeros(3)}, r"positions: expected shape .* got \(3,\)"),
    ({"positions": 1.0}, r"positions: expected shape .* got \(\)"),
    ({"positions": BENT[:1]}, "positions: expected at least 2 vertices, got 1"),
    ({"positions": BENT[:2], "closed": True}, "positions: expected at least 3 vertices, got 2"),
    ({"positions": np.zeros((0, 3))}, "positions: expected at least 2 vertices, got 0"),
    ({"positions": at(2, np.nan)}, r"positions\[2\]: expected finite numbers"),
    ({"positions": at(3, [0, np.inf, 0])}, r"positions\[3\]: expected finite numbers"),
    ({"positions": at(2, BENT[1])}, r"positions\[2\]: coincides with positions\[1\]; leave one"),
    ({"positions": at(1, BENT[0])}, r"positions\[1\]: coincides with positions\[0\]; leave one"),
    (
        {"positions": at(3, BENT[0]), "closed": True},
        r"positions\[0\]: coincides with positions\[3\].*returns to its first vertex by itself",
    ),
    (
        {"positions": at(3, [1e61, 0, 0])},
        r"positions\[3\]: the edge before has length 1e\+61.*units",
    ),
    ({"positions": at(2, [0.5, 0, 0])}, r"positions\[1\]: .* antiparallel.*put a vertex aside"),
    ({"positions": at(3, [1, 0.5, 0])}, r"positions\[2\]: .* antiparallel.*put a vertex aside"),
    ({"positions": [[0, 0], [1, 0], [2, 0]], "closed": True}, r"positions\[0\]: .* antiparallel"),
    ({"start_tangent": [-1, 0, 0]}, r"positions\[0\]: .* antiparallel"),
    ({"end_tangent": [0, 0, -2]}, r"positions\[3\]: .* antiparallel"),
    ({"start_tangent": [1, 0]}, r"start_tangent: expected 3 numbers, got shape \(2,\)"),
    ({"end_tangent": [1, np.nan, 0]}, "end_tangent: expected finite numbers"),
    ({"start_tangent": [0, 0, 0]}, "start_tangent: expected a direction, finite and not zero"),
    ({"end_tangent": [0, 1e61, 0]}, "end_tangent: expected a direction"),
    ({"closed": True, "end_tangent": [0, 1, 0]}, "end_tangent: a closed arc has no ends"),
    ({"straight": -0.1}, r"straight: must be an angle in \[0, pi\), got -0.1"),
    ({"straight": np.pi}, r"straight: must be an angle in \[0, pi\)"),
    ({"straight": np.nan}, r"straight: must be an angle in \[0, pi\), got nan"),
]


@pytest.mark.parametrize(("change", "message"), REFUSED)
def test_arcs_are_refused(change: dict[str, object], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        Polyline(**{"positions": BENT, **change})


OPEN, CLOSED = Polyline(BENT), UNKNOT.polyline(UNKNOT.even(20))
ASKED = [
    (lambda: OPEN.curvature("angle"), "measure: expected"),
    (lambda: OPEN.torsion("angle"), "measure: expected"),
    (lambda: OPEN.derivative([0, 1, 2]), r"parameter: expected 4 increasing numbers, got shape"),
    (lambda: OPEN.derivative([0, 1, 1, 2]), "parameter: expected 4 increasing numbers"),
    (lambda: OPEN.derivative([0, 1, np.nan, 2]), "parameter: expected 4 increasing numbers"),
    (lambda: CLOSED.derivative(np.arange(20)), "parameter: expected 21 increasing numbers"),
    (lambda: OPEN.at_vertices(np.zeros(4)), "values: expected 3 rows"),
    (lambda: OPEN.at_centres(np.zeros((3, 2))), "values: expected 4 rows"),
    (lambda: OPEN.at_centres(1.0), "values: expected an array"),
    (lambda: OPEN.bishop([1, 0, 0]), "normal: must not be parallel to the tangent"),
    (lambda: OPEN.bishop([0, 1, 0], frame=[1, 0, 0, 0]), "normal: give either it or frame"),
    (lambda: OPEN.bishop(frame=[1, 1, 0, 0]), "start.*: expected a unit quaternion"),
    (lambda: OPEN.bishop(frame=np.eye(2)), "start: expected a quaternion"),
    (
        lambda: OPEN.bishop(angles=[0.1, 0.2]),
        r"angles: expected one or 3, one per edge, got shape \(2,\)",
    ),
    (lambda: OPEN.bishop(angles=[0.1, np.inf, 0.2]), r"angles\[1\]: expected finite"),
    (lambda: OPEN.holonomy(), "holonomy: only a closed polyline has one; make it with closed=True"),
    (lambda: OPEN.frenet_link(), "frenet_link: only a closed polyline has one"),
    (lambda: OPEN.closed_ribbon(0), "closed_ribbon: only a closed polyline has one"),
    (lambda: CLOSED.closed_ribbon(0.5), "link: must be a whole number, got 0.5"),
    (lambda: CLOSED.closed_ribbon(np.nan), "link: must be a whole number, got nan"),
    (lambda: CLOSED.closed_ribbon(np.inf), "link: must be a whole number, got inf"),
    (
        lambda: CLOSED.closed_ribbon(9),
        r"link: 9 takes half a turn or more at vertex \d+.*more edges",
    ),
]


@pytest.mark.parametrize(("ask", "message"), ASKED)
def test_questions_are_refused(ask: object, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        ask()


@pytest.mark.parametrize("fold", [1e-5, 1e-9, 1e-12])
def test_folds_that_are_nearly_flat_are_taken(fold: float) -> None:
    """pi minus the angle keeps its digits; the binormal is the axis that there is."""
    arc = Polyline([[0, 0, 0], [1, 0, 0], [0, fold, 0]])
    assert np.pi - arc.turning_angles[1] == pytest.approx(fold, rel=1e-3, abs=4e-16)
    np.testing.assert_allclose(arc.binormals[1], [0, 0, 1], rtol=0, atol=1e-15)


@pytest.mark.parametrize("size", [1e-40, 1.0, 1e14, 1e40])
def test_directions_of_ends_have_no_length(size: float) -> None:
    """Neither compared with positions nor with edges."""
    for length in (1e-40, 1.0, 1e40):
        arc = Polyline(size * BENT, False, length * np.array([1, 0, 1]), [0, length, length])
        np.testing.assert_allclose(arc.turning_angles[[0, -1]], np.pi / 4, rtol=4e-16)
        ends = [[0, 1, 0], [-1, 0, 0]]
        np.testing.assert_allclose(arc.binormals[[0, -1]], ends, rtol=0, atol=1e-16)


# Where nothing bends ------------------------------------------------------------------------------


@pytest.mark.parametrize("scale", [1e-50, 1e-9, 1.0, 1e12, 1e50])
@pytest.mark.parametrize("shift", [0.0, 1e3])
def test_a_straight_arc_has_a_normal_and_no_torsion(scale: float, shift: float) -> None:
    """Shifted, the vertices are rounded, and bend by that."""
    arc = Polyline(scale * (0.1 * LINE + shift))
    for name, values in values_of(arc).items():
        assert np.isfinite(values).all(), name
    np.testing.assert_array_equal(arc.dihedral_angles, np.zeros(4))
    np.testing.assert_allclose(arc.turning_angles, 0, rtol=0, atol=1e-12 if shift else 1e-15)
    b = arc.binormals
    np.testing.assert_allclose(b, np.tile(b[0], (5, 1)), rtol=0, atol=1e-12 if shift else 1e-15)
    np.testing.assert_allclose(np.linalg.norm(b, axis=1), 1, rtol=1e-15)
    np.testing.assert_allclose(b @ [1, 2, 2], 0, rtol=0, atol=1e-11 if shift else 1e-15)


def dogleg(angle: float) -> Polyline:
    """Straight, bent about e3, straight for three edges, bent about an axis turned by ``angle``."""
    up = [0, np.cos(angle), np.sin(angle)]
    r = np.cumsum([[0, 0, 0], [1, -1, 0], [1, -1, 0], *[[1, 0, 0]] * 3, [1, *up[1:]]], axis=0)
    return Polyline(np.vstack([r, r[-1] + [1, *up[1:]]]))


@pytest.mark.parametrize("angle", [0.3, -1.0, 3.0, np.pi])
def test_straight_stretches_keep_the_binormal_before(angle: float) -> None:
    """The whole angle falls on the edge into the next bent vertex; the start takes what follows."""
    arc = dogleg(angle)
    bent = [2, 5]
    np.testing.assert_array_equal(np.flatnonzero(arc.turning_angles > 1e-9), bent)
    np.testing.assert_allclose(arc.binormals[:5], np.tile([0, 0, 1], (5, 1)), rtol=0, atol=1e-15)
    last = [0, -np.sin(angle), np.cos(angle)]
    np.testing.assert_allclose(arc.binormals[5:], np.tile(last, (3, 1)), rtol=0, atol=1e-15)
    expected = np.zeros(7)
    expected[4] = angle
    np.testing.assert_allclose(arc.dihedral_angles, expected, rtol=0, atol=1e-15)


def test_a_closed_arc_takes_the_binormal_over_the_seam() -> None:
    """Vertices 0 and 1 are straight and follow the last one."""
    ring = [[-1, 0, 0], [0, 0, 0], [1, 0, 0], [2, 1, 0.5], [0, 3, 0], [-2, 0, 0]]
    arc = Polyline(ring[1:] + ring[:1], closed=True)
    straight = arc.turning_angles < 1e-9
    np.testing.assert_array_equal(np.flatnonzero(straight), [0, 5])
    np.testing.assert_allclose(arc.binormals[[5, 0]], arc.binormals[[4, 4]], rtol=0, atol=1e-15)
    np.testing.assert_allclose(arc.dihedral_angles[[4, 5]], 0, rtol=0, atol=1e-15)


def test_an_inflection_turns_the_binormal_by_pi_and_nothing_else() -> None:
    x = np.linspace(-1, 1, 12)
    arc = Polyline(np.column_stack([x, x**3]))
    assert sorted(np.abs(arc.dihedral_angles))[-1] == np.pi
    assert sorted(np.abs(arc.dihedral_angles))[-2] < 1e-15
    signed = arc.curvature_binormals()[1:-1, 2]
    assert (np.diff(signed)[2:-2] > 0).all()  # through zero without a jump
    np.testing.assert_allclose(signed, -signed[::-1], rtol=0, atol=1e-14)
    for name, values in values_of(arc).items():
        assert np.isfinite(values).all(), name


def test_the_option_straight_says_what_counts_as_straight() -> None:
    """Noise of 1e-6 about a line: binormals at random, unless told what is straight."""
    noise = np.random.default_rng(2).normal(size=(20, 3)) * 1e-6
    r = np.arange(20.0)[:, None] * [0, 0, 1] + noise
    loose, strict = Polyline(r, straight=1e-4), Polyline(r)
    assert np.abs(strict.torsion()).max() > 1
    np.testing.assert_allclose(loose.torsion(), 0, rtol=0, atol=1e-9)
    np.testing.assert_array_equal(loose.turning_angles, strict.turning_angles)
    assert Polyline(BENT, straight=1.5) != Polyline(BENT)
    np.testing.assert_array_equal(Polyline(BENT, straight=1.5).binormals, OPEN.binormals)


def test_binormals_of_vertices_that_count_as_straight_are_carried_along() -> None:
    """Across the edge behind each, also before the first vertex that bends: by transport back."""
    rng = np.random.default_rng(8)
    steps = np.repeat([[0, 0, 1.0], [0, 1.0, 0]], 6, axis=0) + rng.uniform(-0.1, 0.1, (12, 3))
    arc = Polyline(np.cumsum(steps, axis=0), straight=0.4)
    np.testing.assert_array_equal(np.flatnonzero(arc.turning_angles > 0.4), [5])
    across = np.sum(arc.binormals[:-1] * arc.tangents, axis=1)
    np.testing.assert_allclose(across, 0, rtol=0, atol=1e-15)
    np.testing.assert_allclose(arc.binormals[4], arc.binormals[5], rtol=0, atol=1e-15)
