"""Solving: the plane, the place and the units of a scene do not matter."""

from __future__ import annotations

import numpy as np
import pytest
from support import MODELS, SOFT, SPACES, differences, random_frames, solved

import pyrod
from pyrod import Clamp, DistributedForce, DistributedMoment, Force, Moment, Rod, Section, rotation

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
