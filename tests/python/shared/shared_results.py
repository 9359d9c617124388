"""Results that the tests of files share: a plug-in of pytest that these name."""

from __future__ import annotations

import pytest

import pyrod
from pyrod import Clamp, Force, Gravity, Joint, Material, Rod, Scene, Section

TUBE = Section.tube(0.02, 0.01, Material(1e7, density=1000.0))


@pytest.fixture(scope="session")
def bent() -> pyrod.Equilibrium:
    """With all that a result may have."""
    rod = Rod.precurved(1.0, None, TUBE, (0.0, 1.0, 0.5))
    scene = Scene(rod, Clamp(), [Force((0.5, 1, 0.2), at=0.33), Gravity()])
    return pyrod.solve(scene, tol=1e-5, eigenvalue=True)


@pytest.fixture(scope="session")
def joined() -> pyrod.Equilibrium:
    """Rods of different numbers of edges, joined."""
    post = Rod.straight(1.0, 6, TUBE)
    beam = Rod.straight(1.0, 4, TUBE).placed((0, 0, 1), tangent=(1, 0, 0), normal=(0, 0, 1))
    joint = Joint(((0, "end"), (1, "start")))
    return pyrod.solve(Scene([post, beam], Clamp(), Force((0, 0, -3), (1, "end")), joints=joint))


@pytest.fixture(params=["bent", "joined"])
def result(request: pytest.FixtureRequest) -> pyrod.Equilibrium:
    return request.getfixturevalue(request.param)
