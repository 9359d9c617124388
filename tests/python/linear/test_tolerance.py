"""Derivatives of results with a tolerance, and their errors."""

from __future__ import annotations

import numpy as np
import pytest

import pyrod
from pyrod import Clamp, Force, Hinge, Linearised, Rod, Scene, Section

UNIT = Section(EI1=1.0, EI2=1.0, GJ=0.8, mass_per_length=1.0)
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


def test_what_belongs_to_one_grid(elastica: Linearised) -> None:
    with pytest.raises(ValueError, match="one grid"):
        elastica.vjp({"tip": (1, 0, 0)})
    with pytest.raises(ValueError, match="one grid"):
        elastica.jacobian("tip", "rods.0.K0")
    with pytest.raises(ValueError, match="with a tolerance"):
        elastica.jacobian("K", "loads.0.force")
