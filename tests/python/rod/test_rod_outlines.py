"""The outlines along rods: constant, per edge, by a function; cut, refined, pickled, made up."""

from __future__ import annotations

import pickle
from dataclasses import replace
from math import sqrt

import numpy as np
import pytest

import pyrod
from pyrod import Material, Outline, Rod, Section
from pyrod.rod.outlines import outlines

RUBBER = Material(E=1e6)
ROUND = Section.circle(0.01, RUBBER)
THIN, THICK = Section.circle(0.01, RUBBER), Section.rectangle(0.03, 0.02, RUBBER)


def radius(s: float) -> float:
    return 0.02 - 0.01 * s


def tapered(s: float) -> Section:
    return Section.circle(radius(s), RUBBER)


def stepped(s: float) -> Section:
    return THIN if s < 0.5 else THICK


def radii(rod: Rod) -> np.ndarray:
    return np.array([[a.radius, b.radius] for a, b in outlines(rod)])


def test_one_section_for_all() -> None:
    rod = Rod.straight(1.0, 5, ROUND)
    assert outlines(rod) == ((ROUND.outline, ROUND.outline),) * 5
    assert rod.outline(0.3) == rod.outline("start") == rod.outline("end") == Outline.circle(0.01)


def test_a_section_per_edge() -> None:
    rod = Rod.straight(1.0, 2, [THIN, THICK])
    assert outlines(rod) == ((THIN.outline,) * 2, (THICK.outline,) * 2)
    assert rod.outline(0.4999) == THIN.outline
    assert rod.outline(0.5) == THICK.outline  # just behind the jump


def test_sections_per_edge_stay_where_they_are_when_edges_are_cut() -> None:
    rod = Rod.straight(1.0, 2, [THIN, THICK])
    for finer in (rod.with_vertices([0.25, 0.9]), rod.refined(2)):
        assert finer.edges > 2
        assert finer.outline(0.4999) == THIN.outline
        assert finer.outline(0.5) == THICK.outline


@pytest.mark.parametrize("edges", [3, None])
def test_a_function_of_arc_length(edges: int | None) -> None:
    rod = Rod.straight(1.0, edges, tapered)
    s = rod.arc_lengths
    exact = np.column_stack([radius(s[:-1]), radius(s[1:])])
    np.testing.assert_allclose(radii(rod), exact, rtol=1e-8)
    assert rod.outline(0.7).radius == pytest.approx(radius(0.7), rel=1e-8)
    finer = rod.with_vertices([0.1])
    np.testing.assert_allclose(radii(finer)[0], [0.02, radius(finer.arc_lengths[1])], rtol=1e-8)


def test_a_function_that_jumps_is_asked_on_both_sides() -> None:
    rod = Rod.straight(1.0, 4, stepped)
    assert outlines(rod) == (((THIN.outline,) * 2,) * 2 + ((THICK.outline,) * 2,) * 2)


def test_rods_made_from_curves_have_their_outline() -> None:
    positions = np.column_stack([np.zeros((3, 2)), [0.0, 1.0, 3.0]])
    frames = np.tile([1.0, 0, 0, 0], (2, 1))
    rod = Rod.from_curve(positions, frames, [THIN, THICK])
    for one in (rod, rod.placed((1, 2, 3)), rod.with_vertices(2.0), rod.refined(1)):
        assert one.outline(0.9) == THIN.outline
        assert one.outline(1.5) == THICK.outline
    assert pickle.loads(pickle.dumps(rod)).outline(1.5) == THICK.outline
    assert Rod.from_curve(positions, frames, ROUND).outline("end") == ROUND.outline


@pytest.mark.parametrize("section", [ROUND, [THIN, THICK] * 2, stepped])
def test_pickles_keep_outlines(section: object) -> None:
    rod = Rod.straight(1.0, 4, section)
    assert outlines(pickle.loads(pickle.dumps(rod))) == outlines(rod)


