"""Tendons of given length: tensions found, slack, stretch, derivatives."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from tendon_robots import DISTANCE, HELICAL, LENGTH, TIP_FORCE, WIRE, converging, helix, robot

import pyrod
from pyrod import Clamp, Force, Gravity, Hinge, Moment, Rod, Scene, Tendon


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
