"""Rods in space with pyvista: the data of the solid, and the pixels of images without a window."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from support import uninstall

import pyrod
from pyrod import Clamp, DistributedForce, Force, Hinge, Joint, Material, Rod, Scene, Section
from pyrod.pictures import view
from pyrod.pictures.swept import swept
from pyrod.pictures.view import scene
from pyrod.result.fields import KINDS, field

pyvista = pytest.importorskip("pyvista", reason="pictures in space need pyvista")

RUBBER = Material(E=1e6)
FLAT = Section.rectangle(0.02, 0.06, RUBBER)
TUBE = Section.tube(0.04, 0.03, RUBBER)
SIZE = (400, 300)


@pytest.fixture(scope="module")
def bent() -> pyrod.Equilibrium:
    rod = Rod.straight(1.0, 12, FLAT)
    return pyrod.solve(Scene(rod, Clamp(), Force((0.6, 0.3, 0.0))))


@pytest.fixture(scope="module")
def net() -> pyrod.Equilibrium:
    rods = [Rod.straight(1.0, 4, TUBE), Rod.straight(1.0, 6, FLAT).placed((0, 0, 1))]
    scene = Scene(rods, Clamp(), joints=Joint(((0, "end"), (1, "start"))))
    return pyrod.solve(scene)


def is_paper(image: np.ndarray) -> np.ndarray:
    return (image == 255).all(axis=-1)


# The solid ----------------------------------------------------------------------------------------


def test_the_solid_is_the_swept_one(net: pyrod.Equilibrium) -> None:
    mesh, poly = swept(net, 10), net.to_pyvista(10)
    np.testing.assert_allclose(poly.points, mesh.points, rtol=1e-6)
    assert (poly.n_cells, poly.is_manifold) == (len(mesh.quads) + len(mesh.caps), True)
    assert {poly.get_cell(0).n_points, poly.get_cell(poly.n_cells - 1).n_points} == {3, 4}
    volume = TUBE.outline.area * 10 * np.sin(2 * np.pi / 10) / (2 * np.pi) + 0.02 * 0.06
    assert poly.triangulate().volume == pytest.approx(volume, rel=1e-5)


def test_the_solid_has_all_quantities(bent: pyrod.Equilibrium) -> None:
    mesh, poly = swept(bent), bent.to_pyvista()
    edges = {name for name, kind in KINDS.items() if kind.place == "edge"}
    assert set(poly.cell_data.keys()) == edges
    assert set(poly.point_data.keys()) == {"rod", *(set(KINDS) - edges)}
    for name in set(KINDS) - edges:
        expected = field(bent.rods[0], name).values[mesh.vertex]
        np.testing.assert_array_equal(poly.point_data[name], expected, err_msg=name)
    for name in edges:
        expected = field(bent.rods[0], name).values[mesh.edge]
        np.testing.assert_array_equal(poly.cell_data[name], expected, err_msg=name)


def test_points_know_their_rod(net: pyrod.Equilibrium) -> None:
    poly = net.to_pyvista()
    assert set(poly.point_data["rod"]) == {0, 1}
    assert (poly.points[poly.point_data["rod"] == 1, 2] >= 1 - 1e-6).all()


def test_too_few_sides(net: pyrod.Equilibrium) -> None:
    with pytest.raises(ValueError, match="sides: must be at least 3"):
        net.to_pyvista(2)


# Images -------------------------------------------------------------------------------------------


def pixels_of(plotter: Any, points: np.ndarray) -> np.ndarray:
    """(p, 2) row and column at which points are seen, from the camera alone."""
    camera = plotter.camera
    eye, focus = np.array(camera.position), np.array(camera.focal_point)
    ahead = (focus - eye) / np.linalg.norm(focus - eye)
    right = np.cross(ahead, camera.up)
    right /= np.linalg.norm(right)
    up = np.cross(right, ahead)
    scale = SIZE[1] / (2 * camera.parallel_scale)
    x, y = (points - focus) @ right, (points - focus) @ up
    return np.column_stack([SIZE[1] / 2 - scale * y, SIZE[0] / 2 + scale * x])


def test_pixels_are_where_the_rod_is(bent: pyrod.Equilibrium) -> None:
    plotter = scene(bent, None, False, True, 24, SIZE)
    middle = pixels_of(plotter, bent.positions[1:-1]).astype(int)
    corners = pixels_of(plotter, swept(bent).points)
    image = bent.show(off_screen=True, size=SIZE)
    plotter.close()
    assert image.shape == (SIZE[1], SIZE[0], 3)
    assert not is_paper(image[middle[:, 0], middle[:, 1]]).any()
    # far from all points of the solid, of the load, of the support and of the axes is paper
    rows, columns = np.indices(image.shape[:2])
    blue = (image[..., 2] > 1.3 * image[..., 0]) & (image[..., 2] > 1.1 * image[..., 1])
    places = np.column_stack([rows[blue], columns[blue]])
    on_axes = (places[:, 0] > 220) & (places[:, 1] < 80)
    low, high = corners.min(axis=0) - 2, corners.max(axis=0) + 2
    assert ((places >= low) & (places <= high))[~on_axes].all()
    span = np.ptp(places[~on_axes], axis=0)
    np.testing.assert_allclose(span, np.ptp(corners, axis=0), atol=3)


@pytest.mark.parametrize("size", [SIZE, (200, 400)])
@pytest.mark.parametrize("tangent", [(0, 0, 1), (-1, 1, 0)])
def test_all_is_in_the_picture(size: tuple[int, int], tangent: tuple[int, int, int]) -> None:
    rod = Rod.straight(1.0, 12, FLAT)
    lying = pyrod.solve(Scene(rod, Clamp(tangent=tangent), Force((0, 0, 0.1))))
    image = lying.show(frames=True, off_screen=True, size=size)
    for border in (image[:5], image[-5:], image[:, :5], image[:, -5:]):
        assert is_paper(border).all()
    assert 0.01 < (~is_paper(image)).mean() < 0.3


def test_colours_follow_the_quantity(bent: pyrod.Equilibrium) -> None:
    """Viridis: from violet, which is blue, at the least, to yellow, which is not, at the most."""
    plotter = scene(bent, "s", False, True, 24, SIZE)
    start, end = pixels_of(plotter, bent.positions[[2, -2]]).astype(int)
    plotter.close()
    image = bent.show("s", off_screen=True, size=SIZE).astype(int)
    for (row, column), sign in ((start, 1), (end, -1)):
        red, green, blue = image[row, column]
        assert sign * (blue - green) > 20, (red, green, blue)
    other = bent.show("moment", off_screen=True, size=SIZE).astype(int)
    assert (np.abs(other - image).sum(axis=-1) > 100).mean() > 0.005


def test_edges_are_coloured_whole(bent: pyrod.Equilibrium) -> None:
    plotter = scene(bent, "force.x", False, True, 24, SIZE)
    (rods,) = (m for m in plotter.meshes if "colours" in m.array_names)
    assert rods.cell_data["colours"].shape == (rods.n_cells,)
    np.testing.assert_allclose(rods.cell_data["colours"], 0.6, rtol=1e-9)
    plotter.close()


def test_the_bar_tells_quantity_and_unit(bent: pyrod.Equilibrium) -> None:
    for of, title in (
        ("moment.y", "section moment m_y [N m]"),
        ("Gamma.3", "shear and stretch Gamma3 [1]"),
    ):
        plotter = scene(bent, of, False, True, 24, SIZE)
        assert list(plotter.scalar_bars.keys()) == [title]
        plotter.close()
    plain = scene(bent, None, False, True, 24, SIZE)
    assert not len(plain.scalar_bars)
    plain.close()


def test_several_rods_have_several_colours(net: pyrod.Equilibrium) -> None:
    image = net.show(off_screen=True, size=SIZE).astype(int)
    red, _, blue = np.moveaxis(image, -1, 0)
    assert (red - blue > 60).sum() > 100
    assert (blue - red > 60).sum() > 100


def test_frames_are_arrows_in_three_colours(bent: pyrod.Equilibrium) -> None:
    plotter = scene(bent, None, True, True, 24, SIZE)
    found = {}
    for actor in plotter.actors.values():
        colour = getattr(getattr(actor, "prop", None), "color", None)
        if colour is not None and colour.name in ("red", "green", "blue"):
            found[colour.name] = actor.mapper.dataset
    assert set(found) == {"red", "green", "blue"}
    length = 0.03 + 0.06
    for name, axis in (("red", 0), ("green", 1), ("blue", 2)):
        tips = bent.positions + length * pyrod.rotation.rotate(bent.vertex_frames, np.eye(3)[axis])
        gaps = np.linalg.norm(found[name].points[:, None] - tips, axis=2).min(axis=0)
        np.testing.assert_allclose(gaps, 0, atol=1e-6)
    plotter.close()


def arrows(result: pyrod.Equilibrium) -> np.ndarray | None:
    plotter = scene(result, None, False, True, 24, SIZE)
    found = [a for a in plotter.actors.values() if hasattr(a, "prop")]
    points = [a.mapper.dataset.points for a in found if a.prop.color.name == "crimson"]
    plotter.close()
    return np.vstack(points) if points else None


@pytest.mark.parametrize(("force", "low", "high"), [(1.0, 1.0, 1.2), (-0.01, 1.0, 1.2)])
def test_loads_at_an_end_are_arrows_outside(force: float, low: float, high: float) -> None:
    stiff = Section(1.0, 1.0, 1.0)
    result = pyrod.solve(Scene(Rod.straight(1.0, 3, stiff), Clamp(), Force((0, 0, force))))
    points = arrows(result)
    assert points is not None
    z = points[:, 2]
    np.testing.assert_allclose([z.min(), z.max()], [low, high], atol=1e-6)
    tip = z[np.hypot(points[:, 0], points[:, 1]).argmax()]  # the widest place is near the head
    assert (tip > 1.1) == (force > 0)


def test_distributed_loads_have_an_arrow_per_vertex() -> None:
    rod = Rod.straight(1.0, 4, FLAT)
    one = pyrod.solve(Scene(rod, Clamp(), Force((0.1, 0, 0))))
    many = pyrod.solve(Scene(rod, Clamp(), DistributedForce((0.1, 0, 0))))
    few, all_of_them = arrows(one), arrows(many)
    assert few is not None
    assert all_of_them is not None
    assert len(all_of_them) == 5 * len(few)
    assert arrows(pyrod.solve(Scene(rod, Clamp()))) is None


def test_supports_are_cubes_and_balls() -> None:
    supports = [Clamp(), Hinge(at="end")]
    result = pyrod.solve(Scene(Rod.straight(1.0, 4, FLAT), supports))
    plotter = scene(result, None, False, True, 24, SIZE)
    solids = [m for m in plotter.meshes if "colours" not in m.array_names]
    plotter.close()
    cube, ball = sorted(solids, key=lambda m: m.n_points)
    np.testing.assert_allclose(cube.center, [0, 0, 0], atol=1e-7)
    np.testing.assert_allclose(ball.center, [0, 0, 1], atol=1e-7)
    assert cube.bounds.x_max == pytest.approx(0.045)
    radii = np.linalg.norm(ball.points - [0, 0, 1], axis=1)
    np.testing.assert_allclose(radii, 0.045, rtol=1e-5)


def test_screenshots_are_written_and_need_no_window(
    bent: pyrod.Equilibrium, tmp_path: Path
) -> None:
    image = bent.show(screenshot=tmp_path / "rod.png", size=SIZE)
    np.testing.assert_array_equal(pyvista.read(tmp_path / "rod.png").dimensions, [*SIZE, 1])
    assert (~is_paper(image)).any()


def test_a_window_is_shown_unless_told_otherwise(
    bent: pyrod.Equilibrium, monkeypatch: pytest.MonkeyPatch
) -> None:
    shown = []
    monkeypatch.setattr(pyvista.Plotter, "show", lambda self: shown.append(self.off_screen))
    assert bent.show(size=SIZE) is None
    assert shown == [False]


def test_unknown_quantities_are_refused(bent: pyrod.Equilibrium) -> None:
    with pytest.raises(ValueError, match="quantity: expected one of"):
        bent.show("beauty", off_screen=True)


def test_without_pyvista_the_remedy_is_told(
    bent: pyrod.Equilibrium, monkeypatch: pytest.MonkeyPatch
) -> None:
    uninstall(monkeypatch, "pyvista")
    for picture in (bent.show, bent.to_pyvista):
        with pytest.raises(ImportError, match=r"pip install 'pyrod\[view\]'"):
            picture()


def test_where_vtk_would_crash_it_is_told(
    bent: pyrod.Equilibrium, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """A Python that dies takes the place of one whose VTK does."""
    dies = tmp_path / "python"
    dies.write_text("#!/bin/sh\nkill -SEGV $$\n")
    dies.chmod(0o755)
    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.setattr(sys, "executable", str(dies))
    view.check_drawing_without_display.cache_clear()
    with pytest.raises(RuntimeError, match="apt-get install libegl1"):
        bent.show(screenshot=tmp_path / "rod.png")
    assert not (tmp_path / "rod.png").exists()
