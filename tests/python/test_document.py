"""Scenes as documents: what is written is read as the same, to the last bit; what is refused."""

from __future__ import annotations

import json
import tomllib
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from scenes_of_all_kinds import scenes
from support import ROUND, SOFT

import pyrod
from pyrod import Clamp, DistributedForce, Force, Rod, Scene
from pyrod._document import read, write
from pyrod._document.files import json_text
from pyrod._document.toml import dumps

STEEL = {"E": "200 GPa", "density": "7850 kg/m^3"}
WIRE = {"circle": {"radius": "1 mm"}, "material": "steel"}


def document(**changes: Any) -> dict[str, Any]:
    """A clamped wire, with other keys on top."""
    return {
        "materials": {"steel": STEEL},
        "sections": {"wire": WIRE},
        "rods": [{"name": "wire", "length": "1 m", "edges": 8, "section": "wire"}],
        "supports": [{"kind": "clamp"}],
        **changes,
    }


def problems(document: dict[str, Any]) -> list[tuple[str, str]]:
    """Keys and texts of what is wrong."""
    with pytest.raises(pyrod.SceneFileError) as caught:
        read(document)
    return [(problem.key, problem.what) for problem in caught.value.problems]


# Round trips --------------------------------------------------------------------------------------


def assert_same(a: Scene, b: Scene) -> None:
    """Also in what equality does not compare."""
    assert a == b
    for one, other in zip(a.rods, b.rods, strict=True):
        assert all(map(np.array_equal, one.placement, other.placement))
        assert one._law.outlines(one.edge_lengths) == other._law.outlines(other.edge_lengths)
        assert one._refined(1) == other._refined(1)
        assert one._breaks == other._breaks
        first, second = (rod._made and rod._made.jumps for rod in (one, other))
        if first is not None and first[0]:
            assert first[0] == second[0]
            assert np.array_equal(first[1], second[1])


@settings(max_examples=60, suppress_health_check=list(HealthCheck))
@given(scenes())
def test_what_is_written_is_read_as_the_same(scene: Scene) -> None:
    plain = write(scene)
    assert_same(read(plain), scene)
    assert write(read(plain)) == plain
    assert_same(read(tomllib.loads(dumps(plain))), scene)
    assert_same(read(json.loads(json_text(plain))), scene)


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
    assert read(write(scene))._chooses_edges


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
    assert rod(length=1)._breaks == ()
    assert rod(length=1, vertices=[0.25])._breaks == (0.25,)
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


# What is refused ----------------------------------------------------------------------------------

GOOD_ROD = {"length": 1, "edges": 4, "section": "wire"}
ARRAYS = write(
    Scene(Rod.from_curve(np.outer(range(3), (0, 0, 1)), [[1, 0, 0, 0]] * 2, ROUND), Clamp())
)["rods"][0]
LONG = "9" * 90 + " m"

