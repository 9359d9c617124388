"""Scenes as documents: what is written is read as the same, to the last bit."""

from __future__ import annotations

import json
import tomllib
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from scenes_of_all_kinds import document, scenes
from support import ROUND, SOFT

import pyrod
from pyrod import Clamp, DistributedForce, Force, Rod, Scene
from pyrod.document import read, write
from pyrod.document.files import json_text
from pyrod.document.toml import dumps

# Round trips --------------------------------------------------------------------------------------


def assert_same(a: Scene, b: Scene) -> None:
    """Also in what equality does not compare."""
    assert a == b
    for one, other in zip(a.rods, b.rods, strict=True):
        assert all(map(np.array_equal, one.placement, other.placement))
        assert one._law.outlines(one.edge_lengths) == other._law.outlines(other.edge_lengths)
        assert one.refined(1) == other.refined(1)
        assert one._compiled.kept == other._compiled.kept
        first, second = (rod._compiled.jumps for rod in (one, other))
        assert first[0] == second[0]
        assert np.array_equal(first[1], second[1])


def check_both_ways(scene: Scene) -> None:
    plain = write(scene)
    assert_same(read(plain), scene)
    assert write(read(plain)) == plain
    assert_same(read(tomllib.loads(dumps(plain))), scene)
    assert_same(read(json.loads(json_text(plain))), scene)


@settings(max_examples=25, suppress_health_check=list(HealthCheck))
@given(scenes())
def test_what_is_written_is_read_as_the_same(scene: Scene) -> None:
    check_both_ways(scene)


@pytest.mark.long
@settings(max_examples=300, suppress_health_check=list(HealthCheck))
@given(scenes())
def test_many_that_are_written_are_read_as_the_same(scene: Scene) -> None:
    check_both_ways(scene)


@pytest.mark.parametrize("space", ["planar", "spatial"])
def test_the_space_is_kept(space: str) -> None:
    scene = Scene(Rod.straight(1.0, 4, ROUND), Clamp(), space=space)
    assert write(scene).get("space", "spatial") == space
    assert read(write(scene)) == scene


def test_functions_become_their_values_as_in_a_pickle() -> None:
    rod = Rod.precurved(1.0, 4, lambda s: SOFT, lambda s: (0, s, 0))
    scene = Scene(rod, Clamp(), DistributedForce(lambda s: (s, 0, 0)))
    back = read(write(scene))
    assert back.rod == rod
    assert back.loads[0].force_per_length[:, 0].tolist() == [0.125, 0.375, 0.625, 0.875]


def test_outlines_that_change_along_a_rod_are_kept() -> None:
    steel = pyrod.Material(200e9)
    rod = Rod.straight(1.0, 4, lambda s: pyrod.Section.circle(1.0 + s, steel))
    back = read(write(Scene(rod, Clamp()))).rod
    for s in (0.0, 0.3, 1.0):
        assert back.outline(s).radius == pytest.approx(1 + s, rel=1e-8)


def test_the_solver_still_chooses_the_edges() -> None:
    """And what is written is as short as what a user would write."""
    scene = Scene(Rod.straight(1.0, None, ROUND), Clamp(), Force((1, 0, 0), at=0.3))
    (rod,) = write(scene)["rods"]
    assert {**rod, "vertices": [0.3]} == rod
    assert not {"edges", "grid"} & set(rod)
    assert read(write(scene)).rods[0]._compiled.kept is not None


def test_equal_sections_are_written_once() -> None:
    rods = [Rod.straight(1.0, 2, s).placed((i, 0, 0)) for i, s in enumerate((SOFT, ROUND, SOFT))]
    plain = write(Scene(rods, [Clamp(at=(i, "start")) for i in range(3)]))
    assert len(plain["sections"]) == 2
    assert plain["rods"][0]["section"] == plain["rods"][2]["section"]


def test_what_no_file_can_hold_is_refused() -> None:
    class Own(pyrod.Hinge):
        pass

    scene = Scene(Rod.straight(1.0, 2, ROUND), [Clamp(), Own(at="end")])
    with pytest.raises(TypeError, match="Own cannot be written"):
        write(scene)


# What the keys mean -------------------------------------------------------------------------------


