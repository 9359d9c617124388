"""Sections, curvatures and loads that jump or have kinks inside an edge, found by themselves."""

from __future__ import annotations

import pickle
import warnings
from collections.abc import Callable

import numpy as np
import pytest
from independent import Elastica

import pyrod
from pyrod import (
    AccuracyWarning,
    Clamp,
    DistributedForce,
    Force,
    Moment,
    NotConverged,
    Rod,
    Scene,
    Section,
    _core,
)

Array = np.ndarray
ROUND = Section(EI1=1.0, EI2=1.0, GJ=0.7)
LOAD = np.array([10.0, 0.0])


def table(stations: Array, values: Array) -> Callable[[float], Section]:
    return lambda s: Section(1.0, float(np.interp(s, stations, values)), 1.0)


def solved(stations: Array, values: Array, edges: int | None, tol: float) -> pyrod.Equilibrium:
    rod = Rod.straight(1.0, edges, table(stations, values))
    return pyrod.solve(Scene(rod, Clamp(), Force((*LOAD[:1], 0, *LOAD[1:])), "planar"), tol=tol)


def true_errors(result: pyrod.Equilibrium, stations: Array, values: Array) -> dict[str, float]:
    """Of the end and of the moment at the clamp, against the elastica."""
    q = result.rods[0].vertex_frames[-1]
    rod = Elastica(1.0, lambda s: float(np.interp(s, stations, values)), LOAD, stations)
    end, moment = rod.solved(2 * np.arctan2(q[2], q[0]))
    found = result.moment[0, 1]
    return {
        "positions": float(np.linalg.norm(result.tip[[0, 2]] - end)),
        "moments": abs(found - moment) / np.abs(result.moment).max(),
    }


def check(stations: Array, values: Array, edges: int | None, tol: float) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        result = solved(stations, values, edges, tol)
    assert result.accuracy.regular
    assert result.accuracy.reached <= tol
    for name, error in true_errors(result, stations, values).items():
        assert error <= result.errors[name] + 2e-12, name  # the reference is good to 1e-12


@pytest.mark.parametrize("edges", [None, 10, 16])
def test_stiffness_from_a_table(edges: int | None) -> None:
    """Its kink at 0.179 used to spoil errors of 6e-7, told as 5e-9."""
    stations, values = np.array([0, 0.179, 1]), np.array([1.0, 4.0, 1.0])
    for tol in (1e-6, 1e-9):
        check(stations, values, edges, tol)


def random_table(rng: np.random.Generator, inner: int) -> tuple[Array, Array]:
    stations = np.concatenate([[0.0], np.sort(rng.uniform(0.01, 0.99, inner)), [1.0]])
    return stations, rng.uniform(1, 4, inner + 2)


