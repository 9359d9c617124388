"""Scenes with all that a scene may have: derivatives against differences of solves.

Where rounding leaves differences digits to tell something by: members of like stiffness, and no
mode or force that is nearly free.
"""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, Phase, assume, given, settings
from hypothesis import strategies as st
from scenes_of_all_kinds import scenes
from test_derivatives import moved, slope, told

import pyrod
from pyrod.base.immutable import Array
from pyrod.linear.numbers import all_paths

TIGHT = pyrod.Options(tolerance=1e-11, max_iterations=40)
HARD = (pyrod.SingularEquilibrium, pyrod.NotConverged, ValueError)


def is_tame(scene: pyrod.Scene) -> bool:
    stiff = np.concatenate([rod.bending.ravel() / rod.length for rod in scene.rods])
    slender = [np.min(rod.stretching) * rod.length**2 / np.max(rod.bending) for rod in scene.rods]
    edges = sum(rod.edges for rod in scene.rods)
    return bool(edges <= 24 and stiff.max() < 1e3 * stiff.min() and min(slender) > 0.1)


def unit_of(scene: pyrod.Scene, name: str) -> float:
    """What rounding of turns is multiplied by in an output."""
    length = max(rod.length for rod in scene.rods)
    moment = max(rod.bending.max() / rod.length for rod in scene.rods)
    stretch = max(rod.bending.max() / rod.length**2 for rod in scene.rods)
    units = {"energy": moment, "moment": moment, "force": stretch, "positions": length}
    return float(units.get(name.rsplit(".", 1)[-1], 1.0))


def linearised(scene: pyrod.Scene) -> Any:
    """None if there is nothing to compare."""
    try:
        result = pyrod.solve(scene, TIGHT, strict=False, stable=False)
        if not result.converged or result.accuracy is not None or result.neutral:
            return None
        return pyrod.linearised(result)
    except HARD:
        return None


@pytest.mark.long
@pytest.mark.filterwarnings("ignore")
@settings(
    max_examples=25,
    deadline=None,
    phases=[Phase.explicit, Phase.generate],
    suppress_health_check=list(HealthCheck),
)
@given(scenes(), st.integers(0, 2**16))
def test_derivatives_of_any_scene(scene: pyrod.Scene, seed: int) -> None:
    assume(is_tame(scene))
    linear = linearised(scene)
    assume(linear is not None)
    rng = np.random.default_rng(seed)
    path = str(rng.choice(all_paths(linear.scene)))
    v = rng.standard_normal(linear._grid.entry(path).shape)
    value = np.abs(np.asarray(linear._grid.entry(path).value))
    if path.endswith(("bending", "stretching")):
        v = v * value[np.isfinite(value)].min(initial=1e3)
    v = v / np.abs(v).max() * (1.0 if value.max() == 0 else min(1.0, value.min(initial=1.0) or 1.0))
    base = linear.result

    def at(t: float) -> dict[str, Array]:
        scene = moved(linear.scene, path, t * v)
        return told(pyrod.solve(scene, TIGHT, start=base, stable=False), base)

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            change = linear.jvp({path: v})
            coarse, fine = slope(at, 2e-3), slope(at, 1e-3)
        except HARD:
            assume(False)
    assume(np.isfinite(change["rods.0.force"]).all())
    for name, expected in fine.items():
        size = np.abs(expected).max()
        rough = np.abs(coarse[name] - expected).max()
        found = np.where(np.isfinite(change[name]), change[name], expected)
        # else differences tell little
        if rough < 1e-8 * size and size > 1e-9 * unit_of(linear.scene, name):
            assert found == pytest.approx(expected, abs=1e-6 * size), (path, name)


@pytest.mark.long
@pytest.mark.filterwarnings("ignore")
@settings(
    max_examples=8,
    deadline=None,
    phases=[Phase.explicit, Phase.generate],
    suppress_health_check=list(HealthCheck),
)
@given(scenes(), st.integers(0, 2**16))
def test_backward_is_forward_of_any_scene(scene: pyrod.Scene, seed: int) -> None:
    """Sums of all that has a derivative, under a change of all at once."""
    assume(is_tame(scene))
    linear = linearised(scene)
    assume(linear is not None and not linear._grid.free)
    rng = np.random.default_rng(seed)
    paths = all_paths(linear.scene)
    try:
        zeros = linear._grid.zeros
        v = {path: direction(rng, linear._grid.entry(path)) for path in paths}
        change = linear.jvp(v)
        known = {name: np.isfinite(change[name]) for name in zeros}
        w = {name: rng.standard_normal(np.shape(zeros[name])) * known[name] for name in zeros}
        gradient = linear.vjp(w, paths)
    except HARD:
        assume(False)
    parts = [w[name][known[name]] * np.asarray(change[name])[known[name]] for name in zeros]
    forward, size = sum(map(np.sum, parts)), sum(np.abs(part).sum() for part in parts)
    backward = [np.nansum(gradient[path] * v[path]) for path in paths]
    size = max(size, float(np.abs(backward).sum()))
    assert abs(forward - sum(backward)) <= 1e-9 * size


def direction(rng: np.random.Generator, entry: Any) -> Array:
    """A change that stays in the plane of a planar scene, of the size of what it changes."""
    v = entry.unit * rng.standard_normal(entry.shape)
    value = np.broadcast_to(entry.value, entry.shape) if entry.shape == entry.value.shape else v
    v = np.where(np.isfinite(value), v, 0.0)
    if entry.scene.space != "planar" or entry.kind == "rods":
        return v
    flat = np.reshape(v, -1)
    for i, unit in enumerate(entry.units()):
        flat[i] = 0.0 if unit is None else flat[i]
    return flat.reshape(entry.shape)
