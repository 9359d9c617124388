"""Curves in files: tables, what ParaView reads, surfaces; and lines of other programs."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from support import HELIX, KNOTS, uninstall

import pyrod
from pyrod import CurveWarning
from pyrod.curve import FramedCurve, Polyline

pyvista = pytest.importorskip("pyvista")

ARC = HELIX.polyline(HELIX.even(30))
KNOT = KNOTS[0].polyline(KNOTS[0].even(60))


@pytest.mark.parametrize("suffix", [".vtp", ".vtk"])
@pytest.mark.parametrize("curve", [ARC, KNOT, ARC.bishop(), KNOT.closed_ribbon()], ids=repr)
def test_curves_come_back(curve: Polyline | FramedCurve, suffix: str, tmp_path: Path) -> None:
    path = tmp_path / f"curve{suffix}"
    curve.save(path)
    (found,) = pyrod.load_curves(path)
    arc = curve.polyline if isinstance(curve, FramedCurve) else curve
    np.testing.assert_array_equal(found.polyline.positions, arc.positions)
    assert found.polyline.closed == arc.closed
    np.testing.assert_array_equal(found.columns["s"], arc.arc_lengths)
    np.testing.assert_array_equal(found.columns["curvature"], arc.curvature(ends="continued"))
    if isinstance(curve, FramedCurve):
        columns = [found.columns[name] for name in ("a1", "a2", "a3")]
        again = pyrod.curve.from_poses(
            (arc.positions, np.stack(columns, axis=2)), closed=arc.closed
        )
        assert again.twist == pytest.approx(curve.twist, abs=4e-2)


def test_tables_of_curves(tmp_path: Path) -> None:
    path = tmp_path / "curve.csv"
    ARC.bishop().save(path)
    table = np.genfromtxt(path, delimiter=",", names=True)
    assert table.dtype.names == ("s", "x", "y", "z", "curvature", "w", "qx", "qy", "qz")
    r = np.column_stack([table[axis] for axis in "xyz"])
    np.testing.assert_array_equal(r, ARC.positions)
    np.testing.assert_array_equal(table["s"], ARC.arc_lengths)
    frames = np.column_stack([table[name] for name in ("w", "qx", "qy", "qz")])
    np.testing.assert_array_equal(frames, ARC.bishop().vertex_frames)
    KNOT.save(path)
    assert np.loadtxt(path, delimiter=",", skiprows=1).shape == (60, 5)


@pytest.mark.parametrize("suffix", [".ply", ".stl", ".obj"])
def test_tubes_are_solids_of_their_size(suffix: str, tmp_path: Path) -> None:
    path = tmp_path / f"tube{suffix}"
    ARC.save(path, radius=0.05, sides=40)
    mesh = pyvista.read(path)
    across = mesh.find_closest_point(ARC.positions[15])
    assert np.linalg.norm(mesh.points[across] - ARC.positions[15]) == pytest.approx(0.05, rel=0.05)
    with pytest.raises(ValueError, match=f"radius: {suffix} files hold surfaces"):
        ARC.save(path)


def test_files_that_are_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(ValueError, match=r"the suffix tells the format, for curves one of \.csv"):
        ARC.save(tmp_path / "curve.trk")
    with pytest.raises(TypeError, match=r"radius: \.csv files of curves have the options: none"):
        ARC.save(tmp_path / "curve.csv", radius=1)
    with pytest.raises(TypeError, match=r"colour: .*options: radius, width, sides"):
        ARC.save(tmp_path / "curve.vtp", colour=1)
    with pytest.raises(FileNotFoundError, match="there is no such file"):
        pyrod.load_curves(tmp_path / "no.vtp")
    pyvista.Sphere().save(tmp_path / "ball.vtp")
    with pytest.raises(ValueError, match="there is no curve in it"):
        pyrod.load_curves(tmp_path / "ball.vtp")
    uninstall(monkeypatch, "pyvista")
    with pytest.raises(ImportError, match="pyvista is not installed"):
        pyrod.load_curves(tmp_path / "ball.vtp")


def test_lines_of_other_programs(tmp_path: Path) -> None:
    """Streamlines: several polylines with columns, in single precision, in one file."""
    path = tmp_path / "streamlines.vtp"
    t = np.linspace(0, 1, 20)
    one = np.column_stack([t, t**2, 0 * t]).astype(np.float32)
    lines = np.concatenate([[20, *range(20)], [20, *range(20, 40)]])
    mesh = pyvista.PolyData(np.vstack([one, one + 1]), lines=lines)
    mesh["speed"] = np.arange(40.0)
    mesh.save(path)
    first, second = pyrod.load_curves(path)
    np.testing.assert_array_equal(second.polyline.positions, one + np.float32(1))
    np.testing.assert_array_equal(second.columns["speed"], np.arange(20.0, 40))
    assert first.polyline.precision == np.finfo(np.float32).eps
    assert not first.polyline.closed


def test_a_point_told_twice_and_a_line_that_closes(tmp_path: Path) -> None:
    path = tmp_path / "ring.vtk"
    ring = KNOT.positions[[*range(30), 29, *range(30, 60), 0]]
    mesh = pyvista.PolyData(ring, lines=[62, *range(62)])
    mesh["column"] = np.arange(62)
    mesh.cast_to_unstructured_grid().save(path)
    (found,) = pyrod.load_curves(path)
    assert found.polyline == KNOT
    assert found.columns["column"].tolist() == [*range(30), *range(31, 61)]
    (opened,) = pyrod.load_curves(path, closed=False)
    assert len(opened.polyline.positions) == 61


def test_nearly_closed_lines_are_told(tmp_path: Path) -> None:
    path = tmp_path / "ring.vtp"
    ring = np.vstack([KNOT.positions, KNOT.positions[:1] + 1e-9])
    pyvista.PolyData(ring, lines=[61, *range(61)]).save(path)
    with pytest.warns(CurveWarning, match="nearly repeats"):
        pyrod.load_curves(path, closed=True)


# pyvista ------------------------------------------------------------------------------------------


def test_ribbons_and_tubes_for_pyvista() -> None:
    ribbon = KNOT.closed_ribbon()
    strip = ribbon.to_pyvista(width=0.2)
    assert strip.n_cells == KNOT.edges
    assert strip.area == pytest.approx(0.2 * KNOT.length, rel=0.02)
    np.testing.assert_allclose(strip.point_data["a3"][:60], KNOT.vertex_tangents, rtol=0, atol=1e-2)
    tube = ARC.to_pyvista(radius=0.1, sides=60)
    assert tube.area == pytest.approx(2 * np.pi * 0.1 * ARC.length, rel=0.02)
    line = ARC.to_pyvista()
    np.testing.assert_array_equal(line.cell_data["torsion"], ARC.torsion())
    assert line.length > 0
    for options, message in (
        ({"width": 1}, "width: is of the ribbon of a FramedCurve"),
        ({"radius": -1}, "radius: must be positive"),
        ({"radius": 1, "sides": 2}, "sides: must be at least 3"),
    ):
        with pytest.raises(ValueError, match=message):
            ARC.to_pyvista(**options)
    with pytest.raises(ValueError, match="not together with radius"):
        ribbon.to_pyvista(width=1, radius=1)
