"""Options of `solve`: what they are by default, how they are given, and what is refused."""

from __future__ import annotations

import pickle

import numpy as np
import pytest
from support import ROUND, differences

import pyrod
from pyrod import Clamp, Force, Options, Rod, Scene


def test_options_have_documented_defaults() -> None:
    options = Options()
    values = (options.max_iterations, options.tolerance, options.trust, options.near)
    assert values == (100, 1e-8, 2.0, 0.5)
    for name in ("max_iterations", "tolerance", "trust", "near"):
        assert len(getattr(Options, name).__doc__) > 20


@pytest.mark.parametrize(
    ("keywords", "message"),
    [
        ({"max_iterations": 0}, "max_iterations: must be at least 1, got 0"),
        ({"tolerance": 0.0}, r"tolerance: must lie in \(0, 1e-3\] rad, got 0"),
        ({"tolerance": 2e-3}, "tolerance: must lie"),
        ({"tolerance": np.nan}, "tolerance: must lie"),
        ({"trust": 0.0}, "trust: must be positive, got 0"),
        ({"trust": np.nan}, "trust: must be positive"),
        ({"near": -1.0}, "near: must not be negative, got -1"),
        ({"near": np.nan}, "near: must not be negative"),
    ],
)
def test_options_are_refused_by_name(keywords, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        Options(**keywords)


def test_unknown_options_are_refused_with_those_there_are() -> None:
    with pytest.raises(TypeError, match="there are: max_iterations, tolerance, trust, near"):
        Options(tolerance=1e-6, tolerence=1e-7)
    with pytest.raises(TypeError):
        Options(100)


def test_options_as_objects() -> None:
    options = Options(tolerance=1e-6, max_iterations=7)
    shown = (
        "max_iterations=7, tolerance=1e-06, trust=2.0, near=0.5, max_edges=262144, max_time=60.0"
    )
    assert repr(options) == f"Options({shown})"
    assert eval(repr(options), vars(pyrod)) == options
    assert pickle.loads(pickle.dumps(options)) == options
    assert options != Options()
    assert options != 7
    with pytest.raises(AttributeError):
        options.trust = 1.0


def test_a_looser_tolerance_saves_iterations() -> None:
    scene = Scene(Rod.straight(1.0, 32, ROUND), Clamp(), Force((10, 0, 0)))
    loose, tight = (pyrod.solve(scene, Options(tolerance=t)) for t in (1e-3, 1e-12))
    assert loose.iterations < tight.iterations
    assert loose.record["step"][-1] <= 1e-3
    assert tight.record["step"][-1] <= 1e-12
    assert differences(loose.positions, tight.positions) < 1e-6  # the square of the step
