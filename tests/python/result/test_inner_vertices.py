"""Inner vertices at which something holds, acts or jumps: both sides are told, each of second
order."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from support import about_y, extrapolated

import pyrod
from pyrod import (
    Clamp,
    Equilibrium,
    Force,
    Hinge,
    Joint,
    Moment,
    Options,
    Pivot,
    Rod,
    Scene,
    Section,
    Sleeve,
    Slider,
    Spring,
)

UNIT = Section(EI1=1, EI2=1, GJ=1)
STRIP = Section(EI1=3, EI2=1, GJ=0.6)
SIDEWAYS = {"tangent": (1, 0, 0), "normal": (0, 0, 1)}
PLACE = (0.2, 0.1, 0.4)
HELD = {"frame": about_y(0.6), "at": 0.5}


def straight(n: int | None, section: object = UNIT) -> Rod:
    return Rod.straight(1.0, n, section)


def held(inner: object, space: str) -> Callable[[int | None], Scene]:
    load = Force((1, 0, 0.5) if space == "planar" else (1, 2, 0.5))
    return lambda n: Scene(straight(n), [Clamp(), inner], load, space)


def turned(moment: object, section: Section, space: str) -> Callable[[int | None], Scene]:
    load = Force((1, 0, -0.5) if space == "planar" else (1, -2, 0.5))
    return lambda n: Scene(straight(n, section), Clamp(), [moment, load], space)


def on_a_spring(moment: Moment, space: str) -> Callable[[int | None], Scene]:
    load = Force((1, 0, -0.5) if space == "planar" else (1, -2, 0.5))
    spring = Spring(10.0, 1.0, (0.05, 0, 0.45), at=0.5)
    return lambda n: Scene(straight(n, STRIP), [Clamp(), spring], [moment, load], space)


def tee(n: int | None, *more: object) -> Scene:
    post = straight(n)
    arm = straight(n).placed((0, 0, 0.5), tangent=(1, 0, 0), normal=(0, 0, -1))
    joint = Joint(((0, 0.5), (1, "start")), "rigid")
    held = [Clamp(at=(0, "start")), Hinge((0.1, 0, 0.9), at=(0, "end"))]
    return Scene([post, arm], held, [Force((0, 1, -2), at=(1, "end")), *more], joints=[joint])


def on_a_tee(follower: bool) -> Callable[[int | None], Scene]:
    return lambda n: tee(n, Moment((0.6, 1, 0.5), at=(0, 0.5), follower=follower))


def stepped(s: float) -> Section:
    return STRIP if s < 0.5 else UNIT


def of_function(n: int | None) -> Scene:
    return Scene(straight(n, stepped).with_vertices([0.5]), Clamp(), Force((3, 1, -1)))


def clip_at_a_step(n: int | None) -> Scene:
    m = n or 16
    rod = Rod.precurved(np.full(m, 1 / m), None, [STRIP] * (m // 2) + [UNIT] * (m // 2), (0, 1, 0))
    inner = Clamp(PLACE, at=0.5, **SIDEWAYS)
    return Scene(rod, [Clamp(), inner], Force((1, 2, 0.5)))


def between_vertices_of_unequal_edges(load: object) -> Callable[[int | None], Scene]:
    return lambda n: Scene(unequal(n), Clamp(), [load, Force((1, -2, 0.5))])


def unequal(n: int | None) -> Rod:
    part = (n or 16) // 4
    h = np.concatenate([np.full(part, 0.5 / part), np.full(3 * part, 0.5 / part / 3)])
    return Rod.precurved(h, None, STRIP, (0.3, 1, 0.2))


SCENES: dict[str, Callable[[int | None], Scene]] = {
    "clamp, planar": held(Clamp((0.12, 0, 0.47), **HELD), "planar"),
    "clamp": held(Clamp(PLACE, **HELD), "spatial"),
    "pivot": held(Pivot((0, 1, 0), PLACE, **HELD), "spatial"),
    "sleeve": held(Sleeve(PLACE, **HELD), "spatial"),
    "slider": held(Slider((1, 0, 2), position=PLACE, clamped=True, **HELD), "spatial"),
    "torsion spring": held(Spring(torsion=20.0, at=0.5), "spatial"),
    "torsion spring, planar": held(Spring(torsion=20.0, at=0.5), "planar"),
    "moment, planar": turned(Moment((0, 2, 0), at=0.5), UNIT, "planar"),
    "moment": turned(Moment((0.6, 1, 0.5), at=0.5), STRIP, "spatial"),
    "follower, planar": turned(Moment((0, 2, 0), at=0.5, follower=True), UNIT, "planar"),
    "follower": turned(Moment((0.6, 1, 0.5), at=0.5, follower=True), UNIT, "spatial"),
    "follower on a strip": turned(Moment((0.6, 1, 0.5), at=0.5, follower=True), STRIP, "spatial"),
    "rigid T": tee,
    "function": of_function,
    "clip at a step": clip_at_a_step,
    "unequal edges": between_vertices_of_unequal_edges(Moment((0.6, 1, 0.5), at=0.5)),
    "following force": between_vertices_of_unequal_edges(Force((2, 1, -3), at=0.5, follower=True)),
    "moment on a T": on_a_tee(False),
    "follower on a T": on_a_tee(True),
    "moment on a spring, planar": on_a_spring(Moment((0, 2, 0), at=0.5), "planar"),
    "moment on a spring": on_a_spring(Moment((0.6, 1, 0.5), at=0.5), "spatial"),
    "follower on a spring": on_a_spring(Moment((0.4, 2, 0.5), at=0.5, follower=True), "spatial"),
}


def numbers(result: Equilibrium, stride: int = 1) -> dict[str, np.ndarray]:
    """All that vertices say; curvatures only where the scheme tells them by the moments."""
    every = {
        "positions": "positions",
        "frames": "vertex_frames",
        "forces": "vertex_force",
        "forces before": "vertex_force_before",
        "moments": "moment",
        "moments before": "moment_before",
    }
    out = {
        key: np.vstack([getattr(rod, name)[::stride] for rod in result.rods])
        for key, name in every.items()
    }
    middle = [rod.rod.edges // 2 for rod in result.rods]
    for key, name in {"curvatures": "K", "curvatures before": "K_before"}.items():
        rows = [getattr(rod, name)[j] for rod, j in zip(result.rods, middle, strict=True)]
        out[key] = np.vstack(rows)
    out["energy"] = np.array([[result.energy]])
    out["reactions"] = np.vstack([r.force for r in result.reactions])
    return out


def turns(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Twice the distance of quaternions of any sign."""
    return 2 * np.minimum(np.linalg.norm(a - b, axis=1), np.linalg.norm(a + b, axis=1))


