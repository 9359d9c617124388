"""Scenes of all kinds to a tolerance, against much finer grids; loads and stiffness that jump."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from support import ROUND, SOFT, X, Y, Z, extrapolated

import pyrod
from pyrod import (
    Clamp,
    DistributedForce,
    DistributedMoment,
    Equilibrium,
    Force,
    Gravity,
    Hinge,
    Joint,
    Options,
    Rod,
    Scene,
    Section,
    Slider,
    Spring,
    rotation,
)

HEAVY = Section(EI1=1.0, EI2=1.3, GJ=0.8, GA1=60.0, GA2=80.0, EA=150.0, mass_per_length=0.5)
UPWARD = rotation.frame_along(Z, X)
LEVEL = rotation.frame_along(X, Z)


def portal(n: int | None) -> Scene:
    """Two posts and a beam, rigid and by an axis, under weight and a push."""
    rods = [
        Rod.straight(1.0, n, HEAVY).placed((0, 0, 0), UPWARD),
        Rod.straight(1.0, n, HEAVY).placed((0, 0, 1), LEVEL),
        Rod.straight(1.0, n, HEAVY).placed((1, 0, 0), UPWARD),
    ]
    joints = [Joint(((0, "end"), (1, "start"))), Joint(((1, "end"), (2, "end")), "hinge", axis=Y)]
    held = [Clamp(at=(0, "start")), Clamp(at=(2, "start"))]
    return Scene(rods, held, [Gravity(), Force((0.5, 0.3, 0), at=(1, "start"))], joints=joints)


def ring(n: int | None) -> Scene:
    """A ring that is hung up, with a weight."""
    rod = Rod.precurved(1.0, n, SOFT, (0, 2 * np.pi, 0))
    return Scene(rod, Clamp(), Force((0, 3, -4), at=0.5), joints=Joint(("start", "end")))


def sprung(n: int | None) -> Scene:
    """A beam on a hinge, a slider and a spring."""
    held = [
        Clamp((0, 0, 0), at="start"),
        Slider((0, 0, 1), at="end"),
        Spring(20.0, at=0.5),
    ]
    return Scene(Rod.straight(1.0, n, SOFT), held, Force((4, 2, -1), at=0.75))


def pushed(n: int | None) -> Scene:
    """A follower force at the end, and pressure that follows."""
    loads = [
        Force((2, 1, -1), follower=True),
        DistributedForce((1.0, 0.5, 0.0), follower=True),
    ]
    return Scene(Rod.straight(1.0, n, SOFT), Clamp(), loads)


def hinged(n: int | None) -> Scene:
    held = [Hinge((0, 0, 0)), Hinge((0.1, 0, 0.9), at="end")]
    return Scene(Rod.straight(1.0, n, ROUND), held, Force((1, 0, 0), at=0.5), "planar")


def numbers(result: Equilibrium, stride: int = 1) -> dict[str, np.ndarray]:
    return {
        "positions": np.vstack([rod.positions[::stride] for rod in result.rods]),
        "forces": np.vstack([rod.vertex_force[::stride] for rod in result.rods]),
        "moments": np.vstack([rod.moment[::stride] for rod in result.rods]),
        "energy": np.array([[result.energy]]),
        "reactions": np.vstack([r.force for r in result.reactions]),
    }


@pytest.mark.parametrize("scene", [portal, ring, sprung, pushed, hinged])
def test_all_scenes_to_a_tolerance(scene: Callable[[int | None], Scene]) -> None:
    """Against plain solves of up to 1024 edges a rod, each started from that before."""
    result = pyrod.solve(scene(None), tol=1e-8)
    assert result.accuracy.regular
    assert result.accuracy.reached <= 1e-8
    assert max(result.balance) < 1e-12
    base = result.rods[0].rod.edges
    fine = [pyrod.solve(scene(base * 2**k), Options(tolerance=1e-9)) for k in range(3, 7)]
    found = numbers(result)
    told = [numbers(other, 2**k) for k, other in enumerate(fine, start=3)]
    for name, value in found.items():
        exact = extrapolated([level[name] for level in told])
        size = 1.0 if name == "positions" else np.linalg.norm(exact, axis=1).max()
        error = np.linalg.norm(value - exact, axis=1).max() / (size or 1.0)
        assert error <= max(result.accuracy.errors[name], 1e-9), name
        plain = np.linalg.norm(told[-1][name] - exact, axis=1).max() / (size or 1.0)
        assert error < plain or plain < 1e-9  # ... which these grids are farther from


# What jumps ---------------------------------------------------------------------------------------

AT = 1 / 3  # never where edges are halved


def step_load(s: float) -> tuple[float, float, float]:
    return (8.0, 3.0, 0.0) if s < AT else (0.0, 0.0, -2.0)


def step_couple(s: float) -> tuple[float, float, float]:
    return (0.0, 2.0, 0.5) if s > AT else (0.0, 0.0, 0.0)


def kink(s: float) -> tuple[float, float, float]:
    return (0.5, abs(s - AT), 0.2)


JUMPS = {
    "force": lambda rod: Scene(rod, Clamp(), [DistributedForce(step_load), Force(X)]),
    "couple": lambda rod: Scene(rod, Clamp(), [DistributedMoment(step_couple), Force(X)]),
    "between clamps": lambda rod: Scene(
        rod, [Clamp(), Clamp((0.1, 0, 0.9), at="end")], DistributedForce(step_load)
    ),
}


@pytest.mark.parametrize("make", JUMPS.values(), ids=JUMPS)
@pytest.mark.parametrize("tol", [1e-3, 1e-9])
def test_a_load_that_jumps_inside_an_edge_is_found(
    make: Callable[[Rod], Scene], tol: float
) -> None:
    """As with a vertex that was given; which the last bit of 1/3 decides where it is."""
    rod = Rod.straight(1.0, None, SOFT)
    found = pyrod.solve(make(rod), tol=tol)
    exact = pyrod.solve(make(rod.with_vertices(AT)), tol=1e-10)
    for result in (found, exact):
        assert result.accuracy.regular
        assert result.accuracy.grids <= 6
    # compared at the end and in sums, which both have
    assert np.linalg.norm(found.tip - exact.tip) <= found.errors["positions"] + 1e-10
    assert abs(found.energy / exact.energy - 1) <= found.errors["energy"] + 1e-10
    size = np.linalg.norm(exact.vertex_force, axis=1).max()
    for one, true in zip(found.reactions, exact.reactions, strict=True):
        error = np.linalg.norm(one.force - true.force) / size
        assert error <= max(found.errors["reactions"], found.errors["forces"]) + 1e-10


def test_a_kink_of_the_curvature_with_a_vertex_is_as_good_as_none() -> None:
    rod = Rod.precurved(1.0, None, SOFT, kink).with_vertices(AT)
    result = pyrod.solve(Scene(rod, Clamp(), Force((1, 2, -1))), tol=1e-10)
    assert result.accuracy.regular
    finer = pyrod.solve(
        Scene(Rod.precurved(np.repeat(rod.edge_lengths / 4, 4), None, SOFT, kink), Clamp(),
              Force((1, 2, -1))), tol=1e-10)  # fmt: skip
    assert np.abs(result.positions - finer.positions[::4]).max() < 2e-10


@pytest.mark.parametrize("model", ["cosserat", "inextensible"])
def test_a_section_that_jumps_has_a_vertex(model: str) -> None:
    """Against two rods that are joined there."""

    def section(s: float) -> Section:
        return SOFT if s < AT else Section(3.0, 2.0, 1.5, 90.0, 70.0, 200.0)

    def rod(n: int | None) -> Rod:
        return Rod.straight(1.0, n, section, model)

    load = Force((3, 2, -1))
    with_vertex = pyrod.solve(Scene(rod(None).with_vertices(AT), Clamp(), load), tol=1e-9)
    first = Rod.straight(AT, 16, SOFT, model)
    second = Rod.straight(1 - AT, 16, section(1.0), model).placed((0, 0, AT))
    joined = pyrod.solve(
        Scene([first, second], Clamp(), Force((3, 2, -1), at=(1, "end")),
              joints=Joint(((0, "end"), (1, "start")))), tol=1e-10)  # fmt: skip
    assert with_vertex.accuracy.regular
    assert np.linalg.norm(with_vertex.tip - joined.rods[1].positions[-1]) < 1e-9
    assert with_vertex.energy == pytest.approx(joined.energy, rel=2e-9)
    alone = pyrod.solve(Scene(rod(None), Clamp(), load), tol=1e-9)  # it finds the place
    assert alone.accuracy.regular
    assert np.linalg.norm(alone.tip - with_vertex.tip) <= 2e-9
    assert alone.energy == pytest.approx(with_vertex.energy, rel=2e-9)


def test_a_load_by_edges_holds_for_all_of_an_edge() -> None:
    values = np.zeros((20, 3))
    values[:9] = (3.0, -1.0, 0.5)  # up to 0.45, a vertex
    rod = Rod.straight(1.0, 20, SOFT)
    by_edges = pyrod.solve(Scene(rod, Clamp(), DistributedForce(values)), tol=1e-10)
    step = DistributedForce(lambda s: (3.0, -1.0, 0.5) if s < 0.45 else (0, 0, 0))
    by_function = pyrod.solve(
        Scene(Rod.straight(1.0, None, SOFT).with_vertices(0.45), Clamp(), step), tol=1e-10
    )
    assert by_edges.accuracy.regular
    assert np.linalg.norm(by_edges.tip - by_function.tip) < 2e-10


def test_reactions_are_those_of_the_whole_load() -> None:
    """A load that no grid samples exactly, and its sum."""
    scene = Scene(
        Rod.straight(1.0, None, ROUND), Clamp(), DistributedForce(lambda s: np.exp(s) * X)
    )
    for tol in (1e-4, 1e-9):
        result = pyrod.solve(scene, tol=tol)
        error = np.linalg.norm(result.reactions[0].force + (np.e - 1) * X) / (np.e - 1)
        assert error <= result.accuracy.errors["reactions"] <= tol
        assert error > 1e-11 or tol < 1e-4
        assert max(result.balance) < 1e-12


def test_a_point_load_between_given_vertices_gets_one() -> None:
    """Shared by two vertices as by a lever, it would be another load on every grid."""
    load = Force((1, 2, -3), at=AT)
    given = pyrod.solve(Scene(Rod.straight(1.0, 16, SOFT), Clamp(), load), tol=1e-9)
    chosen = pyrod.solve(Scene(Rod.straight(1.0, None, SOFT), Clamp(), load), tol=1e-9)
    assert given.accuracy.regular
    assert np.isin(np.arange(17) / 16, given.scene.rod.arc_lengths).all()
    assert np.linalg.norm(given.tip - chosen.tip) < 2e-9


def test_sections_and_curvature_by_edges_and_vertices() -> None:
    """A list holds for each edge, curvature is linear between vertices, on finer grids as well."""
    stiff = Section(3.0, 2.0, 1.5, 90.0, 70.0, 200.0)
    s = np.arange(17) / 16
    K0 = np.column_stack([np.abs(s - 0.5), s, 0 * s])
    listed = Rod.precurved(1.0, 16, [SOFT] * 8 + [stiff] * 8, K0)
    told = Rod.precurved(
        1.0, None, lambda s: SOFT if s < 0.5 else stiff, lambda s: (abs(s - 0.5), s, 0)
    ).with_vertices(0.5)
    a, b = (pyrod.solve(Scene(rod, Clamp(), Force((1, 2, -1))), tol=1e-9) for rod in (listed, told))
    assert a.accuracy.regular
    assert b.accuracy.regular
    assert np.linalg.norm(a.tip - b.tip) < 2e-9
    assert a.energy == pytest.approx(b.energy, rel=4e-9)
