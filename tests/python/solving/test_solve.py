"""Solving: closed forms, invariances, iteration counts, and what a result and a failure tell."""

from __future__ import annotations

import pickle
import warnings
from dataclasses import FrozenInstanceError, fields
from math import inf, pi

import numpy as np
import pytest
from support import IDENTITY, MODELS, ROUND, SOFT, SPACES, differences, random_frames, solved, unit

import pyrod
from pyrod import (
    Clamp,
    DistributedForce,
    DistributedMoment,
    Force,
    Moment,
    Options,
    Rod,
    Scene,
    Section,
    rotation,
)

EULER = pi**2 / 4  # of a cantilever with EI = L = 1


# Closed forms that hold on every grid -------------------------------------------------------------


@pytest.mark.parametrize("space", SPACES)
@pytest.mark.parametrize("n", [1, 2, 3, 17])
def test_pure_moment_bends_to_an_exact_circle(n: int, space: str) -> None:
    result = solved(Rod.straight(1.0, n, SOFT), Moment((0, 2.6, 0)), space=space)
    np.testing.assert_allclose(result.K, np.tile([0, 2, 0], (n + 1, 1)), rtol=0, atol=1e-12)
    np.testing.assert_allclose(result.moment, np.tile([0, 2.6, 0], (n + 1, 1)), rtol=0, atol=1e-12)
    assert result.bend_twist_energy == pytest.approx(1.3 * 2**2 / 2, rel=1e-12)
    assert result.stretch_shear_energy == 0
    assert result.iterations == 1


@pytest.mark.parametrize("space", SPACES)
def test_ten_turns_at_64_edges(space: str) -> None:
    result = solved(Rod.straight(1.0, 64, ROUND), Moment((0, 20 * pi, 0)), space=space)
    np.testing.assert_allclose(result.K, np.tile([0, 20 * pi, 0], (65, 1)), rtol=0, atol=1e-11)
    np.testing.assert_allclose(result.tip, np.zeros(3), rtol=0, atol=1e-12)
    assert result.iterations == 1


@pytest.mark.parametrize("n", [2, 3, 64])
@pytest.mark.parametrize("moment", [(0.3, 0.4, 2.0), (5.0, -4.0, 7.0), (0, 0, 1.0)])
def test_equal_stiffnesses_and_a_dead_moment_give_an_exact_helix(moment, n: int) -> None:
    """With EI = GJ the frames turn about the moment, which is fixed in space."""
    C = 1.7
    result = solved(Rod.straight(1.0, n, Section(C, C, C)), Moment(moment))
    centres = (np.arange(n) + 0.5) / n
    expected = rotation.exp(np.outer(centres, moment) / C)
    np.testing.assert_allclose(result.frames, expected, rtol=0, atol=1e-13)
    np.testing.assert_allclose(
        result.tip_frame, rotation.exp(np.array(moment) / C), rtol=0, atol=1e-13
    )
    assert result.energy == pytest.approx(np.dot(moment, moment) / (2 * C), rel=1e-13)


@pytest.mark.parametrize("n", [2, 3, 64])
def test_a_dead_moment_on_a_round_rod_gives_a_helix(n: int) -> None:
    """Clamped so that the moment makes the helix angle with the rod, Love (1927), art. 270: the
    tangent keeps its angle with the moment, and |kappa| and the torque are the same everywhere."""
    result = solved(Rod.straight(1.0, n, ROUND), Moment((0.0, 3.0, 4.0)))
    kappa = np.hypot(result.K[:, 0], result.K[:, 1])
    np.testing.assert_allclose(kappa[1:-1], kappa[1], rtol=1e-12)
    np.testing.assert_allclose(result.K[1:-1, 2], result.K[1, 2], rtol=1e-12)
    along = rotation.rotate(result.frames, (0, 0, 1)) @ (0, 3, 4)
    np.testing.assert_allclose(along, along[0], rtol=1e-12)


