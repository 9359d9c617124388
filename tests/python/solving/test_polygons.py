"""Rods made from points are these points on every level of a climb."""

from __future__ import annotations

import pickle
import warnings
from pathlib import Path

import numpy as np
import pytest
from independent import Problem, shot

import pyrod
from pyrod import Clamp, Force, Hinge, Joint, Rod, Scene, Section, Spring, curve

Array = np.ndarray
ROUND = Section(1, 1, 1)
FLAT = Section(1.5, 1.0, 0.7)


def polygon(points: Array, section: object = ROUND) -> Rod:
    return Rod.from_curve(points, curve.Polyline(points).bishop().frames, section)


def half_circle(n: int = 8) -> Array:
    t = np.linspace(0, np.pi, n + 1)
    return np.stack([1 - np.cos(t), 0 * t, np.sin(t)], axis=1)


def corner() -> Array:
    """An L of 20 edges."""
    up = [(0.0, 0, 0.1 * i) for i in range(11)]
    return np.array(up + [(0.1 * i, 0.0, 1) for i in range(1, 11)])


def random_points(seed: int = 0) -> Array:
    return np.cumsum(np.random.default_rng(seed).normal(size=(12, 3)), axis=0)


POINTS = {"half circle": half_circle(), "corner": corner(), "random": random_points()}


@pytest.mark.parametrize("points", POINTS.values(), ids=POINTS)
@pytest.mark.parametrize("tol", [None, 1e-4, 1e-9])
def test_unloaded_it_is_where_its_points_are(points: Array, tol: float | None) -> None:
    for section in (ROUND, FLAT, [FLAT] * 5 + [ROUND] * (len(points) - 6)):
        rod = polygon(points, section)
        result = pyrod.solve(Scene(rod, Clamp()), tol=tol)
        assert np.abs(result.positions - points).max() < 1e-12
        assert np.abs(result.moment).max() < 1e-9
        assert np.abs(result.K - rod.K0).max() < 1e-9


@pytest.mark.parametrize("points", POINTS.values(), ids=POINTS)
def test_every_level_has_the_points(points: Array) -> None:
    scene = Scene(polygon(points), [Clamp(), Spring(1.0, at=1.234)])
    for level in (1, 3):
        fine = scene._climbing.refined(level).rod
        r, _ = fine.at_rest()
        at = np.searchsorted(scene.rod.arc_lengths, 1.234)
        assert np.isclose(scene.rod.arc_lengths[at], 1.234)
        assert np.abs(np.delete(r[:: 2**level], at, axis=0) - points).max() < 1e-12


def two_rods(load: Array, section: Section) -> Scene:
    up = Rod.straight(1.0, None, section)
    along = Rod.straight(1.0, None, section).placed((0, 0, 1), tangent=(1, 0, 0), normal=(0, 0, -1))
    joint = Joint(((0, "end"), (1, "start")))
    return Scene([up, along], Clamp(), Force(load, at=(1, "end")), joints=joint)


@pytest.mark.parametrize("load", [(0.3, 0, -0.4), (0.1, 0.3, -0.2)], ids=["in plane", "spatial"])
@pytest.mark.parametrize("section", [ROUND, FLAT], ids=["round", "flat"])
def test_a_corner_is_two_rods_with_a_rigid_corner(load: Array, section: Section) -> None:
    points = corner()
    frames = curve.Polyline(points).bishop(normal=(1, 0, 0)).frames
    rod = Rod.from_curve(points, frames, section)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = pyrod.solve(Scene(rod, Clamp(), Force(load)), tol=1e-7)
    exact = pyrod.solve(two_rods(load, section), tol=1e-10)
    errors = found.errors["positions"] * rod.length
    assert np.linalg.norm(found.tip - exact.rods[1].tip) <= errors + 1e-9
    assert abs(found.energy / exact.energy - 1) <= found.errors["energy"] + 1e-9
    moment = np.linalg.norm(found.moment, axis=1).max()
    assert np.linalg.norm(found.moment[0] - exact.rods[0].moment[0]) <= (
        found.errors["moments"] * moment + 1e-9
    )


