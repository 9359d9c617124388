"""Derivatives of equilibria against differences of equilibria, forward against backward."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import pyrod
from pyrod import Clamp, Force, Gravity, Hinge, Joint, Moment, Pivot, Rod, Scene, Section, Slider
from pyrod.base.immutable import Array
from pyrod.linear.told import OF_RODS
from pyrod.rotation import exp, log, multiply
from pyrod.scene.changes import changed

STIFF = Section(EI1=1.0, EI2=1.4, GJ=0.8, GA1=40.0, GA2=50.0, EA=60.0, mass_per_length=0.3)
SOFT = Section(EI1=1.0, EI2=0.7, GJ=0.5, mass_per_length=0.2)


def curved(edges: int = 12, section: Section = STIFF) -> Rod:
    return Rod.precurved(1.0, edges, section, lambda s: (0.5, 1.0 - s, 0.3))


def cantilever() -> Scene:
    loads = [Force((0.5, 1.0, -0.3)), Force((0.2, -0.5, 0.1), at=0.37), Gravity((0, 0, -2.0))]
    return Scene(curved(), Clamp((0, 0, 0)), loads)


def followers() -> Scene:
    loads = [
        Force((0.5, 0.4, -0.3), follower=True),
        Moment((0.1, 0.3, 0.2), follower=True),
        pyrod.DistributedForce((0.2, 0.3, 0.1), follower=True),
    ]
    return Scene(curved(), Clamp((0, 0, 0)), loads)


def dead_moments() -> Scene:
    loads = [Moment((0.3, 0.5, -0.2)), pyrod.DistributedMoment((0.1, 0.2, 0.1)), Force((0.5, 0, 0))]
    return Scene(curved(section=SOFT), Clamp((0, 0, 0)), loads)


def arch() -> Scene:
    supports = [
        Clamp((0, 0, 0)),
        Clamp((0.4, 0.1, 0.6), tangent=(1, 0.2, 0.4), at="end"),
        pyrod.Spring(3.0, 0.5, (0.2, 0.1, 0.4), at=0.5),
    ]
    return Scene(curved(section=SOFT), supports, Force((0.5, 0.3, 0.2), at=0.25))


def sliding() -> Scene:
    supports = [
        Pivot((0, 1, 0), (0, 0, 0)),
        Slider((1, 0, 1), position=(0.3, 0.1, 0.7), clamped=True, at="end"),
    ]
    return Scene(curved(), supports, Force((0.5, 0.3, 0.2), at=0.5))


def frame() -> Scene:
    post = Rod.straight(1.0, 8, STIFF).placed((0, 0, 0))
    beam = Rod.straight(0.8, 6, SOFT).placed((0, 0, 1.0), tangent=(1, 0, 0.1))
    brace = Rod.straight(0.7, 6, SOFT).placed((0.8, 0, 1.1), tangent=(0, 0.3, -1))
    return Scene(
        [post, beam, brace],
        [Clamp((0, 0, 0)), Hinge((0.8, 0.2, 0.5), at=(2, "end"))],
        [Force((0.5, 0.3, -0.2), at=(1, 0.4)), Gravity((0, 0, -1.0))],
        joints=[
            Joint([(0, "end"), (1, "start")], aligned=False),
            Joint([(1, "end"), (2, "start")]),
        ],
    )


def planar() -> Scene:
    rod = Rod.precurved(1.0, 12, SOFT, lambda s: (0, 1.0 - s, 0))
    supports = [Clamp((0, 0, 0)), Hinge((0.3, 0, 0.7), at="end")]
    return Scene(
        rod, supports, [Force((1.0, 0, 0.2), at=0.5), Moment((0, 0.3, 0), "end")], "planar"
    )


SCENES = (cantilever, followers, dead_moments, arch, sliding, frame, planar)
PATHS: dict[str, list[str]] = {
    "cantilever": ["loads.0.force", "loads.1.force", "loads.2.acceleration", "supports.0.position",
                   "supports.0.frame", "rods.0.K0", "rods.0.bending", "rods.0.stretching",
                   "rods.0.edge_lengths", "rods.0.mass_per_length"],
    "followers": ["loads.0.force", "loads.1.moment", "loads.2.force_per_length",
                  "supports.0.frame", "rods.0.K0", "rods.0.bending", "rods.0.edge_lengths"],
    "dead_moments": ["loads.0.moment", "loads.1.moment_per_length", "supports.0.frame",
                     "rods.0.K0", "rods.0.bending"],
    "arch": ["loads.0.force", "supports.1.position", "supports.1.frame", "supports.1.turns",
             "supports.2.position", "supports.2.stiffness", "supports.2.torsion", "rods.0.K0",
             "rods.0.bending"],
    "sliding": ["loads.0.force", "supports.0.position", "supports.1.position", "rods.0.K0",
                "rods.0.stretching"],
    "frame": ["loads.0.force", "supports.1.position", "supports.0.frame", "rods.1.K0",
              "rods.2.bending", "rods.0.edge_lengths", "rods.1.K0"],
    "planar": ["loads.0.force.0", "loads.1.moment.1", "supports.1.position.2", "rods.0.bending"],
}  # fmt: skip
CASES = [(scene, path) for scene in SCENES for path in PATHS[scene.__name__]]


def is_turn(path: str) -> bool:
    return path.endswith((".frame", ".turns"))


def moved(scene: Scene, path: str, change: Array) -> Scene:
    """The scene with another value of an entry; of frames turned on."""
    if is_turn(path):
        number = int(path.split(".")[1])
        by = change if path.endswith("frame") else np.array([0, 0, 2 * np.pi * change])
        frame = multiply(scene._compiled.held(number)[1], exp(by))
        return changed(scene, {f"supports.{number}.frame": frame})[0]
    *whole, last = path.split(".")
    if last.isdecimal():
        kind, number, name = whole
        value = getattr(getattr(scene, kind)[int(number)], name)[int(last)]
        return changed(scene, {path: float(value + change)})[0]
    kind, number, name = path.split(".")
    value = getattr(getattr(scene, kind)[int(number)], name)
    if value is None:
        value = scene._compiled.held(int(number))[0]
    new = value + change
    return changed(scene, {path: new if np.ndim(new) else float(new)})[0]


def told(result: pyrod.Equilibrium, base: pyrod.Equilibrium) -> dict[str, Array]:
    """By the names of linear responses; frames as turns from another equilibrium's."""
    out: dict[str, Array] = {"energy": np.array(result.energy)}
    for i, (rod, like) in enumerate(zip(result.rods, base.rods, strict=True)):
        for name in OF_RODS:
            if name == "rotations":
                continue
            value = getattr(rod, name)
            if "frames" in name:
                turns = multiply(getattr(like, name) * [1, -1, -1, -1], value)
                value = log(np.where(turns[:, :1] < 0, -turns, turns))
            out[f"rods.{i}.{name}"] = value
    for i, reaction in enumerate(result.reactions):
        out[f"reactions.{i}.force"] = reaction.force
        out[f"reactions.{i}.moment"] = reaction.moment
    return out