def test_a_rod_without_loads_keeps_its_rest_shape() -> None:
    rod = Rod.precurved(1.0, 40, SOFT, lambda s: (3 * s, 2, 8 - s))
    frame = random_frames(np.random.default_rng(1))
    result = solved(rod, clamp=Clamp((1, 2, 3), frame))
    r, q = rod.at_rest((1, 2, 3), frame)
    np.testing.assert_allclose(result.K, rod.K0, rtol=0, atol=1e-12)
    np.testing.assert_allclose(result.positions, r, rtol=0, atol=1e-14)
    np.testing.assert_allclose(result.frames, q, rtol=0, atol=1e-14)
    assert result.energy < 1e-26


@pytest.mark.parametrize("space", SPACES)
@pytest.mark.parametrize(
    ("model", "stretch"), [("cosserat", 0.3 / 150), ("extensible", 0.3 / 150), ("inextensible", 0)]
)
def test_pulling_stretches_exactly(model: str, stretch: float, space: str) -> None:
    result = solved(Rod.straight(2.0, 5, SOFT, model), Force((0, 0, 0.3)), space=space)
    np.testing.assert_allclose(result.tip, (0, 0, 2 * (1 + stretch)), rtol=0, atol=1e-15)
    assert result.stretch_shear_energy == pytest.approx(0.3 * 2 * stretch / 2, rel=1e-12)
    assert result.bend_twist_energy < 1e-30


def test_twisting_twists_exactly() -> None:
    result = solved(Rod.straight(2.0, 5, SOFT), Moment((0, 0, 1.2)))
    np.testing.assert_allclose(
        result.tip_frame, rotation.exp((0, 0, 2 * 1.2 / 0.8)), rtol=0, atol=1e-14
    )


# Small loads: beam theory -------------------------------------------------------------------------

SMALL = 1e-6  # its square, the nonlinear part, is at the level of rounding
BEAMS = [
    # load, deflection along a1 by EI2 = 1.3, along a2 by EI1 = 1; shear of the cosserat rod
    ("force", Force((SMALL, 0, 0)), 0, 1 / 3 / 1.3, 1 / 60),
    ("force", Force((0, SMALL, 0)), 1, 1 / 3, 1 / 80),
    ("weight", DistributedForce((SMALL, 0, 0)), 0, 1 / 8 / 1.3, 1 / 120),
    ("weight", DistributedForce((0, SMALL, 0)), 1, 1 / 8, 1 / 160),
    ("moment", Moment((0, SMALL, 0)), 0, 1 / 2 / 1.3, 0),
    ("moment", Moment((-SMALL, 0, 0)), 1, 1 / 2, 0),
    ("moments", DistributedMoment((0, SMALL, 0)), 0, 1 / 3 / 1.3, 0),
]


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize(("kind", "load", "axis", "bending", "shear"), BEAMS)
def test_small_deflections_are_timoshenkos(kind, load, axis, bending, shear, model) -> None:
    """The error is that of the midpoint rule: once h^2 is eliminated, rounding is left."""
    expected = SMALL * (bending + (shear if model == "cosserat" else 0))

    def deflection(n: int) -> float:
        return solved(Rod.straight(1.0, n, SOFT, model), load).tip[axis]

    coarse, fine = deflection(8), deflection(16)
    assert (4 * fine - coarse) / 3 == pytest.approx(expected, rel=1e-11)
    if kind == "force":
        discrete = SMALL * bending * (1 + 1 / (2 * 8**2))  # summed by hand for n equal edges
        assert coarse == pytest.approx(expected + discrete - SMALL * bending, rel=1e-11)


# Planar and spatial, here and there ---------------------------------------------------------------


def elbow(model: str, n: int = 24) -> Rod:
    """A rod bent in its plane, of unequal edges and varying stiffness."""
    h = np.random.default_rng(3).uniform(0.5, 1.5, n) / n
    section = lambda s: Section(1 + s, 1.3 - s / 2, 0.8, 60, 80, 150)  # noqa: E731
    return Rod.precurved(h, None, section, lambda s: (0, 2 - s, 0), model)


