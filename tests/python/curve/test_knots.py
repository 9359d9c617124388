"""Writhe, twist and link of closed curves, also counted without each other."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from support import HELIX, KNOTS, UNKNOT, VIVIANI, SmoothCurve, orders, random_frames

from pyrod import rotation
from pyrod.curve import FramedCurve, Polyline, linking_number

KNOT = KNOTS[0]


def knot(smooth: SmoothCurve, n: int = 150) -> Polyline:
    return smooth.polyline(smooth.even(n))


def circle(centre: list[float], n: int = 20) -> Polyline:
    """In the plane of x and y, counterclockwise."""
    t = 2 * np.pi * np.arange(n) / n
    return Polyline(np.column_stack([np.cos(t), np.sin(t), 0 * t]) + np.array(centre), closed=True)


# Writhe -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("smooth", KNOTS, ids=repr)
def test_writhe_twist_and_holonomy_converge(smooth: SmoothCurve) -> None:
    """At second order to the values of the smooth curve."""
    exact = smooth.data["values"]
    arcs = [knot(smooth, n) for n in (200, 400, 800)]
    found = {
        "writhe": [arc.writhe() for arc in arcs],
        "twist_frenet_frame": [arc.frenet().twist for arc in arcs],
        "bishop_holonomy_mod_2pi": [arc.holonomy() for arc in arcs],
    }
    for name, values in found.items():
        errors = np.abs(np.array(values) - exact[name])
        np.testing.assert_allclose(orders(errors), 2, rtol=0, atol=0.03, err_msg=name)
        assert errors[-1] < 1e-3


@pytest.mark.parametrize("n", [40, 61, 150])
@pytest.mark.parametrize("smooth", KNOTS, ids=repr)
def test_frenet_link_is_that_of_the_smooth_curve(smooth: SmoothCurve, n: int) -> None:
    """A whole number, so no convergence: the sum of writhe and torsion is it to rounding."""
    arc, exact = knot(smooth, n), smooth.data["values"]["self_link_frenet"]
    assert arc.frenet_link() == exact
    assert abs(arc.writhe() + arc.frenet().twist - exact) < 1e-10


@pytest.mark.parametrize("smooth", KNOTS, ids=repr)
def test_holonomy_is_the_writhe_in_turns(smooth: SmoothCurve) -> None:
    """The angle of parallel transport once around (Linn 6.2.1): exact for polygons, since frames
    that close by twisting back link with the curve; and Bishop frames miss it at the seam."""
    arc = knot(smooth, 31)
    difference = arc.holonomy() / (2 * np.pi) - arc.writhe()
    assert abs(difference - round(difference)) < 1e-12
    seam = arc.bishop().twist_angles
    np.testing.assert_allclose(seam[1:], 0, rtol=0, atol=1e-14)
    assert abs(np.remainder(seam[0] + arc.holonomy() + 1, 2 * np.pi) - 1) < 1e-12


@pytest.mark.parametrize("smooth", KNOTS, ids=repr)
def test_mirror_and_reversal(smooth: SmoothCurve) -> None:
    arc = knot(smooth, 60)
    mirrored = Polyline(arc.positions * [1, 1, -1], closed=True)
    reverse = Polyline(arc.positions[::-1], closed=True)
    assert abs(mirrored.writhe() + arc.writhe()) < 1e-13
    assert abs(reverse.writhe() - arc.writhe()) < 1e-13
    assert mirrored.frenet_link() == -arc.frenet_link()
    assert reverse.frenet_link() == arc.frenet_link()


def test_writhe_of_an_open_arc_by_hand() -> None:
    """The first and the last edge cross at a right angle. Seen from each other they fill a square
    of half-side 1 at distance 1, of solid angle 4 asin(1/2); below along e1, above along e2 is a
    left-handed crossing."""
    arc = Polyline([[-1.0, 0, 0], [1, 0, 0], [0, -1, 1], [0, 1, 1]])
    assert abs(arc.writhe() + 4 * np.arcsin(1 / 2) / (2 * np.pi)) < 1e-15


# Link ---------------------------------------------------------------------------------------------


def random_framing(arc: Polyline, seed: int) -> FramedCurve:
    """Any closed framing, with some turns more than Bishop's."""
    rng = np.random.default_rng(seed)
    start = arc.closed_ribbon(int(rng.integers(-3, 4)))
    smooth = np.cumsum(rng.uniform(-0.3, 0.3, arc.edges))
    return start.turned(smooth - np.linspace(0, smooth[-1], arc.edges))


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("smooth", KNOTS, ids=repr)
def test_link_is_twist_plus_writhe_and_counted_with_the_edge(
    smooth: SmoothCurve, seed: int
) -> None:
    ribbon = random_framing(knot(smooth), seed)
    arc = ribbon.polyline
    link = linking_number(arc, ribbon.edge(0.2 * arc.self_approach().distance))
    assert abs(ribbon.twist + arc.writhe() - link) < 1e-10
    assert ribbon.link() == link


