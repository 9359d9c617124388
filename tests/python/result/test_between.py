"""Between the vertices: against an independent solution, of the order that is told."""

from __future__ import annotations

import pickle

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from support import angle_between, orders

import pyrod
from pyrod import Clamp, Force, Hinge, Moment, Rod, Scene, Section, rotation

P = 4.0
EXTENSIBLE = Section(EI1=1.0, EI2=1.0, GJ=0.8, GA1=40.0, GA2=50.0, EA=60.0)
S = np.linspace(0, 1, 101)


def bent(n: int | None, section: Section, **how: float) -> pyrod.Equilibrium:
    rod = Rod.straight(1.0, n, section)
    return pyrod.solve(Scene(rod, Clamp(), Force((P, 0, 0.3 * P))), **how)


def elastica(section: Section) -> np.ndarray:
    """(101, 5) angle, curvature, x, z, and the axial strain, by shooting."""
    f = np.array([P, 0.3 * P])  # along x, z

    def slope(s: float, y: np.ndarray) -> list[float]:
        a1 = np.array([np.cos(y[0]), -np.sin(y[0])])
        a3 = np.array([np.sin(y[0]), np.cos(y[0])])
        way = a1 * (a1 @ f) / section.GA1 + a3 * (1 + (a3 @ f) / section.EA)
        return [y[1], -(way[1] * f[0] - way[0] * f[1]) / section.EI2, *way]

    def shot(K: float) -> np.ndarray:
        return solve_ivp(slope, (0, 1), [0, K, 0, 0], "DOP853", S, rtol=1e-12, atol=1e-13).y

    y = shot(brentq(lambda K: shot(K)[1, -1], 0, P, xtol=1e-14))
    axial = (np.sin(y[0]) * f[0] + np.cos(y[0]) * f[1]) / section.EA
    return np.vstack([y, axial]).T


def errors_at(found: pyrod.Equilibrium, exact: np.ndarray) -> np.ndarray:
    """Of positions, frames, curvature, stretch and moment."""
    at, (angle, K, x, z, axial) = found.at(S), exact.T
    frames = rotation.exp(np.column_stack([0 * angle, angle, 0 * angle]))
    return np.array(
        [
            np.abs(at.positions[:, [0, 2]] - np.column_stack([x, z])).max(),
            angle_between(at.frames, frames).max(),
            np.abs(at.K[:, 1] - K).max(),
            np.abs(at.Gamma[:, 2] - 1 - axial).max(),
            np.abs(at.moment[:, 1] - K).max(),
        ]
    )


@pytest.mark.parametrize(
    "section", [EXTENSIBLE, Section(1.0, 1.0, 0.8)], ids=["cosserat", "inextensible"]
)
def test_between_vertices_errors_are_of_the_order_of_the_solution(section: Section) -> None:
    exact = elastica(section)
    found = np.array([errors_at(bent(n, section), exact) for n in (16, 32, 64)])
    seen = [orders(column)[-1] for column in found.T if column.max() > 1e-12]
    assert len(seen) > 3
    assert np.all(np.abs(np.array(seen) - 2) < 0.15), seen


def test_of_a_tolerance_they_are_of_high_order() -> None:
    exact = elastica(EXTENSIBLE)
    found = np.array([errors_at(bent(n, EXTENSIBLE, tol=1e-11), exact) for n in (8, 16, 32)])
    assert (found[0] < [1e-6, 1e-6, 1e-5, 1e-4, 1e-5]).all(), found
    for column in found.T:
        assert orders(column)[0] > 4.5
    assert (found[2] < 2e-8).all(), found


def test_in_space_too() -> None:
    """Bent two ways and twisted, so that neighbouring curvatures are not of one axis."""
    section = Section(EI1=1.0, EI2=2.0, GJ=0.7, GA1=60.0, GA2=80.0, EA=150.0)
    loads = [Force((2.0, 3.0, -1.0)), Moment((0, 0, 1.5))]
    rods = [Rod.precurved(1.0, n, section, (2.0, 3.0, 4.0)) for n in (16, 128)]
    coarse, fine = (pyrod.solve(Scene(rod, Clamp(), loads), tol=1e-9) for rod in rods)
    at, inside = coarse.at(fine.s), slice(16, -16)
    np.testing.assert_allclose(at.positions[inside], fine.positions[inside], atol=2e-8)
    np.testing.assert_allclose(at.positions, fine.positions, atol=5e-7)
    assert angle_between(at.frames, fine.vertex_frames)[inside].max() < 1e-6


