"""How loads reach the grid, and that reactions balance all of them."""

from __future__ import annotations

import numpy as np
import pytest
from support import MODELS, SOFT, SPACES, differences, solved
from test_scene import UNEQUAL

import pyrod
from pyrod import Clamp, DistributedForce, DistributedMoment, Force, Moment, Rod, rotation


def vertex_loads(result: pyrod.Equilibrium) -> np.ndarray:
    """The forces on the free vertices: by how much the section force falls there."""
    n = np.vstack([result.force, np.zeros(3)])
    return n[:-1] - n[1:]


# How loads reach the grid -------------------------------------------------------------------------


@pytest.mark.parametrize("at", [0.0, 0.1, 0.2, 0.5, 0.7, 1.0, 1.3, 1.99, 2.0])
def test_a_force_between_vertices_is_shared_as_by_a_lever(at: float) -> None:
    force = np.array([0.1, -0.2, 0.3])
    shares = vertex_loads(solved(UNEQUAL, Force(force, at=at))) @ force / (force @ force)
    s = UNEQUAL.arc_lengths
    start_share = max(0.0, 1 - at / s[1])
    assert shares.sum() == pytest.approx(1 - start_share, abs=1e-15)
    assert shares @ s[1:] == pytest.approx(at, abs=1e-15)
    assert np.count_nonzero(np.abs(shares) > 1e-14) <= 2


@pytest.mark.parametrize(("word", "at"), [("start", 0.0), ("end", 2.0)])
def test_places_may_be_words(word: str, at: float) -> None:
    loads = [[Force((1, 2, 3), at=p), Moment((0.1, 0.2, 0.3), at=p)] for p in (word, at)]
    a, b = (solved(UNEQUAL, *pair) for pair in loads)
    np.testing.assert_array_equal(a.positions, b.positions)
    assert differences(a.reaction, b.reaction) == 0


def test_loads_on_the_clamp_reach_the_clamp_only() -> None:
    result = solved(UNEQUAL, Force((1, 2, 3), at="start"), Moment((4, 5, 6), at="start"))
    np.testing.assert_array_equal(result.positions, UNEQUAL.at_rest()[0])
    np.testing.assert_array_equal(result.reaction, [(-1, -2, -3), (-4, -5, -6)])
    assert not result.force.any()


def test_a_uniform_load_puts_half_an_edge_on_either_vertex() -> None:
    result = solved(UNEQUAL, DistributedForce((0, 0, 3)))
    h = UNEQUAL.edge_lengths
    expected = 3 * (h + np.append(h[1:], 0)) / 2
    np.testing.assert_allclose(vertex_loads(result)[:, 2], expected, rtol=0, atol=1e-14)
    np.testing.assert_allclose(result.reaction[0], (0, 0, -6), rtol=0, atol=1e-14)
    np.testing.assert_allclose(result.vertex_force[[0, -1], 2], (6, 0), rtol=0, atol=1e-14)


@pytest.mark.parametrize("load", [DistributedForce, DistributedMoment])
def test_functions_are_taken_at_the_centres_of_the_edges(load) -> None:
    s = UNEQUAL.arc_lengths
    centres = (s[1:] + s[:-1]) / 2
    given = (
        lambda s: (s, 0.1, -(s**2)),
        np.column_stack([centres, np.full(5, 0.1), -(centres**2)]),
    )
    a, b = (solved(UNEQUAL, load(values)) for values in given)
    np.testing.assert_array_equal(a.positions, b.positions)
    same_everywhere = (solved(UNEQUAL, load(v)) for v in ((1, 2, 3), np.tile((1.0, 2, 3), (5, 1))))
    c, d = same_everywhere
    np.testing.assert_array_equal(c.positions, d.positions)


def test_loads_add_up() -> None:
    many = [
        Force((1, 0, 0)),
        Force((0, 1, 0)),
        DistributedForce((0, 0, 1)),
        DistributedForce((0, 0, 2)),
    ]
    few = [Force((1, 1, 0)), DistributedForce((0, 0, 3))]
    a, b = solved(UNEQUAL, *many), solved(UNEQUAL, *few)
    np.testing.assert_allclose(a.positions, b.positions, rtol=0, atol=1e-15)


