"""Rings, frames of rods, and a gridshell."""

from __future__ import annotations

from collections.abc import Callable
from math import cos, pi, sin, tan
from typing import Any

import numpy as np
from scipy.optimize import brentq

import pyrod
from hard.case import Array, Hard, Result, energy, first_integral, planar_frames
from pyrod import Clamp, DistributedForce, Force, Hinge, Joint, Rod, Scene, Section, Slider
from pyrod.rotation import exp, multiply

ROUND = Section(EI1=1.0, EI2=1.0, GJ=0.75)
STRIP = Section(EI1=4.0, EI2=1.0, GJ=2.0)

# Rings --------------------------------------------------------------------------------------------


def ring(turns: int) -> Callable[[int], Scene]:
    def scene(n: int) -> Scene:
        return Scene(Rod.straight(1.0, n, ROUND), joints=[Joint(("start", "end"), turns=turns)])

    return scene


def circle_energy(turns: float) -> float:
    return 2 * pi**2 * (1 + 0.75 * turns**2)


RINGS = [
    *(
        Hard(
            f"ring with {turns} turns of twist",
            ring(turns),
            128,
            energy(circle_energy(turns)),
            "closed form",
        )
        for turns in (0, 1, 2)
    ),
    Hard(
        "ring with 3 turns of twist",  # the circle is unstable; two turns go into passing through
        ring(3),
        128,
        energy(circle_energy(1)),
        "closed form",
    ),
]


def covered_ring(turns: float, index: int) -> Hard:
    """The circle on either side of its critical twist sqrt(3) EI/GJ = 2.309, clamped at a point."""
    whole = round(turns)
    end = exp((0.0, 0.0, 2 * pi * (turns - whole)))

    def scene(n: int) -> Scene:
        ends = [Clamp((0, 0, 0), (1, 0, 0, 0)), Clamp((0, 0, 0), end, at="end", turns=whole)]
        return Scene(Rod.straight(1.0, n, ROUND), ends)

    def start(n: int) -> Array:
        s = (np.arange(n) + 0.5) / n
        return multiply(planar_frames(2 * pi * s), exp(np.outer(2 * pi * turns * s, (0, 0, 1.0))))

    return Hard(
        f"circle with {turns:g} turns of twist",
        scene,
        256,
        energy(circle_energy(turns)),
        "closed form, known threshold",
        index=index,
        start=start,
        stable=False,
    )


CIRCLES = [covered_ring(2.28, 0), covered_ring(2.34, 2)]


# Frames -------------------------------------------------------------------------------------------

SWAY = brentq(lambda x: x / tan(x) + 6, 2.0, 3.0, xtol=1e-15) ** 2
"""Critical load of each column of a portal of three like rods: k L cot(k L) = -6."""


def portal(share: float) -> Callable[[int], Scene]:
    """Two clamped columns and a beam, rigidly joined, pushed down at both corners."""
    up, along, down = ((0, 0, 1), (1, 0, 0), (0, 0, -1))

    def rod(n: int, position: object, tangent: object) -> Rod:
        normal = np.cross((0, 1, 0), tangent)
        return Rod.straight(1.0, n, STRIP).placed(position, tangent=tangent, normal=normal)

    def scene(n: int) -> Scene:
        rods = [rod(n, (0, 0, 0), up), rod(n, (0, 0, 1), along), rod(n, (1, 0, 1), down)]
        joints = [Joint(((0, "end"), (1, "start"))), Joint(((1, "end"), (2, "start")))]
        supports = [Clamp(at=(0, "start")), Clamp(at=(2, "end"))]
        loads = [Force((0, 0, -share * SWAY), at=at) for at in ((0, "end"), (2, "start"))]
        return Scene(rods, supports, loads, "planar", joints)

    return scene


def stands(result: Result) -> float:
    return float(np.abs(result.rods[0].positions[:, 0]).max())


def sways(result: Result) -> None:
    assert stands(result) > 0.1


