"""Documents that are refused: with the key, what is wrong and what would be right."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scenes_of_all_kinds import WIRE, document
from support import ROUND

import pyrod
from pyrod import Clamp, Rod, Scene
from pyrod.document import read, write


def problems(document: dict[str, Any]) -> list[tuple[str, str]]:
    """Keys and texts of what is wrong."""
    with pytest.raises(pyrod.SceneFileError) as caught:
        read(document)
    return [(problem.key, problem.what) for problem in caught.value.problems]


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
