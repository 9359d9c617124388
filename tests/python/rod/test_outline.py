"""Outlines of cross-sections: areas, loops, triangles that fill them, and what is refused."""

from __future__ import annotations

import pickle
from itertools import pairwise
from math import inf, pi, sin

import numpy as np
import pytest

from pyrod import Material, Outline, Section
from pyrod.rod.polygons import signed_area, triangles

STEEL = Material(E=200e9, density=7850.0)
SQUARE = [(0, 0), (4, 0), (4, 4), (0, 4)]
I_BEAM = [(0, 0), (3, 0), (3, 1), (2, 1), (2, 2), (3, 2), (3, 3), (0, 3), (0, 2), (1, 2), (1, 1)]
I_BEAM = [*I_BEAM, (0, 1)]  # pairs of its sides lie on one line without meeting
COMB = [(0, 0), (9, 0), *((9 - i, 5 - 4 * (i % 2)) for i in range(10))]
NOTCHED = [(0, 0), (10, 0), (10, 10), (5.1, 10), (5, 1), (4.9, 10), (3, 10), (4.5, 8), (2, 10)]
NOTCHED = [*NOTCHED, (0, 10)]  # the notch is between the nearest corners of outline and hole
OUTLINES = {
    "circle": Outline.circle(0.5),
    "tube": Outline.tube(2.0, 1.0),
    "rectangle": Outline.rectangle(3.0, 1.0),
    "beam": Outline.polygon(I_BEAM),
    "comb": Outline.polygon(COMB),
    "midpoints": Outline.polygon([(0, 0), (1, 0), (2, 0), (2, 1), (2, 2), (1, 2), (0, 2), (0, 1)]),
    "slanted": Outline.polygon([(0, 0), (5, 4), (6, 5.5), (1, 1.2)]),
    "pierced": Outline.polygon(SQUARE, hole=[(1, 1), (2, 1), (2, 3)]),
    "notched": Outline.polygon(NOTCHED, hole=[(5.6, 8), (6.5, 7.5), (6.5, 8.5)]),
    "pierced beam": Outline.polygon(I_BEAM, hole=[(1.4, 0.2), (1.6, 0.2), (1.6, 2.8), (1.4, 2.8)]),
}
each = pytest.mark.parametrize("outline", OUTLINES.values(), ids=OUTLINES)


def corners(outline: Outline) -> np.ndarray:
    return np.vstack(outline.loops())


# What they know -----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "area"),
    [
        ("circle", pi / 4),
        ("tube", 3 * pi),
        ("rectangle", 3.0),
        ("beam", 7.0),
        ("pierced", 15.0),
        ("pierced beam", 7 - 0.52),
    ],
)
def test_areas(name: str, area: float) -> None:
    assert OUTLINES[name].area == pytest.approx(area, rel=1e-15)


@pytest.mark.parametrize("sides", [3, 6, 40])
def test_a_circle_becomes_a_regular_polygon_on_it(sides: int) -> None:
    (loop,) = Outline.circle(2.0).loops(sides)
    assert loop.shape == (sides, 2)
    np.testing.assert_allclose(np.linalg.norm(loop, axis=1), 2.0, rtol=1e-15)
    assert signed_area(loop) == pytest.approx(2 * sides * sin(2 * pi / sides), rel=1e-14)


def test_the_loops_of_a_tube_have_its_radii() -> None:
    outer, inner = Outline.tube(2.0, 1.5).loops()
    np.testing.assert_allclose(np.linalg.norm(outer, axis=1), 2.0, rtol=1e-15)
    np.testing.assert_allclose(np.linalg.norm(inner, axis=1), 1.5, rtol=1e-15)


def test_a_rectangle_is_wide_along_a1() -> None:
    (loop,) = Outline.rectangle(3.0, 1.0).loops()
    np.testing.assert_array_equal(np.ptp(loop, axis=0), [3.0, 1.0])
    np.testing.assert_array_equal(loop.mean(axis=0), [0.0, 0.0])


@each
def test_outer_loops_go_round_counter_clockwise_and_holes_the_other_way(outline: Outline) -> None:
    senses = [np.sign(signed_area(loop)) for loop in outline.loops()]
    assert senses == [1, -1][: len(senses)]