def test_at_the_vertices_they_are_what_the_arrays_say(cantilever: pyrod.Equilibrium) -> None:
    at = cantilever.at(cantilever.s)
    for name, told in (
        ("positions", cantilever.positions),
        ("K", cantilever.K),
        ("force", cantilever.vertex_force),
        ("moment", cantilever.moment),
        ("material_moment", cantilever.material_moment),
        ("backbone_force", cantilever.backbone_force),
    ):
        np.testing.assert_allclose(getattr(at, name), told, rtol=0, atol=1e-12)
    assert angle_between(at.frames, cantilever.vertex_frames).max() < 1e-12
    assert angle_between(rotation.exp(at.rotation_vectors), at.frames).max() < 1e-12
    assert angle_between(rotation.exp(cantilever.rotation_vectors), at.frames).max() < 1e-12


def test_moments_and_forces_balance_between_vertices(cantilever: pyrod.Equilibrium) -> None:
    """Of dead end loads the force is one, and the moment that of the force about the tip."""
    at = cantilever.at(S)
    force = cantilever.scene.loads[0].acting
    np.testing.assert_allclose(at.force, np.tile(force, (len(S), 1)), atol=1e-12)
    np.testing.assert_allclose(at.moment, np.cross(cantilever.tip - at.positions, force), atol=2e-2)
    inside = rotation.rotate(at.frames, at.material_force)
    np.testing.assert_allclose(inside, at.force, atol=2e-2)


def test_polynomials_end_at_kinks() -> None:
    """K = M/EI is kinked where EI is, which no jump of the solution tells."""

    def EI(s: float) -> float:
        return 1 + 5 * abs(s - 0.37)

    rod = Rod.straight(1.0, 64, lambda s: Section(EI(s), EI(s), 1.0))
    result = pyrod.solve(Scene(rod, Clamp(), Force((P, 0, 0))), tol=1e-9)
    s = np.linspace(0.3, 0.44, 57)
    at = result.at(s)
    np.testing.assert_allclose(at.K[:, 1], at.moment[:, 1] / [EI(x) for x in s], rtol=1e-6)


@pytest.mark.parametrize("n", [12, 16, 24])
def test_what_lies_between_vertices_is_told_with_its_error(n: int) -> None:
    """Of a rod whose stiffness varies so much that the tolerance means little between vertices."""

    def section(s: float) -> Section:
        return Section(1.2 - s, 1 + s**2, 0.8 + np.sin(4 * s) / 2)

    loads = [Force((2.0, 3.0, -1.0)), Moment((0, 0, 0.5))]
    few, many = (
        pyrod.solve(Scene(Rod.straight(1.0, edges, section), Clamp(), loads), tol=1e-9)
        for edges in (n, 256)
    )
    for s in (S, S[40:60], 0.77):
        at, exact = few.at(s), many.at(s)
        told = at.interpolation
        frames = angle_between(np.atleast_2d(at.frames), np.atleast_2d(exact.frames))
        assert frames.max() <= told["frames"] + 1e-8
        for name in ("positions", "K", "force", "moment"):
            off = np.linalg.norm(getattr(at, name) - getattr(exact, name), axis=-1).max()
            assert off <= told[name] + 1e-8, (name, off, told[name])
    assert few.at(few.s).interpolation["K"] < 1e-12
    assert few.at([]).interpolation["K"] == 0


def test_both_sides_of_what_jumps() -> None:
    loads = [Moment((0, 4, 0), at=0.5), Moment((0, -1, 0))]
    scene = Scene(Rod.straight(1.0, 16, Section(1.0, 1.0, 1.0)), Clamp(), loads)
    result = pyrod.solve(scene)
    assert result.at(0.5).K[1] == pytest.approx(-1, abs=1e-12)
    assert result.at(0.5, before=True).K[1] == pytest.approx(3, abs=1e-12)
    near = result.at([0.5 - 1e-9, 0.5 + 1e-9, 0.4, 0.6]).moment[:, 1]
    np.testing.assert_allclose(near, [3, -1, 3, -1], atol=1e-9)


