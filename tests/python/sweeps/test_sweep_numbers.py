"""Sweeps of a scene whose numbers change, which make no scenes."""

from __future__ import annotations

import numpy as np
import pytest

from pyrod import Clamp, Force, Rod, Scene, Section, solve, sweep


def test_cases_of_numbers_are_those_of_their_scenes_to_the_bit() -> None:
    def scene(force: float, height: float) -> Scene:
        rod = Rod.straight(1, 16, Section(1, 1.2, 0.7))
        return Scene(rod, Clamp((0, 0, height)), Force((force, 0.1, 0)))

    values = {"force": [1.0, 2, 3], "height": [0.0, 0.5]}
    paths = {"loads.0.force.0": values["force"], "supports.0.position.2": values["height"]}
    for start in (None, "previous"):
        made = sweep(scene, values, start=start, progress=False)
        told = sweep(scene(1, 0), paths, start=start, keep_results=True, progress=False)
        assert told["tip"] == pytest.approx(made["tip"], abs=1e-11 if start else 0)
        assert [result.scene.loads[0].acting[0] for result in told.results] == [1, 1, 2, 2, 3, 3]
    uneven = [{"loads.0.force.0": 1.0}, {"loads.0.force.0": "2 N"}]
    told = sweep(scene(1, 0), uneven, progress=False)
    expected = [solve(scene(1, 0)), solve(scene(2, 0))]
    assert told["tip"] == pytest.approx(np.array([x.tip for x in expected]), abs=1e-12)
