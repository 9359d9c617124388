"""Scenes: what they refuse, how loads reach the grid, and that reactions balance all loads."""

from __future__ import annotations

import pickle
from dataclasses import FrozenInstanceError
from math import inf, nan

import numpy as np
import pytest
from support import MODELS, ROUND, SOFT, SPACES, differences, random_frames, solved, unit

import pyrod
from pyrod import Clamp, DistributedForce, DistributedMoment, Force, Moment, Rod, Scene, rotation

RNG = np.random.default_rng(1)
ROD = Rod.straight(2.0, 8, SOFT)
UNEQUAL = Rod.precurved([0.2, 0.5, 0.3, 0.4, 0.6], None, SOFT, (0, 0, 0))


def vertex_loads(result: pyrod.Equilibrium) -> np.ndarray:
    """The forces on the free vertices: by how much the section force falls there."""
    n = np.vstack([result.force, np.zeros(3)])
    return n[:-1] - n[1:]


# Refusals -----------------------------------------------------------------------------------------


def test_rods_are_held() -> None:
    with pytest.raises(ValueError, match="supports: nothing holds the rod"):
        Scene(ROD, [])


def test_vertices_are_held_once() -> None:
    with pytest.raises(ValueError, match="supports: vertex 0 of rod 0 is held twice"):
        Scene(ROD, [Clamp(), Clamp()])


@pytest.mark.parametrize(
    ("arguments", "error", "message"),
    [
        (("rod", Clamp()), TypeError, "rods: cannot use a str"),
        ((ROD, "clamp"), TypeError, "supports: cannot use a str"),
        ((ROD, Clamp(), [Clamp()]), TypeError, "loads: cannot use a Clamp"),
        (
            (ROD, Clamp(), [], "flat"),
            ValueError,
            "space: expected 'planar' or 'spatial', got 'flat'",
        ),
    ],
)
def test_scene_refuses(arguments, error, message: str) -> None:
    with pytest.raises(error, match=message):
        Scene(*arguments)


@pytest.mark.parametrize(
    ("keywords", "message"),
    [
        ({"position": (0, 0)}, "position: expected 3 numbers"),
        ({"position": (0, 0, nan)}, "position: expected finite numbers"),
        ({"frame": (1, 0, 0)}, "frame: expected"),
        ({"frame": (2, 0, 0, 0)}, "frame: expected a unit quaternion"),
        ({"frame": (nan, 0, 0, 0)}, "frame: expected a unit quaternion"),
        ({"frame": 2 * np.eye(3)}, "matrix.*: expected a rotation"),
        ({"frame": (1, 0, 0, 0), "tangent": (0, 0, 1)}, "frame: give either"),
        ({"normal": (1, 0, 0)}, "normal: needs a tangent"),
        ({"tangent": (0, 0, 0)}, "tangent: expected a vector"),
        ({"tangent": (1, 0, 0), "normal": (2, 0, 0)}, "normal: must not be parallel"),
    ],
)
def test_clamp_refuses(keywords, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        Clamp(**keywords)


@pytest.mark.parametrize("load", [Force, Moment])
@pytest.mark.parametrize("values", [(1, 2), np.zeros((1, 3)), (nan, 0, 0), (0, inf, 0), 3.0])
def test_point_loads_refuse_what_is_no_vector(load, values) -> None:
    with pytest.raises(ValueError, match=f"^{load.__name__.lower()}: expected"):
        load(values)


@pytest.mark.parametrize("load", [Force, Moment])
@pytest.mark.parametrize("at", ["middle", nan, inf])
def test_point_loads_refuse_no_place(load, at) -> None:
    with pytest.raises(ValueError, match=r"^at: expected 'start', 'end' or an arc length"):
        load((1, 0, 0), at=at)


@pytest.mark.parametrize("load", [Force, Moment])
@pytest.mark.parametrize("at", [-1e-9, 2.0 + 1e-9, -1.0, 5.0])
def test_places_outside_the_rod_are_refused(load, at: float) -> None:
    with pytest.raises(ValueError, match=r"^at: must be an arc length on the rod, in \[0, 2\]"):
        Scene(ROD, Clamp(), load((1, 0, 0), at=at))


@pytest.mark.parametrize(
    ("load", "name"),
    [(DistributedForce, "force_per_length"), (DistributedMoment, "moment_per_length")],
)
@pytest.mark.parametrize(
    ("values", "message"),
    [
        ((1, 2), "expected 3 numbers, or 8 times 3"),
        (np.zeros((9, 3)), r"got shape \(9, 3\)"),
        (lambda s: (1, 2), "expected 3 numbers"),
        ((0, nan, 0), "expected finite numbers"),
        (lambda s: (0, inf, 0), "expected finite numbers"),
    ],
)
def test_distributed_loads_refuse(load, name: str, values, message: str) -> None:
    with pytest.raises(ValueError, match=f"^{name}.*{message}"):
        Scene(ROD, Clamp(), load(values))


# Planar scenes ------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "load",
    [
        Force((1, 1e-6, 1)),
        Force((0, 1, 0), at=1.0),
        DistributedForce((0, 1, 0)),
        Moment((1, 5, 0)),
        Moment((0, 0, 1), at=0.3),
        DistributedMoment((0, 0, 1)),
    ],
    ids=lambda load: type(load).__name__,
)
def test_loads_that_leave_the_plane_are_refused(load) -> None:
    with pytest.raises(ValueError, match=r"^loads: a (force|moment) .* choose the spatial rod"):
        solved(ROD, load, space="planar")