def test_circles_are_exact() -> None:
    rod = Rod.straight(1.0, 3, Section(1.0, 1.0, 1.0))
    result = pyrod.solve(Scene(rod, Clamp(), Moment((0, 2.5, 0)), "planar"))
    at = result.at(S)
    np.testing.assert_allclose(at.positions[:, 0], (1 - np.cos(2.5 * S)) / 2.5, atol=6e-2)
    np.testing.assert_allclose(at.rotation_vectors[:, 1], 2.5 * S, atol=1e-12)


def test_rods_that_move_and_turn_take_their_places_along(cantilever: pyrod.Equilibrium) -> None:
    turn, shift = rotation.exp((0.3, -1.0, 0.5)), np.array([1.0, -2.0, 0.5])
    scene = cantilever.scene
    moved = Scene(scene.rod, Clamp(shift, turn), Force(rotation.rotate(turn, (1, 3, -5))))
    there, here = pyrod.solve(moved).at(S), cantilever.at(S)
    np.testing.assert_allclose(
        there.positions, shift + rotation.rotate(turn, here.positions), atol=1e-9
    )
    np.testing.assert_allclose(there.K, here.K, atol=1e-8)


def test_one_place_and_its_names(joined_rods: pyrod.Equilibrium) -> None:
    one = joined_rods.at((1, "end"))
    assert (one.positions.shape, one.frames.shape, one.s.shape) == ((3,), (4,), ())
    np.testing.assert_allclose(one.positions, joined_rods.rods[1].tip, atol=1e-12)
    assert joined_rods.rods[0].at(0.33).s == pytest.approx(0.33)
    assert joined_rods.at((1, [0.1, 0.2])).K.shape == (2, 3)
    assert not one.positions.flags.writeable
    assert pickle.loads(pickle.dumps(one)) == one
    assert repr(one) == "RodAt(s=1)"


def test_pickled_results_say_the_same() -> None:
    result = bent(8, EXTENSIBLE, tol=1e-8)
    again = pickle.loads(pickle.dumps(result))
    assert again.at(0.33) == result.at(0.33)
    assert again.rods[0].at(0.33) == result.rods[0].at(0.33)


def test_kinks_of_the_section_are_no_smooth_places() -> None:
    """A section that jumps inside: what is before it says nothing of what is behind."""

    def section(s: float) -> Section:
        return Section(1.0, 1.0 if s < 0.37 else 3.0, 1.0)

    scene = Scene(Rod.straight(1.0, 12, section), Clamp(), Force((2.0, 0, 0)), "planar")
    result = pyrod.solve(scene, tol=1e-8)
    fine = pyrod.solve(
        Scene(Rod.straight(1.0, 96, section), Clamp(), scene.loads, "planar"), tol=1e-8
    )
    np.testing.assert_allclose(result.at(fine.s).K, fine.K, atol=2e-6)


@pytest.mark.parametrize(
    ("place", "words"),
    [
        (1.5, r"s: must be an arc length on the rod, in \[0, 1\], got 1.5"),
        (-0.1, "must be an arc length on the rod"),
        ([[0.1]], r"s: expected an arc length, or \(k,\) of them, got shape \(1, 1\)"),
        (float("nan"), "s: expected finite numbers"),
        ("middle", "expected 'start', 'end'"),
        ((2, 0.1), "there is no rod 2, the scene has 1"),
    ],
)
def test_places_that_are_none(place: object, words: str, cantilever: pyrod.Equilibrium) -> None:
    with pytest.raises(ValueError, match=words):
        cantilever.at(place)  # type: ignore[arg-type]


def test_of_several_rods_one_is_named(joined_rods: pyrod.Equilibrium) -> None:
    with pytest.raises(ValueError, match=r"the scene has 2 rods; say which, as at\(\(0, 0.3\)\)"):
        joined_rods.at(0.3)


def test_supports_between_the_ends() -> None:
    held = [Clamp(), Hinge((0.1, 0, 0.45), at=0.5), Clamp((0, 0, 0.9), at="end")]
    strip = Section(1.0, 1.0, 1.0)
    coarse, fine = (
        pyrod.solve(Scene(Rod.straight(1.0, n, strip), held, space="planar"), tol=1e-9)
        for n in (16, 64)
    )
    at = coarse.at(fine.s)
    np.testing.assert_allclose(at.positions, fine.positions, atol=5e-6)
    np.testing.assert_allclose(at.force, fine.vertex_force, atol=1e-5)
