"""Polygonal arcs: what they are made from, what they tell and what they refuse."""

from __future__ import annotations

import pickle

import numpy as np
import pytest
from support import UNKNOT, differences, unit

from pyrod.curve import Approach, Polyline

RNG = np.random.default_rng(7)
OPEN = Polyline(RNG.normal(size=(6, 3)))
HELD = Polyline(OPEN.positions, False, RNG.normal(size=3), RNG.normal(size=3))
CLOSED = Polyline(RNG.normal(size=(6, 3)), closed=True)
ALL = [OPEN, HELD, CLOSED]
SQUARE = [[0, 0], [1, 0], [1, 1], [0, 1]]


def values_of(arc: Polyline) -> dict[str, np.ndarray]:
    """Everything an arc tells of its vertices and edges."""
    names = ("edge_vectors", "edge_lengths", "cell_lengths", "arc_lengths", "centre_arc_lengths")
    names += ("centres", "tangents", "turning_angles", "binormals", "dihedral_angles")
    out = {name: getattr(arc, name) for name in (*names, "vertex_tangents")}
    for measure in ("log", "chord", "cayley"):
        out[f"curvature {measure}"] = arc.curvature(measure)
        out[f"curvature binormals {measure}"] = arc.curvature_binormals(measure)
        out[f"torsion {measure}"] = arc.torsion(measure)
    out["sauer"] = arc.torsion("sauer")
    out["vertex frames"] = arc.vertex_frenet_frames()
    out["frenet"], out["bishop"] = arc.frenet().frames, arc.bishop().frames
    return out


# What it is ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("arc", ALL, ids=["open", "held", "closed"])
def test_one_value_per_vertex_or_edge(arc: Polyline) -> None:
    n, vertices = arc.edges, len(arc.positions)
    assert (n, vertices) == ((6, 6) if arc.closed else (5, 6))
    per_edge = ("edge_", "centre", "tangents", "dihedral", "torsion", "sauer", "frenet", "bishop")
    for name, values in values_of(arc).items():
        assert len(values) == (n if name.startswith(per_edge) else vertices), name
        assert np.isfinite(values).all(), name


@pytest.mark.parametrize("arc", ALL, ids=["open", "held", "closed"])
def test_lengths_and_directions_by_hand(arc: Polyline) -> None:
    r = arc.positions
    ends = np.vstack([r, r[:1]]) if arc.closed else r
    edges = np.diff(ends, axis=0)
    h = np.linalg.norm(edges, axis=1)
    s = np.append(0, np.cumsum(h))
    cells = (h + np.roll(h, 1)) / 2 if arc.closed else np.diff([0, *(s[1:] + s[:-1]) / 2, s[-1]])
    expected = {
        "edge_vectors": edges,
        "edge_lengths": h,
        "tangents": edges / h[:, None],
        "centres": (ends[1:] + ends[:-1]) / 2,
        "cell_lengths": cells,
        "arc_lengths": s[: len(r)],
        "centre_arc_lengths": (s[1:] + s[:-1]) / 2,
    }
    for name, values in expected.items():
        np.testing.assert_allclose(getattr(arc, name), values, rtol=0, atol=2e-15, err_msg=name)
    assert arc.length == pytest.approx(h.sum(), rel=1e-15)


@pytest.mark.parametrize("arc", ALL, ids=["open", "held", "closed"])
def test_angles_by_hand(arc: Polyline) -> None:
    """Independently: angles of dot products, axes of cross products."""
    t = arc.tangents
    if arc.closed:
        before, behind = np.roll(t, 1, axis=0), t
    else:
        start, end = arc.start_tangent, arc.end_tangent
        before = np.vstack([t[0] if start is None else unit(start), t])
        behind = np.vstack([t, t[-1] if end is None else unit(end)])
    theta = np.arccos(np.clip(np.sum(before * behind, axis=1), -1, 1))
    np.testing.assert_allclose(arc.turning_angles, theta, rtol=0, atol=3e-8)  # arccos at 1
    bent = slice(1, -1) if arc is OPEN else slice(None)
    np.testing.assert_allclose(arc.turning_angles[bent], theta[bent], rtol=0, atol=4e-15)
    np.testing.assert_allclose(
        arc.binormals[bent], unit(np.cross(before, behind)[bent]), rtol=0, atol=4e-15
    )
    np.testing.assert_allclose(arc.vertex_tangents, unit(before + behind), rtol=0, atol=4e-15)
    b = np.vstack([arc.binormals, arc.binormals[:1]]) if arc.closed else arc.binormals
    cosine, triple = np.sum(b[1:] * b[:-1], axis=1), np.sum(t * np.cross(b[:-1], b[1:]), axis=1)
    np.testing.assert_allclose(np.cos(arc.dihedral_angles), cosine, rtol=0, atol=4e-15)
    np.testing.assert_allclose(np.sin(arc.dihedral_angles), triple, rtol=0, atol=4e-15)


