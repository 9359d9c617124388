"""Critical loads that others found wrong, against closed forms and shooting."""

from __future__ import annotations

import warnings
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, minimize_scalar
from support import EULER, ROUND, X, Y, Z, about_y, within

import pyrod
from pyrod import (
    AccuracyWarning,
    Clamp,
    DistributedForce,
    Force,
    Hinge,
    Joint,
    Rod,
    Scene,
    Section,
    Slider,
    critical_load,
    solve,
)
from pyrod.stability.path import Path


def holds(found: pyrod.Critical, exact: float, relative: float) -> None:
    """The error is less than told, and both are small."""
    assert abs(found.factor - exact) <= found.error
    assert found.error <= relative * exact


# Limit points -------------------------------------------------------------------------------------


def truss(degrees: float, n: int = 4) -> Scene:
    """Two bars of length 1 at an angle, hinged, pressed down at the apex; they stay straight."""
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    bar = Section(10, 10, 10, EA=1)
    a = Rod.straight(1.0, n, bar).placed(tangent=(c, 0, s), normal=(s, 0, -c))
    b = Rod.straight(1.0, n, bar).placed((c, 0, s), tangent=(c, 0, -s), normal=(-s, 0, -c))
    held = [Hinge(at=(0, "start")), Hinge(at=(1, "end"))]
    load, apex = Force(-Z, at=(0, "end")), Joint(((0, "end"), (1, "start")), "ball")
    return Scene([a, b], held, load, "planar", apex)


@pytest.mark.parametrize(
    ("degrees", "relative"), [(2, 2e-7), (5, 1e-8), (20, 1e-8), (45, 1e-8), (60, 1e-8)]
)
def test_a_truss_snaps_at_its_closed_form(degrees: float, relative: float) -> None:
    """At an angle t, P = 2 EA sin t (1 - cos a/cos t), largest where cos^3 t = cos a."""
    exact = 2 * (1 - np.cos(np.radians(degrees)) ** (2 / 3)) ** 1.5
    found = critical_load(truss(degrees))
    assert found.kind == "limit point"
    holds(found, exact, relative)


def test_a_steep_truss_goes_to_the_side() -> None:
    """Its bars, of length l, bear the apex sideways as long as cos^2 t > (1/l - 1) sin^2 t."""
    a = np.radians(80)
    t = brentq(lambda t: np.tan(t) ** -2 - (np.cos(t) / np.cos(a) - 1), 1.2, a, xtol=1e-15)
    found = critical_load(truss(80))
    assert found.kind == "bifurcation"
    holds(found, 2 * np.sin(t) * (1 - np.cos(a) / np.cos(t)), 3e-8)


@pytest.mark.parametrize("rtol", [1e-2, 1e-4, 1e-6, 1e-10])
def test_the_search_is_as_exact_as_it_is_told(rtol: float) -> None:
    exact = 2 * (1 - np.cos(np.radians(10)) ** (2 / 3)) ** 1.5
    holds(critical_load(truss(10), rtol=rtol), exact, rtol + 1e-8)
    straight = Scene(Rod.straight(1.0, 32, ROUND), Clamp(), Force(-Z), "planar")
    holds(critical_load(straight, rtol=rtol), EULER["clamped-free"], rtol + 1e-6)


def shallow_arc(rise: float, thrusts: tuple[float, float]) -> float:
    """The limit load of an arc of length 1, EI = 1, EA = 1e9 and a curvature, pressed at its crown.

    Under a thrust H its height obeys y'' + H y = P x/2 - rise up to the crown, where y' = 0; its
    shortening H/EA is half the integral of y0'^2 - y'^2. That is quadratic in P.
    """
    x, w = np.polynomial.legendre.leggauss(40)
    x, w = (x + 1) / 4, w / 2  # of the left half, counted twice

    def load(H: float) -> float:
        m = np.sqrt(H)
        by_load = (1 - np.cos(m * x) / np.cos(m / 2)) / (2 * H)
        by_rise = rise / m * (np.tan(m / 2) * np.cos(m * x) - np.sin(m * x))
        a, b = w @ by_load**2, 2 * w @ (by_load * by_rise)
        c = w @ by_rise**2 - w @ (rise * (0.5 - x)) ** 2 + 2 * H / 1e9
        return float((-b + np.sqrt(b * b - 4 * a * c)) / (2 * a))

    return -minimize_scalar(lambda H: -load(H), bounds=thrusts, options={"xatol": 1e-12}).fun


