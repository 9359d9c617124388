"""The swept solid: closed, outward, of the right volume, joined to a ring where rods close."""

from __future__ import annotations

from dataclasses import replace
from math import pi, sin
from typing import Any

import numpy as np
import pytest
import trimesh
from support import orders

import pyrod
from pyrod import Clamp, Force, Joint, Material, Outline, Rod, Scene, Section
from pyrod.pictures.swept import Swept, swept
from pyrod.rotation import exp, multiply, rotate

RUBBER = Material(E=1e6)
TUBE = Section.tube(0.04, 0.03, RUBBER)
FLAT = Section.rectangle(0.02, 0.06, RUBBER)
BEAM = [(0, 0), (3, 0), (3, 1), (2, 1), (2, 2), (3, 2), (3, 3), (0, 3), (0, 2), (1, 2), (1, 1)]
PROFILE = Outline.polygon(0.02 * np.array([*BEAM, (0, 1)]))
PIERCED = Outline.polygon(
    0.1 * np.array([(0, 0), (1, 0), (0, 1)]),
    [(0.02, 0.02), (0.04, 0.02), (0.04, 0.04), (0.02, 0.04)],
)
OUTLINES = {
    "tube": TUBE.outline,
    "flat": FLAT.outline,
    "beam": PROFILE,
    "pierced": PIERCED,
    "circle": Outline.circle(0.05),
}


def chorded(sides: int) -> float:
    """Area of the regular polygon in the unit circle over that of the circle."""
    return sides * sin(2 * pi / sides) / (2 * pi)


def solid(mesh: Swept) -> trimesh.Trimesh:
    return trimesh.Trimesh(mesh.points, mesh.triangles, process=False)


def bent(section: Any, edges: int = 8) -> pyrod.Equilibrium:
    scene = Scene(Rod.straight(2.0, edges, section), Clamp(), Force((10.0, 4.0, 0.0)))
    return pyrod.solve(scene)


def ring(section: Any, edges: int, turn: float = 0.0) -> pyrod.Equilibrium:
    """A circle of radius 1 at rest, whose frames turn about its tangent on the way round."""
    angle = 2 * pi * np.arange(edges + 1) / edges
    positions = np.column_stack([np.sin(angle), np.zeros(edges + 1), np.cos(angle)])
    middle = (angle[1:] + angle[:-1]) / 2
    frames = multiply(
        exp(np.outer(middle + pi / 2, (0, 1, 0))),
        exp(np.outer(middle / (2 * pi) * turn, (0, 0, 1))),
    )
    rod = Rod.from_curve(positions, frames, section)
    return pyrod.solve(Scene(rod, Clamp(), joints=Joint(((0, "start"), (0, "end")))))


@pytest.mark.parametrize("name", OUTLINES)
def test_a_straight_rod_has_the_area_times_the_length(name: str) -> None:
    outline = OUTLINES[name]
    scene = Scene(Rod.straight(2.0, 5, Section(1, 2, 3, outline=outline)), Clamp((1, 2, 3)))
    mesh = solid(swept(pyrod.solve(scene), 10))
    assert mesh.is_watertight
    assert mesh.is_winding_consistent
    curved = name in ("tube", "circle")
    expected = 2 * outline.area * (chorded(10) if curved else 1)
    assert mesh.volume == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("name", OUTLINES)
def test_bent_rods_are_closed_and_outward(name: str) -> None:
    mesh = solid(swept(bent(Section(1, 2, 3, outline=OUTLINES[name]))))
    assert mesh.is_watertight
    assert mesh.is_winding_consistent
    assert mesh.volume > 0
    assert mesh.euler_number == (0 if name in ("tube", "pierced") else 2)


def test_points_lie_in_the_frames_of_their_vertices() -> None:
    result = bent(FLAT)
    mesh = swept(result)
    a1, a2 = (rotate(result.vertex_frames, axis)[mesh.vertex] for axis in ((1, 0, 0), (0, 1, 0)))
    away = mesh.points - result.positions[mesh.vertex]
    np.testing.assert_allclose(np.abs((away * a1).sum(axis=1)), 0.01, rtol=1e-12)
    np.testing.assert_allclose(np.abs((away * a2).sum(axis=1)), 0.03, rtol=1e-12)
    assert not mesh.rod.any()


def test_sides_face_away_from_the_centreline() -> None:
    result = bent(Section.circle(0.05, RUBBER))
    mesh = swept(result)
    corners = mesh.points[mesh.quads]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 3] - corners[:, 0])
    from_axis = corners.mean(axis=1) - result.positions[mesh.vertex[mesh.quads]].mean(axis=1)
    assert ((normals * from_axis).sum(axis=1) > 0).all()


@pytest.mark.parametrize("section", [Section.circle(0.05, RUBBER), TUBE, FLAT])
def test_a_ring_has_no_caps_and_the_volume_of_pappus(section: Section) -> None:
    errors = []
    for edges in (16, 32, 64):
        mesh = swept(ring(section, edges), 48)
        assert not len(mesh.caps)
        made = solid(mesh)
        assert made.is_watertight
        assert made.is_winding_consistent
        assert made.euler_number == 0
        area = section.outline.area * (1 if section is FLAT else chorded(48))
        errors.append(made.volume / (2 * pi * area) - 1)
    assert abs(errors[0]) < 0.03
    np.testing.assert_allclose(orders(errors), 2, atol=0.02)


def test_a_ring_has_points_for_all_vertices_but_the_last() -> None:
    mesh = swept(ring(FLAT, 12))
    np.testing.assert_array_equal(np.unique(mesh.vertex, return_counts=True), [range(12), [4] * 12])


