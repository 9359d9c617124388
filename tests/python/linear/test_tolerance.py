"""Derivatives of results with a tolerance, and their errors."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import pyrod
from pyrod import Clamp, Force, Hinge, Linearised, Rod, Scene, Section
from pyrod.base.immutable import Array

UNIT = Section(EI1=1.0, EI2=1.0, GJ=0.8, mass_per_length=1.0)
SOFT = Section(EI1=1.0, EI2=1.4, GJ=0.8, GA1=40.0, GA2=50.0, EA=60.0)
BENT = np.array([7.2049919149637, 23.4333018500811, 57.2104562866074, 114.4770912455378])


@pytest.fixture(scope="module")
def elastica() -> Linearised:
    rod = Rod.straight(1.0, 32, UNIT)
    scene = Scene(rod, Clamp(), Force((10.0, 0, 0)), space="planar")
    return pyrod.linearised(pyrod.solve(scene, tol=1e-10))


def test_products_to_all_digits(elastica: Linearised) -> None:
    change = elastica.jvp({"loads.0.force": (1, 0, 0)})
    across, _, along = change["tip"]
    found = [along, across, change["tip_frame"][1], -change["reactions.0.moment"][1]]
    expected = [-0.0215494661655, 0.0105359712168, 0.0222664098397, 0.2295097405916]
    assert found == pytest.approx(expected, abs=1e-12)
    errors = dict(elastica.errors)
    assert 0 < errors["rods.0.positions"] < 1e-10
    assert "K" not in change
    J = elastica.jacobian("tip", "loads.0.force")["loads.0.force"]
    assert J[:, 0] == pytest.approx(change["tip"], abs=1e-12)
    C = elastica.compliance()
    assert C[0, 0] == pytest.approx(expected[1], abs=1e-12)


def test_frequencies_with_their_errors(elastica: Linearised) -> None:
    modes = elastica.modes(4)
    assert modes.angular_frequencies == pytest.approx(BENT, rel=1e-9)
    off = np.abs(modes.angular_frequencies - BENT) / (2 * np.pi)
    assert modes.errors is not None
    assert (off <= modes.errors + 1e-12).all()
    assert (modes.errors < 1e-8 * modes.frequencies).all()


def test_in_space() -> None:
    """Odd powers of h, and a support; against differences of solves."""

    def scene(x: float) -> Scene:
        rod = Rod.precurved(1.0, 16, UNIT, (0.5, 1.0, 0.3))
        supports = [Clamp((0, 0, 0)), Hinge((x, 0.1, 0.7), at="end")]
        return Scene(rod, supports, Force((0.5, 1.0, 0), at=0.5))

    result = pyrod.solve(scene(0.2), tol=1e-9)
    linear = pyrod.linearised(result)
    J = linear.jacobian("reactions.1.force", "supports.1.position")["supports.1.position"]
    h = 0.004
    ahead, behind = (pyrod.solve(scene(0.2 + s * h), tol=1e-10, start=result) for s in (1, -1))
    far, back = (pyrod.solve(scene(0.2 + 2 * s * h), tol=1e-10, start=result) for s in (1, -1))
    force = [r.reactions[1].force for r in (ahead, behind, far, back)]
    slope = (8 * (force[0] - force[1]) - (force[2] - force[3])) / (12 * h)
    assert J[:, 0] == pytest.approx(slope, rel=1e-6)
    assert linear.errors["supports.1.position"] < 1e-7
    assert pytest.approx(J.T, rel=1e-8) == J
    K = linear.stiffness(1)[:3, :3]
    assert pytest.approx(J, rel=1e-7) == K


def arch(**arrays: Array) -> Scene:
    rod = Rod.precurved(1.0, 8, SOFT, (0.5, 1.0, 0.3))
    supports = [Clamp((0, 0, 0), frame=(1, 0, 0, 0)), Hinge((0.2, 0.1, 0.7), at="end")]
    return Scene(replace(rod, **arrays), supports, Force((0.5, 1.0, 0), at=0.5))


@pytest.mark.parametrize("name", ["K0", "bending", "stretching"])
def test_arrays_of_rods(name: str) -> None:
    """In the numbers that the user gave, as finer edges have them: against solves."""
    value = getattr(arch().rods[0], name)
    v = np.random.default_rng(3).standard_normal(value.shape)
    if name != "K0":
        value = value * (1 + 0.1 * np.cos(np.arange(len(value))))[:, None]
        v = 0.3 * v * value
    result = pyrod.solve(arch(**{name: value}), tol=1e-10)
    linear = pyrod.linearised(result)
    path = f"rods.0.{name}"
    change = linear.jvp({path: v})

    def force(t: float) -> Array:
        return (
            pyrod.solve(arch(**{name: value + t * v}), tol=1e-10, start=result).reactions[1].force
        )

    h = 3e-3
    slope = (8 * (force(h) - force(-h)) - force(2 * h) + force(-2 * h)) / (12 * h)
    assert change["reactions.1.force"] == pytest.approx(slope, abs=1e-6 * np.abs(slope).max())
    assert linear.errors["reactions.1.force"] < 1e-6
    weights = np.array([0.3, -1.0, 0.5])
    gradient = linear.vjp({"reactions.1.force": weights}, path)[path]
    assert gradient.shape == value.shape
    assert np.sum(gradient * v) == pytest.approx(weights @ change["reactions.1.force"], rel=1e-6)
    assert 0 < linear.errors[path] < 1e-6
    J = linear.jacobian("reactions.1.force", path)[path]
    assert np.tensordot(weights, J, 1) == pytest.approx(gradient, abs=1e-6 * np.abs(gradient).max())


def test_gradients_backwards(elastica: Linearised) -> None:
    """The transpose of what goes forward, in all paths at once."""
    weights = np.random.default_rng(2).standard_normal((33, 3)) * [1, 0, 1]
    gradient = elastica.vjp({"positions": weights, "energy": 0.7})
    change = elastica.jvp({"loads.0.force": (1.0, 0, 0.3)})
    forward = np.sum(weights * change["positions"]) + 0.7 * change["energy"]
    backward = gradient["loads.0.force"][[0, 2]] @ (1.0, 0.3)
    assert backward == pytest.approx(forward, rel=1e-9)
    assert gradient["rods.0.K0"].shape == (33, 3)
    K0 = elastica.jvp({"rods.0.K0": np.tile([0, 1.0, 0], (33, 1))})
    forward = np.sum(weights * K0["positions"]) + 0.7 * K0["energy"]
    assert gradient["rods.0.K0"][:, 1].sum() == pytest.approx(forward, rel=1e-8)


def test_longer_edges_are_a_larger_force(elastica: Linearised) -> None:
    """A rod x times as long is as bent under a force x**-2 times as large: forward and backward."""
    rod, force = elastica.result.scene.rods[0], elastica.result.scene.loads[0].force
    path = "rods.0.edge_lengths"
    change = elastica.jvp({path: rod.edge_lengths})["tip"]
    by_force = elastica.jvp({"loads.0.force": 2 * force})["tip"]
    assert change == pytest.approx(elastica.result.tip + by_force, abs=1e-8)
    weights = np.array([0.3, 0, -1.0])
    gradient = elastica.vjp({"tip": weights}, path)[path]
    assert gradient.shape == rod.edge_lengths.shape
    assert gradient @ rod.edge_lengths == pytest.approx(weights @ change, rel=1e-8)
    v = np.random.default_rng(1).standard_normal(len(gradient)) * rod.edge_lengths
    assert gradient @ v == pytest.approx(weights @ elastica.jvp({path: v})["tip"], rel=1e-6)


def test_what_belongs_to_one_grid(elastica: Linearised) -> None:
    with pytest.raises(ValueError, match="with a tolerance"):
        elastica.vjp({"frames": np.ones((32, 3))})
    with pytest.raises(ValueError, match="with a tolerance"):
        elastica.vjp({"multipliers": np.ones((1, 3))})
    with pytest.raises(ValueError, match="with a tolerance"):
        elastica.jacobian("K", "loads.0.force")