@pytest.mark.parametrize(
    ("rise", "thrusts"), [(5e-4, (9.9, 10.1)), (6e-4, (10.5, 14)), (7.5e-4, (13, 22))]
)
def test_a_shallow_arc_snaps_at_its_closed_form(rise: float, thrusts: tuple[float, float]) -> None:
    section = Section(1, 1, 1, EA=1e9)
    rod = Rod.precurved(1.0, 64, section, rise * Y).placed((0, 0, 0), about_y(-rise / 2))
    ends = [Hinge(), Hinge(at="end")]
    found = critical_load(Scene(rod, ends, Force(X, at=0.5), "planar"))
    assert found.kind == "limit point"
    holds(found, shallow_arc(rise, thrusts), 5e-4)


def test_the_end_of_a_path_is_no_limit_point(monkeypatch: pytest.MonkeyPatch) -> None:
    """If equilibria are not found any more, far from where the eigenvalue points to zero."""
    solved = Path.solved

    def lost(path: Path, factor: float, start: Any) -> pyrod.Equilibrium:
        result = solved(path, factor, start)
        if factor > 1.2:
            raise pyrod.NotConverged(result)
        return result

    monkeypatch.setattr(Path, "solved", lost)
    straight = Scene(Rod.straight(1.0, 8, ROUND), Clamp(), Force(-Z), "planar")
    with pytest.raises(RuntimeError, match=r"could be followed up to a factor of 1\.2 only"):
        critical_load(straight)


# How far the loads grow ---------------------------------------------------------------------------


def with_pennant(mast: Rod, EI: float, load: Any) -> Scene:
    """A clamped mast that bears a light rod at its top."""
    light = Rod.straight(1.0, 8, Section(EI, EI, EI)).placed(Z, tangent=X, normal=-Z)
    top = Joint(((0, "end"), (1, "start")))
    force = Force(load, at=(0, "end"))
    return Scene([mast, light], Clamp(at=(0, "start")), force, "planar", top)


@pytest.mark.parametrize("EI", [1e-2, 1e-4, 1e-6])
def test_light_rods_do_not_hide_the_load_of_heavy_ones(EI: float) -> None:
    found = critical_load(with_pennant(Rod.straight(1.0, 32, ROUND), EI, -Z))
    holds(found, EULER["clamped-free"], 1e-6)


@pytest.mark.parametrize("spans", [1, 5, 20])
def test_many_supports_make_a_strong_column(spans: int) -> None:
    """With its spans hinged the load is that of one of them: their number squared times pi^2."""
    rod = Rod.straight(1.0, 8 * spans, ROUND)
    held = [Slider(Z, at=i / spans if i < spans else "end") for i in range(1, spans + 1)]
    found = critical_load(Scene(rod, [Hinge(), *held], Force(-Z), "planar"))
    within(found, spans**2 * np.pi**2, 1e-4)


def test_what_is_pulled_has_no_critical_load() -> None:
    found = critical_load(with_pennant(Rod.straight(1.0, 8, ROUND), 1e-4, Z))
    assert (found.kind, found.factor) == ("none", np.inf)
    assert found.grid_factor >= 100 * np.pi**2
    assert found.equilibrium.stable


def test_loads_do_not_grow_beyond_sense() -> None:
    """A rod too soft along its axis to buckle, as P (1 - P/EA) < P_E, is turned inside out."""
    rod = Rod.straight(1.0, 8, Section(1, 1, 1, EA=3 * EULER["clamped-free"]))
    found = critical_load(Scene(rod, Clamp(), Force(-Z), "planar"))
    assert found.kind == "none"
    assert 0.4 < found.grid_factor / rod.stretching[0, 2] < 1


# Loss and return of stability ---------------------------------------------------------------------


def shortening(excess: float) -> tuple[Rod, float]:
    """A column that is unstable between two loads only, and the lower: P (1 - P/EA) = P_E."""
    ratio = 4 * (1 + excess)
    EA = ratio * EULER["clamped-free"]
    return Rod.straight(1.0, 16, Section(1, 1, 1, EA=EA)), EA * (1 - np.sqrt(1 - 4 / ratio)) / 2


@pytest.mark.parametrize("excess", [1e-4, 1e-3, 1e-2])
@pytest.mark.parametrize("part", [0.8, 0.87, 0.95])
def test_stability_that_returns_is_missed_neither_where_it_is_lost(
    excess: float, part: float
) -> None:
    rod, exact = shortening(excess)
    upper = part * rod.stretching[0, 2]
    found = critical_load(Scene(rod, Clamp(), Force(-Z), "planar"), upper)
    holds(found, exact, 0.02)


@pytest.mark.parametrize("part", [0.8, 0.87, 0.95])
def test_a_softer_mode_does_not_hide_it(part: float) -> None:
    """The lowest eigenvalue is that of the pennant, and changes only where stability is lost."""
    rod, exact = shortening(0.03)
    upper = part * rod.stretching[0, 2]
    holds(critical_load(with_pennant(rod, 1e-3, -Z), upper), exact, 0.02)


