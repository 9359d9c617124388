"""One end held, the other free: boundary layers, roll-up, extreme stiffnesses and grids."""

from __future__ import annotations

from functools import cache
from math import cos, inf, pi, radians, sin, sqrt
from typing import Any

import numpy as np
from scipy.integrate import solve_bvp, solve_ivp

from hard.case import Hard, Result, energy, first_integral, from_reference
from pyrod import Clamp, DistributedForce, Force, Moment, Rod, Scene, Section

EI = Section(EI1=1.5, EI2=1.0, GJ=0.8)


def cantilever(rod: Rod, load: Any, space: str = "spatial") -> Scene:
    return Scene(rod, Clamp(), [load], space)


# Dead tip forces, in one step ---------------------------------------------------------------------


def layer(degrees: float, space: str) -> Hard:
    """The layer of an endless rod, but for exp(-30): theta' = 2 sqrt(F) sin((angle - theta)/2)."""
    angle, root = radians(degrees), sqrt(1000.0)
    force = Force((1000 * sin(angle), 0.0, 1000 * cos(angle)))
    return Hard(
        f"tip force 1000 at {degrees:g} degrees, {space}",
        lambda n: cantilever(Rod.straight(1.0, n, EI), force, space),
        512,
        energy(2 * root * (1 - cos(angle / 2))),
        "closed form",
        unit=1.5,
    )


TIP_FORCES = [
    *(from_reference("P1_F1000_a90", space, 512) for space in ("planar", "spatial")),
    *(from_reference("P1_F100_a135", space, 128) for space in ("planar", "spatial")),
    *(layer(angle, space) for angle in (135.0, 175.0) for space in ("planar", "spatial")),
    from_reference("S2_bathe_P600_Jpolar_k5-6", "spatial", 64),
    from_reference("S2_bathe_P600_Jpolar_kirchhoff", "spatial", 64),
    from_reference("S2_bathe_P600_J0.1406_k5-6", "spatial", 64),
]


# Turns from edge to edge --------------------------------------------------------------------------


def rolled(turn: float, n: int, name: str) -> Hard:
    """A dead end moment that turns the rod by `turn` from each edge to the next."""
    K = turn * n

    def error(result: Result) -> float:
        return float(np.abs(result.K / K - (0, 1, 0)).max())

    return Hard(
        name,
        lambda m: cantilever(Rod.straight(1.0, m, EI), Moment((0.0, K, 0.0))),
        n,
        error,
        "exact on the grid",
        index=-1,
        on_every_grid=1e-11,
        unit=1.5,
    )


def straightened(turn: float, n: int) -> Hard:
    """Rolled up at rest, and straightened by the moment that this takes."""
    K = turn * n
    return Hard(
        f"straightened, at rest {turn / pi:g} pi an edge",
        lambda m: cantilever(Rod.precurved(1.0, m, EI, (0.0, K, 0.0)), Moment((0.0, -K, 0.0))),
        n,
        lambda result: float(np.linalg.norm(result.tip - (0.0, 0.0, 1.0))),
        "exact on the grid",
        index=-1,
        on_every_grid=1e-11,
        unit=1.5,
    )


ROLLED = [
    rolled(20 * pi / 64, 64, "rolled up ten times"),
    rolled(0.9 * pi, 8, "rolled up, 0.9 pi an edge"),
    straightened(0.9 * pi, 8),
]


# Weight -------------------------------------------------------------------------------------------


@cache
def heavy_root_moment(w: float) -> float:
    """Of theta'' = -w (1 - s) cos(theta), theta(0) = theta'(1) = 0, theta towards the weight."""

    def rates(s: Any, y: Any) -> Any:
        return np.array([y[1], -w * (1 - s) * np.cos(y[0])])

    s = np.linspace(0, 1, 400) ** 2
    guess = np.array([np.pi / 2 * (1 - np.exp(-s * sqrt(w))), s * 0.0])
    ends = lambda a, b: np.array([a[0], b[1]])  # noqa: E731
    out = solve_bvp(rates, ends, s, guess, tol=1e-10, max_nodes=200_000)
    assert out.success, out.message
    return float(out.y[1, 0])


def heavy(w: float) -> Hard:
    return Hard(
        f"weight w L^3/EI = {w:g}",
        lambda n: cantilever(Rod.straight(1.0, n, EI), DistributedForce((w, 0.0, 0.0))),
        1024,
        lambda result: abs(result.moment[0, 1] / heavy_root_moment(w) - 1),
        "boundary value problem, 1e-10",
        floor=1e-8,
        unit=1.5,
    )


HEAVY = [from_reference("P5_heavy_w100", "spatial", 64), heavy(1e3), heavy(1e4)]


# Stiffnesses and grids ----------------------------------------------------------------------------