@pytest.mark.parametrize("half_turns", [1, 2])
def test_a_moebius_band_is_joined_turned(half_turns: int) -> None:
    """Half a turn brings a rectangle onto itself."""
    result = ring(FLAT, 120, turn=half_turns * pi)
    mesh = swept(result)
    assert not len(mesh.caps)
    assert solid(mesh).is_watertight
    seam = mesh.quads[np.isin(mesh.quads, np.arange(4)).any(axis=1)]
    lengths = np.linalg.norm(mesh.points[seam[:, 0]] - mesh.points[seam[:, 3]], axis=1)
    assert lengths.max() < 0.06  # no side goes across


def test_frames_that_do_not_meet_keep_their_caps() -> None:
    mesh = swept(ring(FLAT, 40, turn=pi / 4))
    assert len(mesh.caps) == 4
    assert solid(mesh).is_watertight
    round_one = swept(ring(TUBE, 40, turn=pi / 4))
    assert not len(round_one.caps)
    assert solid(round_one).is_watertight


def test_where_outlines_jump_closed_pieces_meet() -> None:
    thin, thick = Section.circle(0.02, RUBBER), Section.circle(0.05, RUBBER)
    scene = Scene(Rod.straight(2.0, 4, [thin, thin, thick, FLAT]), Clamp())
    mesh = solid(swept(pyrod.solve(scene), 20))
    assert mesh.is_watertight
    assert mesh.body_count == 3
    expected = (chorded(20) * pi * (2 * 0.02**2 + 0.05**2) + 0.02 * 0.06) / 2
    assert mesh.volume == pytest.approx(expected, rel=1e-12)


def test_a_taper_is_one_piece() -> None:
    def section(s: float) -> Section:
        return Section.rectangle(0.02 * (1 + s), 0.02 * (1 + s), RUBBER)

    mesh = solid(swept(pyrod.solve(Scene(Rod.straight(1.0, 6, section), Clamp()))))
    assert mesh.body_count == 1
    slabs = [(1 + i / 6, 1 + (i + 1) / 6) for i in range(6)]
    frustum = sum(4e-4 * (a * a + a * b + b * b) / 3 / 6 for a, b in slabs)
    assert mesh.volume == pytest.approx(frustum, rel=1e-7)


def test_rods_of_a_net_are_told_apart() -> None:
    rods = [Rod.straight(1.0, 4, TUBE), Rod.straight(1.0, 6, FLAT).placed((0, 0, 1))]
    scene = Scene(rods, Clamp(), joints=Joint(((0, "end"), (1, "start"))))
    result = pyrod.solve(scene)
    mesh = swept(result, 12)
    assert solid(mesh).body_count == 2
    np.testing.assert_array_equal(np.unique(mesh.rod, return_counts=True), [[0, 1], [120, 28]])
    z = np.concatenate([rod.positions[:, 2] for rod in result.rods])
    np.testing.assert_allclose(mesh.points[:, 2], z[5 * mesh.rod + mesh.vertex], atol=1e-12)


@pytest.fixture(scope="module")
def net() -> pyrod.Equilibrium:
    section = [FLAT, FLAT, TUBE, TUBE]
    rods = [Rod.straight(1.0, 4, section), Rod.straight(3.0, 6, FLAT).placed((0, 0, 1))]
    return pyrod.solve(Scene(rods, Clamp(), joints=Joint(((0, "end"), (1, "start")))))


def test_values_at_points_are_those_of_their_vertices(net: pyrod.Equilibrium) -> None:
    mesh = swept(net)
    s = mesh.at_points([rod.s for rod in net.rods])
    np.testing.assert_allclose(s + mesh.rod, mesh.points[:, 2], atol=1e-12)
    frames = mesh.at_points([rod.vertex_frames for rod in net.rods])
    assert frames.shape == (len(mesh.points), 4)


def test_values_on_faces_are_those_of_their_edges(net: pyrod.Equilibrium) -> None:
    mesh = swept(net)
    low, high = (
        mesh.on_faces([rod.positions[i : len(rod.s) - 1 + i, 2] for rod in net.rods])
        for i in (0, 1)
    )
    z = [mesh.points[faces, 2] for faces in (mesh.quads, mesh.caps)]
    least = np.concatenate([of.min(axis=1) for of in z])
    largest = np.concatenate([of.max(axis=1) for of in z])
    flat = least == largest
    np.testing.assert_allclose(low[~flat], least[~flat], atol=1e-12)
    np.testing.assert_allclose(high[~flat], largest[~flat], atol=1e-12)
    at_an_end = np.isclose(least[flat], low[flat]) | np.isclose(least[flat], high[flat])
    assert at_an_end.all()
    assert flat.sum() == len(mesh.caps) > 0


def test_a_single_edge() -> None:
    mesh = solid(swept(pyrod.solve(Scene(Rod.straight(1.0, 1, FLAT), Clamp()))))
    assert mesh.volume == pytest.approx(0.02 * 0.06, rel=1e-12)


def test_two_sides_are_refused() -> None:
    with pytest.raises(ValueError, match="sides: must be at least 3, got 2"):
        swept(bent(FLAT), 2)


def test_made_up_outlines_are_swept() -> None:
    plain = replace(FLAT, outline=None)
    mesh = solid(swept(pyrod.solve(Scene(Rod.straight(2.0, 3, plain), Clamp()))))
    assert mesh.volume == pytest.approx(2 * 0.04 * 0.04 / 3, rel=1e-12)
