"""Supports: what they refuse, what they are if nothing is said, and places on a rod.

What they do is in test_beams.py.
"""

from __future__ import annotations

import copy
import pickle
from math import inf, nan
from typing import Any

import numpy as np
import pytest
from support import (
    FLAT,
    SOFT,
    X,
    Y,
    Z,
    about_y,
    angle_between,
    differences,
    pin,
)

from pyrod import (
    Clamp,
    Force,
    Hinge,
    Pivot,
    Rod,
    Scene,
    Sleeve,
    Slider,
    Spring,
    solve,
)

ROD = Rod.straight(1.0, 8, FLAT)
CURVED = Rod.precurved(1.0, 12, SOFT, (0.4, -0.8, 1.1)).placed((1, 2, 3), tangent=(1, 2, 2))


# Arguments ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Clamp(turns=0.5), "turns: must be a whole number, got 0.5; fractions are the fr"),
        (lambda: Clamp(turns=nan), "turns: must be a whole number, got nan"),
        (lambda: Clamp(turns=inf), "turns: must be a whole number, got inf"),
        (lambda: Clamp(turns=-(2**40)), "turns: must be at most 1e.06, got -1099511627776"),
        (lambda: Clamp(at=(0, 1, 2)), r"at: expected \(number of the rod, place\), got \(0, 1, 2"),
        (lambda: Clamp(at=(-1, "end")), r"at: expected \(number of the rod, place\)"),
        (lambda: Clamp(at=(0.5, "end")), r"at: expected \(number of the rod, place\)"),
        (lambda: Clamp(at=(0, (0, "end"))), r"at: expected \(number of the rod, place\)"),
        (lambda: Clamp(at=None), "at: expected 'start', 'end' or an arc length, got None"),
        (lambda: Clamp(at=1j), "at: expected 'start', 'end' or an arc length, got 1j"),
        (lambda: Hinge((1, 2)), "position: expected 3 numbers"),
        (lambda: Slider(), "along: give either it or the normal of a plane"),
        (lambda: Slider(X, normal=Y), "along: give either it or the normal of a plane"),
        (lambda: Slider((0, 0, 0)), "along: expected a direction, got the zero vector"),
        (lambda: Slider(normal=(0, 0, 0)), "normal: expected a direction, got the zero vector"),
        (lambda: Slider(X, frame=(1, 1, 0, 0)), "frame: expected a unit quaternion"),
        (lambda: Sleeve(normal=X), "normal: needs a tangent, too"),
        (lambda: Pivot((0, 0, 0)), "axis: expected a direction, got the zero vector"),
        (lambda: Pivot((0, nan, 0)), "axis: expected finite numbers"),
        (lambda: Spring(-1.0), "stiffness: must be finite and not negative, got -1.0"),
        (lambda: Spring(inf), "stiffness: must be finite and not negative, got inf"),
        (lambda: Spring(1.0, nan), "torsion: must be finite and not negative, got nan"),
    ],
)
def test_arguments_are_refused(make: Any, message: str) -> None:
    with pytest.raises(ValueError, match=f"^{message}"):
        make()


MADE = {
    "clamp": lambda: Clamp((0, 1, 2), tangent=X, at=0.25, turns=2),
    "hinge": lambda: Hinge((0, 1, 2), at=(1, "end")),
    "slider": lambda: Slider((1, 1, 0), frame=about_y(0.3)),
    "slider in a plane": lambda: Slider(normal=(0, 3, 4), clamped=True),
    "sleeve": lambda: Sleeve(at=0.5),
    "pivot": lambda: Pivot((0, 0, 2), along=(1, 0, 0)),
    "spring": lambda: Spring(3.0, 4.0, (1, 0, 0)),
}


@pytest.mark.parametrize("name", MADE)
def test_supports_are_values(name: str) -> None:
    support, same = MADE[name](), MADE[name]()
    assert support == same == pickle.loads(pickle.dumps(support)) == copy.deepcopy(support)
    assert support != Clamp()
    assert type(support).__name__ in repr(support)
    assert all(support != MADE[other]() for other in MADE if other != name)
    with pytest.raises(AttributeError):
        support.at = "start"


