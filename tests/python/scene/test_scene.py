"""Scenes: what they refuse, the plane of planar ones, clamps, and what they are as objects."""

from __future__ import annotations

import pickle
from dataclasses import FrozenInstanceError
from math import inf, nan

import numpy as np
import pytest
from support import ROUND, SOFT, SPACES, random_frames, solved, unit

import pyrod
from pyrod import Clamp, DistributedForce, DistributedMoment, Force, Moment, Rod, Scene, rotation

RNG = np.random.default_rng(1)
ROD = Rod.straight(2.0, 8, SOFT)
UNEQUAL = Rod.precurved([0.2, 0.5, 0.3, 0.4, 0.6], None, SOFT, (0, 0, 0))


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
