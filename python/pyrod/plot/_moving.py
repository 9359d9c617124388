"""Moving pictures of modes, by matplotlib's animation."""

from __future__ import annotations

from math import inf
from pathlib import Path
from typing import Any

from pyrod.base.arrays import number, whole
from pyrod.base.optional import need
from pyrod.base.words import shortly
from pyrod.pictures.displaced import Motion
from pyrod.plot._shape import coordinates, draw_lines, in_plane, new_axes

WRITERS = {".gif": "pillow", ".mp4": "ffmpeg", ".html": None}
"""matplotlib's, by suffix; a page it makes by itself."""
FAINT = {"color": "0.75", "linewidth": 1}
MOVING = {"color": "C3", "linewidth": 2}


def write_moving(motion: Motion, path: Path, frames: int, seconds: float) -> None:
    """One period of a mode, between the shapes farthest out.

    Refuses what cannot be written before anything is drawn.
    """
    frames, seconds = whole(frames, "frames"), number(seconds, "seconds")
    if frames < 2:
        raise ValueError(f"frames: must be 2 or more, got {frames}")
    if not 0 < seconds < inf:
        raise ValueError(f"seconds: must be positive and finite, got {seconds}")
    _check_writer(path.suffix)
    pyplot, ax = need("matplotlib.pyplot", "plot"), new_axes(motion.result)
    try:
        _write_as(_animation(motion, ax, frames, seconds), path)
    finally:
        pyplot.close(ax.figure)


def _animation(motion: Motion, ax: Any, frames: int, seconds: float) -> Any:
    result = motion.result
    for phase in (0.0, 0.5):
        draw_lines(result, ax, motion.shapes(phase), FAINT, {})
    lines = draw_lines(result, ax, motion.shapes(0.0), MOVING, {})
    ax.set_title(motion.title, fontsize="medium")

    def move(frame: int) -> list[Any]:
        for line, r in zip(lines, motion.shapes(frame / frames), strict=True):
            points = coordinates(result, r).T
            line.set_data(*points) if in_plane(result) else line.set_data_3d(*points)
        return lines

    made = need("matplotlib.animation", "plot").FuncAnimation
    return made(ax.figure, move, frames, interval=1e3 * seconds / frames)


def _write_as(picture: Any, path: Path) -> None:
    writer = WRITERS[path.suffix]
    if writer is None:
        path.write_text(picture.to_jshtml(), encoding="utf-8")
    else:
        picture.save(path, writer=writer)


def _check_writer(suffix: str) -> None:
    if suffix not in WRITERS:
        raise ValueError(f"path: expected one of {', '.join(WRITERS)}, got {shortly(suffix)}")
    writer = WRITERS[suffix]
    known = need("matplotlib.animation", "plot").writers
    if writer is not None and not known.is_available(writer):
        raise RuntimeError(f"{suffix} needs {writer}, which is not installed; take another suffix")