@pytest.mark.parametrize("number", range(8))
def test_random_tables(number: int) -> None:
    rng = np.random.default_rng(1000 + number)
    check(
        *random_table(rng, 1 if number % 2 else rng.integers(3, 11)), (None, 10)[number // 4], 1e-6
    )


@pytest.mark.long
@pytest.mark.parametrize("number", range(600))
def test_many_random_tables(number: int) -> None:
    """Half with one kink, half with five to twelve stations; no true error above the told one."""
    rng = np.random.default_rng(number)
    edges = (None, 10, 32)[number % 3]
    check(*random_table(rng, 1 if number < 300 else rng.integers(3, 11)), edges, 1e-6)


AT = 0.4321


@pytest.mark.parametrize("edges", [None, 16])
@pytest.mark.parametrize("tol", [1e-4, 1e-9])
def test_a_load_with_a_step(edges: int | None, tol: float) -> None:
    """Grids of 16, 32 and 64 edges see it at 0.4375. Against a rod that has a vertex there."""
    step = DistributedForce(lambda s: (5.0 if s > AT else 0.0, 0.0, 0.0))
    h = np.concatenate([np.full(8, AT / 8), np.full(8, (1 - AT) / 8)])
    by_edges = DistributedForce(np.repeat([(0.0, 0, 0), (5.0, 0, 0)], 8, axis=0))
    given = Rod.precurved(h, None, ROUND, (0, 0, 0))
    exact = pyrod.solve(Scene(given, Clamp(), by_edges), tol=1e-11)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = pyrod.solve(Scene(Rod.straight(1.0, edges, ROUND), Clamp(), step), tol=tol)
    assert np.isclose(found.rod.arc_lengths, AT, rtol=0, atol=1e-10).any()
    error = np.linalg.norm(found.tip - exact.tip)
    assert error <= found.errors["positions"] + exact.errors["positions"]
    assert np.allclose(found.reactions[0].force, (-5 * (1 - AT), 0, 0), rtol=0, atol=1e-9)


def test_sections_and_curvatures_that_jump() -> None:
    """As functions and edge by edge."""
    thick = Section(EI1=2.0, EI2=3.0, GJ=1.0)
    h = np.concatenate([np.full(8, AT / 8), np.full(8, (1 - AT) / 8)])
    K0 = np.repeat([(0.0, 1.0, 0.5), (0.0, 0.0, 0.0)], 8, axis=0)
    sections = Rod.precurved(h, None, [ROUND] * 8 + [thick] * 8, (0, 0, 0))
    stepped = Rod.straight(1.0, None, lambda s: ROUND if s < AT else thick)
    results = [
        pyrod.solve(Scene(rod, Clamp(), Force((3, 1, -1))), tol=1e-9) for rod in (sections, stepped)
    ]
    assert np.linalg.norm(results[0].tip - results[1].tip) < 4e-9
    curved = Rod.precurved(1.0, None, ROUND, lambda s: K0[0] if s < AT else K0[-1])
    first = Rod.precurved(AT, None, ROUND, K0[0])
    r, q = first.at_rest()
    behind = Rod.straight(1 - AT, None, ROUND).placed(r[-1], first.frame_at_rest(first.edges, q))
    joint = pyrod.Joint(((0, "end"), (1, "start")))
    two = Scene([first, behind], Clamp(), Force((3, 1, -1), at=(1, "end")), joints=joint)
    one = pyrod.solve(Scene(curved, Clamp(), Force((3, 1, -1))), tol=1e-9)
    assert np.linalg.norm(one.tip - pyrod.solve(two, tol=1e-9).rods[1].tip) < 1e-8


# The search ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("function", "places"),
    [
        (lambda s: (5.0 if s > AT else 0.0, 0, 0), [AT]),
        (lambda s: (1.0, 1e-5 * (s > AT), np.sin(9 * s)), [AT]),
        (lambda s: (abs(s - 1 / 3), 0.5, 0.2), [1 / 3]),
        (lambda s: (np.exp(s) + 1e-2 * max(s - AT, 0), 0, 0), [AT]),
        (lambda s: (max(s - AT, 0) ** 2, 1, 0), [AT]),
        (lambda s: (np.interp(s, [0, 0.5, 0.5001, 1], [1, 1, 2, 2]), 0, 0), [0.5, 0.5001]),
        (lambda s: (float(0.2 < s < 0.207) + (s > 0.7), 0, 0), [0.2, 0.207, 0.7]),
    ],
)
def test_places_are_found(function: Callable[[float], object], places: list[float]) -> None:
    for length in (1.0, 250.0):
        at, unresolved = _core.breaks(lambda s, L=length: function(s / L), length)
        assert not unresolved
        assert len(at) == len(places)
        exact = np.array(places) * length
        near = 1e-4 if len(places) == 1 and function(0.9)[0] == (0.9 - AT) ** 2 else 1e-9
        assert np.abs(np.array(at) - exact).max() < near * length


@pytest.mark.parametrize(
    "function",
    [
        lambda s: (1, 2, 3),
        lambda s: (np.sin(40 * s), np.exp(-20 * s), 1 / (1 + s)),
        lambda s: (np.tanh((s - AT) / 2e-3), 0, 0),
        lambda s: (1e12 + s, 0, 1e-9 * s**5),
        lambda s: (0.1 + 0.2, 1e-300, 0),
    ],
)
def test_smooth_functions_have_none(function: Callable[[float], object]) -> None:
    found = _core.breaks(function, 1.0)
    assert found == ((), False)


ZIGZAG = np.linspace(0, 1, 401), np.arange(401.0) % 3


@pytest.mark.parametrize(
    "function",
    [
        lambda s: (1 + 1e-5 * np.sin(1e9 * s**2), 0, 0),  # noise, to samples
        lambda s: (np.sqrt(s), 0, 0),
        lambda s: (np.interp(s, *ZIGZAG), 0, 0),
    ],
    ids=["noise", "singular", "too many"],
)
def test_what_cannot_be_found_is_told(function: Callable[[float], object]) -> None:
    assert _core.breaks(function, 1.0)[1]
    scene = Scene(Rod.straight(1.0, None, ROUND), Clamp(), DistributedForce(function))
    with pytest.warns(AccuracyWarning, match="load 0 has more jumps and kinks"):
        pyrod.solve(scene, tol=1e-2)


def test_what_cannot_be_found_is_told_with_what_is_not_reached() -> None:
    noise = DistributedForce(lambda s: (1 + 0.3 * np.sin(1e9 * s**2), 0, 0))
    scene = Scene(Rod.straight(1.0, None, ROUND), Clamp(), noise)
    with pytest.raises(NotConverged, match="load 0 has more jumps and kinks"):
        pyrod.solve(scene, pyrod.Options(max_edges=512), tol=1e-6)