def test_polygons_keep_their_corners_in_either_sense() -> None:
    assert Outline.polygon(SQUARE[::-1]).area == 16.0
    np.testing.assert_array_equal(Outline.polygon(SQUARE).loops()[0], SQUARE)
    np.testing.assert_array_equal(Outline.polygon(SQUARE[::-1]).loops()[0], SQUARE)
    hole = [(1, 1), (2, 1), (2, 3)]
    outline = Outline.polygon(SQUARE, hole)
    np.testing.assert_array_equal(outline.loops()[1], hole[::-1])
    assert Outline.polygon(SQUARE, hole[::-1]) == outline


@pytest.mark.parametrize(("name", "size"), [("circle", 1.0), ("tube", 4.0), ("beam", 3.0)])
def test_size_is_the_larger_extent(name: str, size: float) -> None:
    assert OUTLINES[name].size == pytest.approx(size, rel=1e-15)


@each
def test_outlines_are_values(outline: Outline) -> None:
    assert pickle.loads(pickle.dumps(outline)) == outline
    assert hash(pickle.loads(pickle.dumps(outline))) == hash(outline)
    assert sum(outline == other for other in OUTLINES.values()) == 1


@each
def test_outlines_as_dictionaries_and_back(outline: Outline) -> None:
    assert Outline.from_dict(outline.to_dict()) == outline


def test_the_dictionaries_hold_plain_numbers() -> None:
    assert Outline.circle(1).to_dict() == {"circle": {"radius": 1.0}}
    expected = {"tube": {"outer_radius": 2.0, "inner_radius": 1.0}}
    assert Outline.tube(2, 1).to_dict() == expected
    assert Outline.rectangle(np.float64(2), 1).to_dict() == {
        "rectangle": {"width": 2.0, "height": 1.0}
    }
    pierced = OUTLINES["pierced"].to_dict()["polygon"]
    assert pierced == {
        "points": [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]],
        "hole": [[1.0, 1.0], [2.0, 1.0], [2.0, 3.0]],
    }
    assert list(OUTLINES["beam"].to_dict()["polygon"]) == ["points"]


def test_reprs() -> None:
    assert eval(repr(Outline.tube(2, 1))) == Outline.tube(2, 1)
    assert repr(OUTLINES["beam"]) == "Outline.polygon(12 corners)"
    assert repr(OUTLINES["pierced"]) == "Outline.polygon(4 corners, hole of 3)"


def test_between_two_outlines() -> None:
    assert Outline.circle(1).towards(Outline.circle(3), 0.25) == Outline.circle(1.5)
    wide, high = Outline.rectangle(2, 1), Outline.rectangle(1, 2)
    assert wide.towards(high, 0.5) == Outline.rectangle(1.5, 1.5)
    small = Outline.polygon(SQUARE, [(1, 1), (2, 1), (2, 3)])
    large = Outline.polygon(2 * np.array(SQUARE), 2 * np.array([(1, 1), (2, 1), (2, 3)]))
    assert small.towards(large, 0.5).area == pytest.approx(1.5**2 * 15, rel=1e-15)
    beam = OUTLINES["beam"]
    for far in (wide, small):
        assert beam.towards(far, 0.4) is beam
        assert beam.towards(far, 0.6) is far


# Triangles ----------------------------------------------------------------------------------------


@each
def test_triangles_fill_the_outline(outline: Outline) -> None:
    """Each is positive and they add up to the area; each side of a loop is in one of them, and all
    others are shared by two."""
    loops = outline.loops(12)
    found, points = triangles(loops), np.vstack(loops)
    areas = np.array([signed_area(points[t]) for t in found])
    assert (areas > 0).all()
    assert areas.sum() == pytest.approx(sum(map(signed_area, loops)), rel=1e-13)
    edges = [tuple(e) for a, b, c in found.tolist() for e in ((a, b), (b, c), (c, a))]
    assert len(set(edges)) == len(edges)
    first = np.cumsum([0, *map(len, loops)])
    sides = {
        (a, b)
        for start, end in pairwise(first.tolist())
        for a, b in zip(range(start, end), [*range(start + 1, end), start], strict=True)
    }
    assert {e for e in edges if e[::-1] not in edges} == sides


# What is refused ----------------------------------------------------------------------------------


