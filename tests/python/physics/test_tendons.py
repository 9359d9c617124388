"""Tendons: closed forms, an own integration of the equations of tendon robots, and invariances."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import pyrod
from pyrod import Clamp, Force, Gravity, Hinge, Joint, Moment, Rod, Scene, Section, Tendon
from pyrod.rotation import exp, log, multiply, rotate

LENGTH, DISTANCE = 0.242, 8e-3
STEEL = pyrod.Material(E=210e9, nu=0.3125)
WIRE = replace(Section.circle(0.4e-3, STEEL), GA1=np.inf, GA2=np.inf, EA=np.inf)
TIP_FORCE = (0.05, 0.1, -0.05)


def helix(s):
    turn = 2 * np.pi * s / LENGTH
    return DISTANCE * np.cos(turn), DISTANCE * np.sin(turn)


def converging(s):
    return DISTANCE * (1 - 0.7 * s / LENGTH), 0.0


def robot(tendons, loads=(), edges=8, space="spatial", rod=None, clamp=None):
    rod = rod or Rod.straight(LENGTH, edges, WIRE, "inextensible")
    return Scene(rod, clamp or Clamp(), loads, space, actuators=tendons)


PARALLEL = Tendon((DISTANCE, 0), 5)
HELICAL = Tendon(helix, 5)

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


def potential(frames, tension, offset, edges, force):
    """Bending and twisting, the work of one tendon and of a force along z at the tip."""
    h = LENGTH / edges
    clamp = np.array([1.0, 0, 0, 0])
    total = 0.0
    for j in range(edges):
        a = clamp if j == 0 else frames[j - 1]
        u = log(multiply(a * [1, -1, -1, -1], frames[j]))
        ds, start = (h / 2, 0.0) if j == 0 else (h, (j - 0.5) * h)
        stiffness = np.array([WIRE.EI1, WIRE.EI2, WIRE.GJ])
        total += (stiffness * u**2).sum() / (2 * ds)
        before, middle, behind = (
            np.array([*offset(start + part * ds), 0.0]) for part in (0, 0.5, 1)
        )
        v = np.array([0, 0, ds]) + behind - before + np.cross(u, middle)
        total += tension * np.linalg.norm(v)
        total -= force * h * rotate(frames[j], [0.0, 0, 1])[2]
    return total


def second_variation(result, tension, offset, force, step=2e-4):
    """The Hessian in rotation vectors of the edges, by differences of the potential."""
    frames = result.frames
    size = frames.size // 4 * 3

    def turned(x):
        return multiply(frames, exp(x.reshape(-1, 3)))

    def at(x):
        return potential(turned(x), tension, offset, len(frames), force)

    units = step * np.eye(size)
    there = [[at(s * a) for a in units] for s in (1, -1)]
    here = at(np.zeros(size))
    out = np.diag([(p - 2 * here + m) / step**2 for p, m in zip(*there, strict=True)])
    for i in range(size):
        for k in range(i):
            corners = [s * t * at(s * units[i] + t * units[k]) for s in (1, -1) for t in (1, -1)]
            out[i, k] = out[k, i] = sum(corners) / (4 * step**2)
    return out


@pytest.mark.parametrize(
    ("tension", "force"),
    [(5.0, 0.0), (25.0, 0.0), (2.0, -1.0), (0.5, -2.5), (1.0, -4.0)],
)
def test_the_index_counts_the_falling_directions_of_the_potential(tension, force):
    """A robot that is bent by its tendon and pressed at its tip falls out of the plane."""
    edges = 6
    loads = Force((0, 0, force))
    scene = robot(Tendon(converging, tension), loads, edges=edges)
    result = pyrod.solve(replace(scene, space="planar"), stable=False)
    result = pyrod.solve(scene, start=result, stable=False, eigenvalue=True, strict=False)
    assert result.converged
    H = second_variation(result, tension, converging, force)
    eigenvalues = np.linalg.eigvalsh(H)
    assert result.index == (eigenvalues < 0).sum()
    assert (result.index > 0) == (force < -2)
    # of K v = lambda M v, M the share of each edge in the length
    assert result.lowest_eigenvalue == pytest.approx(eigenvalues[0] * edges, rel=1e-4)


def test_what_would_fall_out_of_the_plane_settles_there():
    scene = robot(Tendon(converging, 2.0), Force((0, 0, -0.5)), edges=12)
    result = pyrod.solve(scene)
    assert result.index == 0
    assert max(result.balance) < 1e-12


@pytest.mark.parametrize("tension", [5.0, 20.0])
def test_tendons_alone_never_make_a_clamped_rod_unstable(tension):
    """Lengths of tendons are convex in the turns of the cells, which are free."""
    result = pyrod.solve(robot([Tendon(helix, tension), Tendon(converging, tension)]))
    assert result.index == 0
    assert result.descents == 0


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


# Given length -------------------------------------------------------------------------------------


def behind(s):
    """The same helix, a third of a turn further."""
    return helix(s + LENGTH / 3)


def pulled_by(lengths, loads=(), edges=8, EA=None, **more):
    offsets = [helix, behind]
    return robot(
        [Tendon(d, length=x * LENGTH, EA=EA) for d, x in zip(offsets, lengths, strict=False)],
        loads,
        edges,
        **more,
    )


def test_two_helices_pulled_by_five_and_two_percent():
    result = pyrod.solve(pulled_by((0.95, 0.98), Force(TIP_FORCE)))
    assert result.iterations <= 7  # the last looks whether there is more to do
    assert result.index == 0
    assert result.multipliers == 2
    for tendon, length in zip(result.tendons, (0.95, 0.98), strict=True):
        assert tendon.length == pytest.approx(length * LENGTH, rel=1e-13)
        assert not tendon.slack
    tensions = [tendon.tension for tendon in result.tendons]
    prescribed = [
        Tendon(helix, tensions[0]),
        Tendon(behind, tensions[1]),
    ]
    again = pyrod.solve(robot(prescribed, Force(TIP_FORCE)))
    assert np.abs(again.positions - result.positions).max() < 1e-12 * LENGTH


@pytest.mark.parametrize("tension", [0.5, 5.0, 12.0])
@pytest.mark.parametrize("space", ["planar", "spatial"])
def test_from_tension_to_length_and_back(tension, space):
    loads = Force((0.1, 0, -0.3))
    one = pyrod.solve(robot(Tendon(converging, tension), loads, space=space))
    held = Tendon(converging, length=one.tendons[0].length)
    back = pyrod.solve(robot(held, loads, space=space))
    assert back.tendons[0].tension == pytest.approx(tension, rel=1e-10)
    assert np.abs(back.positions - one.positions).max() < 1e-12 * LENGTH
    assert max(back.balance) < 1e-12


@pytest.mark.parametrize("EA", [30.0, 3e2, 1e4, 1e8])
def test_tendons_that_stretch(EA):
    length = 0.93 * LENGTH
    result = pyrod.solve(robot(Tendon(helix, length=length, EA=EA)))
    tendon = result.tendons[0]
    assert tendon.length == pytest.approx(length * (1 + tendon.tension / EA), rel=1e-13)
    same = pyrod.solve(robot(Tendon(helix, tendon.tension)))
    assert np.abs(same.positions - result.positions).max() < 1e-12 * LENGTH
    stiff = pyrod.solve(robot(Tendon(helix, length=length)))
    assert result.iterations <= stiff.iterations + 1


def test_long_tendons_are_slack():
    loads = Force((0.0, 0.2, 0))
    result = pyrod.solve(robot([Tendon((DISTANCE, 0), length=1.05 * LENGTH), HELICAL], loads))
    bare = pyrod.solve(robot(HELICAL, loads))
    assert result.tendons[0].slack
    assert result.tendons[0].tension == 0
    assert np.abs(result.positions - bare.positions).max() < 1e-12 * LENGTH
    assert result.tendons[0].length < 1.05 * LENGTH
    assert result.index == bare.index == 0


@pytest.mark.parametrize("share", [1.5, 10.0])
def test_much_too_long_tendons_are_slack(share):
    loads = Force((0.0, 0.2, 0))
    result = pyrod.solve(robot(Tendon(helix, length=share * LENGTH), loads))
    assert result.tendons[0].slack
    bare = pyrod.solve(robot((), loads))
    assert np.abs(result.positions - bare.positions).max() < 1e-12 * LENGTH


def test_a_slack_tendon_becomes_taut_when_the_rod_bends_away():
    """Two tendons of the rod's own length on both sides: one is slack under a load, one is not."""
    pair = [Tendon((x, 0), length=LENGTH) for x in (DISTANCE, -DISTANCE)]
    for sign in (1, -1):
        result = pyrod.solve(robot(pair, Force((0.3 * sign, 0, 0.0))))
        taut, slack = result.tendons[::-sign]
        assert slack.slack
        assert slack.length < LENGTH * (1 + 1e-12)
        assert not taut.slack
        assert taut.tension > 0
        assert taut.length == pytest.approx(LENGTH, rel=1e-13)


