"""Strains beyond those of rubber are warned of: mostly they are wrong units."""

from __future__ import annotations

import warnings

import pytest
from arguments import assert_matches

import pyrod
from pyrod import Rod, Scene, Section


def test_a_wire_in_gigapascals_is_loud() -> None:
    wire = Rod.straight(1.0, 8, Section.circle(1e-3, pyrod.Material(E=200)))
    scene = Scene(wire, pyrod.Clamp(), pyrod.Force((0, 0, 5.86)))
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        pyrod.solve(scene)
    texts = [str(w.message) for w in told if w.category is pyrod.StrainWarning]
    assert len(texts) == 1
    assert_matches(r"edge \d is stretched to 93\d\d times its length.*units", texts[0])


@pytest.mark.parametrize(
    ("force", "words"),
    [((0, 0, 440.0), None), ((0, 0, 460.0), "stretched"), ((190.0, 0, 0), "sheared")],
)
def test_strains_beyond_those_of_rubber(force: tuple[float, ...], words: str | None) -> None:
    section = Section(1e6, 1e6, 1e6, 60.0, 60.0, 150.0)
    scene = Scene(Rod.straight(1.0, 4, section), pyrod.Clamp(), pyrod.Force(force))
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        pyrod.solve(scene)
    assert [w.category for w in told] == ([pyrod.StrainWarning] if words else [])
    assert not words or words in str(told[0].message)
