"""Where there is no derivative, in words."""

from __future__ import annotations

from contextlib import suppress

import numpy as np
import pytest

import pyrod
from pyrod import Clamp, Force, Hinge, Joint, Moment, Rod, Scene, Section, Slider
from pyrod.rotation import exp, rotate

UNIT = Section(EI1=1.0, EI2=1.0, GJ=0.8)


def test_at_a_critical_load() -> None:
    """On the grid's own, where the column is about to buckle."""
    rod = Rod.straight(1.0, 16, UNIT)
    scene = Scene(rod, Clamp(), Force((0, 0, -1.0)), space="planar")
    factor = pyrod.critical_load(scene).grid_factor
    heavy = Scene(rod, Clamp(), Force((0, 0, -factor)), space="planar")
    result = pyrod.solve(heavy, stable=False)
    with pytest.raises(pyrod.SingularEquilibrium, match="critical"):
        pyrod.linearised(result)


def test_forces_that_are_not_determined() -> None:
    """A straight inextensible rod between clamps may carry any axial force."""
    scene = Scene(Rod.straight(1.0, 16, UNIT), [Clamp(), Clamp((0, 0, 1.0), at="end")])
    linear = pyrod.linearised(pyrod.solve(scene))
    change = linear.jvp({"rods.0.K0": np.tile([0, 0, 0.1], (17, 1))})
    assert np.isnan(change["force"]).all()
    assert np.isnan(change["reactions.1.force"]).all()
    assert np.isfinite(change["positions"]).all()
    assert np.abs(change["frames"]).max() > 0.05  # it twists
    with pytest.raises(ValueError, match="not determined"):
        linear.vjp({"force": np.ones((16, 3))})
    with pytest.raises(ValueError, match="cannot stretch"):
        linear.jvp({"supports.1.position": (0, 0, 1.0)})
    with pytest.raises(pyrod.SingularEquilibrium):  # nor be pulled longer
        linear.stiffness(1)


BEND = {"rods.0.K0": np.tile([0.1, 0, 0], (17, 1))}


def test_shapes_that_are_not_determined() -> None:
    """Nothing bends a straight rod whose ends cannot come closer; its force may be anything."""
    scene = Scene(Rod.straight(1.0, 16, UNIT), [Clamp(), Clamp((0, 0, 1.0), at="end")])
    linear = pyrod.linearised(pyrod.solve(scene))
    with pytest.raises(pyrod.SingularEquilibrium, match="straight"):
        linear.jvp(BEND)
    with pytest.raises(pyrod.SingularEquilibrium, match="straight"):
        linear.vjp({"positions": np.ones((17, 3))}, "rods.0.K0")
    with pytest.raises(pyrod.SingularEquilibrium, match="straight"):
        linear.compliance(0.5)


def test_gradients_that_are_not_determined() -> None:
    """Of what nothing asks for by name they are NaN; twist is known."""
    scene = Scene(Rod.straight(1.0, 16, UNIT), [Clamp(), Clamp((0, 0, 1.0), at="end")])
    linear = pyrod.linearised(pyrod.solve(scene))
    weights = np.random.default_rng(1).standard_normal((16, 3))
    gradient = linear.vjp({"frames": weights})
    assert np.isnan(gradient["rods.0.K0"][1:-1, :2]).all()
    twist = gradient["rods.0.K0"][:, 2]
    assert np.isfinite(twist).all()
    v = np.outer(np.cos(np.arange(17)), [0, 0, 1.0])
    change = linear.jvp({"rods.0.K0": v})
    assert v[:, 2] @ twist == pytest.approx(np.sum(weights * change["frames"]), rel=1e-9)


def test_gradients_of_taut_rods() -> None:
    """A part in 10^10 longer than its supports are apart: what bends it is not known."""
    supports = [Clamp(), Hinge((0, 0, 1.0 - 1e-10), at="end")]
    scene = Scene(Rod.straight(1.0, 16, UNIT), supports, Force((0, 1e-3, 0), at=0.5))
    linear = pyrod.linearised(pyrod.solve(scene))
    gradient = linear.vjp({"tip_frame": (0, 0, 1.0)})
    assert np.isnan(gradient["supports.1.position"]).any() or np.isnan(gradient["rods.0.K0"]).any()
    assert np.isfinite(gradient["rods.0.K0"][:, 2]).all()


def taut(gap: float, turn: np.ndarray, force: float = 1e-3) -> np.ndarray:
    """What a force does to a rod that is nearly as long as its supports are apart, turned in space
    and turned back: only rounding can tell that it was."""
    frame = exp(turn)
    end = 0.3 * turn + rotate(frame, np.array([0, 0, 1.0 - gap]))
    supports = [Clamp(0.3 * turn, frame=frame), Hinge(end, at="end")]
    load = Force(rotate(frame, np.array([0, force, 0])), at=0.5)
    linear = pyrod.linearised(pyrod.solve(Scene(Rod.straight(1.0, 16, UNIT), supports, load)))
    change = linear.jvp({"loads.0.force": rotate(frame, np.array([0.3, 0.1, 0]))})
    return rotate(frame * [1, -1, -1, -1], change["positions"])