def planar_loads(frame: np.ndarray) -> list[pyrod.scene.Load]:
    """Loads of every kind in the plane of a1 and a3 of a clamp."""

    def at(*vector: float) -> np.ndarray:
        return rotation.rotate(frame, vector)

    return [
        Force(at(3, 0, 4)),
        Force(at(-2, 0, 1), at=0.4),
        DistributedForce(at(1, 0, 2)),
    ]


QUANTITIES = (
    "positions",
    "K",
    "Gamma",
    "force",
    "material_force",
    "moment",
    "material_moment",
    "energy",
)


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize("seed", range(3))
def test_planar_is_spatial_in_any_plane(seed: int, model: str) -> None:
    rng = np.random.default_rng(seed)
    clamp = Clamp(rng.normal(size=3), random_frames(rng))
    planar, spatial = (
        solved(elbow(model), *planar_loads(clamp.frame), clamp=clamp, space=space)
        for space in SPACES
    )
    for name in (*QUANTITIES, "frames", "vertex_frames"):
        assert differences(getattr(planar, name), getattr(spatial, name)) < 1e-12, name
    assert planar.index == spatial.index == 0


def test_planar_is_spatial_with_a_dead_moment_too() -> None:
    """Which has a potential in the plane only, so that the solvers differ."""
    loads = [Force((2, 0, 1)), Moment((0, 1.5, 0)), DistributedMoment((0, -0.7, 0))]
    planar, spatial = (solved(elbow("cosserat"), *loads, space=space) for space in SPACES)
    for name in QUANTITIES:
        assert differences(getattr(planar, name), getattr(spatial, name)) < 1e-12, name
    assert (planar.index, planar.stable) == (0, True)
    assert (spatial.index, spatial.stable) == (-1, None)


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize("seed", range(3))
def test_rigid_motions_move_the_result(seed: int, model: str) -> None:
    rng = np.random.default_rng(seed)
    move, shift = random_frames(rng), rng.normal(size=3)
    rod = Rod.precurved(1.0, 24, SOFT, (1, -2, 3), model)
    F, f, M = 3 * rng.normal(size=(3, 3))
    here = solved(rod, Force(F), DistributedForce(f), Moment(0.2 * M, at=0.6))
    turn = lambda v: rotation.rotate(move, v)  # noqa: E731
    there = solved(
        rod,
        Force(turn(F)),
        DistributedForce(turn(f)),
        Moment(0.2 * turn(M), at=0.6),
        clamp=Clamp(shift, move),
    )
    assert differences(there.positions - shift, turn(here.positions)) < 1e-12
    assert differences(there.frames, rotation.multiply(move, here.frames)) < 1e-12
    assert differences(there.moment, turn(here.moment)) < 1e-12
    for name in ("K", "Gamma", "material_force", "material_moment", "energy"):
        assert differences(getattr(there, name), getattr(here, name)) < 1e-12, name


# Units --------------------------------------------------------------------------------------------


def in_units(length: float, EI: float, model: str, space: str) -> dict[str, np.ndarray]:
    """One scene in other units, and its result without units."""
    force, moment = EI / length**2, EI / length
    section = Section(EI, 1.3 * EI, 0.8 * EI, 60 * force, 80 * force, 150 * force)
    h = length * np.random.default_rng(3).uniform(0.5, 1.5, 32) / 32
    rod = Rod.precurved(h, None, section, (0, 2 / length, 0), model)
    loads = [
        Force((3 * force, 0, 4 * force)),
        DistributedForce((force / length, 0, 2 * force / length)),
        Moment((0, moment, 0), at=0.7 * rod.length),
    ]
    result = solved(rod, *loads, space=space)
    return {
        "positions": result.positions / length,
        "frames": result.frames,
        "K": result.K * length,
        "Gamma": result.Gamma,
        "force": result.force / force,
        "moment": result.moment / moment,
        "energy": np.array(result.energy / moment),
        "iterations": np.array(result.iterations),
    }


@pytest.mark.parametrize("space", SPACES)
@pytest.mark.parametrize("model", MODELS)
def test_a_strand_of_dna_and_a_cable_are_one(model: str, space: str) -> None:
    strand = in_units(3.4e-8, 2e-28, model, space)  # 100 base pairs
    cable = in_units(1e4, 1e9, model, space)
    for name, value in strand.items():
        assert differences(value, cable[name]) < 1e-12, name