@pytest.mark.parametrize("name", MADE)
def test_a_scene_on_supports_survives_pickling(name: str) -> None:
    rods = [ROD, ROD.placed((5, 0, 0))]
    scene = Scene(rods, [MADE[name](), Clamp(at=(0, 0.75)), Clamp(at=(1, "start"))])
    again = pickle.loads(pickle.dumps(scene))
    assert again == scene
    assert repr(again) == repr(scene)


def test_directions_are_made_unit() -> None:
    assert np.array_equal(Slider((0, 3e200, 4e200)).along, [0, 0.6, 0.8])
    assert np.array_equal(Pivot((0, 0, 1e-300)).axis, Z)


def test_a_scene_tells_what_holds_it() -> None:
    scene = Scene(ROD, [pin("start"), Spring(1.0, at=0.5), Spring(1.0)], Force(X))
    assert "Pivot, 2 Springs, Force" in repr(scene)


# Defaults -----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "others",
    [
        [Clamp(at="end")],
        [Hinge(at="end")],
        [Slider(Z)],
        [Slider(normal=X, clamped=True)],
        [Sleeve(at="end")],
        [Pivot(X, at="end")],
        [Spring(5.0, 3.0)],
        [Clamp(at=0.3), Sleeve(at=0.61), Hinge(at="end")],
    ],
    ids=lambda others: "-".join(type(s).__name__ for s in others),
)
def test_a_rod_held_where_it_is_at_rest_stays_there(others: Any) -> None:
    scene = Scene(CURVED, [Clamp(), *others])
    result = solve(scene)
    assert differences(result.positions, scene.rod.at_rest()[0]) < 1e-12
    assert angle_between(result.frames, scene.rod.at_rest()[1]).max() < 1e-9
    assert result.energy < 1e-18
    assert max(np.abs(r.force).max() for r in result.reactions) < 1e-9


@pytest.mark.parametrize("s", [0.3, 0.5, 1 / 3, 1e-3, 1 - 1e-3])
def test_a_clip_in_mid_rod_gets_a_vertex(s: float) -> None:
    scene = Scene(Rod.straight(1.0, 7, FLAT), [Clamp(at=s)], Force(X))
    assert scene.rod.edges == 8
    assert np.isclose(scene.rod.arc_lengths, s, rtol=0, atol=1e-15).sum() == 1
    result = solve(scene)
    vertex = int(np.abs(result.s - s).argmin())
    assert np.allclose(result.positions[vertex], [0, 0, s], rtol=0, atol=1e-15)
    assert np.abs(result.moment[:vertex]).max(initial=0) < 1e-14  # nothing acts before the clip


def test_a_clip_on_a_vertex_needs_none() -> None:
    assert Scene(ROD, [Clamp(at=0.5)]).rod.edges == 8
    assert Scene(ROD, [Clamp(at=0.5 + 1e-13)]).rod.edges == 8


def test_a_new_vertex_bends_as_its_neighbours_do() -> None:
    """Compliances and rest curvatures are linear between vertices; what was there stays."""
    C = np.array([[1.0, 2.0, 3.0], [3.0, 6.0, 1.0], [2.0, 2.0, 2.0]])
    K0 = np.array([[0.1, 0.2, 0.0], [0.3, 0.4, 0.2], [0.5, 0.0, 0.0]])
    rod = Rod([0.4, 0.6], C, [[7.0, 8.0, 9.0], [4.0, 5.0, 6.0]], K0, "cosserat")
    cut = rod.with_vertices([0.1, 0.4, 1.0])
    assert np.allclose(cut.edge_lengths, [0.1, 0.3, 0.6], rtol=1e-15)
    assert np.allclose(cut.bending, [C[0], [1.2, 2.4, 2.0], C[1], C[2]], rtol=1e-15)
    assert np.allclose(cut.K0, [K0[0], [0.15, 0.25, 0.05], K0[1], K0[2]], rtol=1e-15)
    assert np.array_equal(cut.stretching, rod.stretching[[0, 0, 1]])
    assert cut == cut.with_vertices(0.1)
