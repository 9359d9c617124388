"""Pictures: the lines carry the vertices, scales are equal, given axes are used."""

from __future__ import annotations

import matplotlib.pyplot as plt
import numpy as np
import pytest
from support import ROUND, SOFT, solved

import pyrod
from pyrod import Clamp, Force, Rod, rotation

CLAMP = Clamp((1, 2, 3), tangent=(1, 0, 0), normal=(0, 0, 1))
pytestmark = pytest.mark.usefixtures("close_figures")


@pytest.fixture
def planar() -> pyrod.Equilibrium:
    return solved(Rod.straight(1.0, 10, ROUND), Force((0, 0, -5)), clamp=CLAMP, space="planar")


@pytest.fixture
def spatial() -> pyrod.Equilibrium:
    return solved(Rod.straight(1.0, 10, SOFT), Force((1, 3, -5)), clamp=CLAMP)


def test_planar_rods_are_drawn_in_the_plane_of_the_clamp(planar: pyrod.Equilibrium) -> None:
    ax = planar.plot()
    (line,) = ax.lines
    local = planar.positions - [1, 2, 3]
    np.testing.assert_allclose(line.get_xydata(), local[:, [0, 2]], rtol=0, atol=1e-15)
    assert ax.get_aspect() == 1
    assert ax.name == "rectilinear"
    assert "a3" in ax.get_xlabel()
    assert "a1" in ax.get_ylabel()


def test_spatial_rods_are_drawn_in_space(spatial: pyrod.Equilibrium) -> None:
    ax = spatial.plot()
    (line,) = ax.lines
    np.testing.assert_array_equal(np.transpose(line.get_data_3d()), spatial.positions)
    assert [ax.get_xlabel(), ax.get_ylabel(), ax.get_zlabel()] == ["x [m]", "y [m]", "z [m]"]
    assert ax.name == "3d"


def test_the_fringe_lies_along_a1(
    spatial: pyrod.Equilibrium, drawn_faces: list[np.ndarray]
) -> None:
    ax = spatial.plot()
    (faces,) = drawn_faces
    assert [type(c).__name__ for c in ax.collections] == ["Recorded"]
    a1 = rotation.rotate(spatial.vertex_frames, (1, 0, 0))
    np.testing.assert_allclose(faces[:, 0], spatial.positions[:-1], rtol=0, atol=1e-15)
    np.testing.assert_allclose(faces[:, 3] - faces[:, 0], 0.03 * a1[:-1], rtol=0, atol=1e-15)


def test_the_fringe_may_be_left_out(spatial: pyrod.Equilibrium) -> None:
    assert not list(spatial.plot(directors=False).collections)


def test_scales_in_space_are_equal_and_hold_the_rod(spatial: pyrod.Equilibrium) -> None:
    ax = spatial.plot()
    limits = np.array([ax.get_xlim(), ax.get_ylim(), ax.get_zlim()])
    scales = np.ptp(limits, axis=1) / ax.get_box_aspect()
    np.testing.assert_allclose(scales, scales[0], rtol=1e-12)
    assert (limits[:, 0] <= spatial.positions.min(axis=0)).all()
    assert (limits[:, 1] >= spatial.positions.max(axis=0)).all()


def test_scales_stay_equal_with_a_second_rod(spatial: pyrod.Equilibrium) -> None:
    ax = spatial.plot()
    other = solved(Rod.straight(5.0, 10, ROUND), clamp=Clamp((-3, 0, 0)))
    assert other.plot(ax) is ax
    limits = np.array([ax.get_xlim(), ax.get_ylim(), ax.get_zlim()])
    scales = np.ptp(limits, axis=1) / ax.get_box_aspect()
    np.testing.assert_allclose(scales, scales[0], rtol=1e-12)
    r = np.vstack([spatial.positions, other.positions])
    assert (limits[:, 0] <= r.min(axis=0)).all()
    assert (limits[:, 1] >= r.max(axis=0)).all()
    assert len(ax.lines) == 2


@pytest.mark.parametrize("kind", ["planar", "spatial"])
def test_given_axes_and_style_are_used(kind: str, request: pytest.FixtureRequest) -> None:
    result = request.getfixturevalue(kind)
    ax = plt.figure().add_subplot(projection="3d" if kind == "spatial" else None)
    figures = plt.get_fignums()
    assert result.plot(ax, color="red", linestyle="--") is ax
    assert plt.get_fignums() == figures
    (line,) = ax.lines
    assert (line.get_color(), line.get_linestyle()) == ("red", "--")


@pytest.mark.parametrize("kind", ["planar", "spatial"])
def test_pictures_can_be_saved(kind: str, request: pytest.FixtureRequest, tmp_path) -> None:
    ax = request.getfixturevalue(kind).plot()
    ax.figure.savefig(tmp_path / "rod.png")
    pixels = plt.imread(tmp_path / "rod.png")
    assert pixels.std() > 0.01