@pytest.mark.parametrize("make", SCENES.values(), ids=SCENES)
def test_both_sides_to_a_tolerance(make: Callable[[int | None], Scene]) -> None:
    """Against plain solves of up to 512 edges a rod."""
    result = pyrod.solve(make(None), tol=1e-7)
    assert result.accuracy.regular
    assert result.accuracy.order == pytest.approx(2, abs=0.06)
    assert result.accuracy.reached <= 1e-7
    assert result.accuracy.grids <= 7
    assert max(result.balance) < 1e-9
    base = result.rods[0].rod.edges
    fine = [pyrod.solve(make(base * 2**k), Options(tolerance=1e-9)) for k in range(2, 6)]
    told = [numbers(other, 2**k) for k, other in enumerate(fine, start=2)]
    for name, value in numbers(result).items():
        kind = name.removesuffix(" before")
        levels = [level[name] for level in told]
        if kind == "frames":
            for level in levels:
                level[np.sum(level * levels[-1], axis=1) < 0] *= -1
            exact = extrapolated(levels)
            error = turns(value, exact).max()
        else:
            exact = extrapolated(levels)
            size = 1.0 if kind == "positions" else np.linalg.norm(exact, axis=1).max()
            error = np.linalg.norm(value - exact, axis=1).max() / size
        assert error <= max(result.accuracy.errors[kind], 1e-8), name