def test_two_columns_lists_and_other_types_are_taken() -> None:
    flat = Polyline(SQUARE, closed=True)
    assert flat == Polyline([[*p, 0] for p in SQUARE], closed=True)
    assert flat == Polyline(np.array(SQUARE, dtype=np.float32), closed=1)
    assert flat == Polyline(np.asfortranarray(np.array(SQUARE)), closed=True)
    np.testing.assert_allclose(flat.turning_angles, np.pi / 2, rtol=1e-16)


def test_arrays_are_copies_that_cannot_be_written() -> None:
    given = OPEN.positions.copy()
    arc = Polyline(given, start_tangent=[0, 0, 2])
    given[:] = 0
    np.testing.assert_array_equal(arc.positions, OPEN.positions)
    names = ("positions", "start_tangent", "edge_lengths", "cell_lengths", "arc_lengths")
    for name in (*names, "tangents", "turning_angles", "binormals", "dihedral_angles"):
        with pytest.raises(ValueError, match="read-only"):
            getattr(arc, name)[0] = 1.0
    with pytest.raises(AttributeError):
        arc.closed = True


def test_repr_says_what_it_is() -> None:
    assert repr(Polyline(SQUARE)) == "Polyline(open, edges=3, length=3)"
    assert repr(Polyline(SQUARE, closed=True)) == "Polyline(closed, edges=4, length=4)"


@pytest.mark.parametrize("arc", ALL, ids=["open", "held", "closed"])
def test_pickles_are_equal_and_tell_the_same(arc: Polyline) -> None:
    back = pickle.loads(pickle.dumps(arc))
    assert back == arc
    for name, values in values_of(arc).items():
        np.testing.assert_array_equal(values_of(back)[name], values, err_msg=name)
    with pytest.raises(ValueError, match="read-only"):
        back.positions[0] = 1.0


def test_equality_looks_at_everything_given() -> None:
    r = OPEN.positions
    arcs = [OPEN, HELD, Polyline(r, True), Polyline(r, straight=0.1), Polyline(r + 1)]
    arcs += [Polyline(r, start_tangent=[0, 0, 1]), Polyline(r, end_tangent=[0, 0, 1])]
    for i, a in enumerate(arcs):
        assert [a == b for b in arcs] == [i == j for j in range(len(arcs))]
    assert OPEN != "OPEN"
    with pytest.raises(TypeError, match="unhashable"):
        hash(OPEN)


# Measures, ends, averages -------------------------------------------------------------------------


@pytest.mark.parametrize("arc", ALL, ids=["open", "held", "closed"])
def test_measures_of_one_angle(arc: Polyline) -> None:
    theta, alpha = arc.turning_angles, arc.dihedral_angles
    cells, edges = arc.cell_lengths, arc.edge_lengths
    for measure, size in {
        "log": lambda x: x,
        "chord": lambda x: 2 * np.sin(x / 2),
        "cayley": lambda x: 2 * np.tan(x / 2),
    }.items():
        np.testing.assert_allclose(arc.curvature(measure), size(theta) / cells, rtol=4e-16)
        np.testing.assert_allclose(arc.torsion(measure), size(alpha) / edges, rtol=4e-16)
        np.testing.assert_array_equal(
            arc.curvature_binormals(measure), arc.curvature(measure)[:, None] * arc.binormals
        )
    np.testing.assert_array_equal(arc.torsion("sauer"), np.sin(alpha) / edges)


def twisted_by(alpha: float) -> Polyline:
    """Three edges of length 1 across each other, the last turned about the one in the middle."""
    end = [np.cos(alpha), np.sin(alpha), 1.0]
    return Polyline([[1.0, 0, 0], [0, 0, 0], [0, 0, 1], end])


def test_torsion_grows_up_to_half_a_turn_and_sauers_does_not() -> None:
    """Beyond a right angle Sauer's falls: it takes 179 degrees for 1 (Linn A.4.2)."""
    alpha = np.radians(np.arange(-179.0, 181.0))
    arcs = [twisted_by(a) for a in alpha]
    for measure in ("log", "chord", "cayley"):
        assert (np.diff([arc.torsion(measure)[1] for arc in arcs]) > 0).all(), measure
    log, sauer = (np.array([a.torsion(m)[1] for a in arcs]) for m in ("log", "sauer"))
    np.testing.assert_allclose(log, alpha, rtol=0, atol=1e-15)
    np.testing.assert_allclose(sauer, np.sin(alpha), rtol=0, atol=1e-15)
    np.testing.assert_allclose(sauer[-2], sauer[np.abs(alpha - np.radians(1)) < 1e-9], rtol=1e-14)