REFUSED: list[tuple[dict[str, Any], str, str]] = [
    # keys
    ({"rodds": []}, "rodds", 'no key "rodds": did you mean "rods"'),
    ({"rods": [{**GOOD_ROD, "zzz": 1}]}, "rods[0].zzz", "there is name, section"),
    ({"materials": {"steel": {}}}, "materials.steel", '"E" is missing: pressure [Pa]'),
    ({"sections": {"wire": {"circle": {}, "material": "steel"}}}, "sections.wire.circle", "radius"),
    ({"supports": [{}]}, "supports[0]", '"kind" is missing: one of clamp'),
    ({"supports": [{"kind": "clam"}]}, "supports[0].kind", 'did you mean "clamp"'),
    ({"loads": [{"kind": "force"}]}, "loads[0]", '"force" is missing'),
    # types
    ({"rods": {}}, "rods", "expected a list"),
    ({"rods": [1]}, "rods[0]", "expected a table of a rod, got 1"),
    ({"materials": [1]}, "materials", "expected tables by name"),
    ({"supports": [1]}, "supports[0]", "expected a table of a support"),
    ({"title": 1}, "title", "expected text, got 1"),
    ({"rods": [{**GOOD_ROD, "edges": 4.5}]}, "rods[0].edges", "expected whole number, got 4.5"),
    ({"rods": [{**GOOD_ROD, "edges": True}]}, "rods[0].edges", "expected whole number, got True"),
    ({"rods": [{**GOOD_ROD, "edges": 0}]}, "rods[0].edges", "at least 1"),
    ({"rods": [{**GOOD_ROD, "edges": 10**9}]}, "rods[0].edges", "at most 1000000"),
    ({"rods": [{**GOOD_ROD, "length": True}]}, "rods[0].length", "expected a length [m]"),
    ({"rods": [{**GOOD_ROD, "length": float("nan")}]}, "rods[0].length", "nan"),
    ({"rods": [{**GOOD_ROD, "length": 10**400}]}, "rods[0].length", "too large"),
    ({"rods": [{**GOOD_ROD, "length": {"a": 1}}]}, "rods[0].length", "a table with a"),
    ({"rods": [{**GOOD_ROD, "model": "cossrat"}]}, "rods[0].model", 'did you mean "cosserat"'),
    ({"rods": [{**GOOD_ROD, "model": 1}]}, "rods[0].model", 'expected "cosserat" or'),
    ({"rods": [{**GOOD_ROD, "curvature": [0, 1]}]}, "rods[0].curvature", "got shape (2,)"),
    ({"rods": [{**GOOD_ROD, "curvature": [[1], 0]}]}, "rods[0].curvature", "different lengths"),
    ({"rods": [{**GOOD_ROD, "curvature": [[[1]]]}]}, "rods[0].curvature[0][0]", "got [1]"),
    ({"rods": [{**GOOD_ROD, "section": 3}]}, "rods[0].section", "expected the name of one"),
    ({"rods": [{**GOOD_ROD, "section": ["wire", "wir"]}]}, "rods[0].section[1]", '"wire"'),
    # units
    ({"rods": [{**GOOD_ROD, "length": "1 kg"}]}, "rods[0].length", '"kg" is a unit of mass'),
    ({"rods": [{**GOOD_ROD, "length": "1 A"}]}, "rods[0].length", "a unit of [current]"),
    ({"rods": [{**GOOD_ROD, "length": "1 rad"}]}, "rods[0].length", "is a pure number"),
    ({"rods": [{**GOOD_ROD, "length": "1 mmm"}]}, "rods[0].length", 'unknown unit "mmm"'),
    ({"rods": [{**GOOD_ROD, "length": "1"}]}, "rods[0].length", 'such as "2 mm" or a number in m'),
    ({"rods": [{**GOOD_ROD, "length": "9**9**9 m"}]}, "rods[0].length", "expected a length"),
    ({"rods": [{**GOOD_ROD, "length": "1 m**99"}]}, "rods[0].length", "expected a length"),
    ({"rods": [{**GOOD_ROD, "length": LONG}]}, "rods[0].length", "expected a length"),
    ({"rods": [{**GOOD_ROD, "length": "1e999 m"}]}, "rods[0].length", "too large"),
    ({"rods": [{**GOOD_ROD, "tangent": ["1", 0, 0]}]}, "rods[0].tangent[0]", "without quotes"),
    ({"rods": [{**GOOD_ROD, "tangent": ["1 deg", 0, 0]}]}, "rods[0].tangent[0]", "without quotes"),
    # names and places
    ({"sections": {"wire": {**WIRE, "material": "s"}}}, "sections.wire.material", "there is steel"),
    (
        {"rods": [GOOD_ROD, {**GOOD_ROD, "name": "a"}, {**GOOD_ROD, "name": "a"}]},
        "rods[2].name",
        "too",
    ),
    ({"supports": [{"kind": "clamp", "at": 2}]}, "supports[0].at", "[0, 1], got 2"),
    ({"supports": [{"kind": "clamp", "at": "ende"}]}, "supports[0].at", '"start", "end"'),
    ({"supports": [{"kind": "clamp", "at": [1]}]}, "supports[0].at", '"start", "end"'),
    ({"supports": [{"kind": "clamp", "at": "3 kg"}]}, "supports[0].at", "mass"),
    (
        {"supports": [{"kind": "clamp", "at": {"rod": 0}}]},
        "supports[0].at",
        "{ rod = ..., s = ... }",
    ),
    ({"supports": [{"kind": "clamp", "at": {"rod": 1, "s": 0}}]}, "supports[0].at.rod", "no rod 1"),
    ({"supports": [{"kind": "clamp", "at": {"rod": "x", "s": 0}}]}, "supports[0].at.rod", '"x"'),
    ({"supports": [{"kind": "clamp", "at": {"rod": 0.5, "s": 0}}]}, "supports[0].at.rod", "0.5"),
    # what goes together
    ({"rods": []}, "rods", "expected at least 1"),
    ({"rods": [{"section": "wire"}]}, "rods[0]", '"length" is missing'),
    ({"rods": [{"length": 1}]}, "rods[0]", '"section" is missing'),
    ({"rods": [{**GOOD_ROD, "K0": [[0, 0, 0]]}]}, "rods[0].K0", 'does not go with "length"'),
    ({"rods": [{**GOOD_ROD, "vertices": [0], "grid": [1]}]}, "rods[0].grid", "does not go with"),
    ({"rods": [{**GOOD_ROD, "edge_lengths": [1]}]}, "rods[0].edges", 'with "edge_lengths"'),
    (
        {
            "rods": [
                {
                    "positions": [[0, 0, 0], [0, 0, 1]],
                    "frames": [[1, 0, 0, 0]],
                    "normal": [1, 0, 0],
                    "section": "wire",
                }
            ]
        },
        "rods[0].normal",
        "either it or frames",
    ),
    ({"sections": {"wire": {"material": "steel"}}}, "sections.wire", "a material needs a shape"),
    ({"sections": {"wire": {**WIRE, "EI1": 1}}}, "sections.wire.EI1", "from which it follows"),
    ({"sections": {"wire": {"EI1": 1, "EI2": 1}}}, "sections.wire", '"GJ" is missing'),
    (
        {"sections": {"wire": {**WIRE, "rectangle": {"width": 1, "height": 1}}}},
        "sections.wire.rectangle",
        "one shape",
    ),
    # what the classes refuse
    ({"materials": {"steel": {"E": -1}}}, "materials.steel.E", "must be positive"),
    ({"rods": [{**GOOD_ROD, "length": "-1 m"}]}, "rods[0].length", "must be positive"),
    ({"rods": [{**GOOD_ROD, "vertices": [2]}]}, "rods[0].vertices", "expected arc lengths in"),
    ({"rods": [{"length": 1, "section": "wire", "grid": [1, 1]}]}, "rods[0].grid", "1 together"),
    (
        {"rods": [{"length": 1, "section": "wire", "curvature": [1e9, 0, 0]}]},
        "rods[0].curvature",
        "more than 1e+06",
    ),
    (
        {
            "rods": [
                {**ARRAYS, "jumps": [{"vertex": 9, "bending": [[1] * 3] * 2, "K0": [[0] * 3] * 2}]}
            ]
        },
        "rods[0].jumps",
        "[9]",
    ),
    ({"rods": [{**ARRAYS, "outlines": [[{}, {}]]}]}, "rods[0].outlines", "expected 2 pairs"),
    ({"rods": [{**ARRAYS, "outlines": [1]}]}, "rods[0].outlines[0]", "expected a list"),
    ({"supports": []}, "supports", "nothing holds the rod"),
    ({"joints": [{"points": ["start"]}]}, "joints[0].points", "at least 2"),
    ({"solve": {"tol": 0.5}}, "solve.tol", "(0, 0.1]"),
    ({"solve": {"model": "auto"}}, "solve.model", 'needs "tol"'),
]


@pytest.mark.parametrize(
    ("changes", "key", "what"), REFUSED, ids=[f"{i} {key}" for i, (_, key, _) in enumerate(REFUSED)]
)
def test_what_is_refused_is_told_with_its_key(changes: dict[str, Any], key: str, what: str) -> None:
    found = problems(document(**changes))
    assert any(key == k and what in text for k, text in found), found


def test_all_problems_are_told_at_once() -> None:
    found = problems({"rods": [{"length": "1 kg", "section": "x"}], "sections": {"s": {"EI1": 1}}})
    assert [key for key, _ in found] == [
        "rods[0].length",
        "rods[0].section",
        "sections.s",
        "sections.s",
    ]
    many = problems(document(**{f"key{i}": 1 for i in range(30)}))
    assert len(many) == 30
    with pytest.raises(pyrod.SceneFileError, match=r"30 problems(.|\n)*and 10 more"):
        read(document(**{f"key{i}": 1 for i in range(30)}))


def test_a_list_without_rods_in_a_document_is_enough_to_say_so() -> None:
    assert problems({}) == [("", '"rods" is missing: list, each a table of a rod')]
