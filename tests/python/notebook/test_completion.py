"""What completion shows."""

from __future__ import annotations

from support import FLAT, SOFT, solved

import pyrod
from pyrod import Clamp, Force, Rod, Scene


def hidden(names: list[str]) -> list[str]:
    return [name for name in names if name[0] == "_" and name[:2] != "__"]


def test_completion_shows_what_exists_before_it_is_made() -> None:
    result = solved(Rod.straight(1.0, 4, SOFT), Force((1, 0, 0)))
    names = dir(result)
    assert hidden(names) == hidden(dir(result.rods[0])) == hidden(dir(result.scene)) == []
    assert {"positions", "K", "tip", "record", "reactions", "plot"} <= set(names)
    fields = {*pyrod.Equilibrium.__dataclass_fields__, *pyrod.RodEquilibrium.__dataclass_fields__}
    assert fields - {"rod"} <= set(names)
    for name in fields & set(names):
        getattr(result, name)


def test_completion_shows_nothing_that_is_ambiguous(joined_rods: pyrod.Equilibrium) -> None:
    names = dir(joined_rods)
    assert "rods" in names
    assert "positions" not in names
    assert not hasattr(joined_rods, "positions")


def test_columns_of_a_sweep_are_completed() -> None:
    scene = Scene(Rod.straight(1.0, 4, FLAT), Clamp(), Force((1.0, 0, 0)))
    swept = pyrod.sweep(scene, {"loads.0.force.0": [1.0]}, progress=False)
    names = swept._ipython_key_completions_()
    assert {"loads.0.force.0", "energy", "tip", "time", "error"} <= set(names)
    for name in names:
        assert len(swept[name]) == 1
    assert hidden(dir(swept)) == []