def slope(of: Callable[[float], dict[str, Array]], h: float) -> dict[str, Array]:
    """Of sixth order."""
    at = {k: of(k * h) for k in (-3, -2, -1, 1, 2, 3)}
    return {
        name: (
            45 * (at[1][name] - at[-1][name])
            - 9 * (at[2][name] - at[-2][name])
            + at[3][name]
            - at[-3][name]
        )
        / (60 * h)
        for name in at[1]
    }


def solution(scene: Scene, near: pyrod.Equilibrium | None = None) -> pyrod.Equilibrium:
    return pyrod.solve(scene, pyrod.Options(tolerance=1e-11), start=near)


@pytest.fixture(scope="module", params=SCENES, ids=lambda scene: scene.__name__)
def case(request: pytest.FixtureRequest) -> tuple[str, pyrod.Equilibrium, Any]:
    result = solution(request.param())
    return request.param.__name__, result, pyrod.linearised(result)


def test_derivatives_are_those_of_solves(case: tuple[str, pyrod.Equilibrium, Any]) -> None:
    name, result, linear = case
    rng = np.random.default_rng(4)
    for path in PATHS[name]:
        v = rng.standard_normal(linear._grid.entry(path).shape)
        small = 0.1 if path.endswith(("edge_lengths", "mass_per_length", "turns")) else 1.0
        if path.endswith("edge_lengths"):
            v = v * result.scene.rods[int(path.split(".")[1])].edge_lengths
        v = v * small
        change = linear.jvp({path: v})

        def at(t: float, path: str = path, v: Array = v) -> dict[str, Array]:
            return told(solution(moved(result.scene, path, t * v), result), result)

        difference = slope(at, 3e-3)
        for output, expected in difference.items():
            scale = max(np.abs(expected).max(), 1e-3 * float(np.abs(v).max()))
            assert change[output] == pytest.approx(expected, abs=1e-7 * scale), (path, output)


def test_backward_is_the_transpose_of_forward(case: tuple[str, pyrod.Equilibrium, Any]) -> None:
    name, _, linear = case
    rng = np.random.default_rng(5)
    weights = {
        output: rng.standard_normal(np.shape(value))
        for output, value in linear._grid.zeros.items()
        if output != "energy"
    }
    weights["energy"] = 1.3
    paths = PATHS[name]
    changes = {path: rng.standard_normal(linear._grid.entry(path).shape) for path in paths}
    change, gradient = linear.jvp(changes), linear.vjp(weights, paths)
    forward = sum(np.sum(weights[output] * change[output]) for output in weights)
    backward = sum(np.sum(gradient[path] * changes[path]) for path in set(paths))
    sizes = sum(np.sum(np.abs(weights[output] * change[output])) for output in weights)
    assert abs(forward - backward) <= 1e-12 * sizes


def test_jacobian_goes_both_ways(case: tuple[str, pyrod.Equilibrium, Any]) -> None:
    name, result, linear = case
    if len(result.rods) > 1:
        pytest.skip("one rod is enough")
    path = PATHS[name][0]
    forwards = linear.jacobian("positions", path)[path]
    last = linear.jacobian("tip", [path, "rods.0.bending"])
    assert last[path] == pytest.approx(forwards[-1], abs=1e-12)
    v = np.random.default_rng(1).standard_normal(linear._grid.entry("rods.0.bending").shape)
    tip = np.tensordot(last["rods.0.bending"], v, v.ndim)
    assert tip == pytest.approx(linear.jvp({"rods.0.bending": v})["tip"], abs=1e-13)
