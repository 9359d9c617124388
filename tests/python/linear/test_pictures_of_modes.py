"""Modes drawn, shown in space, and moving."""

from __future__ import annotations

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib import animation
from PIL import Image
from support import uninstall

import pyrod
from pyrod import Clamp, Force, Modes, Rod, Scene, Section
from pyrod.pictures.displaced import displaced
from pyrod.rotation import rotate

pytestmark = pytest.mark.usefixtures("close_figures")
UNIT = Section(EI1=1.0, EI2=1.5, GJ=0.8, mass_per_length=1.0)


def modes_of(space: str = "spatial", follower: bool = False, push: float = 2.0) -> Modes:
    rod = Rod.straight(1.0, 16, UNIT)
    load = Force((0, 0, -push), follower=follower)
    scene = Scene(rod, Clamp(), load, space=space)  # type: ignore[arg-type]
    return pyrod.linearised(pyrod.solve(scene)).modes(2)


def test_drawn_both_ways_in_space() -> None:
    modes = modes_of()
    ax = modes.plot(1)
    shape, there, back = (np.transpose(line.get_data_3d()) for line in ax.lines)
    assert shape == pytest.approx(modes.result.positions)
    assert there - shape == pytest.approx(shape - back)
    assert np.linalg.norm(there - shape, axis=1).max() == pytest.approx(0.1)
    move = modes.shapes[0][1]
    assert there - shape == pytest.approx(0.1 * move / np.linalg.norm(move, axis=1).max())
    assert f"mode 1: {modes.frequencies[1]:.4g} Hz" in ax.get_title()


def test_drawn_in_the_plane() -> None:
    ax = plt.figure().add_subplot()
    assert modes_of("planar").plot(0, ax, color="k") is ax
    assert {line.get_color() for line in ax.lines} == {"k"}


def test_modes_of_stability_are_drawn_as_the_lowest_is() -> None:
    result = pyrod.solve(modes_of().result.scene, eigenvalue=True)
    ours = pyrod.linearised(result).stability_modes(2).plot(0)
    theirs = result.plot(what="stability")
    sides = [np.transpose(line.get_data_3d()) for line in theirs.lines[1:]]
    for line in ours.lines[1:]:
        r = np.transpose(line.get_data_3d())
        assert min(np.abs(r - side).max() for side in sides) < 1e-6


def test_flutter_is_drawn_a_half_period_apart() -> None:
    modes = modes_of("planar", follower=True, push=22.0 * 1.5)
    assert not modes.stable
    motion = modes.motion(0)
    there, back = motion.shapes(0.0)[0], motion.shapes(0.5)[0]
    assert (there + back) / 2 == pytest.approx(modes.result.positions)
    quarter = motion.shapes(0.25)[0] - modes.result.positions
    assert np.abs(quarter).max() > 1e-3  # points do not move in step
    assert "flutters" in motion.title


def test_displaced_frames_are_along_the_displaced_rod() -> None:
    modes = modes_of()
    moved = displaced(modes.motion(0), 0.0)
    tangents = np.diff(moved.positions, axis=0)
    tangents /= np.linalg.norm(tangents, axis=1)[:, None]
    middle = rotate(moved.vertex_frames, np.array([0, 0, 1.0]))
    middle = (middle[1:] + middle[:-1])[1:-1]
    middle /= np.linalg.norm(middle, axis=1)[:, None]
    assert np.abs(middle - tangents[1:-1]).max() < 0.02
    assert modes.result.positions is not moved.positions


def test_shown_in_space() -> None:
    pytest.importorskip("pyvista", reason="pictures in space need pyvista")
    image = modes_of().show(0, "moment", off_screen=True, size=(300, 200))
    assert image.shape == (200, 300, 3)
    assert not (image == 255).all()


@pytest.mark.parametrize("space", ["planar", "spatial"])
def test_a_gif(space: str, tmp_path: Path) -> None:
    path = tmp_path / "mode.gif"
    modes_of(space).animate(0, path, frames=6, seconds=0.6)
    with Image.open(path) as picture:
        assert picture.n_frames == 6  # type: ignore[attr-defined]
        assert picture.info["duration"] == 100
        frames = []
        for i in range(6):
            picture.seek(i)
            frames.append(np.asarray(picture.convert("RGB"), dtype=int))
    assert np.abs(frames[0] - frames[3]).max() > 50  # it moves
    assert np.abs(frames[1] - frames[5]).max() < 50  # and comes back the same way
    assert not plt.get_fignums()


def test_a_page(tmp_path: Path) -> None:
    path = tmp_path / "mode.html"
    modes_of().animate(1, path, frames=3)
    text = path.read_text(encoding="utf-8")
    assert text.count("data:image/png;base64") == 3
    assert not plt.get_fignums()


def test_a_film(tmp_path: Path) -> None:
    path = tmp_path / "mode.mp4"
    if animation.writers.is_available("ffmpeg"):
        modes_of().animate(0, path, frames=4)
        assert path.stat().st_size > 1000
    else:
        with pytest.raises(RuntimeError, match="ffmpeg"):
            modes_of().animate(0, path)
    assert len(list(tmp_path.iterdir())) == path.exists()


def test_without_matplotlib(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    modes = modes_of()
    uninstall(monkeypatch, "matplotlib")
    for draw in (modes.plot, lambda: modes.animate(0, tmp_path / "mode.gif")):
        with pytest.raises(ImportError, match=r"pyrod\[plot\]"):
            draw()


def test_without_scipy(monkeypatch: pytest.MonkeyPatch) -> None:
    scene = modes_of().result.scene
    long = Scene(Rod.straight(1.0, 64, UNIT), scene.supports, scene.loads)
    lin = pyrod.linearised(pyrod.solve(long))
    uninstall(monkeypatch, "scipy")
    for ask in (lin.modes, lin.stability_modes):
        with pytest.raises(ImportError, match=r"pyrod\[all\]"):
            ask(2)


def test_refusals(tmp_path: Path) -> None:
    modes = modes_of()
    with pytest.raises(ValueError, match=r"\.gif, \.mp4, \.html"):
        modes.animate(0, tmp_path / "mode.avi")
    with pytest.raises(ValueError, match="frames"):
        modes.animate(0, tmp_path / "mode.gif", frames=1)
    with pytest.raises(ValueError, match="seconds"):
        modes.animate(0, tmp_path / "mode.gif", seconds=0)
    with pytest.raises(FileNotFoundError):
        modes.animate(0, tmp_path / "none" / "mode.gif")
    for wrong in (2, -1, 0.5):
        with pytest.raises(ValueError, match="number"):
            modes.plot(wrong)  # type: ignore[arg-type]
    assert not plt.get_fignums()
    assert not list(tmp_path.iterdir())
