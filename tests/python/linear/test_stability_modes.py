"""The lowest modes of the second variation."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from test_derivatives import SCENES

import pyrod
from pyrod import Clamp, Force, Rod, Scene, Section
from pyrod.pictures.displaced import mode_displacements

UNIT = Section(EI1=1.0, EI2=1.0, GJ=0.8)


def column(P: float, edges: int = 32) -> Scene:
    rod = Rod.straight(2.0, edges, UNIT)
    return Scene(rod, Clamp(), Force((0, 0, -P)), space="planar")


def test_a_column() -> None:
    """L (EI ((k - 1/2) pi/L)^2 - P), below and beyond the first two critical loads."""
    for P, index in ((0.3, 0), (3.0, 1), (9.0, 2)):
        result = pyrod.solve(column(P), tol=1e-8, stable=False)
        assert result.index == index
        modes = pyrod.linearised(result).stability_modes(4)
        exact = 2 * (((np.arange(1, 5) - 0.5) * np.pi / 2) ** 2 - P)
        assert modes.eigenvalues == pytest.approx(exact, rel=1e-8)
        assert (modes.eigenvalues < 0).sum() == index
        assert modes.errors is not None
        assert (modes.errors < 1e-6).all()
        assert f"{exact[0]:.4g}" in modes.title(0)


@pytest.mark.parametrize("make", SCENES, ids=lambda make: make.__name__)
def test_the_first_is_the_lowest_eigenvalue(make: Callable[[], Scene]) -> None:
    result = pyrod.solve(make(), eigenvalue=True)
    lin = pyrod.linearised(result)
    if result.index < 0:
        with pytest.raises(ValueError, match="potential"):
            lin.stability_modes(1)
        return
    modes = lin.stability_modes(3)
    assert modes.eigenvalues[0] == pytest.approx(result.lowest_eigenvalue, rel=1e-6)
    assert (modes.eigenvalues < 0).sum() == min(result.index, 3)
    assert (np.diff(modes.eigenvalues) >= 0).all()


def test_shapes_are_those_of_the_lowest_mode() -> None:
    rod = Rod.precurved(1.0, 40, Section(EI1=1.0, EI2=1.5, GJ=0.8), (0.3, 1.0, 0.5))
    result = pyrod.solve(Scene(rod, Clamp(), Force((2, 3, -1.5))), eigenvalue=True)
    modes = pyrod.linearised(result).stability_modes(2)
    turns = modes.frames[0][0]
    assert (turns**2).sum() / 40 == pytest.approx(1, rel=1e-9)
    assert result.mode is not None
    along = (turns * result.mode).sum() / np.linalg.norm(turns) / np.linalg.norm(result.mode)
    assert abs(along) == pytest.approx(1, abs=1e-9)
    (moves,) = mode_displacements(result)
    scale = moves.ravel() @ modes.shapes[0][0].ravel() / (moves**2).sum()
    assert modes.shapes[0][0] == pytest.approx(scale * moves, abs=1e-6 * abs(scale))


def test_those_of_a_saddle_are_all_told() -> None:
    """Many negative ones, of which the lowest are wanted only."""
    result = pyrod.solve(column(200.0, 64), stable=False)
    exact = np.linalg.eigvalsh(_stiffness(200.0, 64))[:8]
    modes = pyrod.linearised(result).stability_modes(8)
    assert result.index == 9
    assert modes.eigenvalues == pytest.approx(exact, rel=1e-9)


def _stiffness(P: float, n: int) -> np.ndarray:
    """Of the straight column, edge by edge, for weights h/L: L/h times it."""
    h = 2.0 / n
    K = np.zeros((n, n))
    for j in range(n - 1):
        K[j : j + 2, j : j + 2] += np.array([[1, -1], [-1, 1]]) / h
    K[0, 0] += 2 / h
    return (K - P * h * np.eye(n)) * 2.0 / h


def test_refusals() -> None:
    lin = pyrod.linearised(pyrod.solve(column(0.3, 4)))
    for wrong in (0, 1.5, True, "two"):
        with pytest.raises(ValueError, match="1 or more"):
            lin.stability_modes(wrong)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="fewer than 5"):
        lin.stability_modes(5)