def test_local_functions_become_tables_of_outlines() -> None:
    rod = Rod.straight(1.0, 4, lambda s: tapered(s))
    again = pickle.loads(pickle.dumps(rod))
    assert not callable(getattr(again._law, "section", None))
    assert outlines(again) == outlines(rod)
    assert again.refined(1).outline(0.375).radius == pytest.approx(radius(0.375), rel=1e-8)
    s = np.linspace(0, 1, 9)
    halves = np.column_stack([radius(s[:-1]), radius(s[1:])])
    np.testing.assert_allclose(radii(again.refined(1)), halves, rtol=1e-8)


def test_tables_between_kinds_of_outlines_take_the_nearer() -> None:
    def odd(s: float) -> Section:
        return THIN if s < 0.1 else THICK

    again = pickle.loads(pickle.dumps(Rod.straight(1.0, 2, odd)))
    assert again.outline(0.24) == THIN.outline
    assert again.outline(0.26) == THICK.outline


def test_other_stiffnesses_leave_the_outline() -> None:
    for rod in (Rod.straight(1.0, 2, [THIN, THICK]), Rod.straight(1.0, 2, stepped)):
        changed = replace(rod, bending=2 * rod.bending)
        assert outlines(changed) == outlines(rod)
        assert outlines(replace(rod, model="inextensible")) == outlines(rod)


def test_another_length_and_stiffness_leave_no_outline() -> None:
    rod = Rod.straight(1.0, 2, ROUND)
    longer = replace(rod, edge_lengths=[1.0, 2.0], bending=2 * rod.bending)
    assert longer.outline(0.0) == Outline.rectangle(0.06, 0.06)


def test_scenes_keep_outlines() -> None:
    rod = Rod.straight(1.0, 2, [THIN, THICK])
    scene = pyrod.Scene(rod, [pyrod.Clamp(), pyrod.Hinge((0, 0, 0.3), at=0.3)])
    assert scene.rod.outline(0.2) == THIN.outline
    assert pickle.loads(pickle.dumps(scene)).rod.outline(0.8) == THICK.outline


# Made up ------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("EI1", "EI2", "width", "height"),
    [
        (1.0, 1.0, 0.04, 0.04),
        (4.0, 1.0, 0.02, 0.04),  # hard to bend about a1: tall along a2
        (1.0, 4.0, 0.04, 0.02),
        (1e9, 1.0, 0.002, 0.04),
        (1.0, 1e9, 0.04, 0.002),
    ],
)
def test_stiffnesses_alone_give_a_rectangle_of_their_ratio(
    EI1: float, EI2: float, width: float, height: float
) -> None:
    outline = Rod.straight(2.0, 3, Section(EI1, EI2, 1.0)).outline("start")
    made = outline.to_dict()["rectangle"]
    assert made == pytest.approx({"width": width, "height": height}, rel=1e-14)


def test_made_up_outlines_have_the_ratio_of_a_true_rectangle() -> None:
    true = Section.rectangle(0.3, 0.1, RUBBER)
    made = Rod.straight(1.0, 1, replace(true, outline=None)).outline(0.0)
    assert made.width / made.height == pytest.approx(3.0, rel=1e-14)


def test_where_some_sections_have_an_outline_the_others_get_one() -> None:
    rod = Rod.straight(1.0, 2, [THIN, Section(2.0, 1.0, 1.0)])
    assert rod.outline(0.2) == THIN.outline
    assert rod.outline(1.0) == Outline.rectangle(0.02 / sqrt(2.0), 0.02)


def test_tables_know_where_there_is_no_outline() -> None:
    def partly(s: float) -> Section:
        return THIN if s > 0.1 else replace(THIN, outline=None)

    finer = pickle.loads(pickle.dumps(Rod.straight(1.0, 1, partly))).refined(2)
    assert finer.outline(0.1) == Outline.rectangle(0.02, 0.02)
    assert finer.outline(0.8) == THIN.outline


@pytest.mark.parametrize("at", [-0.1, 1.1, "middle", float("nan"), (1, 0.5)])
def test_places_off_the_rod_are_refused(at: object) -> None:
    with pytest.raises(ValueError, match=r"^at: "):
        Rod.straight(1.0, 2, ROUND).outline(at)  # type: ignore[arg-type]