@pytest.mark.parametrize("link", [-7, -1, 0, 1, 4])
@pytest.mark.parametrize("smooth", KNOTS, ids=repr)
def test_closed_ribbons_have_the_link_asked_for_and_an_even_twist(
    smooth: SmoothCurve, link: int
) -> None:
    ribbon = knot(smooth).closed_ribbon(link, normal=[0.3, 0.2, 1.0])
    arc = ribbon.polyline
    assert ribbon.link() == link
    edge = ribbon.edge(0.2 * arc.self_approach().distance)
    assert linking_number(arc, edge) == linking_number(edge, arc) == link
    rate = ribbon.twist_angles / arc.cell_lengths
    np.testing.assert_allclose(rate, rate[0], rtol=1e-10, atol=1e-12)
    np.testing.assert_allclose(ribbon.K[:, 2] * arc.cell_lengths, ribbon.twist_angles, atol=2e-3)
    a1 = rotation.rotate(ribbon.frames[0], [1.0, 0, 0])
    assert a1 @ [0.3, 0.2, 1.0] > 0.5


@pytest.mark.parametrize("smooth", KNOTS, ids=repr)
def test_the_frenet_ribbon_links_as_often_as_its_edge(smooth: SmoothCurve) -> None:
    ribbon = knot(smooth).frenet()
    edge = ribbon.edge(0.1 * ribbon.polyline.self_approach().distance)
    assert linking_number(ribbon.polyline, edge) == ribbon.link() == ribbon.polyline.frenet_link()


def test_the_edge_of_a_ribbon_stays_off_other_parts() -> None:
    made = knot(KNOT, 100).closed_ribbon(-4)
    gap = made.polyline.self_approach().distance
    edge = made.edge(0.49 * gap)
    assert edge.closed
    a1 = rotation.rotate(made.vertex_frames, [1.0, 0, 0])
    np.testing.assert_allclose(
        edge.positions, made.polyline.positions + 0.49 * gap * a1, rtol=1e-15
    )
    for distance in (0.51 * gap, -0.51 * gap, 0.0, np.nan):
        with pytest.raises(ValueError, match=r"distance: must be less than .*, half that of"):
            made.edge(distance)


def test_link_needs_frames_that_point_along() -> None:
    ribbon = knot(UNKNOT).closed_ribbon(1)
    tilt = rotation.exp([1e-6, 0, 0])
    tilted = FramedCurve(ribbon.polyline, rotation.multiply(ribbon.frames, tilt))
    with pytest.raises(ValueError, match=r"frames\[\d+\]: a3 is not along the edge; take adapted"):
        tilted.link()
    assert tilted.adapted().link() == 1
    opened = HELIX.polyline(HELIX.even(20))
    with pytest.raises(ValueError, match="link: only a closed polyline has one"):
        opened.bishop().link()
    with pytest.raises(ValueError, match="linking_number: only a closed polyline has one"):
        linking_number(ribbon.polyline, opened)


# Links of two curves ------------------------------------------------------------------------------


def torus_link(p: int, q: int, strand: int, n: int = 200) -> Polyline:
    """One of two parallel curves that wind p times around the axis and q times around the ring."""
    t = 2 * np.pi * np.arange(n) / n
    ring, meridian = p * t, q * t + strand * np.pi / p
    radius = 2 + np.cos(meridian)
    xy = radius * np.cos(ring), radius * np.sin(ring)
    return Polyline(np.column_stack([*xy, np.sin(meridian)]), closed=True)