def pieces_of(points: Array, section: Section, load: Array) -> Scene:
    """Each edge a rod, rigidly joined: a polygon to the letter."""
    frames = curve.Polyline(points).bishop().frames
    lengths = np.linalg.norm(np.diff(points, axis=0), axis=1)
    rods = [
        Rod.straight(h, 4, section).placed(r, q)
        for h, r, q in zip(lengths, points, frames, strict=False)
    ]
    last = len(rods) - 1
    joints = [Joint(((i, "end"), (i + 1, "start"))) for i in range(last)]
    return Scene(rods, Clamp(points[0], frames[0]), Force(load, at=(last, "end")), joints=joints)


@pytest.mark.parametrize("section", [ROUND, FLAT], ids=["round", "flat"])
def test_a_helix_of_points_is_its_edges_joined(section: Section) -> None:
    s = np.linspace(0, 1, 9)
    points = np.stack([np.cos(4 * s), np.sin(4 * s), s], axis=1)
    frames = curve.Polyline(points).bishop().frames
    rod = polygon(points, section)
    load = np.array((0.2, 0.1, -0.1))
    # the clamp of the polygon turns by the half of its first corner less: clamp the first edge
    half = pyrod.rotation.exp(-rod.edge_lengths[0] / 2 * rod.K0[0])
    clamp = Clamp(points[0], pyrod.rotation.multiply(frames[0], half))
    found = pyrod.solve(Scene(rod, clamp, Force(load)), tol=1e-6)
    exact = pyrod.solve(pieces_of(points, section, load), tol=1e-9)
    error = np.linalg.norm(found.tip - exact.rods[-1].tip)
    assert error <= found.errors["positions"] * rod.length + 1e-8


def test_curvature_is_told_as_on_its_own_edges() -> None:
    """At corners K is what the moment adds to the rest curvature of the polygon."""
    rod = polygon(half_circle(16), FLAT)
    result = pyrod.solve(Scene(rod, Clamp(), Force((0.1, 0, 0.2)), "planar"), tol=1e-8)
    M = np.einsum("ij,ij->i", result.moment, np.array([[0, 1.0, 0]]))
    frames = result.vertex_frames
    material = pyrod.rotation.rotate(pyrod.rotation.conjugate(frames), result.moment)
    assert np.abs(result.K - rod.K0 - material / FLAT.bending).max() < 1e-9
    assert np.abs(M).max() > 0.1


def test_supports_between_points_do_not_move_it() -> None:
    points = random_points(3)
    rod = polygon(points)
    held = [Clamp(), Hinge(at=2.5), Hinge(at="end")]
    plain = pyrod.solve(Scene(rod, held))
    fine = pyrod.solve(Scene(rod, held), tol=1e-8)
    for result in (plain, fine):
        assert result.energy < 1e-20
        near = np.abs(result.rod.arc_lengths[:, None] - rod.arc_lengths).argmin(axis=0)
        assert np.abs(result.positions[near] - points).max() < 1e-12 * rod.length


def test_copies_and_files_are_the_same_polygon(tmp_path: Path) -> None:
    rod = polygon(random_points(1), FLAT)
    scene = Scene(rod, Clamp(), Force((0.01, 0.02, 0)))
    once = pyrod.solve(scene, tol=1e-5)
    scene.save(tmp_path / "polygon.toml")
    for copy in (pickle.loads(pickle.dumps(scene)), pyrod.load(tmp_path / "polygon.toml")):
        again = pyrod.solve(copy, tol=1e-5)
        assert np.abs(again.positions - once.positions).max() < 1e-9


def test_against_shooting() -> None:
    """In the plane: a corner of the rod is a turn of the frame, between straight pieces."""
    points = corner()
    load = np.array((0.3, 0, -0.4))
    found = pyrod.solve(
        Scene(polygon(points), Clamp(), Force(load), "planar"),
        tol=1e-9,
    )
    width = 1e-4  # the corner as an arc of so little length, and as stiff as not to bend
    flexible, rigid = np.array([1, 1, 1, 0, 0, 0.0]), np.zeros(6)
    p = Problem(
        2.0,
        lambda s: rigid if abs(s - 1) < width / 2 else flexible,
        lambda s: np.array([0, np.pi / 2 / width, 0]) if abs(s - 1) < width / 2 else np.zeros(3),
        end_force=load,
        breaks=(1 - width / 2, 1 + width / 2),
    )
    start = np.concatenate([-found.reactions[0].force, -found.reactions[0].moment])
    _, state = shot(p, start)
    assert np.linalg.norm(state(2.0)[:3] - found.tip) < 2 * width