def test_what_rounding_of_taut_rods_leaves() -> None:
    """It is told as long as it is right to a millionth: five different roundings agree."""
    turns = np.random.default_rng(2).standard_normal((5, 3))
    told = 0
    for gap in 10.0 ** -np.arange(6, 12):
        found = []
        for turn in turns:
            with suppress(pyrod.SingularEquilibrium):
                found.append(taut(gap, turn))
        told += len(found)
        for one in found:
            assert one == pytest.approx(found[0], abs=4e-6 * np.abs(found[0]).max())
    assert 15 <= told <= 20  # up to 1e-8 all, from 1e-10 on none


def test_no_equilibrium() -> None:
    scene = Scene(Rod.straight(1.0, 8, UNIT), Clamp(), Force((30.0, 2.0, 0)))
    result = pyrod.solve(scene, pyrod.Options(max_iterations=1), strict=False)
    with pytest.raises(ValueError, match="no equilibrium"):
        pyrod.linearised(result)


def test_names() -> None:
    scene = Scene(Rod.straight(1.0, 8, UNIT), Clamp(), Force((1.0, 0, 0)))
    linear = pyrod.linearised(pyrod.solve(scene))
    for wrong in ("rods.0.model", "loads.0.at", "loads.0", "rods.0.placement"):
        with pytest.raises(ValueError, match=r"rods|loads"):
            linear.jvp({wrong: 1.0})
    with pytest.raises(ValueError, match="there is no"):
        linear.jacobian("tap", "loads.0.force")
    with pytest.raises(ValueError, match="no vertex"):
        linear.compliance(0.03)
    with pytest.raises(ValueError, match="shape"):
        linear.jvp({"loads.0.force": 1.0})
    with pytest.raises(ValueError, match="shape"):
        linear.vjp({"tip": 1.0})
    with pytest.raises(ValueError, match="none"):
        linear.jvp({})


def test_places_that_no_longer_are_vertices() -> None:
    """With other lengths of edges the arc length of a support is elsewhere on the rod."""
    supports = [Clamp((0, 0, 0)), Hinge((0.1, 0, 0.45), at=0.5)]
    linear = pyrod.linearised(pyrod.solve(Scene(Rod.straight(1.0, 8, UNIT), supports)))
    with pytest.raises(ValueError, match="edges"):
        linear.jacobian("tip", "rods.0.edge_lengths")


def test_what_jumps() -> None:
    """Rods that meet at rest are joined as they meet; apart, their directions are aligned."""
    post = Rod.straight(1.0, 8, UNIT)
    beam = Rod.straight(0.8, 6, UNIT).placed((0, 0, 1.0), tangent=(1, 0, 0.1))
    scene = Scene([post, beam], Clamp((0, 0, 0)), joints=Joint([(0, "end"), (1, "start")]))
    linear = pyrod.linearised(pyrod.solve(scene))
    with pytest.raises(ValueError, match="jumps"):
        linear.jvp({"rods.0.edge_lengths": np.ones(8)})


def test_directions_of_supports() -> None:
    supports = [Clamp((0, 0, 0)), Slider((1, 0, 0.5), at="end")]
    scene = Scene(Rod.straight(1.0, 8, UNIT), supports, Force((1.0, 0.3, 0), at=0.5))
    linear = pyrod.linearised(pyrod.solve(scene))
    with pytest.raises(ValueError, match="directions"):
        linear.jvp({"supports.1.along": (0, 1, 0)})


def test_changes_that_leave_the_plane() -> None:
    scene = Scene(Rod.straight(1.0, 8, UNIT), Clamp(), Force((1.0, 0, 0)), space="planar")
    linear = pyrod.linearised(pyrod.solve(scene))
    J = linear.jacobian("tip", "loads.0.force")["loads.0.force"]
    assert np.isnan(J[:, 1]).all()
    assert np.isfinite(J[:, [0, 2]]).all()
    with pytest.raises(ValueError, match="spatial"):
        linear.jvp({"loads.0.force": (0, 1.0, 0)})


def test_beside_a_moment_inside_of_a_rod() -> None:
    scene = Scene(Rod.straight(1.0, 8, UNIT), Clamp(), Moment((0, 1.0, 0.2), at=0.5))
    change = pyrod.linearised(pyrod.solve(scene)).jvp({"loads.0.moment": (0, 1.0, 0)})
    for name in ("K", "moment", "vertex_frames"):
        assert np.isnan(change[name]).any(axis=1).nonzero()[0].tolist() == [4]
    assert np.isnan(change["energy"])
    assert np.isfinite(change["positions"]).all()


def test_modes() -> None:
    rod = Rod.straight(1.0, 8, UNIT)
    linear = pyrod.linearised(pyrod.solve(Scene(rod, Clamp())))
    with pytest.raises(ValueError, match="mass"):
        linear.modes()
    heavy = Rod.straight(1.0, 8, Section(EI1=1.0, EI2=1.5, GJ=0.8, mass_per_length=1.0))
    saddle = pyrod.solve(Scene(heavy, Clamp(), Force((0, 0, -10.0))), stable=False)
    with pytest.raises(ValueError, match="unstable, with index 2"):
        pyrod.linearised(saddle).modes()
    with pytest.raises(ValueError, match="1 or more"):
        linear.modes(0)