# Effort -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("space", SPACES)
@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize("EA", [1e2, 1e4, 1e6, 1e8])
@pytest.mark.parametrize("load", [1, 10, 100, 1000])
def test_iterations_from_the_straight_start(load: float, EA: float, model: str, space: str) -> None:
    section = Section(1, 1, 1, EA / 2.6, EA / 2.6, EA)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", pyrod.StrainWarning)  # EA = 100 under 1000
        result = solved(Rod.straight(1.0, 64, section, model), Force((load, 0, 0)), space=space)
    assert result.iterations <= 8
    assert result.stable


def forces_within(angle: float, count: int, seed: int) -> np.ndarray:
    """Forces from 1 to 1000 whose directions are within an angle [degrees] of e3."""
    rng = np.random.default_rng(seed)
    directions = unit(rng.normal(size=(4 * count, 3)))
    directions = directions[directions[:, 2] > np.cos(np.radians(angle))][:count]
    return directions * 10 ** rng.uniform(0, 3, (count, 1))


def test_iterations_of_an_anisotropic_precurved_rod_in_space() -> None:
    rod = Rod.precurved(1.0, 64, Section(1, 2.5, 0.8), (0.6, 1.2, 0.9))
    forces = forces_within(120, 100, seed=0)
    assert len(forces) == 100
    counts = [solved(rod, Force(force)).iterations for force in forces]
    assert max(counts) <= 12
    assert np.median(counts) <= 7


@pytest.mark.parametrize("space", SPACES)
def test_a_hundred_thousand_edges(space: str) -> None:
    result = solved(Rod.straight(1.0, 100_000, ROUND), Force((10, 0, 0)), space=space)
    assert result.iterations <= 8
    coarse = [
        solved(Rod.straight(1.0, n, ROUND), Force((10, 0, 0)), space=space).tip for n in (500, 1000)
    ]
    limit = (4 * coarse[1] - coarse[0]) / 3
    np.testing.assert_allclose(result.tip, limit, rtol=0, atol=1e-9)


@pytest.mark.parametrize("moment", [(0, 2, 0), (1, 2, 0.5), (2, -3, 4)])
def test_dead_moments_in_space_converge_quadratically(moment) -> None:
    """The tangent is not symmetric; with all of it each step is of the order of the last one's
    square, here at most four times that."""
    result = solved(Rod.straight(1.0, 64, Section(1, 2, 0.7)), Force((1, 2, 3)), Moment(moment))
    steps = result.record["step"]
    assert result.record["exact"][-3:].all()
    assert steps[-1] < 1e-8
    near = steps < 0.2
    assert near.sum() >= 3
    for before, after in zip(steps[near], steps[near][1:], strict=False):
        assert after < 4 * before**2


# Starts -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("space", SPACES)
def test_a_start_near_the_solution_saves_iterations(space: str) -> None:
    rod = Rod.straight(1.0, 64, SOFT)
    before = solved(rod, Force((10, 0, 1)), space=space)
    scene = Scene(rod, Clamp(), Force((10.5, 0, 1)), space)
    cold, warm = pyrod.solve(scene), pyrod.solve(scene, start=before)
    assert warm.iterations < cold.iterations
    assert differences(warm.positions, cold.positions) < 1e-12
    assert pyrod.solve(scene, start=cold).iterations == 1


@pytest.mark.parametrize("as_matrices", [False, True])
@pytest.mark.parametrize("space", SPACES)
def test_frames_may_start_a_solve(space: str, as_matrices: bool) -> None:
    clamp = Clamp(tangent=(1, 1, 0), normal=(0, 0, 1))
    scene = Scene(Rod.straight(1.0, 32, ROUND), clamp, Force((0, 0, 5)), space)
    solution = pyrod.solve(scene)
    signs = np.random.default_rng(1).choice([-1, 1], (32, 1))
    start = rotation.to_matrix(solution.frames) if as_matrices else signs * solution.frames
    again = pyrod.solve(scene, start=start)
    assert again.iterations == 1
    assert differences(again.frames, solution.frames) < 1e-13  # signs are those of the clamp