@pytest.mark.parametrize("make", SCENES.values(), ids=SCENES)
def test_fixed_grids_are_of_second_order_too(make: Callable[[int | None], Scene]) -> None:
    found = [numbers(pyrod.solve(make(n)), n // 16) for n in (64, 128, 256)]
    for name in found[0]:
        if name == "frames":
            a, b = (turns(found[i][name], found[i + 1][name]).max() for i in (0, 1))
        else:
            a, b = (np.abs(found[i][name] - found[i + 1][name]).max() for i in (0, 1))
        assert a < 1e-11 or b < 0.3 * a, name


def test_the_sides_differ_by_what_acts() -> None:
    """Moment at 0.5: both moments from balance, both curvatures from them."""
    scene = Scene(straight(16, STRIP), Clamp(), Moment((0.6, 1, 0.5), at=0.5))
    for result in (pyrod.solve(scene), pyrod.solve(scene, tol=1e-9)):
        jump = result.moment_before - result.moment
        np.testing.assert_allclose(jump[8], (0.6, 1, 0.5), atol=1e-12)
        assert not np.delete(jump, 8, axis=0).any()
        np.testing.assert_allclose(result.moment[8:], 0, atol=1e-12)
        np.testing.assert_allclose(result.K[8:-1], 0, atol=1e-11)
        assert np.linalg.norm(result.K_before[8]) > 0.5


def test_a_force_and_a_support_part_the_section_force() -> None:
    load = (1, 0, -0.5)
    scene = Scene(straight(16), Clamp(), Force(load, at=0.25))
    result = pyrod.solve(scene)
    np.testing.assert_allclose(result.vertex_force_before[4], load, atol=1e-13)
    np.testing.assert_allclose(result.vertex_force[4], 0, atol=1e-13)
    np.testing.assert_array_equal(result.K_before, result.K)
    scene = Scene(straight(16), [Clamp(), Hinge((0.05, 0, 0.49), at=0.5)], Force((1, 0, 0)))
    result = pyrod.solve(scene)
    force = result.vertex_force_before[8] - result.vertex_force[8]
    np.testing.assert_allclose(force, result.reactions[1].force, atol=1e-12)


def test_the_cable_with_a_clip() -> None:
    cable = Section(EI1=0.06, EI2=0.06, GJ=0.05, mass_per_length=0.22)
    rod = Rod.straight(0.9, None, cable)
    clip = Clamp((0.25, 0.1, -0.25), at=0.45, **SIDEWAYS)
    far = Clamp((0.5, 0.2, -0.2), tangent=(0, 0, 1), normal=(-1, 0, 0), at="end")
    scene = Scene(rod, [Clamp(**SIDEWAYS), clip, far], pyrod.Gravity())
    result = pyrod.solve(scene)
    assert result.accuracy.regular
    assert result.accuracy.grids <= 6
    jump = result.moment_before[8] - result.moment[8]
    np.testing.assert_allclose(jump, result.reactions[1].moment, atol=1e-6)


def test_both_sides_are_saved(tmp_path: object) -> None:
    result = pyrod.solve(SCENES["clamp"](16), tol=1e-6)
    for name in ("result.npz", "result.json"):
        path = f"{tmp_path}/{name}"
        pyrod.save(result, path)
        again = pyrod.load(path)
        assert again == result
        np.testing.assert_array_equal(again.K_before, result.K_before)
        np.testing.assert_array_equal(again.moment_before, result.moment_before)
        assert again.largest_K == result.largest_K


def test_a_moment_on_a_clamp_bends_nothing_on_coarse_grids_either() -> None:
    """It took 247 iterations: the coarse grids that the start comes from were bent by it."""
    rod = straight(80, Section(EI1=1, EI2=1, GJ=1, EA=1e3))
    scene = Scene(rod, [Clamp(), Clamp(at=0.5)], Moment((0, 1000, 0), at=0.5))
    result = pyrod.solve(scene)
    assert result.iterations <= 8
    np.testing.assert_allclose(result.reactions[1].moment, (0, -1000, 0), atol=1e-9)
    np.testing.assert_allclose(result.tip, (0, 0, 1), atol=1e-12)


def test_places_that_differ_by_rounding_are_one_vertex() -> None:
    rod = straight(11).with_vertices([0.3, 0.1 + 0.2])
    assert rod.edges == 12
    assert rod.edge_lengths.min() > 1e-3
