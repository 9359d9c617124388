"""The energy of rods, with its derivatives."""

from __future__ import annotations

from math import nan

import numpy as np
import pytest
from support import IDENTITY, MODELS, ROUND, SOFT, Z, orders, random_frames, solved
from test_rod import some_curve, with_model

import pyrod
from pyrod import Rod, Section, rotation

RNG = np.random.default_rng(1)


def displaced(
    n: int = 3, seed: int = 5
) -> tuple[Rod, np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """A rod with everything that varies, a random shape, and frames that hold its ends."""
    rng = np.random.default_rng(seed)
    h = rng.uniform(0.2, 0.5, n)
    section = lambda s: Section(1 + s, 1.5, 0.7, 20 + s, 30, 50)  # noqa: E731
    rod = Rod.precurved(h, None, section, rng.normal(size=(n + 1, 3)), "cosserat")
    K, Gamma = 2 * rng.normal(size=(n + 1, 3)), [0, 0, 1] + 0.2 * rng.normal(size=(n, 3))
    start = random_frames(rng)
    r, q, end = pyrod.curve.reconstruct(h, K, Gamma, frame=start)
    return rod, r, q, start, end


def moved(r: np.ndarray, q: np.ndarray, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Station by station: r_0, q_{1/2}, r_1, ...; frames move as R <- R exp(phi)."""
    n = len(q)
    stations = np.append(x, np.zeros(3)).reshape(n + 1, 6)
    return r + stations[:, :3], rotation.multiply(q, rotation.exp(stations[:n, 3:]))


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize("held", [(False, False), (True, False), (False, True), (True, True)])
def test_energy_is_that_of_the_strains(model: str, held: tuple[bool, bool]) -> None:
    rod, r, q, start, end = displaced()
    rod = with_model(rod, model)
    ends = {"start_frame": start if held[0] else None, "end_frame": end if held[1] else None}
    K, Gamma = pyrod.curve.strains(rod.edge_lengths, r, q, **ends)
    h = rod.edge_lengths
    cells = np.concatenate([[h[0] / 2], (h[1:] + h[:-1]) / 2, [h[-1] / 2]]) * [
        held[0],
        *[1] * (len(h) - 1),
        held[1],
    ]
    stores = {"cosserat": [1, 1, 1], "extensible": [0, 0, 1], "inextensible": [0, 0, 0]}[model]
    energy = rod.energy(r, q, **ends)
    bend_twist = (cells[:, None] * rod.bending * (K - rod.K0) ** 2).sum() / 2
    stretch_shear = (h[:, None] * rod.stretching * stores * (Gamma - Z) ** 2).sum() / 2
    assert energy.bend_twist == pytest.approx(bend_twist, rel=1e-13)
    assert energy.stretch_shear == pytest.approx(stretch_shear, rel=1e-12)
    assert energy.total == energy.bend_twist + energy.stretch_shear


@pytest.mark.parametrize("model", MODELS)
def test_gradient_is_the_slope_to_fourth_order(model: str) -> None:
    """Central differences of two step sizes: their error falls with the square of the step."""
    rod, r, q, *ends = displaced()
    rod = with_model(rod, model)
    gradient = rod.energy(r, q, *ends).gradient
    direction = RNG.normal(size=gradient.size)

    def slope(step: float) -> float:
        plus, minus = (rod.energy(*moved(r, q, e * direction), *ends).total for e in (step, -step))
        return (plus - minus) / (2 * step)

    errors = [abs(slope(e) - gradient @ direction) for e in (4e-2, 2e-2, 1e-2)]
    np.testing.assert_allclose(orders(errors), 2, atol=0.1)
    extrapolated = (4 * slope(1e-3) - slope(2e-3)) / 3
    assert extrapolated == pytest.approx(gradient @ direction, rel=1e-8)


@pytest.mark.parametrize("model", MODELS)
def test_hessian_is_the_second_derivative_along_geodesics(model: str) -> None:
    rod, r, q, *ends = displaced()
    rod = with_model(rod, model)
    here = rod.energy(r, q, *ends)
    x = RNG.normal(size=here.gradient.size)
    curvature = x @ here.hessian @ x

    def second_difference(step: float) -> float:
        plus, minus = (rod.energy(*moved(r, q, e * x), *ends).total for e in (step, -step))
        return (plus - 2 * here.total + minus) / step**2

    errors = [abs(second_difference(e) - curvature) for e in (4e-2, 2e-2, 1e-2)]
    np.testing.assert_allclose(orders(errors), 2, atol=0.1)
    extrapolated = (4 * second_difference(1e-3) - second_difference(2e-3)) / 3
    assert extrapolated == pytest.approx(curvature, rel=1e-6)


@pytest.mark.parametrize("model", MODELS)
def test_every_entry_of_the_hessian(model: str) -> None:
    """Polarisation: H(x, y) = (H(x + y, x + y) - H(x - y, x - y))/4 from second differences."""
    rod, r, q, *ends = displaced(2)
    rod = with_model(rod, model)
    here = rod.energy(r, q, *ends)
    size, unit_vectors = here.gradient.size, np.eye(here.gradient.size)

    def second(x: np.ndarray, step: float = 2e-3) -> float:
        total = [rod.energy(*moved(r, q, k * step * x), *ends).total for k in (-2, -1, 0, 1, 2)]
        return np.dot([-1, 16, -30, 16, -1], total) / (12 * step**2)

    expected = (
        np.array([[second(a + b) - second(a - b) for b in unit_vectors] for a in unit_vectors]) / 4
    )
    dense = here.hessian.toarray()
    assert dense.shape == (size, size)
    np.testing.assert_allclose(dense, expected, rtol=0, atol=1e-7 * np.abs(dense).max())


def test_hessian_is_a_symmetric_sparse_array_of_blocks() -> None:
    from scipy.sparse import csc_array

    n = 10
    rod, r, q, *ends = displaced(n)
    H = rod.energy(r, q, *ends).hessian
    assert isinstance(H, csc_array)
    assert H.shape == (6 * n + 3,) * 2
    assert abs(H - H.T).max() < 1e-13 * abs(H).max()
    # Each edge couples r, q, r (9 x 9); neighbouring edges share the 3 x 3 of their vertex; and
    # neighbouring frames are coupled both ways.
    assert H.nnz == 81 * n - 9 * (n - 1) + 2 * 9 * (n - 1)


def test_an_excluded_strain_stores_nothing() -> None:
    rod, r, q, *ends = displaced()
    inextensible = with_model(rod, "inextensible").energy(r, q, *ends)
    assert inextensible.stretch_shear == 0
    assert (inextensible.gradient.reshape(-1)[:3] == 0).all()
    extensible = with_model(rod, "extensible").energy(r, q, *ends)
    assert 0 < extensible.stretch_shear < rod.energy(r, q, *ends).stretch_shear
    infinite = Rod.straight(rod.length, 3, Section(1, 1, 1), "inextensible").energy(r, q, *ends)
    assert infinite.stretch_shear == 0  # not inf times 0


def test_rest_has_no_energy_and_no_slope() -> None:
    r, q = some_curve(20)
    rod = Rod.from_curve(r, q, SOFT)
    energy = rod.energy(*rod.at_rest(), start_frame=rod.placement[1])
    assert energy.total < 1e-24
    assert np.abs(energy.gradient).max() < 1e-10


def test_solver_finds_a_stationary_point_of_this_energy() -> None:
    rod, force = Rod.straight(1.0, 20, SOFT), np.array([3.0, -2.0, 1.0])
    result = solved(rod, pyrod.Force(force))
    energy = rod.energy(result.positions, result.frames, start_frame=IDENTITY)
    gradient = energy.gradient
    assert energy.total == pytest.approx(result.energy, rel=1e-13)
    np.testing.assert_allclose(gradient[-3:], force, rtol=0, atol=1e-11)  # balanced by the load
    np.testing.assert_allclose(gradient[3:-3], 0, rtol=0, atol=1e-11)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"positions": np.zeros((3, 3))}, "positions: expected 4 rows"),
        ({"frames": np.zeros((3, 4))}, r"frames\[0\]: expected a unit quaternion"),
        ({"start_frame": [1, 0, 0]}, "start_frame: expected a quaternion"),
        ({"end_frame": [nan, 0, 0, 0]}, r"end_frame.*: expected finite"),
    ],
)
def test_energy_refuses(change, message: str) -> None:
    rod, r, q, *_ = displaced()
    with pytest.raises(ValueError, match=message):
        rod.energy(**{"positions": r, "frames": q, **change})


@pytest.mark.parametrize(
    ("change", "message"),
    [({"position": [0, 0]}, "position: expected 3 numbers"), ({"frame": [2.0, 0, 0, 0]}, "frame")],
)
def test_at_rest_refuses(change, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        Rod.straight(1.0, 2, ROUND).at_rest(**change)
