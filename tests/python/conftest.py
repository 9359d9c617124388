"""Settings of all Python tests, and what those of pictures share.

Property tests draw the same examples in every run.
"""

from collections.abc import Iterator

import matplotlib as mpl
import numpy as np
import pytest
from hypothesis import settings
from support import FLAT, ROUND, SOFT, solved

import pyrod

mpl.use("Agg")
settings.register_profile("fixed", derandomize=True, deadline=None, database=None, max_examples=40)
settings.load_profile("fixed")


@pytest.fixture
def close_figures() -> Iterator[None]:
    """Leaves no figure of a test to the next."""
    import matplotlib.pyplot as plt

    yield
    plt.close("all")


@pytest.fixture
def drawn_faces(monkeypatch: pytest.MonkeyPatch) -> list[np.ndarray]:
    """The faces of all collections in space that are drawn from now on."""
    from mpl_toolkits.mplot3d import art3d

    drawn: list[np.ndarray] = []

    class Recorded(art3d.Poly3DCollection):
        def __init__(self, faces: np.ndarray, **style: object) -> None:
            drawn.append(faces)
            super().__init__(faces, **style)

    monkeypatch.setattr(art3d, "Poly3DCollection", Recorded)
    return drawn


@pytest.fixture(scope="session")
def cantilever() -> pyrod.Equilibrium:
    """In space, curved at rest, with all strains and its lowest mode."""
    rod = pyrod.Rod.precurved(1.0, 10, SOFT, (0.3, 1.0, 0.5))
    return solved(rod, pyrod.Force((1, 3, -5)), eigenvalue=True)


@pytest.fixture(scope="session")
def planar_cantilever() -> pyrod.Equilibrium:
    """In the plane, inextensible, with its lowest mode."""
    rod = pyrod.Rod.straight(1.0, 10, FLAT)
    return solved(rod, pyrod.Force((1, 0, 0)), space="planar", eigenvalue=True)


@pytest.fixture(scope="session")
def joined_rods() -> pyrod.Equilibrium:
    """Two rods of different models, the second at the end of the first, with the lowest mode."""
    rods = [
        pyrod.Rod.straight(1.0, 6, SOFT),
        pyrod.Rod.straight(1.0, 5, ROUND).placed((0, 0, 1), tangent=(1, 0, 0)),
    ]
    joint = pyrod.Joint(((0, "end"), (1, "start")))
    load = pyrod.Force((0, 2, -1), at=(1, "end"))
    return pyrod.solve(pyrod.Scene(rods, pyrod.Clamp(), load, joints=joint), eigenvalue=True)
