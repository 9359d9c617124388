"""Both ends held: pushed together, twisted, hanging, snapping."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from math import atan, cosh, pi, sinh

import numpy as np
from scipy.optimize import brentq
from scipy.special import ellipe, ellipk

import pyrod
from hard.case import (
    Array,
    Hard,
    Result,
    centres,
    energy,
    first_integral,
    from_reference,
    mirrored,
    planar_frames,
    reference,
)
from pyrod import Clamp, DistributedForce, Force, Hinge, Rod, Scene, Section
from pyrod.rotation import exp

ROUND = Section(EI1=1.0, EI2=1.0, GJ=1.0)
STRIP = Section(EI1=4.0, EI2=1.0, GJ=2.0)


# Clamped ends pushed together ---------------------------------------------------------------------


def clamped(section: Section, shortening: float, load: float = 0.0) -> Callable[[int], Scene]:
    def scene(n: int) -> Scene:
        ends = [Clamp(), Clamp((0.0, 0.0, 1 - shortening), (1, 0, 0, 0), at="end")]
        loads = [Force((-load, 0.0, 0.0), 0.5)] if load else []
        return Scene(Rod.straight(1.0, n, section), ends, loads, space(section))

    return scene


def space(section: Section) -> str:
    return "planar" if section is STRIP else "spatial"


def elastica_energy(shortening: float) -> float:
    """Of the inflectional elastica, lambda = 4 K, shortening 2 - 2 E/K; EI = L = 1."""
    m = brentq(lambda m: 2 - 2 * ellipe(m) / ellipk(m) - shortening, 1e-12, 1 - 1e-12, xtol=1e-15)
    return 2 * (4 * ellipk(m)) ** 2 * (ellipe(m) / ellipk(m) - 1 + m)


def falls_short(result: Result) -> None:
    """The planar shape is unstable there (GJ = EI: beyond 2/3); what is found has less energy."""
    assert result.energy < 0.9 * elastica_energy(1 - float(np.linalg.norm(result.tip)))


def shortened(percent: float, section: Section) -> Hard:
    flat = section is STRIP or percent < 66
    return Hard(
        f"clamped, {percent:g} % shorter, {space(section)}",
        clamped(section, percent / 100),
        128,
        energy(elastica_energy(percent / 100)) if flat else first_integral,
        "closed form" if flat else "first integral",
        unit=4.0 if section is STRIP else 1.0,
        also=lambda result: None if flat else falls_short(result),
    )


def planar_at(percent: float, index: int) -> Hard:
    """On either side of 2/3, where the planar shape of a round rod loses stability."""
    return Hard(
        f"planar shape of a round rod, {percent:g} % shorter",
        clamped(ROUND, percent / 100),
        256,
        energy(elastica_energy(percent / 100)),
        "closed form, known threshold",
        index=index,
        start=lambda n: pyrod.solve(clamped(STRIP, percent / 100)(n)).frames,
        stable=False,
    )


SHORTENED = [
    *(shortened(p, section) for section in (STRIP, ROUND) for p in (1, 10, 50, 90, 99)),
    planar_at(65, 0),
    planar_at(68, 1),
]


# Twisted ------------------------------------------------------------------------------------------


def twisted(turns: float, ratio: float) -> Hard:
    """The end turned about the axis, then brought nearer by a fifth."""
    whole = round(turns) if turns >= 1 else 0
    frame = exp((0.0, 0.0, 2 * pi * (turns - whole)))

    def scene(n: int) -> Scene:
        rod = Rod.straight(1.0, n, Section(EI1=ratio, EI2=1.0, GJ=0.8))
        end = Clamp((0.0, 0.0, 0.8), frame, at="end", turns=whole)
        return Scene(rod, [Clamp(), end])

    kind = "iso" if ratio == 1 else "aniso1.5"
    name = f"S4_twist_X0.8_t{turns:g}_{kind}"
    known = turns <= 2 and not (ratio > 1 and turns > 0.5)
    return Hard(
        f"twisted by {turns:g} turns, slack 0.8, EI1/EI2 = {ratio:g}",
        scene,
        128,
        energy(reference(name).data["energy"]) if known else first_integral,
        "reference" if known else "first integral",
        unit=ratio,
    )


TWISTED = [
    *(twisted(turns, ratio) for ratio in (1.0, 1.5) for turns in (0.5, 1.0, 2.0, 4.0)),
    from_reference("S4_generic_iso_stableA", "spatial", 128),
    from_reference("S4_generic_iso_stableB", "spatial", 128),
    from_reference("S4_generic_iso_stableC", "spatial", 128),
]


# Chains -------------------------------------------------------------------------------------------


@cache
def catenary(span: float) -> float:
    """u with sinh(u)/u = 1/span; the sag is (cosh u - 1)/(2 sinh u), the end slope sinh u."""
    return brentq(lambda u: sinh(u) / u - 1 / span, 1e-3, 10, xtol=1e-15)


def chain(w: float) -> Hard:
    """Clamped along the catenary, so that no boundary layers shift it; bending does, by O(1/w)."""
    u = catenary(0.8)
    slope = atan(sinh(u))

    def scene(n: int) -> Scene:
        ends = [
            Clamp((0, 0, 0), planar_frames([-slope])[0]),
            Clamp((0, 0, 0.8), planar_frames([slope])[0], at="end"),
        ]
        weight = DistributedForce((-w, 0.0, 0.0))
        return Scene(Rod.straight(1.0, n, STRIP), ends, [weight])

    sag = (cosh(u) - 1) / (2 * sinh(u))
    return Hard(
        f"hanging chain, w L^3/EI = {w:g}",
        scene,
        256,
        lambda result: abs(-result.positions[:, 0].min() / sag - 1),
        "catenary, but for O(EI/w L^3)",
        floor=4 / w,
        unit=4.0,
    )


CHAINS = [
    from_reference("P5_chain_w1e4_span0.8", "spatial", 128),
    from_reference("P5_chain_w1e4_span0.8_aligned", "spatial", 128),
    chain(1e6),
]


# Arches -------------------------------------------------------------------------------------------

TENTH = clamped(STRIP, 0.1)
CRITICAL = 44.03752417081722396998474  # force on the middle of the arch, EI = L = 1


def arch(n: int) -> Array:
    return pyrod.solve(TENTH(n)).frames


def state(name: str, exact: str, start: Callable[[int], Array], index: int) -> Hard:
    return Hard(
        name,
        TENTH,
        128,
        energy(reference(exact).data["energy"]),
        "reference",
        index=index,
        start=start,
        stable=False,
        unit=4.0,
    )


def second_mode(n: int) -> Array:
    """Antisymmetric positions: angles even about the middle."""
    s = centres(n)
    return planar_frames(0.8 * (1 - np.cos(2 * pi * s)) * np.cos(2 * pi * s) - 0.4)


def pushed(force: float, name: str, **more: object) -> Hard:
    return Hard(
        f"arch pushed down, {name}",
        clamped(STRIP, 0.1, force),
        128,
        start=arch,
        unit=4.0,
        **more,  # type: ignore[arg-type]
    )


def middle(result: Result) -> float:
    """Height of the middle where the arch loses stability."""
    return abs(abs(result.positions[result.rod.edges // 2, 0]) / 0.1901971360150946587130383 - 1)


def stays_symmetric(result: Result) -> float:
    x = result.positions[:, 0]
    return float(np.abs(x - x[::-1]).max() / np.abs(x).max())


def is_inverted(result: Result) -> None:
    assert result.positions[result.rod.edges // 2, 0] < -0.15


ARCHES = [
    state("arch, the one side", "P3_clamp_m1_d10", arch, 0),
    state("arch, the other side", "P3_clamp_m1_d10", lambda n: mirrored(arch(n)), 0),
    state("arch, between the two", "P3_clamp_m2_d10", second_mode, 1),
    pushed(
        0.99 * CRITICAL,
        "0.99 of its critical load",
        error=stays_symmetric,
        known="symmetry, known threshold",
        on_every_grid=1e-7,
        stable=False,
    ),
    pushed(
        CRITICAL,
        "its critical load",
        error=middle,
        known="reference",
        stable=False,
        index=None,
    ),
    pushed(
        1.01 * CRITICAL,
        "1.01 of its critical load",
        error=stays_symmetric,
        known="symmetry, known threshold",
        on_every_grid=1e-7,
        stable=False,
        index=1,
    ),
    pushed(
        1.01 * CRITICAL,
        "1.01 of its critical load, left alone",
        error=stays_symmetric,
        known="symmetry",
        on_every_grid=1e-7,
        also=is_inverted,
    ),
]
# Over several supports ----------------------------------------------------------------------------


def waves_energy(slack: float, spans: int) -> float:
    """Of hinged spans of a rod of length 1 whose bows alternate, half a wave each; EI = 1."""
    m = brentq(lambda m: 2 - 2 * ellipe(m) / ellipk(m) - slack, 1e-12, 1 - 1e-12, xtol=1e-15)
    return spans**2 * 2 * (2 * ellipk(m)) ** 2 * (ellipe(m) / ellipk(m) - 1 + m)


def over_hinges(slack: float, inner: int, section: Section) -> Hard:
    """All spans alike, hinged at both ends, too: no moment passes a hinge."""

    def scene(n: int) -> Scene:
        at = np.linspace(0, 1, inner + 2)
        held = [Hinge((0, 0, (1 - slack) * s), at=float(s)) for s in at]
        return Scene(Rod.straight(1.0, n, section), held, [], space(section))

    return Hard(
        f"over {inner} inner hinge{'s' * (inner > 1)}, slack {100 * slack:g} %, {space(section)}",
        scene,
        32 * (inner + 1),
        energy(waves_energy(slack, inner + 1)),
        "closed form",
        unit=4.0 if section is STRIP else 1.0,
    )


WAVES = [
    over_hinges(slack, inner, section)
    for section in (STRIP, ROUND)
    for slack, inner in ((0.2, 1), (0.6, 1), (0.2, 5))
]

SPANS = [*SHORTENED, *TWISTED, *CHAINS, *ARCHES, *WAVES]