def rod(**keys: Any) -> Rod:
    """The rod of a table."""
    return read(document(rods=[{"section": "wire", **keys}])).rod


def test_a_section_by_shape_and_material_is_that_of_the_class() -> None:
    steel = pyrod.Material(200e9, density=7850)
    for shape, made in (
        ({"circle": {"radius": 0.01}}, pyrod.Section.circle(0.01, steel)),
        (
            {"tube": {"outer_radius": 0.02, "inner_radius": 0.01}},
            pyrod.Section.tube(0.02, 0.01, steel),
        ),
        (
            {"rectangle": {"width": 0.01, "height": "3 cm"}},
            pyrod.Section.rectangle(0.01, 0.03, steel),
        ),
    ):
        scene = read(document(sections={"wire": {**shape, "material": "steel"}}))
        assert scene.rod == Rod.straight(1.0, 8, made)
        assert scene.rod.outline("start") == made.outline


def test_a_section_by_stiffnesses_may_have_the_look_of_a_polygon() -> None:
    points = [[0, 0], [0.1, 0], [0, "100 mm"]]
    section = {"EI1": 1, "EI2": 2.0, "GJ": "3 N m^2", "polygon": {"points": points}}
    scene = read(document(sections={"wire": section}))
    assert scene.rod.bending[0].tolist() == [1, 2, 3]
    assert scene.rod.outline("end") == pyrod.Outline.polygon([(0, 0), (0.1, 0), (0, 0.1)])


def test_rods_by_curvature_places_and_vertices() -> None:
    made = rod(length=1, edges=4, curvature=[0, "90 deg/m", 0], vertices=[0.3])
    assert made.edges == 5
    np.testing.assert_allclose(made.K0[:, 1], np.pi / 2)
    placed = rod(length=1, edges=4, position=[1, 2, 3], tangent=[1, 0, 0], normal=[0, 0, 1])
    r, _ = placed.at_rest()
    np.testing.assert_allclose(r[-1], [2, 2, 3], atol=1e-15)
    turned = rod(length=1, edges=4, frame=[[1, 0, 0], [0, -1, 0], [0, 0, -1]])
    np.testing.assert_allclose(turned.at_rest()[0][-1], [0, 0, -1], atol=1e-15)
    assert rod(length=1)._compiled.kept == []
    assert rod(length=1, vertices=[0.25])._compiled.kept == [0.25]
    assert rod(edge_lengths=[0.1, "20 cm"], model="inextensible").model == "inextensible"
    assert rod(length=1, edges=2, section=["wire", "wire"]).edges == 2


def test_rods_by_a_curve() -> None:
    arc = np.array([[np.sin(x), 0, 1 - np.cos(x)] for x in np.linspace(0, 1, 6)])
    bent = rod(positions=arc.tolist(), normal=[0, 0, 1])
    np.testing.assert_allclose(bent.at_rest()[0], arc, atol=1e-15)
    # a1 turns with the curve inwards, so the rod bends about a2
    np.testing.assert_allclose(bent.K0[1:-1], [[0, 1, 0]] * 4, atol=1e-2)
    framed = rod(positions=[[0, 0, 0], [0, 0, 1]], frames=[[0, 0, 0, 1]])
    np.testing.assert_allclose(framed.placement[1], [0, 0, 0, 1])


def test_places_by_name_and_number() -> None:
    two = [
        {"name": name, "length": 1, "edges": 4, "section": "wire", "position": [x, 0, 0]}
        for name, x in (("a", 0), ("b", 1))
    ]
    places = ["start", {"rod": "b", "s": "end"}]
    supports = [{"kind": "clamp", "at": at} for at in places]
    loads = [
        {"kind": "force", "force": [1, 0, 0], "at": {"rod": 0, "s": "500 mm"}},
        {"kind": "distributed_force", "force_per_length": [0, 0, 1], "rod": "b"},
        {"kind": "moment", "moment": [1, 0, 0], "at": 0.25},
    ]
    scene = read(document(rods=two, supports=supports, loads=loads))
    assert [support.at for support in scene.supports] == ["start", (1, "end")]
    assert [scene.loads[0].at, scene.loads[1].rod, scene.loads[2].at] == [(0, 0.5), 1, 0.25]