def test_given_lengths_to_a_tolerance():
    result = pyrod.solve(pulled_by((0.95, 0.98), Force(TIP_FORCE)), tol=1e-9)
    assert result.accuracy.regular
    assert result.tendons[0].length == pytest.approx(0.95 * LENGTH, rel=1e-12)
    tensions = [tendon.tension for tendon in result.tendons]
    prescribed = [
        Tendon(helix, tensions[0]),
        Tendon(behind, tensions[1]),
    ]
    again = pyrod.solve(robot(prescribed, Force(TIP_FORCE)), tol=1e-9)
    assert np.abs(again.tip - result.tip).max() < 1e-8 * LENGTH


def test_what_stretches_the_index_counts_motions_that_keep_lengths():
    """Held by its length a robot is stiffer than under the same tension."""
    one = pyrod.solve(robot(Tendon(converging, 5)), eigenvalue=True)
    held = Tendon(converging, length=one.tendons[0].length)
    other = pyrod.solve(robot(held), eigenvalue=True)
    assert other.lowest_eigenvalue >= one.lowest_eigenvalue - 1e-9
    assert other.index == 0


def test_given_length_with_inner_ends_supports_and_gravity():
    rod = Rod.straight(LENGTH, 12, replace(WIRE, mass_per_length=0.02), "inextensible")
    scene = Scene(
        rod,
        [Clamp(), Hinge((0.01, 0, 0.14), at=0.15)],
        Gravity((0, -9.81, 0)),
        actuators=[Tendon(helix, length=0.98 * 0.19, start=0.03, end=0.22)],
    )
    result = pyrod.solve(scene)
    assert result.converged
    assert max(result.balance) < 1e-12
    tendon = result.tendons[0]
    assert tendon.slack or tendon.length == pytest.approx(0.98 * 0.19, rel=1e-12)