def test_what_functions_raise_comes_through() -> None:
    def ends_early(s: float) -> float:
        if s > 0.7:
            raise LookupError(s)
        return s

    with pytest.raises(LookupError):
        _core.breaks(ends_early, 1.0)
    for start, end in ((0.5, 1.1), (0.501, 0.51)):  # at the first samples, and between them
        with pytest.raises(ValueError, match=r"gives 3 numbers at 0\.50?.*, and 2 at 0"):
            _core.breaks(lambda s, a=start, b=end: (1, 2, 3) if a <= s <= b else (1, 2), 1.0)


def test_vertices_that_are_there_are_taken() -> None:
    """Breaks beside a vertex, a support or another break are these."""
    stepped = lambda s: ROUND if s < 0.1 * 3 else Section(2.0, 2.0, 1.0)  # noqa: E731
    rod = Rod.straight(1.0, None, stepped).with_vertices([0.3])
    load = DistributedForce(lambda s: (float(s > 0.3), 0, 0))
    scene = Scene(rod, [Clamp(), pyrod.Spring(5.0, at=0.3)], [load, Moment((0, 1, 0), at=0.3)])
    assert scene._climbing.rod.edges == rod.edges
    assert rod.edge_lengths.min() > 0.01
    assert rod.with_vertices([0.1 * 3]).edges == rod.edges


def test_scenes_without_functions_ask_nothing() -> None:
    scene = Scene(Rod.straight(1.0, 16, ROUND), Clamp(), Force((1, 0, 0)))
    assert scene._climbing is scene


def test_the_search_is_made_once() -> None:
    asked = []

    def stiffness(s: float) -> Section:
        asked.append(s)
        return Section(1.0, 1.0 + abs(s - AT), 1.0)

    rod = Rod.straight(1.0, None, stiffness)
    scenes = [Scene(rod, Clamp(), Force((f, 0, 0))) for f in (1.0, 2.0)]
    counts = []
    for scene in scenes:
        before = len(asked)
        assert scene._climbing.rod.edges >= 16
        counts.append(len(asked) - before)
    assert counts[1] < 150 < counts[0]


@pytest.mark.parametrize("at", [0.3, 0.37])
def test_sections_edge_by_edge_keep_their_ends_on_the_solvers_own_grid(at: float) -> None:
    """A load between them moved the grid, and 1e-5 was off where 8e-9 was told."""
    thin, thick = Section(1, 1, 1), Section(4, 4, 4)
    loads = [Force((3, 0, 0)), Force((1, 0, 0), at=at)]

    def tip(section: object) -> Array:
        rod = Rod.straight(1.0, None, section)
        return pyrod.solve(Scene(rod, Clamp(), loads), tol=1e-7).tip

    told = tip(lambda s: thin if s < 0.5 else thick)
    np.testing.assert_allclose(tip([thin] * 8 + [thick] * 8), told, rtol=0, atol=2e-8)


def test_loads_edge_by_edge_keep_their_ends_on_the_solvers_own_grid() -> None:
    """Beside a load whose step moves the grid."""
    values = np.where(np.arange(16)[:, None] < 7, (2.0, 0, 0), (0, 0, 0))
    step = DistributedForce(lambda s: (0, 0, 3.0) if s < 0.61 else (0, 0, 0))

    def tip(force: object) -> Array:
        rod = Rod.straight(1.0, None, Section(1, 1, 1))
        loads = [DistributedForce(force), step]
        return pyrod.solve(Scene(rod, Clamp(), loads), tol=1e-7).tip

    told = tip(lambda s: (2.0, 0, 0) if s < 7 / 16 else (0, 0, 0))
    np.testing.assert_allclose(tip(values), told, rtol=0, atol=2e-8)


def test_rows_of_loads_belong_to_the_rod_that_was_given() -> None:
    """A point load moved the grid, of as many edges as before, and the rows with it."""
    rod = Rod.straight(1.0, None, Section(1, 1, 1))
    values = np.where(np.arange(16)[:, None] < 7, (2.0, 0, 0), (0, 0, 0))
    smooth = DistributedForce(lambda s: (2.0, 0, 0) if s < 7 / 16 else (0, 0, 0))
    point = Force((1, 0, 0), at=0.37)
    scene = Scene(rod, Clamp(), [DistributedForce(values), point])
    told = pyrod.solve(Scene(rod, Clamp(), [smooth, point]), tol=1e-7).tip
    np.testing.assert_allclose(pyrod.solve(scene, tol=1e-7).tip, told, rtol=0, atol=2e-8)
    assert len(scene.loads[0].force_per_length) == scene.rod.edges
    again = pickle.loads(pickle.dumps(scene))
    np.testing.assert_allclose(pyrod.solve(again, tol=1e-7).tip, told, rtol=0, atol=2e-8)