# Sections and loads that are not smooth -----------------------------------------------------------


def stepped(n: int, at: float, EI: float) -> Scene:
    """A column, thicker up to a place."""

    def section(s: float) -> Section:
        return Section(EI, EI, EI) if s < at else Section(1, 1, 1)

    return Scene(Rod.straight(1.0, n, section), Clamp(), Force(-Z), "planar")


def of_stepped(at: float, EI: float) -> float:
    """The root of EI1 k1 cos k1 a cos k2 b = EI2 k2 sin k1 a sin k2 b, with k^2 = P/EI."""

    def left(P: float) -> float:
        k1, k2 = np.sqrt(P / EI), np.sqrt(P)
        up, down = k1 * at, k2 * (1 - at)
        return float(EI * k1 * np.cos(up) * np.cos(down) - k2 * np.sin(up) * np.sin(down))

    loads = np.linspace(1, EI * 2.5, 2001)
    low, high = next((a, b) for a, b in pairwise(loads) if left(a) > 0 >= left(b))
    return float(brentq(left, low, high, xtol=1e-14))


@pytest.mark.parametrize(
    ("n", "at", "EI"), [(8, 0.55, 10), (8, 0.5, 10), (31, 0.31, 2), (9, 0.97, 10), (64, 0.013, 2)]
)
def test_sections_that_jump(n: int, at: float, EI: float) -> None:
    holds(critical_load(stepped(n, at, EI)), of_stepped(at, EI), 1e-3)


def random_columns(count: int) -> Any:
    """8 to 64 edges, a step anywhere, 2:1 and 10:1."""
    rng = np.random.default_rng(6)
    for i in range(count):
        yield int(rng.integers(8, 65)), float(rng.uniform(0.01, 0.99)), (2, 10)[i % 2]


@pytest.mark.long
@pytest.mark.parametrize("seen", [True, False], ids=["cut at the jump", "not seen"])
def test_many_sections_that_jump(seen: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    """No error is larger than told; if the jump is seen, most are not much smaller either."""
    if not seen:
        monkeypatch.setattr(Scene, "_climbing", property(lambda scene: scene))
    times, warned = [], 0
    for n, at, EI in random_columns(170):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            found, exact = critical_load(stepped(n, at, EI)), of_stepped(at, EI)
        warned += len(caught)
        times.append(found.error / max(abs(found.factor - exact), 1e-13 * exact))
    wide = sum(t > 100 for t in times)
    print(
        f"{len(times)} columns: told/true from {min(times):.2f}, {wide} above 100, {warned} warned"
    )
    assert min(times) >= 1
    assert wide < 0.2 * len(times)
    assert (warned == 0) == seen


def test_jumps_that_are_not_seen_are_warned_of(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Scene, "_climbing", property(lambda scene: scene))
    with pytest.warns(AccuracyWarning, match="converge with order .* is not smooth inside an edge"):
        found = critical_load(stepped(8, 0.55, 10))
    assert abs(found.factor - of_stepped(0.55, 10)) <= found.error


def test_loads_that_jump() -> None:
    """Only the part above 0.63 is heavy; a start has the edges of the scene, not of the grid."""
    rod = Rod.straight(1.0, 16, ROUND)
    force = DistributedForce(lambda s: (0, 0, -1.0 * (s > 0.63)))
    scene = Scene(rod, Clamp(), force, "planar")

    def end(w: float) -> float:
        """The moment at the end of a column whose angle is 1 there: zero if it buckles."""

        def rates(s: float, z: Any) -> Any:
            return [z[1], -w * (1 - max(s, 0.63)) * z[0]]

        z = np.array([0.0, 1.0])
        for part in ((0, 0.63), (0.63, 1)):
            z = solve_ivp(rates, part, z, method="DOP853", rtol=1e-12, atol=1e-14).y[:, -1]
        return float(z[1])

    exact = brentq(end, 5, 12, xtol=1e-12)
    holds(critical_load(scene), exact, 1e-4)
    holds(critical_load(scene, start=solve(scene)), exact, 1e-4)


def test_whole_numbers_are_stiffnesses_too() -> None:
    """The mean of both sides of a vertex was cut to a whole number."""

    def rod(*EI: Any) -> Rod:
        sections = [Section(x, x, x) for x in EI]
        return Rod.straight(1.0, 8, lambda s: sections[int(s >= 0.55)]).with_vertices([0.55])

    assert rod(10, 1) == rod(10.0, 1.0)
    assert Section(10, 1, 1).bending.dtype == Section(1, 1, 1, 2, 2, 2).stretching.dtype == float