def blade(ratio: float, force: tuple[float, float, float], **more: Any) -> Hard:
    """Most of the force acts across the stiff direction; EI2 = 1."""

    def scene(n: int) -> Scene:
        return cantilever(Rod.straight(1.0, n, Section(ratio, 1.0, sqrt(ratio))), Force(force))

    name = f"EI1/EI2 = {ratio:g}, force {np.linalg.norm(force):.3g} EI2/L^2"
    return Hard(name, scene, 128, first_integral, "first integral", unit=ratio, **more)


def with_jump(n: int) -> Scene:
    """Soft at the clamp; the stiff half is as good as rigid."""
    halves = [Section(1.0, 1.0, 0.8)] * (n // 2) + [Section(1e6, 1e6, 1e6)] * (n // 2)
    rod = Rod.straight(1.0, n, halves)
    return cantilever(rod, Force((10.0, 0.0, 0.0)))


def jump_error(result: Result) -> float:
    """First integral of the soft half, whose end moment is that of a force on a rigid lever."""
    half = result.rod.edges // 2
    angle = 2 * np.arctan2(result.frames[half + 1, 2], result.frames[half + 1, 0])
    end = 10 * 0.5 * cos(angle)
    return abs(sqrt(end**2 + 2 * 10 * sin(angle)) / result.moment[0, 1] - 1)


def graded(n: int) -> Scene:
    """Edges that grow by a constant factor, 1e4 in all."""
    edges = np.diff(np.expm1(np.linspace(0, np.log(1e4), n + 1)) / np.expm1(np.log(1e4)))
    return cantilever(Rod.precurved(edges, None, EI, (0, 0, 0)), Force((10.0, 0.0, 0.0)), "planar")


def alternating(n: int) -> Scene:
    """Every other edge is 1e4 times as long."""
    edges = np.tile([1e-4, 1.0], n // 2)
    rod = Rod.precurved(edges / edges.sum(), None, EI, (0, 0, 0))
    return cantilever(rod, Force((10.0, 0.0, 0.0)), "planar")


def tip_error(result: Result) -> float:
    exact = (0.8106090248802965, 0.0, 0.4450044022462487)  # F L^2/EI = 10
    return float(np.linalg.norm(result.tip - exact))


def stretchable(EA: float) -> Hard:
    def scene(n: int) -> Scene:
        rod = Rod.straight(1.0, n, Section(1.5, 1.0, 0.8, EA=EA), "extensible")
        return cantilever(rod, Force((10.0, 0.0, 0.0)))

    return Hard(
        f"tip force 10, EA L^2/EI = {EA:g}", scene, 128, first_integral, "first integral", unit=1.5
    )


EXTREMES = [
    blade(1e6, (10.0, 20.0, 10.0)),
    blade(
        1e6,
        (10.0, 1000.0, 20.0),
        beyond="steps follow the narrow valley of a bending that is all but forbidden",
    ),
    Hard("stiffness jumps by 1e6", with_jump, 128, jump_error, "closed form", floor=1e-5, unit=1e6),
    Hard("edges grow by 1e4", graded, 256, tip_error, "reference", unit=1.5),
    Hard("edges alternate by 1e4", alternating, 256, tip_error, "reference", unit=1.5),
    *(stretchable(EA) for EA in (1e1, 1e2, 1e4, 1e6, 1e10, inf)),
]


# Follower forces ----------------------------------------------------------------------------------


@cache
def follower_root_moment(F: float) -> float:
    """Backwards from the tip: psi'' = -F cos(psi), psi = psi' = 0 there."""
    rates = lambda s, y: [y[1], -F * np.cos(y[0])]  # noqa: E731
    out = solve_ivp(rates, (1.0, 0.0), (0.0, 0.0), "DOP853", rtol=1e-13, atol=1e-13)
    return float(out.y[1, -1])


def follower(F: float, **more: Any) -> Hard:
    return Hard(
        f"follower force {F:g} across the tip",
        lambda n: cantilever(Rod.straight(1.0, n, EI), Force((F, 0.0, 0.0), follower=True)),
        128,
        lambda result: abs(result.moment[0, 1] / follower_root_moment(F) - 1),
        "initial value problem, 1e-13",
        index=-1,
        unit=1.5,
        **more,
    )


FOLLOWERS = [
    *(follower(F) for F in (10.0, 50.0, 200.0)),
    follower(1000.0, beyond="converges, but in many small load steps"),
]


# Sizes --------------------------------------------------------------------------------------------


def million(space: str) -> Hard:
    return Hard(
        f"a million edges, {space}",
        lambda n: cantilever(Rod.straight(1.0, n, EI), Force((10.0, 0.0, 0.0)), space),
        1_000_000,
        tip_error,
        "reference",
        on_every_grid=1e-9,
        unit=1.5,
        long=True,
    )


CANTILEVERS = [
    *TIP_FORCES,
    *ROLLED,
    *HEAVY,
    *EXTREMES,
    *FOLLOWERS,
    *(million(space) for space in ("planar", "spatial")),
]
