"""Critical loads of columns beside slender members that bear nothing before these buckle."""

from __future__ import annotations

import numpy as np
from support import ROUND, Z

from pyrod import Force, Hinge, Joint, Rod, Scene, Section, Slider, critical_load


def test_a_wire_beside_a_column_does_not_weaken_it() -> None:
    """The column keeps its length until it buckles under pi^2."""
    wire = Rod.straight(1.0, 16, Section(1e-6, 1e-6, 1e-6, EA=1e6))
    rods = [Rod.straight(1.0, 64, ROUND), wire]
    ends = [Joint(((0, x), (1, x)), "ball") for x in ("start", "end")]
    held = [Hinge(at=(0, "start")), Slider(Z, at=(0, "end"))]
    scene = Scene(rods, held, Force(-Z, at=(0, "end")), "planar", ends)
    found = critical_load(scene)
    assert abs(found.factor / np.pi**2 - 1) < 1e-8
    assert abs(found.factor - np.pi**2) <= found.error


def test_guys_hold_the_top_of_a_mast() -> None:
    """Unstressed guys bear nothing until the mast, hinged at its foot, buckles between its ends."""
    exact = 100 * np.pi**2
    mast = Rod.straight(1.0, 64, Section(100, 100, 100))
    guys = []
    for side in (-1, 1):
        along = np.array([side, 0, 1]) / np.sqrt(2)
        guy = Rod.straight(np.sqrt(2), 8, Section(1e-3, 1e-3, 1e-3, EA=1e6))
        across = np.cross((0, 1, 0), along)
        guys.append(guy.placed((-side, 0, 0), tangent=along, normal=across))
    held = [Hinge(at=(0, "start"))]
    held += [Hinge((-side, 0, 0), at=(i, "start")) for i, side in ((1, -1), (2, 1))]
    top = Joint(tuple((i, "end") for i in range(3)), "ball")
    scene = Scene([mast, *guys], held, Force(-Z, at=(0, "end")), "planar", top)
    found = critical_load(scene)
    assert abs(found.factor / exact - 1) < 1e-8
    assert abs(found.factor - exact) <= found.error