@pytest.mark.parametrize("K0", [(1, 0, 0), (0, 1, 1e-9)])
def test_rest_curvature_that_leaves_the_plane_is_refused(K0) -> None:
    with pytest.raises(ValueError, match=r"^K0\[0\]: a planar rod bends about director 2 only"):
        solved(Rod.precurved(1.0, 8, SOFT, K0), space="planar")


def test_the_plane_is_that_of_the_clamp() -> None:
    clamp = Clamp(tangent=(1, 0, 0), normal=(0, 1, 0))  # a2 along z
    result = solved(ROD, Force((0.1, 0.2, 0)), Moment((0, 0, 0.3)), clamp=clamp, space="planar")
    assert not result.positions[:, 2].any()
    with pytest.raises(ValueError, match="leaves the plane"):
        solved(ROD, Force((0, 0, 1)), clamp=clamp, space="planar")


def test_rounding_does_not_leave_the_plane() -> None:
    frame = random_frames(RNG)
    for angle in np.linspace(0, 6, 20):
        force = rotation.rotate(frame, [np.cos(angle), 0, np.sin(angle)])
        solved(ROD, Force(0.1 * force), clamp=Clamp(frame=frame), space="planar")


# Clamps -------------------------------------------------------------------------------------------


def test_clamp_defaults_to_the_place_at_rest() -> None:
    scene = Scene(ROD, Clamp())
    np.testing.assert_array_equal(scene.clamp_position, np.zeros(3))
    np.testing.assert_array_equal(scene.clamp_frame, [1, 0, 0, 0])
    r, q = [(1, 2, 3), (1, 2, 4), (1, 2, 6)], np.tile([1.0, 0, 0, 0], (2, 1))
    np.testing.assert_array_equal(
        Scene(Rod.from_curve(r, q, SOFT), Clamp()).clamp_position, (1, 2, 3)
    )


def test_clamp_by_matrix_quaternion_and_tangent() -> None:
    frame = rotation.frame_along((1, 1, 0), (0, 0, 1))
    for clamp in (
        Clamp((1, 2, 3), frame),
        Clamp((1, 2, 3), rotation.to_matrix(frame)),
        Clamp((1, 2, 3), tangent=(2, 2, 0), normal=(1, 1, 1)),
    ):
        result = solved(ROD, clamp=clamp)
        expected = np.array([1.0, 2.0, 3.0]) + np.outer(ROD.arc_lengths, unit([1, 1, 0]))
        np.testing.assert_allclose(result.positions, expected, rtol=0, atol=3e-15)
        a1 = rotation.rotate(result.vertex_frames[0], (1, 0, 0))
        np.testing.assert_allclose(a1, (0, 0, 1), rtol=0, atol=1e-15)


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


# As objects ---------------------------------------------------------------------------------------


def test_scenes_do_not_change() -> None:
    force = np.array([1.0, 2.0, 3.0])
    scene = Scene(ROD, Clamp(), Force(force))
    force[0] = 7
    assert scene.loads[0].force[0] == 1
    with pytest.raises(FrozenInstanceError):
        scene.space = "planar"
    with pytest.raises(FrozenInstanceError):
        scene.loads[0].at = "start"
    for array in (scene.loads[0].force, Clamp((1, 2, 3)).position, Clamp(tangent=(1, 0, 0)).frame):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 1


def crowded(space: str = "spatial") -> Scene:
    loads = [
        Force((1, 0, 2), at=0.3),
        Moment((0, 0.5, 0)),
        DistributedForce(lambda s: (s, 0, 1)),
        DistributedMoment(lambda s: (0, s, 0)),
    ]
    return Scene(
        Rod.precurved(2.0, 8, SOFT, (0, 1, 0)), Clamp((1, 2, 3), tangent=(0, 0, 1)), loads, space
    )


@pytest.mark.parametrize("space", SPACES)
def test_scenes_with_functions_are_pickled_with_their_values(space: str) -> None:
    scene = crowded(space)
    copy = pickle.loads(pickle.dumps(scene))
    assert copy.space == space
    assert copy.rod == scene.rod
    assert copy.supports == scene.supports
    assert copy.loads[:2] == scene.loads[:2]
    assert pickle.loads(pickle.dumps(copy)) == copy
    np.testing.assert_array_equal(pyrod.solve(copy).positions, pyrod.solve(scene).positions)


def test_scenes_are_equal_if_all_they_hold_is() -> None:
    def scene(**changes) -> Scene:
        return Scene(
            **{"rods": ROD, "supports": Clamp((1, 2, 3)), "loads": Force((1, 2, 3)), **changes}
        )

    assert scene() == scene()
    for change in (
        {"rods": UNEQUAL},
        {"supports": Clamp()},
        {"loads": Force((1, 2, 4))},
        {"loads": Moment((1, 2, 3))},
        {"loads": ()},
        {"space": "planar"},
    ):
        assert scene() != scene(**change)


def test_one_load_or_support_needs_no_list() -> None:
    assert Scene(ROD, Clamp(), Force((1, 0, 0))) == Scene(ROD, [Clamp()], (Force((1, 0, 0)),))


def test_repr() -> None:
    rod = "Rod(inextensible, straight, length=2, edges=4)"
    bare = Scene(Rod.straight(2.0, 4, ROUND), Clamp(), space="planar")
    assert repr(bare) == f"Scene({rod}, clamped at its start, no loads, planar)"
    loaded = Scene(Rod.straight(2.0, 4, ROUND), Clamp(), [Force((1, 0, 0)), Moment((0, 1, 0))])
    assert repr(loaded) == f"Scene({rod}, clamped at its start, Force, Moment, spatial)"