PORTALS = [
    *(
        Hard(
            f"portal at {share:g} of its critical load",
            portal(share),
            64,
            stands,
            "exact on the grid, known threshold",
            index=index,
            on_every_grid=1e-9,
            stable=False,
        )
        for share, index in ((0.99, 0), (1.01, 1))
    ),
    *(
        Hard(
            f"portal at {share:g} of its critical load, left alone",
            portal(share),
            64,
            first_integral,
            "first integral",
            also=sways,
        )
        for share in (1.01, 1.5)
    ),
]


def soft(EA: float) -> Section:
    return Section(EI1=1.0, EI2=1.0, GJ=0.8, EA=EA)


def star(EA: float, force: float) -> Callable[[int], Scene]:
    """Three clamped rods that meet at angles of 120 degrees, pushed out of their plane."""

    def scene(n: int) -> Scene:
        outwards = [np.array((cos(2 * pi * k / 3), sin(2 * pi * k / 3), 0.0)) for k in range(3)]
        rods = [
            Rod.straight(1.0, n, soft(EA), "extensible").placed(r, tangent=-r, normal=(0, 0, 1))
            for r in outwards
        ]
        middle = Joint(tuple((k, "end") for k in range(3)))
        load = Force((0, 0, -3 * force), at=(0, "end"))
        return Scene(rods, [Clamp(at=(k, "start")) for k in range(3)], load, joints=middle)

    return scene


def one_of_three(result: Result) -> float:
    """By symmetry each rod is one whose end slides out of the plane without turning."""
    rod = result.scene.rods[0]
    third = Force(result.scene.loads[0].force / 3)
    ends = [Clamp(), Slider((0, 0, 1), clamped=True, at="end")]
    single = pyrod.solve(Scene(rod, ends, third))
    return float(np.abs(single.positions - result.rods[0].positions).max())


def pushed_star(EA: float, force: float, **more: Any) -> Hard:
    return Hard(
        f"three rods, EA = {EA:g}, force {force:g} each",
        star(EA, force),
        64,
        one_of_three,
        "symmetry: one rod",
        on_every_grid=1e-11,
        **more,
    )


STARS = [
    pushed_star(1e2, 10.0),
    pushed_star(1e4, 10.0),
    pushed_star(1e2, 100.0),
]


# A gridshell --------------------------------------------------------------------------------------

LINES = 20


def gridshell(n: int) -> Scene:
    """Lines of rods, rigidly joined at their crossings, hinged at one end and sliding at the other.

    Pushed down evenly, so that it sags by two spacings; `n` edges between crossings.
    """
    L, thin = LINES + 1, Section(EI1=1e-2, EI2=1e-2, GJ=0.8e-2)
    rods, supports = [], []
    for k in range(2 * LINES):
        x, y = np.eye(3)[:2] if k < LINES else np.eye(3)[1::-1]
        start = (k % LINES + 1) * y
        rod = Rod.straight(L, n * L, thin, "inextensible")
        rods.append(rod.placed(start, tangent=x, normal=(0, 0, 1)))
        supports += [
            Hinge(start, at=(k, "start")),
            Slider(x, position=start + L * x, at=(k, "end")),
        ]
    joints = [
        Joint(((i, float(j + 1)), (LINES + j, float(i + 1))))
        for i in range(LINES)
        for j in range(LINES)
    ]
    loads = [DistributedForce((0, 0, -1e-4), rod=k) for k in range(2 * LINES)]
    return Scene(rods, supports, loads, joints=joints)


def across_the_diagonal(result: Result) -> float:
    """The lines of the two directions are mirror images."""
    r = np.array([rod.positions for rod in result.rods])
    return float(np.abs(r[:LINES][..., [1, 0, 2]] - r[LINES:]).max())


def sags(result: Result) -> None:
    lowest = min(rod.positions[:, 2].min() for rod in result.rods)
    assert -2.2 < lowest < -1.8


GRIDSHELL = Hard(
    "gridshell of 20 by 20 lines",
    gridshell,
    4,
    across_the_diagonal,
    "symmetry",
    on_every_grid=1e-10,
    unit=1e-2 / (LINES + 1),
    also=sags,
)

NETWORKS = [*RINGS, *CIRCLES, *PORTALS, *STARS, GRIDSHELL]
