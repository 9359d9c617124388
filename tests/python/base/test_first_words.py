"""What is mistaken first: refused with what would be right."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from arguments import ARC, E3, FRAMED, HELD, NO_TURN, PLACES, ROD, SOFT, assert_matches, refused

import pyrod
from pyrod import Rod, Scene, Section, curve, rotation


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (
            lambda: pyrod.Force(0, 0, -2),
            r"force: expected 3 numbers in one tuple or array, as in \(",
        ),
        (lambda: pyrod.Moment(1), "moment: expected 3 numbers in one tuple"),
        (lambda: Rod(1.0), r"make one with Rod.straight\(length, edges, section\)"),
        (lambda: pyrod.solve(ROD), r"scene: expected a Scene, got a Rod; hold it: Scene\(rod, Cl"),
        (lambda: pyrod.solve([HELD]), "scene: expected a Scene, got a list; .*solve_many"),
        (lambda: pyrod.solve_many(HELD), "scenes: expected several.*solve"),
        (lambda: pyrod.critical_load(ROD), "scene: expected a Scene, got a Rod"),
        (lambda: pyrod.smallest_model(ROD, 1e-3), "scene: expected a Scene, got a Rod"),
        (lambda: pyrod.is_planar(ROD), "scene: expected a Scene, got a Rod"),
        (lambda: Scene(ROD, pyrod.Force(E3), pyrod.Clamp()), "a Force belongs to loads: Scene"),
        (lambda: Scene(ROD, pyrod.Clamp(), pyrod.Hinge()), "a Hinge belongs to supports"),
        (lambda: Scene(pyrod.Clamp(), ROD), "rods: cannot use a Clamp; .* belongs to supports"),
        (
            lambda: Scene(ROD, pyrod.Clamp(), (), pyrod.Joint(("start", "end"))),
            "space: .*a Joint belongs to joints: Scene",
        ),
        (lambda: Scene(ROD, 3), "supports: cannot use a int"),
        (lambda: Section.circle(1.0, 200e9), r"material: expected a Material, as Material\(E="),
        (lambda: Rod.straight(1.0, 4, 3.0), "section: expected a Section, got a float"),
        (lambda: Section(np.eye(3), 1, 1), r"EI1: expected a number, got .* shape \(3, 3\)"),
        (lambda: Rod.straight("1 m", 4, SOFT), "length: .*give the number in SI units"),
        (lambda: pyrod.Options(3), "Options: give them by keyword"),
        (lambda: pyrod.Options(max_edges=1.5), "max_edges: expected a whole number, got 1.5"),
        (lambda: rotation.multiply(np.ones((2, 4)), np.ones((3, 4))), "a, b: as many of one"),
        (lambda: FRAMED.angles_from(ARC), "other: expected a FramedCurve, got a Polyline"),
        (lambda: curve.strains([1], PLACES[:2], NO_TURN[:1], measure=3), "measure: .*got 3"),
    ],
)
def test_first_words(call: Callable[[], Any], words: str) -> None:
    assert_matches(words, refused(lambda _: call(), None))


def test_color_by() -> None:
    result = pyrod.solve(HELD)
    assert "colour_by" in refused(lambda x: result.plot(color_by=x), "K")
