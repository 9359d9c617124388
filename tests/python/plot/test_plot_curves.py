"""Pictures of curves without mechanics."""

from __future__ import annotations

import matplotlib.pyplot as plt
import numpy as np
import pytest
from support import HELIX, KNOTS

from pyrod import rotation
from pyrod.curve import Polyline

ARC = HELIX.polyline(HELIX.even(30))
KNOT = KNOTS[0].polyline(KNOTS[0].even(60))
pytestmark = pytest.mark.usefixtures("close_figures")


def test_curves_in_space() -> None:
    ax = ARC.plot(linewidth=3)
    (line,) = ax.lines
    np.testing.assert_array_equal(np.transpose(line.get_data_3d()), ARC.positions)
    assert line.get_linewidth() == 3
    assert [ax.get_xlabel(), ax.get_ylabel(), ax.get_zlabel()] == ["x [m]", "y [m]", "z [m]"]
    assert KNOT.plot(ax) is ax
    around = np.transpose(ax.lines[1].get_data_3d())
    np.testing.assert_array_equal(around, np.vstack([KNOT.positions, KNOT.positions[:1]]))


def test_flat_curves() -> None:
    flat = Polyline([[0, 0], [3, 0], [3, 4]], closed=True)
    ax = flat.plot()
    assert ax.name == "rectilinear"
    assert ax.get_aspect() == 1
    np.testing.assert_array_equal(ax.lines[0].get_xydata(), [[0, 0], [3, 0], [3, 4], [0, 0]])
    space = plt.figure().add_subplot(projection="3d")
    flat.plot(space)
    assert np.shape(space.lines[0].get_data_3d()) == (3, 4)


@pytest.mark.parametrize("curve", [ARC, KNOT, Polyline([[0, 0], [3, 0], [3, 4]])], ids=repr)
def test_curves_coloured_by_values(curve: Polyline) -> None:
    ax = curve.plot(colour_by=curve.curvature(), label="curvature [1/m]")
    (lines,) = ax.collections
    np.testing.assert_allclose(lines.get_array(), curve.at_centres(curve.curvature()))
    assert ax.figure.axes[1].get_ylabel() == "curvature [1/m]"
    ax.figure.canvas.draw()
    if not curve.closed:
        ax = curve.plot(colour_by=curve.torsion())
        np.testing.assert_array_equal(ax.collections[0].get_array(), curve.torsion())
    with pytest.raises(ValueError, match=r"colour_by: expected .* values .one per vertex."):
        curve.plot(colour_by=[1.0, 2.0, 3.0, 4.0])


@pytest.mark.parametrize("curve", [ARC.bishop(), KNOT.closed_ribbon()], ids=repr)
def test_framed_curves_have_a_fringe_along_a1(curve, drawn_faces: list[np.ndarray]) -> None:
    ax = curve.plot()
    ax.figure.canvas.draw()
    (faces,) = drawn_faces
    arc = curve.polyline
    assert faces.shape == (arc.edges, 4, 3)
    across = faces[:, 3] - faces[:, 0]
    a1 = rotation.rotate(curve.vertex_frames[: arc.edges], [1.0, 0, 0])
    np.testing.assert_allclose(across, 0.03 * arc.length * a1, rtol=0, atol=1e-12)