def test_a_start_decides_between_equilibria() -> None:
    scene = Scene(Rod.straight(1.0, 64, ROUND), Clamp(), Force((0, 0, -1.3 * EULER)), "planar")
    arcs = [Rod.precurved(1.0, 64, ROUND, (0, K, 0)).at_rest()[1] for K in (2, -2)]
    left, right = (pyrod.solve(scene, start=arc) for arc in arcs)
    assert left.stable
    assert right.stable
    assert left.tip[0] > 0.5
    assert differences(right.positions * [-1, 1, 1], left.positions) < 1e-12


@pytest.mark.parametrize(
    ("start", "message"),
    [
        (np.tile(IDENTITY, (9, 1)), "start: expected 8 rows"),
        (np.zeros((8, 3)), "start: expected quaternions"),
        (np.zeros((8, 4)), "expected a unit quaternion"),
        (np.full((8, 4), np.nan), "expected finite numbers|expected a unit quaternion"),
    ],
)
def test_starts_that_do_not_fit_are_refused(start, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        solved(Rod.straight(1.0, 8, ROUND), start=start)


def test_an_equilibrium_of_another_grid_is_refused_as_a_start() -> None:
    with pytest.raises(ValueError, match="start: expected 8 rows"):
        solved(Rod.straight(1.0, 8, ROUND), start=solved(Rod.straight(1.0, 9, ROUND)))


# Options ------------------------------------------------------------------------------------------


def test_options_have_documented_defaults() -> None:
    options = Options()
    values = (options.max_iterations, options.tolerance, options.trust, options.near)
    assert values == (100, 1e-8, 2.0, 0.5)
    for name in ("max_iterations", "tolerance", "trust", "near"):
        assert len(getattr(Options, name).__doc__) > 20


@pytest.mark.parametrize(
    ("keywords", "message"),
    [
        ({"max_iterations": 0}, "max_iterations: must be at least 1, got 0"),
        ({"tolerance": 0.0}, r"tolerance: must lie in \(0, 1e-3\] rad, got 0"),
        ({"tolerance": 2e-3}, "tolerance: must lie"),
        ({"tolerance": np.nan}, "tolerance: must lie"),
        ({"trust": 0.0}, "trust: must be positive, got 0"),
        ({"trust": np.nan}, "trust: must be positive"),
        ({"near": -1.0}, "near: must not be negative, got -1"),
        ({"near": np.nan}, "near: must not be negative"),
    ],
)
def test_options_are_refused_by_name(keywords, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        Options(**keywords)


def test_unknown_options_are_refused_with_those_there_are() -> None:
    with pytest.raises(TypeError, match="there are: max_iterations, tolerance, trust, near"):
        Options(tolerance=1e-6, tolerence=1e-7)
    with pytest.raises(TypeError):
        Options(100)


def test_options_as_objects() -> None:
    options = Options(tolerance=1e-6, max_iterations=7)
    shown = (
        "max_iterations=7, tolerance=1e-06, trust=2.0, near=0.5, max_edges=262144, max_time=60.0"
    )
    assert repr(options) == f"Options({shown})"
    assert eval(repr(options), vars(pyrod)) == options
    assert pickle.loads(pickle.dumps(options)) == options
    assert options != Options()
    assert options != 7
    with pytest.raises(AttributeError):
        options.trust = 1.0


def test_a_looser_tolerance_saves_iterations() -> None:
    scene = Scene(Rod.straight(1.0, 32, ROUND), Clamp(), Force((10, 0, 0)))
    loose, tight = (pyrod.solve(scene, Options(tolerance=t)) for t in (1e-3, 1e-12))
    assert loose.iterations < tight.iterations
    assert loose.record["step"][-1] <= 1e-3
    assert tight.record["step"][-1] <= 1e-12
    assert differences(loose.positions, tight.positions) < 1e-6  # the square of the step


# Failures -----------------------------------------------------------------------------------------

HARD = Scene(Rod.straight(1.0, 32, ROUND), Clamp(), Force((10, 0, 0)))
FEW = Options(max_iterations=2)


def test_not_converged_carries_the_last_iterate() -> None:
    with pytest.raises(
        pyrod.NotConverged, match="out_of_iterations after 2 iterations: max_iter"
    ) as caught:
        pyrod.solve(HARD, FEW)
    result = caught.value.result
    assert (result.status, result.iterations, result.converged) == ("out_of_iterations", 2, False)
    assert result.index == -1
    assert np.isfinite(result.positions).all()
    assert pyrod.solve(HARD, start=result).converged


def test_not_converged_can_be_pickled() -> None:
    with pytest.raises(pyrod.NotConverged) as caught:
        pyrod.solve(HARD, FEW)
    copy = pickle.loads(pickle.dumps(caught.value))
    assert str(copy) == str(caught.value)
    assert copy.result == caught.value.result


def test_not_strict_returns_the_last_iterate() -> None:
    result = pyrod.solve(HARD, FEW, strict=False)
    assert result.status == "out_of_iterations"
    assert "out_of_iterations" in repr(result)
    assert "allow more" in result.advice


def test_overflow_is_said_to_be_one() -> None:
    rod = Rod.straight(1e200, 8, ROUND)  # F L is more than a double can hold
    result = solved(rod, Force((1e200, 0, 0)), strict=False)
    assert result.status == "not_finite"
    assert "overflowed" in result.advice
    assert not result.converged


def test_a_converged_result_says_so() -> None:
    result = pyrod.solve(HARD)
    assert (result.status, result.converged, result.stable) == ("converged", True, True)
    assert result.advice == "the last full Newton step was below the tolerance"
    assert result.residual < 1e-12


# Stability ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("load", "section", "planar", "spatial"),
    [
        (0.99, ROUND, 0, 0),
        (1.01, ROUND, 1, 2),  # in space it may fall to all sides: two directions
        (1.01, Section(1, 1.3, 1), 0, 1),  # out of the plane
        (1.01, Section(1.3, 1, 1), 1, 1),
        (1.31, Section(1, 1.3, 1), 1, 2),
        (9.01, ROUND, 2, 4),
    ],
)
def test_index_of_a_compressed_column(
    load: float, section: Section, planar: int, spatial: int
) -> None:
    """Euler: a direction more at each of 1, 9, 25, ... times pi^2 EI/(4 L^2)."""
    for space, index in (("planar", planar), ("spatial", spatial)):
        scene = Scene(Rod.straight(1.0, 64, section), Clamp(), Force((0, 0, -load * EULER)), space)
        result = pyrod.solve(scene, stable=False)
        assert result.index == index
        assert result.stable is (index == 0)
        assert ("stable" if index == 0 else f"index {index}") in repr(result)
        left = pyrod.solve(scene)  # without a warning: warnings are errors here
        assert left.stable
        assert (left.descents > 0) is (index > 0)


@pytest.mark.parametrize("space", SPACES)
def test_a_rod_turned_inside_out_is_doubted(space: str) -> None:
    rod = Rod.straight(1.0, 8, Section(100, 100, 100, EA=1))
    with pytest.warns(pyrod.StrainWarning, match=r"turned inside out"):
        solved(rod, Force((0, 0, -1.5)), space=space)


def test_a_grid_too_coarse_for_its_turns_is_doubted() -> None:
    with pytest.warns(pyrod.StrainWarning, match="more edges are needed"):
        solved(Rod.straight(1.0, 2, ROUND), Moment((0, 7.0, 0)), space="planar")


# Results ------------------------------------------------------------------------------------------


def rich_result() -> pyrod.Equilibrium:
    rod = Rod.precurved(1.0, 6, SOFT, (1, 2, 3))
    return solved(rod, Force((1, 2, 3)), DistributedForce(lambda s: (s, 1, 0)), Moment((0.1, 0, 0)))


def arrays(result: pyrod.Equilibrium) -> dict[str, np.ndarray]:
    (rod,) = result.rods
    values = {f.name: getattr(rod, f.name) for f in fields(rod)}
    return {k: v for k, v in values.items() if isinstance(v, np.ndarray)}


def test_shapes_and_consistency() -> None:
    result = rich_result()
    rows = {name: value.shape for name, value in arrays(result).items()}
    assert rows == {
        **dict.fromkeys(("positions", "K", "moment", "material_moment", "load"), (7, 3)),
        **dict.fromkeys(("vertex_force", "vertex_force_before"), (7, 3)),
        **dict.fromkeys(("K_before", "moment_before"), (7, 3)),
        "load_moment": (3,),
        **dict.fromkeys(("Gamma", "force", "material_force"), (6, 3)),
        "frames": (6, 4),
        "vertex_frames": (7, 4),
    }
    np.testing.assert_array_equal(result.s, result.scene.rod.arc_lengths)
    np.testing.assert_array_equal(result.tip, result.positions[-1])
    np.testing.assert_array_equal(result.tip_frame, result.vertex_frames[-1])
    assert result.energy == result.bend_twist_energy + result.stretch_shear_energy
    assert result.time > 0


def test_strains_are_those_of_the_curve() -> None:
    result = rich_result()
    rod = result.scene.rod
    K, Gamma = pyrod.curve.strains(
        rod.edge_lengths, result.positions, result.frames, result.vertex_frames[0], result.tip_frame
    )
    np.testing.assert_allclose(K, result.K, rtol=0, atol=1e-13)
    np.testing.assert_allclose(Gamma, result.Gamma, rtol=0, atol=1e-13)
    np.testing.assert_allclose(
        result.material_moment, rod.bending * (K - rod.K0), rtol=0, atol=1e-12
    )
    np.testing.assert_allclose(
        result.Gamma - [0, 0, 1], result.material_force / rod.stretching, rtol=0, atol=1e-15
    )


@pytest.mark.parametrize(("model", "rigid"), [("extensible", [0, 1]), ("inextensible", [0, 1, 2])])
def test_excluded_strains_are_zero_exactly(model: str, rigid: list[int]) -> None:
    result = solved(Rod.straight(1.0, 8, SOFT, model), Force((5, -4, 3)))
    np.testing.assert_array_equal(result.Gamma[:, rigid], np.tile(np.eye(3)[2][rigid], (8, 1)))


def test_results_do_not_change() -> None:
    result = rich_result()
    with pytest.raises(FrozenInstanceError):
        result.status = "fine"
    for array in (*arrays(result).values(), *result.record.values()):
        with pytest.raises(ValueError, match="read-only"):
            array[...] = 0


def test_results_are_pickled_and_stay_read_only() -> None:
    result = rich_result()
    copy = pickle.loads(pickle.dumps(result))
    for name, array in arrays(copy).items():
        np.testing.assert_array_equal(array, getattr(result, name), err_msg=name)
        assert not array.flags.writeable, name
    for name in ("status", "advice", "index", "residual", "energy", "iterations", "time"):
        assert getattr(copy, name) == getattr(result, name)
    for column, values in result.record.items():
        np.testing.assert_array_equal(copy.record[column], values)
        assert not copy.record[column].flags.writeable, column
    np.testing.assert_array_equal(copy.reaction, result.reaction)
    assert repr(copy) == repr(result)


def test_equal_scenes_have_equal_results() -> None:
    def result(force: float) -> pyrod.Equilibrium:
        return solved(Rod.straight(1.0, 6, SOFT), Force((force, 0, 0)))

    assert result(1.0) == result(1.0)
    assert result(1.0) != result(2.0)


def test_repr_tells_what_was_found() -> None:
    result = solved(Rod.straight(1.0, 6, SOFT), Moment((0, 1.3, 0)), space="planar")
    text = repr(result)
    for part in (
        "Equilibrium(Rod(cosserat, straight, length=1, edges=6)",
        "1 iterations",
        "stable",
        "energy=0.65,",
        f"tip=({result.tip[0]:.6g}, 0, {result.tip[2]:.6g})",
        "ms)",
    ):
        assert part in text
    assert "no potential" in repr(rich_result())


def test_record_has_a_line_per_iteration() -> None:
    result = pyrod.solve(HARD)
    names = {"exact", "energy", "residual", "step", "fraction", "shift", "factorisations"}
    assert set(result.record) == names
    assert {len(column) for column in result.record.values()} == {result.iterations}
    assert result.record["exact"][-1]
    assert not result.record["exact"][0]
    assert (result.record["factorisations"] >= 1).all()
    assert result.record["residual"][0] > 1e-2 > 1e-12 > result.residual


def test_verbose_prints_a_line_per_iteration(capsys: pytest.CaptureFixture[str]) -> None:
    result = pyrod.solve(HARD, verbose=True)
    *lines, summary = capsys.readouterr().out.splitlines()
    assert summary == (
        f"converged: {result.iterations} iterations, {result.unknowns} unknowns of which "
        "0 multipliers, fill 1.00"
    )
    for line, residual, step in zip(
        lines, result.record["residual"], result.record["step"], strict=True
    ):
        assert f"residual {residual:.2e}" in line
        assert f"step {step:.2e} rad" in line
    pyrod.solve(HARD)
    assert capsys.readouterr().out == ""


def test_verbose_does_not_change_the_result() -> None:
    assert pyrod.solve(HARD, verbose=True) == pyrod.solve(HARD)


# Frames that count turns --------------------------------------------------------------------------


@pytest.mark.parametrize("space", SPACES)
def test_signs_of_frames_are_continued_from_the_clamp(space: str) -> None:
    frame = random_frames(np.random.default_rng(1))
    M = rotation.rotate(frame, (0, 7.5, 0))  # over 2 pi
    result = solved(Rod.straight(1.0, 64, ROUND), Moment(M), clamp=Clamp(frame=frame), space=space)
    all_frames = np.vstack([frame, result.frames, result.tip_frame])
    assert (np.einsum("ij,ij->i", all_frames[1:], all_frames[:-1]) > 0.99).all()
    expected = rotation.multiply(frame, rotation.exp((0, 7.5, 0)))
    np.testing.assert_allclose(result.tip_frame, expected, rtol=0, atol=1e-12)


def test_infinite_stiffness_is_the_limit_of_large_ones() -> None:
    """Inextensible and shear-free results are approached with the first power of 1/EA."""

    def tip(EA: float, model: str = "cosserat") -> np.ndarray:
        rod = Rod.straight(1.0, 32, Section(1, 1.3, 0.8, EA, EA, EA), model)
        return solved(rod, Force((3, -2, 5))).tip

    limit = tip(1.0, "inextensible")
    gaps = [np.linalg.norm(tip(EA) - limit) for EA in (1e4, 1e5, 1e6)]
    np.testing.assert_allclose([gaps[0] / gaps[1], gaps[1] / gaps[2]], 10, rtol=2e-3)
    np.testing.assert_allclose(tip(inf), limit, rtol=0, atol=1e-15)


@pytest.mark.parametrize(
    ("force", "moment"),
    [
        ((7.4, 5.4, -4.0), (-9.0, -4.4, 0.3)),
        ((-9.7, -2.0, -1.5), (7.9, 3.1, 5.2)),
        ((4.0, -4.3, 8.1), (4.5, 5.2, 7.2)),
    ],
)
def test_large_moments_and_forces_are_brought_on_in_steps(
    force: tuple[float, ...], moment: tuple[float, ...]
) -> None:
    """Without a potential, Newton's method fails from afar; the call does not."""
    rod = pyrod.Rod.straight(1.0, 64, pyrod.Section(1, 2, 0.6))
    scene = pyrod.Scene(rod, pyrod.Clamp(), [pyrod.Force(force), pyrod.Moment(moment)])
    result = pyrod.solve(scene)
    assert result.load_steps > 0
    assert result.residual < 1e-11
    lever = np.cross(result.tip, force) + moment
    np.testing.assert_allclose(result.moment[0], lever, atol=1e-10)
    again = pyrod.solve(scene, start=result)
    assert (again.iterations, again.load_steps) == (1, 0)
