"""Scenes for paths, and other forces for scenes."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from support import FLAT

from pyrod import Clamp, Force, Hinge, Rod, Scene, Section


def with_force(scene: Scene, force: Any) -> Scene:
    (load,) = scene.loads
    return replace(scene, loads=(replace(load, force=np.asarray(force)),))


def bow(space: str = "planar", section: Section = FLAT) -> Scene:
    """Clamped at one end, its other end held aside; a force in between."""
    rod = Rod.straight(1.0, 24, section)
    ends = [Clamp(), Hinge((0.3, 0, 0.7), at="end")]
    return Scene(rod, ends, [Force((0, 0, -1.0), at=0.5)], space)
