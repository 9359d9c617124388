"""Tendons of given tension: closed forms, an own integration of tendon robots, and invariances."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from tendon_robots import (
    DISTANCE,
    HELICAL,
    LENGTH,
    PARALLEL,
    TIP_FORCE,
    WIRE,
    converging,
    helix,
    robot,
)

import pyrod
from pyrod import Clamp, Force, Gravity, Hinge, Joint, Moment, Rod, Scene, Tendon
from pyrod.rotation import exp, multiply, rotate

# own integration of the tendon-rod equations (DOP853, 1e-13): tip over L, tendon over L
REFERENCES = {
    "parallel": (
        robot(PARALLEL),
        (0.7243912255169, 0, 0.3274125453937, 0.924211931861),
    ),
    "helix": (
        robot(HELICAL),
        (0.0008741297130, 0.3513398148400, 0.8611368176250, 0.944607820516),
    ),
    "helix and force": (
        robot(HELICAL, Force(TIP_FORCE)),
        (0.1913552159261, 0.6616541617645, 0.5988276280723, 0.938550618126),
    ),
}


def told(result):
    return np.array([*result.tip, result.tendons[0].length]) / LENGTH


@pytest.mark.parametrize("name", REFERENCES)
def test_to_a_tolerance_the_references_are_met(name):
    scene, reference = REFERENCES[name]
    result = pyrod.solve(scene, tol=1e-10)
    assert np.abs(told(result) - reference).max() < 2e-11
    assert result.accuracy.order == pytest.approx(2, abs=0.1)
    assert result.errors["positions"] < 1e-10
    assert result.stable


@pytest.mark.parametrize(
    ("name", "error"), [("parallel", 4e-5), ("helix", 1.3e-4), ("helix and force", 1.2e-4)]
)
def test_plain_grids_are_of_second_order(name, error):
    scene, reference = REFERENCES[name]
    errors = [
        np.abs(told(pyrod.solve(scene.refined(level))) - reference).max() for level in (2, 3, 4)
    ]
    assert errors[1] < error  # of 64 edges
    assert errors[0] / errors[1] == pytest.approx(4, abs=0.35)
    assert errors[1] / errors[2] == pytest.approx(4, abs=0.2)


@pytest.mark.parametrize(
    ("scene", "iterations"),
    [
        (robot(PARALLEL), 4),
        (robot(Tendon(converging, 5)), 4),
        (robot(HELICAL), 5),
        (robot(Tendon(helix, 10)), 7),
        (robot(HELICAL, Force(TIP_FORCE)), 7),
    ],
)
def test_from_straight_a_few_iterations_do(scene, iterations):
    result = pyrod.solve(scene)
    assert result.iterations <= iterations + 1  # the last looks whether there is more to do
    assert result.load_steps == 0


@pytest.mark.parametrize("edges", [1, 2, 7, 40])
@pytest.mark.parametrize("space", ["planar", "spatial"])
def test_a_parallel_tendon_bends_to_a_circle_on_any_grid(edges, space):
    result = pyrod.solve(robot(PARALLEL, edges=edges, space=space))
    curvature = 5 * DISTANCE / WIRE.EI2
    assert np.abs(result.K - (0, curvature, 0)).max() < 1e-12 * curvature
    # the tendon is on the inside of the arc, and shorter by its angle times the distance
    length = LENGTH * (1 - curvature * DISTANCE)
    assert result.tendons[0].length == pytest.approx(length, rel=1e-14)
    assert np.abs(result.backbone_force + 5 * rotate(result.vertex_frames, [0, 0, 1])).max() < 1e-12
    assert np.abs(result.force).max() < 1e-12
    assert np.abs(result.moment).max() < 1e-12 * WIRE.EI2 * curvature


def test_on_uneven_edges_as_well():
    lengths = np.array([0.01, 0.03, 0.012, 0.05, 0.04, 0.03, 0.07])
    rod = Rod.straight(lengths, None, WIRE, "inextensible")
    result = pyrod.solve(robot(PARALLEL, rod=rod))
    assert np.abs(result.K[:, 1] * WIRE.EI2 / (5 * DISTANCE) - 1).max() < 1e-12


@pytest.mark.parametrize("tol", [None, 1e-9])
def test_a_tendon_on_the_axis_changes_nothing(tol):
    loads = [Force((0.2, 0.05, -0.1)), Gravity()]
    rod = Rod.straight(LENGTH, 12, replace(WIRE, mass_per_length=0.004), "inextensible")
    bare = pyrod.solve(Scene(rod, Clamp(), loads), tol=tol)
    pulled = pyrod.solve(Scene(rod, Clamp(), loads, actuators=Tendon((0, 0), 3)), tol=tol)
    assert np.abs(bare.positions - pulled.positions).max() < 1e-13
    assert np.abs(bare.K - pulled.K).max() < 1e-10 * np.abs(bare.K).max()
    assert pulled.tendons[0].length == pytest.approx(LENGTH, rel=1e-14)
    assert np.abs(pulled.moment - bare.moment).max() < 1e-12


def test_planar_and_spatial_agree():
    loads = Force((0.3, 0, -0.2))
    flat, space = (
        pyrod.solve(robot(Tendon(converging, 5), loads, edges=24, space=space))
        for space in ("planar", "spatial")
    )
    assert np.abs(flat.positions - space.positions).max() < 1e-13 * LENGTH
    assert np.abs(flat.backbone_force - space.backbone_force).max() < 1e-10
    assert flat.tendons[0].length == pytest.approx(space.tendons[0].length, rel=1e-14)
    assert np.abs(flat.tendons[0].force_on_base - space.tendons[0].force_on_base).max() < 1e-11


def test_it_does_not_matter_where_and_how_the_robot_stands():
    turn, shift = exp(np.array([0.3, -1.1, 2.0])), np.array([0.1, -0.2, 0.3])
    here = pyrod.solve(robot(HELICAL, Force(TIP_FORCE), edges=16))
    there = pyrod.solve(
        robot(HELICAL, Force(rotate(turn, TIP_FORCE)), edges=16, clamp=Clamp(shift, turn))
    )
    assert np.abs(shift + rotate(turn, here.positions) - there.positions).max() < 1e-13
    assert np.abs(rotate(turn, here.backbone_force) - there.backbone_force).max() < 1e-9
    assert np.abs(here.K - there.K).max() < 1e-9


def test_directors_may_be_named_otherwise():
    """Turned by a quarter about the axis, with the offset turned back."""
    quarter = exp(np.array([0, 0, np.pi / 2]))
    one = pyrod.solve(robot(Tendon((DISTANCE, 0), 5), Force(TIP_FORCE)))
    other = pyrod.solve(
        robot(Tendon((0, -DISTANCE), 5), Force(TIP_FORCE), clamp=Clamp(None, quarter))
    )
    assert np.abs(one.positions - other.positions).max() < 1e-13


def test_all_is_in_balance():
    loads = [Force(TIP_FORCE), Force((0.1, 0, 0.02), at=0.1)]
    tendons = [HELICAL, Tendon((0, DISTANCE), 2, start=0.05, end=0.2)]
    result = pyrod.solve(robot(tendons, loads, edges=20))
    assert max(result.balance) < 1e-13
    # tendons are inside: the support bears the loads alone
    assert (
        np.abs(result.reaction.force + np.sum([load.force for load in loads], axis=0)).max() < 1e-13
    )
    # at the base they pull, and the rod is pressed
    pulls = np.sum([tendon.force_on_base for tendon in result.tendons[:1]], axis=0)
    assert np.abs(result.vertex_force[0] - result.backbone_force[0] - pulls).max() < 1e-12
    for tendon, made in zip(result.tendons, tendons, strict=True):
        assert np.linalg.norm(tendon.force_on_base) == pytest.approx(made.tension, rel=1e-13)


def test_a_tendon_that_ends_inside_leaves_the_rest_straight():
    scene = robot(Tendon((DISTANCE, 0), 5, end=0.15), edges=10)
    for tol in (None, 1e-9):
        result = pyrod.solve(scene, tol=tol)
        curvature = 5 * DISTANCE / WIRE.EI2
        inside = result.s < 0.15 - 1e-9
        assert np.abs(result.K[inside, 1] / curvature - 1).max() < 1e-10
        assert np.abs(result.K[~inside]).max() < 1e-10 * curvature
        angle = 0.15 * curvature
        at = np.array([1 - np.cos(angle), 0, np.sin(angle)]) / curvature
        tip = at + (LENGTH - 0.15) * np.array([np.sin(angle), 0, np.cos(angle)])
        # the polygon's chords are those of the arc to second order; with a tolerance it is the arc
        assert np.abs(result.tip - tip).max() < (1e-9 if tol else 1e-3) * LENGTH
        assert result.tendons[0].length == pytest.approx(
            0.15 * (1 - curvature * DISTANCE), rel=1e-11
        )


def test_the_anchor_of_an_inner_end_is_exact_on_any_grid_in_the_turns():
    """Each half cell beside the end has its own law, so the turn of the end is that of the arc."""
    result = pyrod.solve(robot(Tendon((DISTANCE, 0), 5, start=0.03, end=0.15), edges=7))
    angle = 2 * np.arctan2(result.tip_frame[2], result.tip_frame[0])
    assert angle == pytest.approx(0.12 * 5 * DISTANCE / WIRE.EI2, rel=1e-12)


def test_an_antagonist_takes_the_bending_away():
    pair = [Tendon((DISTANCE, 0), 5), Tendon((-DISTANCE, 0), 5)]
    result = pyrod.solve(robot(pair))
    assert np.abs(result.K).max() < 1e-10
    assert result.stable


def test_like_an_applied_moment():
    """A parallel tendon does what a moment that follows the tip does, but has a potential."""
    moment = Moment((0, 5 * DISTANCE, 0), follower=True)
    followed = pyrod.solve(robot((), [moment, Force((0.1, 0, 0.3))], edges=64), tol=1e-10)
    pulled = pyrod.solve(robot(PARALLEL, Force((0.1, 0, 0.3)), edges=64), tol=1e-10)
    # the moment of the tendon is T d whatever the shape, as it is parallel to the axis
    assert np.abs(followed.positions - pulled.positions).max() < 1e-10 * LENGTH
    assert followed.index == -1
    assert pulled.index == 0


def test_rows_are_straight_between_vertices():
    s = np.linspace(0, LENGTH, 9)
    rows = np.array([converging(x) for x in s])
    even = pyrod.solve(robot(Tendon(rows, 5)), tol=1e-9)
    function = pyrod.solve(robot(Tendon(converging, 5)), tol=1e-9)
    assert np.abs(even.positions - function.positions).max() < 1e-10
    bent = rows.copy()
    bent[4:] = bent[4]
    kinked = pyrod.solve(robot(Tendon(bent, 5)), tol=1e-9)
    same = pyrod.solve(robot(Tendon(lambda s: converging(min(s, LENGTH / 2)), 5)), tol=1e-9)
    assert np.abs(kinked.positions - same.positions).max() < 1e-10
    assert kinked.accuracy.regular
    assert same.accuracy.regular


def test_a_support_inside_gets_vertices_and_rows_follow():
    rows = np.array([converging(x) for x in np.linspace(0, LENGTH, 9)])
    scene = Scene(
        Rod.straight(LENGTH, 8, WIRE, "inextensible"),
        [Clamp(), Hinge((0.02, 0, 0.19), at=0.2)],
        actuators=Tendon(rows, 5),
    )
    assert scene.rod.edges == 9
    assert len(scene.actuators[0].offset) == 10
    result = pyrod.solve(scene, tol=1e-8)
    assert result.accuracy.regular
    function = pyrod.solve(replace(scene, actuators=Tendon(converging, 5)), tol=1e-8)
    assert np.abs(result.positions - function.positions).max() < 1e-9
    assert max(function.balance) < 1e-8


def test_scenes_of_several_rods_and_ball_joints():
    rods = [
        Rod.straight(LENGTH, 8, WIRE, "inextensible"),
        Rod.straight(LENGTH, 8, WIRE, "inextensible").placed((0, 0, LENGTH)),
    ]
    scene = Scene(
        rods,
        Clamp(),
        Force((0, 0.05, 0), at=(1, "end")),
        joints=Joint([(0, "end"), (1, "start")]),
        actuators=[Tendon((DISTANCE, 0), 5), Tendon((0, DISTANCE), 3, rod=1)],
    )
    one = Scene(
        Rod.straight(2 * LENGTH, 16, WIRE, "inextensible"),
        Clamp(),
        Force((0, 0.05, 0)),
        actuators=[
            Tendon((DISTANCE, 0), 5, end=LENGTH),
            Tendon((0, DISTANCE), 3, start=LENGTH),
        ],
    )
    a, b = pyrod.solve(scene), pyrod.solve(one)
    assert np.abs(a.rods[1].tip - b.tip).max() < 1e-12
    for i in (0, 1):
        assert a.tendons[i].length == pytest.approx(b.tendons[i].length, rel=1e-12)


def test_a_moment_or_a_jump_beside_a_tendon_keeps_the_order():
    thin = replace(WIRE, EI1=WIRE.EI1 / 2, EI2=WIRE.EI2 / 2, GJ=WIRE.GJ / 2)
    rod = Rod.straight(LENGTH, 8, [WIRE] * 4 + [thin] * 4, "inextensible")
    moment = Moment((0.002, 0, 0.001), at=LENGTH / 4, follower=True)
    result = pyrod.solve(robot(HELICAL, [moment, Force(TIP_FORCE)], rod=rod), tol=1e-8)
    assert result.accuracy.regular
    assert result.accuracy.order == pytest.approx(2, abs=0.15)


def test_the_backbone_law_holds_at_all_vertices():
    """EI (K - K0) is what is left of the moment when the tendon's is taken away."""
    result = pyrod.solve(robot(HELICAL, Force(TIP_FORCE), edges=16), tol=1e-10)
    d = np.array([[*helix(s), 0] for s in result.s])
    turn = 2 * np.pi / LENGTH
    slope = np.array([[-turn * y, turn * x, 0] for x, y, _ in d])
    along = np.array([0, 0, 1]) + slope + np.cross(result.K, d)
    t = along / np.linalg.norm(along, axis=1)[:, None]
    q = result.vertex_frames
    back = multiply(q * [1, -1, -1, -1], [1, 0, 0, 0])
    carried = rotate(back, result.moment) - 5 * np.cross(d, t)
    assert np.abs(result.material_moment - carried).max() < 1e-9 * np.abs(carried).max()
    force = rotate(back, result.vertex_force - result.backbone_force)
    assert np.abs(force - 5 * t).max() < 1e-8
