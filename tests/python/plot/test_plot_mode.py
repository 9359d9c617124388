"""The picture of the lowest mode, and how points move in it."""

from __future__ import annotations

import matplotlib.pyplot as plt
import numpy as np
import pytest
from support import FLAT, solved

import pyrod
from pyrod import Clamp, Force, Hinge, Rod, Scene, Section, Slider
from pyrod.pictures.displaced import mode_displacements

Equilibrium = pyrod.Equilibrium
pytestmark = pytest.mark.usefixtures("close_figures")


def test_the_mode_is_drawn_on_both_sides(cantilever: Equilibrium) -> None:
    ax = cantilever.plot(what="stability")
    shape, there, back = (np.transpose(line.get_data_3d()) for line in ax.lines)
    np.testing.assert_array_equal(shape, cantilever.positions)
    np.testing.assert_allclose(there - shape, shape - back, atol=1e-15)
    size = np.linalg.norm(there - shape, axis=1).max()
    assert size == pytest.approx(0.1 * np.ptp(cantilever.positions, axis=0).max(), rel=1e-12)
    assert f"index 0, eigenvalue {cantilever.lowest_eigenvalue:.4g} N m" in ax.get_title()


def test_the_mode_of_a_planar_scene_is_drawn_in_its_plane(planar_cantilever: Equilibrium) -> None:
    ax = plt.figure().add_subplot()
    assert planar_cantilever.plot(ax, what="stability") is ax
    shape, there, _ = (line.get_xydata() for line in ax.lines)
    np.testing.assert_allclose(shape, planar_cantilever.positions[:, [2, 0]], atol=1e-15)
    assert (np.abs(there - shape)[1:] > 1e-4).any(axis=1).all()


def test_a_neutral_mode_is_told() -> None:
    scene = Scene(Rod.straight(1.0, 4, FLAT), [Hinge(at="start"), Hinge(at="end")])
    assert "neutral" in pyrod.solve(scene, eigenvalue=True).plot(what="stability").get_title()


def test_a_mode_needs_to_be_asked_for() -> None:
    result = solved(Rod.straight(1.0, 4, FLAT), Force((1, 0, 0)))
    with pytest.raises(ValueError, match="no mode; solve with eigenvalue=True"):
        result.plot(what="stability")
    assert not plt.get_fignums()


def test_displacements_are_the_derivative_of_the_shape(cantilever: Equilibrium) -> None:
    """Of an inextensible rod turned by a small amount along the mode, and put together again."""
    rod = Rod.precurved(1.0, 10, Section(1, 1.3, 0.8), (0.3, 1.0, 0.5))
    result = solved(rod, Force((1, 3, -5)), eigenvalue=True)
    shapes = []
    for amplitude in (1e-5, -1e-5):
        a3 = pyrod.rotation.rotate(result.along_mode(amplitude), (0, 0, 1))
        shapes.append(np.vstack([np.zeros(3), np.cumsum(0.1 * a3, axis=0)]))
    (moves,) = mode_displacements(result)
    np.testing.assert_allclose(moves, (shapes[0] - shapes[1]) / 2e-5, atol=1e-9)


def test_buckling_of_a_column_held_at_both_ends() -> None:
    """Clamped, and clamped in a slider: the displacement is 1 - cos(2 pi s)."""
    ends = [Clamp(), Slider((0, 0, 1), clamped=True)]
    rod = Rod.straight(1.0, 64, FLAT)
    result = pyrod.solve(Scene(rod, ends, Force((0, 0, -38.0), at="end")), eigenvalue=True)
    (moves,) = mode_displacements(result)
    expected = (1 - np.cos(2 * np.pi * result.s)) / 2
    np.testing.assert_allclose(np.abs(moves[:, 0]) / np.abs(moves).max(), expected, atol=1e-3)
    np.testing.assert_allclose(moves[:, 1:], 0, atol=1e-9)


def test_sway_of_a_column_that_slides_across() -> None:
    """Both ends keep their direction: the displacement is (1 - cos(pi s))/2."""
    ends = [Clamp(), Slider((1, 0, 0), clamped=True)]
    result = pyrod.solve(Scene(Rod.straight(1.0, 64, FLAT), ends), eigenvalue=True)
    (moves,) = mode_displacements(result)
    expected = (1 - np.cos(np.pi * result.s)) / 2
    np.testing.assert_allclose(moves[:, 0] / moves[-1, 0], expected, atol=1e-3)
    np.testing.assert_allclose(moves[0], 0, atol=1e-12)


def test_displacements_of_rods_held_elsewhere_and_joined(joined_rods: Equilibrium) -> None:
    first, second = mode_displacements(joined_rods)
    np.testing.assert_allclose(first[0], 0, atol=1e-12)
    np.testing.assert_allclose(first[-1], second[0], atol=1e-12)
    rod = Rod.straight(1.0, 6, FLAT)
    held = pyrod.solve(Scene(rod, Clamp(at="end"), Force((1, 0, 0), at="start")), eigenvalue=True)
    (moves,) = mode_displacements(held)
    np.testing.assert_allclose(moves[-1], 0, atol=1e-12)
    assert np.linalg.norm(moves[0]) > 0.1