def test_moments_on_ends_beside_a_given_length_are_refused():
    with pytest.raises(ValueError, match="give its tension"):
        pyrod.solve(robot(Tendon(helix, length=0.9 * LENGTH), Moment((0, 0.001, 0))))
    with pytest.raises(ValueError, match="on the axis"):
        pyrod.solve(robot(Tendon((0, 0), length=0.9 * LENGTH)))


def test_derivatives_by_a_length():
    def at(share):
        return pyrod.solve(pulled_by((share, 0.98), Force(TIP_FORCE)))

    told = pyrod.linearised(at(0.95)).jvp({"actuators.0.length": LENGTH})
    step = 1e-5
    ahead, before = at(0.95 + step), at(0.95 - step)
    for name in ("positions", "K", "moment"):
        slope = (getattr(ahead, name) - getattr(before, name)) / (2 * step)
        rows = slice(1, -1) if name == "K" else slice(None)  # at the ends it is told by the moment
        assert np.abs(told[name] - slope)[rows].max() < 1e-5 * max(np.abs(slope).max(), 1e-3)
    for i in (0, 1):
        slope = (ahead.tendons[i].tension - before.tendons[i].tension) / (2 * step)
        assert told[f"tendons.{i}.tension"] == pytest.approx(slope, rel=1e-5)
    assert told["tendons.0.length"] == pytest.approx(LENGTH, rel=1e-9)
