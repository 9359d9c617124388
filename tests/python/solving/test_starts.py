"""Equilibria of one scene as starts of another: nodes are matched by what they are."""

from __future__ import annotations

from itertools import permutations

import numpy as np
import pytest

from pyrod import (
    Clamp,
    Equilibrium,
    Force,
    Hinge,
    Joint,
    Pivot,
    Rod,
    Scene,
    Section,
    Slider,
    Spring,
    solve,
)
from pyrod.rotation import log
from pyrod.scene.supports import Support

ROUND = Section(1, 1, 0.7)
ROD = Rod.straight(1.0, 64, ROUND)
ENDS = [Clamp(), Hinge((0, 0, 0.95), at="end")]
LOAD = Force((1, 0, 0), at=0.3)
PROPS = [Spring(5.0, at=i / 64) for i in range(1, 64)]
SPACES = ["planar", "spatial"]


def arch(supports: list[Support], space: str = "spatial") -> Scene:
    return Scene(ROD, supports, LOAD, space)  # type: ignore[arg-type]


def same(a: Equilibrium, b: Equilibrium, within: float = 1e-9) -> bool:
    rods = zip(a.rods, b.rods, strict=True)
    return all(np.abs(p.positions - q.positions).max() < within for p, q in rods)


@pytest.mark.parametrize("space", SPACES)
def test_props_that_are_taken_away_or_put_in_are_left_out(space: str) -> None:
    propped, bare = solve(arch(ENDS + PROPS, space)), solve(arch(ENDS, space))
    assert not same(propped, bare, 1e-4)
    for _ in range(50):
        assert same(solve(arch(ENDS, space), start=propped), bare)
    assert same(solve(arch(ENDS + PROPS, space), start=bare), propped)
    some = ENDS + PROPS[3:60:7]
    assert same(solve(arch(some, space), start=propped), solve(arch(some, space)))


def test_the_order_of_supports_does_not_matter_to_a_start() -> None:
    supports = [*ENDS, Spring(5.0, at=0.25), Slider(along=(0, 0, 1), at=0.5)]
    first = solve(arch(supports))
    for order in permutations(supports):
        again = solve(arch(list(order)), start=first)
        assert same(first, again)
        assert again.iterations == 1


def joined(backwards: bool, hold: bool = True) -> Scene:
    """Three rods in a row, with the nodes in either order, held at the far end or not."""
    rods = [ROD.placed((0, 0, i), tangent=(0.2 * i, 0, 1)) for i in range(3)]
    joints = [Joint(((i, "end"), (i + 1, "start")), aligned=False) for i in range(2)]
    supports = [Clamp(at=(0, "start"))] + [Spring(3.0, at=(2, "end"))] * hold
    order = slice(None, None, -1 if backwards else None)
    loads = [Force((0.5, 0.2, 0), at=(1, 0.5)), Force((0, -0.3, 0), at=(2, 0.7))]
    return Scene(rods, supports[order], loads, joints=joints[order])


def test_joined_rods_start_from_another_order_of_joints_and_supports() -> None:
    first = solve(joined(backwards=False))
    again = solve(joined(backwards=True), start=first)
    assert same(first, again)
    assert again.iterations == 1
    free = solve(joined(backwards=False, hold=False))
    assert same(solve(joined(backwards=True, hold=False), start=first), free)
    assert same(solve(joined(backwards=True), start=free), first)


@pytest.mark.parametrize("space", SPACES)
def test_a_slider_that_moved_holds_where_it_is_now(space: str) -> None:
    def scene(x: float) -> Scene:
        return arch([Clamp(), Slider((0, 0, 1), position=(x, 0, 0.9), at="end")], space)

    before, now = solve(scene(0.0)), solve(scene(0.1))
    for start in (before, before.frames):
        moved = solve(scene(0.1), start=start)
        assert moved.positions[-1, 0] == pytest.approx(0.1, abs=1e-12)
        assert same(moved, now)


def test_a_pin_that_was_turned_lets_the_rod_turn_about_its_axis_only() -> None:
    def scene(turn: float) -> Scene:
        axis = (-np.sin(turn), np.cos(turn), 0)
        pin = Pivot(axis, (0, 0, 0.9), at="end")
        return Scene(ROD, [Clamp(), pin], Force((1, 0.4, 0), at=0.5))

    before = solve(scene(0.0))
    found = solve(scene(0.5), start=before)
    turn = log(found.vertex_frames[-1])
    assert np.linalg.norm(turn) > 0.05
    assert np.linalg.norm(np.cross(turn, (-np.sin(0.5), np.cos(0.5), 0))) < 1e-6
    assert same(found, solve(scene(0.5)))


def test_an_equilibrium_starts_its_own_scene_at_once_and_a_cantilever_starts_a_network() -> None:
    first = solve(arch(ENDS + PROPS[3:60:7]))
    assert solve(first.scene, start=first).iterations == 1
    bent = solve(Scene(ROD, Clamp(), LOAD))
    held = Scene(ROD, [Clamp(), Spring(1e-9, at="end", position=bent.tip)], LOAD)
    again = solve(held, start=bent)
    assert again.iterations <= 2
    assert same(again, bent, 1e-8)


def test_rods_that_have_other_edges_are_refused_in_words() -> None:
    short, long = Rod.straight(1.0, 16, ROUND), Rod.straight(1.0, 32, ROUND).placed((0, 0, 1))

    def scene(first: Rod, second: Rod) -> Scene:
        held = [Clamp(at=(0, "start")), Clamp(at=(1, "start"))]
        return Scene([first, second], held, Force((1, 0, 0), at=(0, "end")))

    start = solve(scene(short, long))
    with pytest.raises(ValueError, match=r"start: expected 32, 16 rows.*got 16, 32; a support"):
        solve(scene(long, short), start=start)
    with pytest.raises(ValueError, match=r"start: expected 65 rows.*got 64"):
        solve(arch([*ENDS, Spring(5.0, at=0.123)]), start=solve(arch(ENDS)))
    frames = np.vstack([start.rods[1].frames, start.rods[0].frames])[:-1]
    with pytest.raises(ValueError, match="start: expected 48 rows"):
        solve(scene(long, short), start=frames)
