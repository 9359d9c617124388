"""What holds for any arc: motions, mirrors, reversal, scale, parallel transport; and any input."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from support import frames, unit, vectors
from test_polyline import values_of

from pyrod import rotation
from pyrod.curve import FramedCurve, Polyline, linking_number, without_repeats

ROUNDING = np.finfo(float).eps
MEASURES = ("log", "chord", "cayley")


@st.composite
def arcs(draw: st.DrawFn) -> Polyline:
    """Open, held or closed; turns and dihedral angles well away from 0 and pi, lengths near 1.

    Angles that rounding can change by more are looked at elsewhere."""
    n = draw(st.integers(4, 12))
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    closed = draw(st.booleans())
    r = rng.normal(size=(n, 3))
    ends = () if closed or draw(st.booleans()) else (rng.normal(size=3), rng.normal(size=3))
    arc = Polyline(r, closed, *ends)
    theta = arc.turning_angles if closed or ends else arc.turning_angles[1:-1]
    assume(arc.edge_lengths.min() > 0.2)
    assume(theta.min() > 0.1 and theta.max() < 3.0)
    assume(np.abs(arc.dihedral_angles).max() < 3.0)
    return arc


def like(arc: Polyline, positions: np.ndarray, start: object, end: object) -> Polyline:
    """The same kind of arc at other positions."""
    if arc.start_tangent is None:
        return Polyline(positions, arc.closed)
    return Polyline(positions, arc.closed, start, end)


def numbers_of(arc: Polyline) -> list[np.ndarray]:
    """Curvatures and torsions in all measures: up to 60 here, and amplify what rounding does to
    angles by at most 1/(length sin(theta) cos(3/2)^2), 1e4."""
    return [f(m) for m in MEASURES for f in (arc.curvature, arc.torsion)]


def assert_same(found: list[np.ndarray], expected: list[np.ndarray], atol: float = 1e-11) -> None:
    for a, b in zip(found, expected, strict=True):
        np.testing.assert_allclose(a, b, rtol=0, atol=atol)


@given(arcs(), frames(), vectors(5.0))
def test_rigid_motion(arc: Polyline, q: np.ndarray, shift: np.ndarray) -> None:
    def turned(v: np.ndarray | None) -> np.ndarray | None:
        return None if v is None else rotation.rotate(q, v)

    moved = like(
        arc, turned(arc.positions) + shift, turned(arc.start_tangent), turned(arc.end_tangent)
    )
    assert_same(numbers_of(moved), numbers_of(arc))
    np.testing.assert_allclose(
        moved.binormals[1:-1], turned(arc.binormals)[1:-1], rtol=0, atol=1e-12
    )
    np.testing.assert_allclose(moved.writhe(), arc.writhe(), rtol=0, atol=1e-10)


@given(arcs())
def test_mirror_changes_the_sign_of_torsion_and_writhe(arc: Polyline) -> None:
    flip = np.array([1.0, 1.0, -1.0])

    def mirrored(v: np.ndarray | None) -> np.ndarray | None:
        return None if v is None else v * flip

    image = like(arc, arc.positions * flip, mirrored(arc.start_tangent), mirrored(arc.end_tangent))
    signs = [1, -1] * 3
    assert_same(numbers_of(image), [s * x for s, x in zip(signs, numbers_of(arc), strict=True)])
    np.testing.assert_allclose(image.writhe(), -arc.writhe(), rtol=0, atol=1e-12)
    if arc.closed:
        turn = image.holonomy() + arc.holonomy()
        assert abs(np.remainder(turn + 1, 2 * np.pi) - 1) < 1e-12


@given(arcs())
def test_reversal(arc: Polyline) -> None:
    def minus(v: np.ndarray | None) -> np.ndarray | None:
        return None if v is None else -v

    back = like(arc, arc.positions[::-1], minus(arc.end_tangent), minus(arc.start_tangent))
    expected = []
    for values in numbers_of(arc):
        per_edge = arc.closed and len(expected) % 2 == 1  # the last edge is between 0 and n - 1
        expected.append(np.roll(values[::-1], -1) if per_edge else values[::-1])
    assert_same(numbers_of(back), expected)
    np.testing.assert_allclose(back.writhe(), arc.writhe(), rtol=0, atol=1e-12)
    if arc.start_tangent is not None or arc.closed:
        np.testing.assert_allclose(back.binormals, -arc.binormals[::-1], rtol=0, atol=1e-13)


@given(arcs(), st.integers(-150, 150))
def test_scale(arc: Polyline, power: int) -> None:
    """By powers of two no bit of an angle changes; curvature and torsion go with the inverse."""
    scaled = like(arc, arc.positions * 2.0**power, arc.start_tangent, arc.end_tangent)
    np.testing.assert_array_equal(scaled.turning_angles, arc.turning_angles)
    np.testing.assert_array_equal(scaled.dihedral_angles, arc.dihedral_angles)
    for found, values in zip(numbers_of(scaled), numbers_of(arc), strict=True):
        np.testing.assert_array_equal(found * 2.0**power, values)
    assert scaled.writhe() == arc.writhe()
    np.testing.assert_array_equal(scaled.bishop().frames, arc.bishop().frames)


@given(arcs(), st.integers(0, 11))
def test_a_closed_arc_has_no_first_vertex(arc: Polyline, shift: int) -> None:
    assume(arc.closed)
    rolled = Polyline(np.roll(arc.positions, shift, axis=0), closed=True)
    assert_same(numbers_of(rolled), [np.roll(x, shift) for x in numbers_of(arc)], 1e-13)
    np.testing.assert_allclose(rolled.writhe(), arc.writhe(), rtol=0, atol=1e-13)
    turn = rolled.holonomy() - arc.holonomy()
    assert abs(np.remainder(turn + 1, 2 * np.pi) - 1) < 1e-13
    whole = rolled.writhe() + rolled.frenet().twist
    assert abs(whole - rolled.frenet_link()) < 1e-10


@given(arcs(), vectors())
def test_an_end_tangent_turns_the_end_and_nothing_else(arc: Polyline, tangent: np.ndarray) -> None:
    assume(not arc.closed and np.linalg.norm(tangent) > 0.1)
    held = Polyline(arc.positions, end_tangent=tangent)
    t = arc.tangents[-1]
    cosine = unit(tangent) @ t
    assume(abs(cosine) < 0.99)
    np.testing.assert_allclose(held.turning_angles[-1], np.arccos(cosine), rtol=0, atol=1e-14)
    np.testing.assert_allclose(
        held.curvature()[-1] * arc.edge_lengths[-1] / 2, np.arccos(cosine), rtol=0, atol=1e-14
    )
    np.testing.assert_array_equal(held.curvature()[1:-1], arc.curvature()[1:-1])
    np.testing.assert_array_equal(held.binormals[1:-1], arc.binormals[1:-1])
    np.testing.assert_array_equal(held.bishop().frames, Polyline(arc.positions).bishop().frames)


# Parallel transport -------------------------------------------------------------------------------


@given(arcs(), vectors(), vectors())
def test_parallel_transport_keeps_products(arc: Polyline, a: np.ndarray, b: np.ndarray) -> None:
    """Of normals with each other and with the tangents (Linn 6.2.1): through any number of turns
    each by itself is the least that takes one tangent to the next."""
    framed = arc.bishop()
    R = framed.matrices
    np.testing.assert_allclose(R[..., 2], arc.tangents, rtol=0, atol=1e-14)
    u, v = R @ a, R @ b
    np.testing.assert_allclose(np.sum(u * v, axis=1), a @ b, rtol=0, atol=1e-13)
    for j in range(1, arc.edges):
        t, t2 = arc.tangents[j - 1], arc.tangents[j]
        across = np.cross(t, t2)
        least = rotation.to_matrix(
            rotation.exp(unit(across) * np.arctan2(np.linalg.norm(across), t @ t2))
        )
        np.testing.assert_allclose(least @ R[j - 1], R[j], rtol=0, atol=1e-14)
    np.testing.assert_allclose(framed.twist_angles[1:], 0, rtol=0, atol=1e-14)


@given(arcs(), st.integers(-5, 5))
def test_link_of_any_polygon(arc: Polyline, link: int) -> None:
    """Twist and writhe of any closed ribbon add up, with its edge to tell if it is near enough."""
    assume(arc.closed)
    try:
        ribbon = arc.closed_ribbon(link)
    except ValueError:
        cells = arc.cell_lengths.max() / arc.length
        assert abs(link - arc.writhe()) * cells >= 0.5  # turns at one vertex
        return
    assert abs(ribbon.twist + arc.writhe() - link) < 1e-10
    assume(np.abs(ribbon.twist_angles).max() < 1)  # so that the edge is near the ribbon
    near = 1e-3 * min(arc.edge_lengths.min(), arc.self_approach().distance)
    edge = ribbon.edge(near)
    assume(is_beside(ribbon, edge))
    assert linking_number(arc, edge) == link


def is_beside(ribbon: FramedCurve, edge: Polyline) -> bool:
    """Whether the edge has its vertices on the sides of the arc's edges to which their a1 point.

    Where more than a right angle of a corner's turn belongs to one of its edges, the longer one, it
    changes sides, and links once more or less.
    """
    a1 = ribbon.matrices[..., 0]
    start = edge.positions[: len(a1)] - ribbon.polyline.positions[: len(a1)]
    end = np.roll(start, -1, axis=0)
    return bool((np.sum(a1 * start, axis=1) > 0).all() and (np.sum(a1 * end, axis=1) > 0).all())


def test_an_edge_that_changes_sides_links_otherwise() -> None:
    """At the corner of 147 degrees, one of whose edges is much longer than the other."""
    corners = [
        (0.70459898, -1.55042176, 0.48497187),
        (0.93953242, 0.47079508, 0.34590371),
        (1.32148295, 1.12050668, -1.14137328),
        (-0.28525085, 1.06365001, -2.06786924),
        (1.32241384, -0.00971558, -2.61118371),
        (-1.7387867, 0.30779905, -0.24923453),
    ]
    arc = Polyline(corners, closed=True)
    ribbon = arc.closed_ribbon(0)
    edge = ribbon.edge(1e-3)
    assert not is_beside(ribbon, edge)
    assert linking_number(arc, edge) == 1


# Any input ----------------------------------------------------------------------------------------

ODD = st.sampled_from([0.0, 1.0, -1.0, 1e-300, 1e-155, 1e-70, 1e-8, 1e8, 1e70, 1e155, 1e300])
WILD = st.one_of(st.floats(-10, 10, width=16), ODD, st.sampled_from([np.nan, np.inf, -np.inf]))
TAME = st.one_of(st.integers(-2, 2).map(float), st.floats(-10, 10, width=16))


def table(numbers: st.SearchStrategy[float]) -> st.SearchStrategy[np.ndarray]:
    """(n, k) numbers; with small whole numbers many rows repeat, stand in line or fold back."""
    return st.tuples(st.integers(0, 8), st.sampled_from([1, 2, 3, 3, 3, 4])).flatmap(
        lambda shape: st.lists(
            numbers, min_size=shape[0] * shape[1], max_size=shape[0] * shape[1]
        ).map(lambda x: np.reshape(np.array(x, dtype=float), shape))
    )


def everything(r: np.ndarray, closed: bool) -> dict[str, np.ndarray]:
    arc = Polyline(r, closed=closed)
    out = values_of(arc)
    out["K"], out["Gamma"] = arc.bishop().strains()
    out["vertex frames of Bishop's"] = arc.bishop().vertex_frames
    if closed:
        out["holonomy"] = np.array(arc.holonomy())
    return out


@pytest.mark.filterwarnings("ignore:overflow encountered")
@given(st.one_of(table(WILD), table(TAME)), st.booleans())
def test_any_positions_are_refused_or_give_finite_numbers(r: np.ndarray, closed: bool) -> None:
    try:
        told = everything(r, closed)
    except ValueError as refusal:
        assert len(str(refusal)) > 20  # noqa: PT017
        return
    for name, values in told.items():
        assert np.isfinite(values).all(), name


@given(table(TAME), table(TAME))
def test_any_pairs_are_refused_or_counted(r: np.ndarray, other: np.ndarray) -> None:
    try:
        a, b = Polyline(r, closed=True), Polyline(other, closed=True)
        assert np.isfinite(a.writhe())
        assert linking_number(a, b) == linking_number(b, a)
        ribbon = a.closed_ribbon(2)
    except ValueError as refusal:
        assert len(str(refusal)) > 20  # noqa: PT017
        return
    assert ribbon.link() == 2


@given(table(TAME), st.booleans())
def test_without_repeats_leaves_no_repeats(r: np.ndarray, closed: bool) -> None:
    assume(r.shape[1] in (2, 3))
    kept, indices = without_repeats(r, closed)
    np.testing.assert_array_equal(kept, r[indices])
    assert (np.abs(np.diff(kept, axis=0)).sum(axis=1) > 0).all()
    if closed and len(kept) > 1:
        assert (kept[0] != kept[-1]).any()
    for row in r:
        assert (row == kept).all(axis=1).any()


@given(table(WILD), table(WILD), table(WILD), st.sampled_from(MEASURES))
def test_any_strains_are_refused_or_give_finite_curves(
    h: np.ndarray, K: np.ndarray, Gamma: np.ndarray, measure: str
) -> None:
    try:
        made = FramedCurve.from_strains(np.abs(h.ravel()), K, Gamma, measure=measure)
    except ValueError as refusal:
        assert len(str(refusal)) > 20  # noqa: PT017
        return
    assert np.isfinite(made.polyline.positions).all()
    assert np.isfinite(made.frames).all()
