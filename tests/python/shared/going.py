"""Scenes that are solved again and again with other numbers."""

from __future__ import annotations

from support import SOFT

from pyrod import (
    Clamp,
    Force,
    Hinge,
    Moment,
    Rod,
    Scene,
)


def catheter() -> Scene:
    return Scene(
        Rod.precurved(1.0, 24, SOFT, (0.5, 1, 0)),
        Clamp((0, 0, 0), (1, 0, 0, 0)),
        [Force((1, -2, 1)), Moment((0, 0.2, 0), at="end", follower=True)],
    )


def strut() -> Scene:
    ends = [Clamp((0, 0, 0), (1, 0, 0, 0)), Hinge((0.1, 0, 0.9), at="end")]
    return Scene(Rod.precurved(1.0, 24, SOFT, (0.2, 1, 0)), ends, Force((0, 1, 0), at=0.5))