@pytest.mark.parametrize("bad", [0.0, -1.0, inf, float("nan")])
def test_sizes_must_be_positive(bad: float) -> None:
    for name, make in (
        ("radius", lambda: Outline.circle(bad)),
        ("outer_radius", lambda: Outline.tube(bad, 1.0)),
        ("width", lambda: Outline.rectangle(bad, 1.0)),
        ("height", lambda: Outline.rectangle(1.0, bad)),
    ):
        with pytest.raises(ValueError, match=f"^{name}: must be positive and finite, got {bad}"):
            make()


def test_tubes_must_have_a_wall() -> None:
    with pytest.raises(ValueError, match="inner_radius: must be less than outer_radius=1"):
        Outline.tube(1.0, 1.0)
    with pytest.raises(ValueError, match="inner_radius: must be positive"):
        Outline.tube(1.0, -0.5)
    assert Outline.tube(1.0, 0.0) == Outline.circle(1.0)


@pytest.mark.parametrize(
    ("points", "message"),
    [
        ([(0, 0), (1, 0)], "at least 3"),
        ([(0, 0, 0), (1, 0, 0), (0, 1, 0)], r"\(k, 2\)"),
        ([1, 2, 3], r"\(k, 2\)"),
        ([(0, 0), (1, 0), (inf, 1)], "finite"),
        ([(0, 0), (1, 1), (2, 2)], "no area"),
        ([(0, 0), (2, 0), (0, 1), (3, 2)], "cross or touch"),
        ([(0, 0), (2, 0), (2, 2), (1, 0), (0, 2)], "cross or touch"),
        ([(0, 0), (1, 0), (1, 1), (0, 0)], "each once"),
    ],
)
def test_polygons_must_be_simple(points: object, message: str) -> None:
    with pytest.raises(ValueError, match=f"^points: .*{message}"):
        Outline.polygon(points)
    with pytest.raises(ValueError, match=f"^hole: .*{message}"):
        Outline.polygon([(-9, -9), (9, -9), (9, 9), (-9, 9)], hole=points)


@pytest.mark.parametrize(
    "hole",
    [
        [(1, 1), (5, 1), (1, 2)],  # reaches out
        [(5, 5), (6, 5), (5, 6)],  # beside it
        [(0, 1), (1, 1), (1, 2)],  # touches
        [(-1, -1), (9, -1), (9, 9), (-1, 9)],  # around it
    ],
)
def test_holes_must_be_inside(hole: object) -> None:
    with pytest.raises(ValueError, match="hole: must be inside"):
        Outline.polygon(SQUARE, hole)


def test_circles_need_three_sides() -> None:
    with pytest.raises(ValueError, match="sides: must be at least 3, got 2"):
        Outline.circle(1.0).loops(2)


@pytest.mark.parametrize(
    "document", [{}, {"blob": {}}, {"circle": {"radius": 1}, "tube": {}}, {"loops": {}}]
)
def test_dictionaries_of_no_outline(document: dict) -> None:
    with pytest.raises(ValueError, match="outline: expected one of circle, polygon"):
        Outline.from_dict(document)


def test_dictionaries_with_other_numbers() -> None:
    with pytest.raises(TypeError, match="diameter"):
        Outline.from_dict({"circle": {"diameter": 1.0}})


# Sections -----------------------------------------------------------------------------------------


def test_sections_made_from_dimensions_have_their_outline() -> None:
    assert Section.circle(0.1, STEEL).outline == Outline.circle(0.1)
    assert Section.tube(0.2, 0.1, STEEL).outline == Outline.tube(0.2, 0.1)
    assert Section.rectangle(0.2, 0.1, STEEL).outline == Outline.rectangle(0.2, 0.1)
    assert Section(1, 1, 1).outline is None


def test_masses_are_those_of_the_outlines() -> None:
    assert Section.tube(0.2, 0.1, STEEL).mass_per_length == pytest.approx(
        7850 * pi * 0.03, rel=1e-15
    )


def test_sections_of_other_outlines_are_others() -> None:
    a = Section(1, 1, 1, outline=Outline.circle(0.1))
    assert a == Section(1, 1, 1, outline=Outline.circle(0.1))
    assert a != Section(1, 1, 1, outline=Outline.circle(0.2))
    assert a != Section(1, 1, 1)


def test_sections_refuse_what_is_no_outline() -> None:
    with pytest.raises(TypeError, match="outline: expected an Outline or None, got a float"):
        Section(1, 1, 1, outline=0.1)  # type: ignore[arg-type]
