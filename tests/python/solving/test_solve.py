"""Solving: closed forms on every grid, beams that bend little, turns, and limits of stiffness."""

from __future__ import annotations

from math import inf, pi

import numpy as np
import pytest
from support import MODELS, ROUND, SOFT, SPACES, random_frames, solved

import pyrod
from pyrod import Clamp, DistributedForce, DistributedMoment, Force, Moment, Rod, Section, rotation

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