@pytest.mark.parametrize(("p", "q"), [(1, 1), (1, 2), (1, -3), (2, 3), (3, -2)])
def test_torus_links(p: int, q: int) -> None:
    """Two parallel strands on a torus link p q times; here left-handed for positive p q."""
    a, b = torus_link(p, q, 0), torus_link(p, q, 1)
    assert linking_number(a, b) == linking_number(b, a) == -p * q
    assert linking_number(a, Polyline(b.positions[::-1], closed=True)) == p * q
    assert (
        linking_number(
            Polyline(a.positions * [1, 1, -1], True), Polyline(b.positions * [1, 1, -1], True)
        )
        == p * q
    )


def test_circles_link_or_do_not() -> None:
    a = circle([0, 0, 0])
    standing = Polyline(circle([0, 0, 0]).positions[:, [0, 2, 1]] + [1, 0, 0.01], closed=True)
    assert abs(linking_number(a, standing)) == 1
    assert linking_number(a, circle([0, 0, 0.3])) == 0
    assert linking_number(a, circle([5, 0, 0])) == 0


# Curves that meet ---------------------------------------------------------------------------------

MEET = r"positions: edge \d+ meets edge \d+ of the same curve.*move the curve apart"


def viviani(n: int, shift: float, seed: int) -> np.ndarray:
    """Somewhere in space; its double point is between vertices by ``shift`` of a step."""
    t = VIVIANI.even(n)[:-1] + shift * 4 * np.pi / n
    q = random_frames(np.random.default_rng(seed))
    return rotation.rotate(q, VIVIANI.derivative(t)) + 10.0 * seed


@pytest.mark.parametrize("shift", [0.0, 0.5])
@pytest.mark.parametrize("n", [16, 64, 100])
def test_vivianis_double_point_is_refused(n: int, shift: float) -> None:
    """Where vertices meet, or the centres of edges, though rounding moves them apart: it would
    decide between -1 and 1."""
    for seed in range(8):
        arc = Polyline(viviani(n, shift, seed), closed=True)
        for ask in (arc.writhe, arc.frenet_link, lambda arc=arc: arc.closed_ribbon(0)):
            with pytest.raises(ValueError, match=MEET):
                ask()
        assert np.isfinite(arc.holonomy())


@pytest.mark.parametrize("gap", [1e-11, 1e-9, 1e-6, 1e-3])
def test_writhe_changes_by_two_where_one_strand_passes_through_the_other(gap: float) -> None:
    """The sight from edge to edge is nearly a half-space, known to rounding relative to the gap."""
    for seed in range(8):
        apart = rotation.rotate(random_frames(np.random.default_rng(seed)), [gap / 2, 0, 0])
        found = []
        for side in (1, -1):
            r = viviani(64, 0.5, seed)
            r[31:33] += side * apart
            found.append(Polyline(r, closed=True).writhe())
        assert abs(found[0] - found[1] - 2) < 1e-13 / gap + 2 * gap


def test_a_vertex_on_an_edge_is_refused() -> None:
    r = np.array([[-1, 0, 0], [1, 0, 0], [1, 1, 0], [0.25, 1, 1], [0.25, 0, 0], [0, -1, 1]])
    for seed in range(8):
        turned = rotation.rotate(random_frames(np.random.default_rng(seed)), r) + seed
        with pytest.raises(ValueError, match=MEET):
            Polyline(turned).writhe()


def test_curves_that_touch_are_refused() -> None:
    a = circle([0, 0, 0])
    for b in (circle([0, 0, 0]), circle([2, 0, 0])):
        with pytest.raises(ValueError, match=r"edge \d+ meets edge \d+ of the other curve"):
            linking_number(a, b)
    assert linking_number(a, circle([2 + 1e-9, 0, 0])) == 0


# Threads ------------------------------------------------------------------------------------------


def test_numbers_of_threads_and_threads_of_python_change_no_bit() -> None:
    arc, other = knot(KNOT, 400), knot(KNOTS[1], 300)
    ask = [
        lambda threads: arc.writhe(threads),
        lambda threads: arc.self_approach(threads),
        lambda threads: arc.approach(other, threads),
        lambda threads: other.frenet_link(threads),
        lambda threads: other.writhe(threads),
    ]
    serial = [question(1) for question in ask]
    for threads in (0, 2, 5):
        assert [question(threads) for question in ask] == serial
    with ThreadPoolExecutor(2) as pool:
        for _ in range(3):
            assert list(pool.map(lambda question: question(2), ask)) == serial