# Balance ------------------------------------------------------------------------------------------


def random_loads(rng: np.random.Generator, rod: Rod, space: str) -> list[pyrod.scene.Load]:
    forces, spins = ((3, 3), (3, 3))
    F, f = rng.normal(size=forces), rng.normal(size=(rod.edges, 3))
    M, l = 0.3 * rng.normal(size=spins), 0.3 * rng.normal(size=(rod.edges, 3))  # noqa: E741
    if space == "planar":
        F[:, 1], f[:, 1] = 0, 0
        M[:, ::2], l[:, ::2] = 0, 0
    places = ["end", *rng.uniform(0, rod.length, 2)]
    point_loads = [
        kind(v, at=s)
        for kind, vs in ((Force, F), (Moment, M))
        for v, s in zip(vs, places, strict=True)
    ]
    return [*point_loads, DistributedForce(f), DistributedMoment(l)]


def place(r: np.ndarray, rod: Rod, s: float) -> np.ndarray:
    """Where the point of arc length s is, on the polygon."""
    return np.array([np.interp(s, rod.arc_lengths, x) for x in r.T])


def resultants(result: pyrod.Equilibrium) -> tuple[np.ndarray, np.ndarray]:
    """Force, and moment about the clamp, of the loads as the user gave them."""
    rod, r = result.scene.rod, result.positions
    force, moment = np.zeros(3), np.zeros(3)
    h, arms = rod.edge_lengths[:, None], (r[1:] + r[:-1]) / 2 - r[0]
    for load in result.scene.loads:
        if isinstance(load, Force):
            force += load.force
            s = rod.length if load.at == "end" else load.at
            moment += np.cross(place(r, rod, s) - r[0], load.force)
        elif isinstance(load, Moment):
            moment += load.moment
        elif isinstance(load, DistributedForce):
            force += (h * load.force_per_length).sum(axis=0)
            moment += np.cross(arms, h * load.force_per_length).sum(axis=0)
        else:
            moment += (h * load.moment_per_length).sum(axis=0)
    return force, moment


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize("space", SPACES)
def test_reaction_balances_all_loads(space: str, model: str, seed: int) -> None:
    rng = np.random.default_rng(seed)
    h = rng.uniform(0.5, 1.5, 12) / 12
    rod = Rod.precurved(h, None, SOFT, (0, 0.5, 0), model)
    result = solved(rod, *random_loads(rng, rod, space), clamp=Clamp((1, 2, 3)), space=space)
    force, moment = resultants(result)
    assert np.abs(result.reaction[0] + force).max() < 1e-12
    assert np.abs(result.reaction[1] + moment).max() < 1e-12


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize("space", SPACES)
def test_section_forces_and_moments_are_statically_exact(space: str, model: str) -> None:
    """Each edge is in balance: of forces by construction, of moments about its end."""
    rng = np.random.default_rng(7)
    rod = Rod.precurved(rng.uniform(0.05, 0.15, 10), None, SOFT, (0, 0.5, 0), model)
    F, l = rng.normal(size=3), 0.3 * rng.normal(size=(10, 3))  # noqa: E741
    end = 0.2 * rng.normal(size=3)
    if space == "planar":
        F[1], l[:, ::2], end[::2] = 0, 0, 0
    result = solved(rod, Force(F), DistributedMoment(l), Moment(end), space=space)
    edges, m = np.diff(result.positions, axis=0), result.moment
    np.testing.assert_allclose(result.force, np.tile(F, (10, 1)), rtol=0, atol=2e-16)
    balance = m[1:] - m[:-1] + np.cross(edges, result.force) + rod.edge_lengths[:, None] * l
    assert np.abs(balance).max() < 1e-13
    np.testing.assert_allclose(m[-1], end, rtol=0, atol=1e-14)  # EI/h times rounding
    local = rotation.rotate(rotation.conjugate(result.frames), result.force)
    np.testing.assert_allclose(result.material_force, local, rtol=0, atol=1e-15)