def test_a_held_end_turns_over_half_its_edge() -> None:
    arc = Polyline([[0, 0, 0], [0, 0, 2], [0, 0, 5]], False, [0, 0.3, 0.4], [3, 0, 4])
    angle = np.arctan2([3, 0, 3], [4, 1, 4])
    np.testing.assert_allclose(arc.turning_angles, angle, rtol=1e-15)
    np.testing.assert_allclose(arc.curvature(), angle / [1.0, 2.5, 1.5], rtol=1e-15)
    np.testing.assert_allclose(arc.binormals[[0, -1]], [[1, 0, 0], [0, 1, 0]], rtol=0, atol=1e-16)
    free = Polyline(arc.positions)
    np.testing.assert_array_equal(free.curvature(), [0, 0, 0])


def test_derivative_by_a_parameter() -> None:
    """Differences over differences; with the parameter as arc length its length is near 1."""
    t = np.array([0.0, 0.5, 0.6, 2.0])
    arc = Polyline(np.column_stack([t, t**2, 3 - t]))
    middle = (t[1:] + t[:-1]) / 2
    expected = np.column_stack([np.ones(3), 2 * middle, -np.ones(3)])  # exact for parabolas
    np.testing.assert_allclose(arc.derivative(t), expected, rtol=0, atol=4e-15)
    loop = UNKNOT.polyline(UNKNOT.even(512))
    speed = np.linalg.norm(loop.derivative(UNKNOT.arc_lengths(UNKNOT.even(512))), axis=1)
    assert 1 - 1e-3 < speed.min() < speed.max() < 1  # a chord is shorter than its arc


@pytest.mark.parametrize("arc", ALL, ids=["open", "held", "closed"])
def test_averages(arc: Polyline) -> None:
    rng = np.random.default_rng(1)
    at_vertices = rng.normal(size=(len(arc.positions), 2, 3))
    after = np.roll(at_vertices, -1, axis=0)[: arc.edges]
    np.testing.assert_array_equal(
        arc.at_centres(at_vertices), (at_vertices[: arc.edges] + after) / 2
    )
    np.testing.assert_array_equal(
        arc.at_centres(at_vertices)[:, 1, 2], arc.at_centres(at_vertices[:, 1, 2])
    )
    c, h = rng.normal(size=arc.edges), arc.edge_lengths
    x = arc.at_vertices(c)
    between = (c[:-1] * h[1:] + c[1:] * h[:-1]) / (h[1:] + h[:-1])  # the nearer counts more
    np.testing.assert_allclose(x[1 : arc.edges], between, rtol=0, atol=1e-15)
    if arc.closed:
        seam = (c[-1] * h[0] + c[0] * h[-1]) / (h[0] + h[-1])
        np.testing.assert_allclose(x[0], seam, rtol=0, atol=1e-15)
    else:
        line = arc.at_vertices(3 - 2 * arc.centre_arc_lengths)  # continued to the ends
        np.testing.assert_allclose(line, 3 - 2 * arc.arc_lengths, rtol=0, atol=2e-14)


def test_averages_of_few_edges() -> None:
    arc = Polyline([[0, 0, 0], [0, 0, 1], [0, 0, 4]])
    line = arc.at_vertices(3 - 2 * arc.centre_arc_lengths)
    np.testing.assert_allclose(line, [3, 1, -5], rtol=0, atol=1e-15)
    arc = Polyline([[0, 0, 0], [0, 0, 1]])
    np.testing.assert_array_equal(arc.at_vertices([4.0]), [4, 4])
    np.testing.assert_array_equal(arc.at_centres([4.0, 5.0]), [4.5])


def test_the_nearest_edges_of_two_arcs() -> None:
    low = Polyline([[0, 0, 0], [1, 0, 0], [2, 0, 0]])
    high = Polyline([[1.6, -1, 0.25], [1.6, 1, 0.25], [1.6, 2, 0.25], [3, 2, 0.25]])
    assert low.approach(high) == Approach(0.25, 1, 0)
    assert high.approach(low) == Approach(0.25, 0, 1)
    assert low.self_approach() == Approach(np.inf, -1, -1)
    hairpin = Polyline([[0, 0], [4, 0], [4.5, 0.25], [4, 0.5], [0, 0.5]])
    assert hairpin.self_approach() == Approach(0.5, 0, 3)
    assert differences(hairpin.self_approach(threads=2), hairpin.self_approach(threads=1)) == 0
