"""Rods: how they are made, what they refuse, and their energy with its derivatives."""

from __future__ import annotations

import pickle
from dataclasses import FrozenInstanceError
from math import inf, nan

import numpy as np
import pytest
from support import (
    IDENTITY,
    MODELS,
    ROUND,
    SOFT,
    angle_between,
    differences,
    orders,
    random_frames,
    solved,
    unit,
)

import pyrod
from pyrod import Rod, Section, rotation

RNG = np.random.default_rng(1)
E3 = np.array([0.0, 0.0, 1.0])


def some_curve(n: int, seed: int = 1) -> tuple[np.ndarray, np.ndarray]:
    """A smooth crooked curve on a non-uniform grid, and frames that fit its edges."""
    rng = np.random.default_rng(seed)
    h = rng.uniform(0.5, 1.5, n) / n
    s = np.concatenate([[0.0], np.cumsum(h)])
    K = np.column_stack([2 * np.sin(3 * s), 1.0 + s, 3 * np.cos(2 * s)])
    r, q, _ = pyrod.curve.reconstruct(h, K, position=rng.normal(size=3), frame=random_frames(rng))
    return r, q


# Straight and precurved ---------------------------------------------------------------------------


def test_straight_rod_lies_along_a3_of_its_frame() -> None:
    rod = Rod.straight(2.0, 8, SOFT)
    q = random_frames(RNG)
    r, frames = rod.at_rest([1.0, 2.0, 3.0], q)
    expected = np.array([1.0, 2.0, 3.0]) + np.outer(rod.arc_lengths, rotation.rotate(q, E3))
    np.testing.assert_allclose(r, expected, rtol=0, atol=2e-15)
    np.testing.assert_allclose(frames, np.tile(q, (8, 1)), rtol=0, atol=4e-16)


@pytest.mark.parametrize("n", [1, 3, 7, 1000, 1_000_000])
def test_length_and_grid(n: int) -> None:
    rod = Rod.straight(0.7, n, ROUND)
    assert rod.edges == n
    assert rod.length == pytest.approx(0.7, rel=4e-16)
    assert rod.arc_lengths[-1] == rod.length
    np.testing.assert_allclose(rod.arc_lengths, 0.7 * np.arange(n + 1) / n, rtol=4e-16, atol=0)


@pytest.mark.parametrize(
    "curvature",
    [(0.1, 0.2, 0.3), np.tile([0.1, 0.2, 0.3], (6, 1)), lambda s: (0.1, 0.2, 0.3)],
    ids=["vector", "rows", "function"],
)
def test_curvature_may_be_given_in_three_ways(curvature) -> None:
    rod = Rod.precurved(1.0, 5, ROUND, curvature)
    np.testing.assert_array_equal(rod.K0, np.tile([0.1, 0.2, 0.3], (6, 1)))


def test_curvature_function_is_taken_at_the_vertices() -> None:
    h = [0.1, 0.4, 0.2]
    rod = Rod.precurved(h, None, ROUND, lambda s: (0, s, 0))
    np.testing.assert_array_equal(rod.edge_lengths, h)
    np.testing.assert_allclose(rod.K0[:, 1], [0, 0.1, 0.5, 0.7], rtol=0, atol=1e-15)


def test_precurved_arc_is_a_circle() -> None:
    r, _ = Rod.precurved(2 * np.pi, 100, ROUND, (0, 1, 0)).at_rest()
    radii = np.linalg.norm(r - r[:-1].mean(axis=0), axis=1)
    edge = 2 * np.pi / 100  # a chord of the angle by which neighbouring edges turn
    np.testing.assert_allclose(radii, edge / (2 * np.sin(edge / 2)), rtol=1e-13)


@pytest.mark.parametrize(
    ("section", "model"),
    [
        (ROUND, "inextensible"),
        (SOFT, "cosserat"),
        ([ROUND, Section(1, 1, 1, EA=1)], "extensible"),
        (lambda s: SOFT if s > 0.5 else ROUND, "cosserat"),
    ],
)
def test_model_defaults_to_the_richest(section, model: str) -> None:
    assert Rod.straight(1.0, 2, section).model == model


@pytest.mark.parametrize("model", MODELS)
def test_model_may_be_chosen(model: str) -> None:
    assert Rod.straight(1.0, 2, SOFT, model).model == model


# From a curve -------------------------------------------------------------------------------------


@pytest.mark.parametrize("n", [1, 2, 3, 40])
def test_from_curve_keeps_the_shape(n: int) -> None:
    r, q = some_curve(n)
    rod = Rod.from_curve(r, q, SOFT)
    back, frames = rod.at_rest()
    np.testing.assert_allclose(back, r, rtol=0, atol=1e-14)
    assert angle_between(frames, q).max() < 1e-14
    np.testing.assert_allclose(
        rod.edge_lengths, np.linalg.norm(np.diff(r, axis=0), axis=1), rtol=1e-15
    )


def test_from_curve_is_at_rest_in_its_place() -> None:
    r, q = some_curve(40)
    rod = Rod.from_curve(r, q, SOFT)
    at_rest = solved(rod)
    np.testing.assert_allclose(at_rest.positions, r, rtol=0, atol=1e-13)
    assert at_rest.energy < 1e-24


@pytest.mark.parametrize("as_matrices", [False, True])
def test_signs_of_the_frames_do_not_matter(as_matrices: bool) -> None:
    r, q = some_curve(40)
    shuffled = q * RNG.choice([-1.0, 1.0], (40, 1))
    given_frames = rotation.to_matrix(shuffled) if as_matrices else shuffled
    rod = Rod.from_curve(r, given_frames, SOFT)
    np.testing.assert_allclose(rod.K0, Rod.from_curve(r, q, SOFT).K0, rtol=0, atol=1e-12)


def test_frames_that_lean_are_turned_the_shortest_way() -> None:
    r, q = some_curve(40)
    lean = np.concatenate([0.3 * unit(RNG.normal(size=(40, 2))), np.zeros((40, 1))], axis=1)
    rod = Rod.from_curve(r, rotation.multiply(q, rotation.exp(lean)), SOFT)
    np.testing.assert_allclose(rod.at_rest()[0], r, rtol=0, atol=1e-14)
    np.testing.assert_allclose(rod.K0, Rod.from_curve(r, q, SOFT).K0, rtol=0, atol=1e-12)


@pytest.mark.parametrize(("angle", "refused"), [(0.49, False), (0.51, True), (np.pi, True)])
def test_frames_that_lean_too_far_are_refused(angle: float, refused: bool) -> None:
    r, q = some_curve(5)
    q[3] = rotation.multiply(q[3], rotation.exp([angle, 0, 0]))
    if refused:
        with pytest.raises(ValueError, match=r"frames\[3\]: a3 is .* rad away from the edge"):
            Rod.from_curve(r, q, SOFT)
    else:
        Rod.from_curve(r, q, SOFT)


def test_frames_turned_by_pi_are_refused() -> None:
    r = np.outer(np.arange(4.0), E3)
    q = np.tile(IDENTITY, (3, 1))
    q[2] = [0, 0, 0, 1]
    with pytest.raises(ValueError, match=r"frames\[2\]: turned by pi"):
        Rod.from_curve(r, q, SOFT)


@pytest.mark.parametrize(
    ("r", "q", "message"),
    [
        (np.zeros((1, 3)), np.tile(IDENTITY, (0, 1)), "positions: expected"),
        (np.zeros((3, 4)), np.tile(IDENTITY, (2, 1)), "positions: expected"),
        ([[0, 0, 0], [0, 0, nan]], [IDENTITY], r"positions\[1\]: expected finite"),
        (
            [[0, 0, 0], [0, 0, 1], [0, 0, 1]],
            np.tile(IDENTITY, (2, 1)),
            r"positions\[2\]: coincides",
        ),
        (
            [[0, 0, 0], [0, 0, 1]],
            np.tile(IDENTITY, (2, 1)),
            r"frames: expected 1 rows \(one per edge\), got 2",
        ),
        ([[0, 0, 0], [0, 0, 1]], np.zeros((1, 5)), "frames: expected quaternions"),
        ([[0, 0, 0], [0, 0, 1]], [2 * IDENTITY], "expected a unit quaternion"),
    ],
)
def test_from_curve_refuses(r, q, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        Rod.from_curve(r, q, SOFT)


# Sections that vary -------------------------------------------------------------------------------


def test_section_function_is_taken_at_vertices_and_centres() -> None:
    rod = Rod.straight(1.0, 2, lambda s: Section(1 + s, 1, 1, 1, 1, 1 + s))
    np.testing.assert_array_equal(rod.bending[:, 0], [1, 1.5, 2])
    np.testing.assert_array_equal(rod.stretching[:, 2], [1.25, 1.75])


def test_compliances_of_the_two_halves_of_a_cell_add() -> None:
    rod = Rod.precurved([1.0, 3.0], None, [Section(1, 1, 1), Section(2, 4, 8)], (0, 0, 0))
    middle = [4 / (1 + 3 / k) for k in (2, 4, 8)]
    np.testing.assert_allclose(rod.bending, [[1, 1, 1], middle, [2, 4, 8]], rtol=1e-15)


def stepped_tip(n: int, load: float) -> float:
    """Deflection of a cantilever whose second half is ten times softer."""
    sections = [Section(10, 10, 10)] * (n // 2) + [Section(1, 1, 1)] * (n // 2)
    return solved(Rod.straight(1.0, n, sections), pyrod.Force((load, 0, 0)), space="planar").tip[0]


def test_stepped_cantilever_converges_with_order_two() -> None:
    """Small deflection: F L^3 ((1 - 1/8)/(3 EI_a) + (1/8)/(3 EI_b)), by parts."""
    load = 1e-6
    exact = load * (7 / 8 / 30 + 1 / 8 / 3)
    errors = [abs(stepped_tip(n, load) / exact - 1) for n in (8, 16, 32, 64)]
    np.testing.assert_allclose(orders(errors), 2, atol=0.02)


def test_stepped_cantilever_converges_with_order_two_in_large_deflection() -> None:
    tips = [stepped_tip(n, 5.0) for n in (16, 32, 64, 128, 256)]
    np.testing.assert_allclose(orders(np.abs(np.diff(tips))), 2, atol=0.05)


@pytest.mark.parametrize("count", [0, 1, 3])
def test_wrong_number_of_sections_is_refused(count: int) -> None:
    with pytest.raises(ValueError, match=f"section: expected 2, one per edge, got {count}"):
        Rod.straight(1.0, 2, [ROUND] * count)


# Refusals -----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((0.0, 5, ROUND), "length: must be positive"),
        ((-1.0, 5, ROUND), "length: must be positive"),
        ((nan, 5, ROUND), "length: must be positive"),
        ((inf, 5, ROUND), "length: must be positive"),
        ((1.0, 0, ROUND), "edges: must be a whole number, at least 1"),
        ((1.0, -3, ROUND), "edges: must be"),
        ((1.0, 2.5, ROUND), "edges: must be"),
        (([0.5, 0.5], 2, ROUND), "edges: give None"),
        ((1.0, 5, ROUND, "stiff"), "model: expected one of cosserat, extensible, inextensible"),
    ],
)
def test_straight_refuses(arguments, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        Rod.straight(*arguments)


@pytest.mark.parametrize(
    ("curvature", "message"),
    [
        (np.zeros(2), "curvature: expected 3 numbers, or 6 times 3"),
        (np.zeros((5, 3)), r"curvature: .* got shape \(5, 3\)"),
        (lambda s: (0, 0), "curvature"),
        ((0, 0, nan), r"K0\[0\]: expected finite"),
        ((0, 0, inf), r"K0\[0\]: expected finite"),
    ],
)
def test_precurved_refuses(curvature, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        Rod.precurved(1.0, 5, ROUND, curvature)


@pytest.mark.parametrize(("turn", "refused"), [(0.999 * np.pi, False), (np.pi, True), (7.0, True)])
def test_a_rest_shape_that_turns_by_pi_at_a_vertex_is_refused(turn: float, refused: bool) -> None:
    if refused:
        with pytest.raises(
            ValueError, match=r"K0\[.\]: the rod at rest turns by .* use more edges"
        ):
            Rod.precurved(1.0, 5, ROUND, (0, 5 * turn, 0))
    else:
        Rod.precurved(1.0, 5, ROUND, (0, 5 * turn, 0))


def parts(n: int = 3) -> dict[str, object]:
    return {
        "edge_lengths": np.full(n, 1 / n),
        "bending": np.ones((n + 1, 3)),
        "stretching": np.full((n, 3), inf),
        "K0": np.zeros((n + 1, 3)),
        "model": "inextensible",
    }


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("edge_lengths", [1, 0, 1], r"edge_lengths\[1\]: must be positive"),
        ("edge_lengths", [[1, 1, 1]], "edge_lengths: expected one number each"),
        ("bending", np.ones((3, 3)), "bending: expected 4 rows"),
        ("bending", np.full((4, 3), inf), r"bending\[0\]"),
        ("bending", np.zeros((4, 3)), r"bending\[0\]: stiffnesses must be positive"),
        ("stretching", np.ones((4, 3)), "stretching: expected 3 rows"),
        ("stretching", np.ones((3, 2)), r"stretching: expected an array of shape \(n, 3\)"),
        ("stretching", np.zeros((3, 3)), r"stretching\[0\]: stiffnesses must be positive"),
        ("stretching", np.full((3, 3), nan), r"stretching\[0\]: stiffnesses must be positive"),
        ("K0", np.zeros((3, 3)), "K0: expected 4 rows"),
        ("K0", np.full((4, 3), nan), r"K0\[0\]: expected finite"),
        ("model", "Cosserat", "model: expected one of"),
    ],
)
def test_constructor_refuses(name: str, value: object, message: str) -> None:
    Rod(**parts())
    with pytest.raises(ValueError, match=message):
        Rod(**{**parts(), name: value})


@pytest.mark.parametrize(
    ("model", "stretching", "message"),
    [
        ("cosserat", [inf, inf, 1.0], None),
        ("extensible", [inf, inf, inf], None),
        ("extensible", [inf, inf, 1.0], None),
        ("inextensible", [1.0, 1.0, 1.0], None),
    ],
)
def test_rigid_is_a_stiffness_like_others(
    model: str, stretching: list[float], message: str | None
) -> None:
    """An infinite stiffness in a model that asks for it is a strain that stays zero."""
    rod = Rod(**{**parts(), "stretching": np.tile(stretching, (3, 1)), "model": model})
    result = solved(rod, pyrod.Force((0.1, 0.2, 0.3)))
    assert (result.Gamma[:, np.isinf(stretching)] == E3[np.isinf(stretching)]).all()


# Energy -------------------------------------------------------------------------------------------


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


def with_model(rod: Rod, model: str) -> Rod:
    return Rod(rod.edge_lengths, rod.bending, rod.stretching, rod.K0, model)


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
    stretch_shear = (h[:, None] * rod.stretching * stores * (Gamma - E3) ** 2).sum() / 2
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


# As objects ---------------------------------------------------------------------------------------

ARRAYS = ("edge_lengths", "bending", "stretching", "K0")


def read_only(rod: Rod) -> bool:
    arrays = [getattr(rod, name) for name in ARRAYS] + list(rod.placement)
    return not any(a.flags.writeable for a in arrays)


def test_rods_do_not_change() -> None:
    rod = Rod.from_curve(*some_curve(4), SOFT)
    assert read_only(rod)
    with pytest.raises(FrozenInstanceError):
        rod.model = "cosserat"
    with pytest.raises(ValueError, match="read-only"):
        rod.K0[0] = 1


def test_arguments_may_be_changed_afterwards() -> None:
    h, K0 = np.ones(3), np.zeros((4, 3))
    rod = Rod.precurved(h, None, ROUND, K0)
    h[:], K0[:] = 2, 1
    assert rod.length == 3
    assert not rod.K0.any()
    assert rod.energy(*rod.at_rest()).total == 0


def test_equality_and_pickling() -> None:
    rod = Rod.from_curve(*some_curve(6), SOFT, "extensible")
    copy = pickle.loads(pickle.dumps(rod))
    assert copy == rod
    assert read_only(copy)
    assert differences(copy.at_rest()[0], rod.at_rest()[0]) == 0  # the placement, too
    assert solved(copy, pyrod.Force((1, 2, 3))).energy == solved(rod, pyrod.Force((1, 2, 3))).energy
    assert rod != with_model(rod, "cosserat")
    assert rod != Rod.from_curve(*some_curve(6, seed=2), SOFT, "extensible")
    assert rod != "rod"


def test_repr() -> None:
    assert repr(Rod.straight(0.5, 10, ROUND)) == "Rod(inextensible, straight, length=0.5, edges=10)"
    assert (
        repr(Rod.precurved(0.5, 10, SOFT, (0, 1, 0)))
        == "Rod(cosserat, precurved, length=0.5, edges=10)"
    )
    assert "stretch_shear=0.0" in repr(
        Rod.straight(1, 2, ROUND).energy(*Rod.straight(1, 2, ROUND).at_rest())
    )


def test_rigid_strains_store_no_energy() -> None:
    rod = Rod.straight(1.0, 2, Section(1, 1, 1), model="cosserat")
    positions = [[0, 0, 0], [0.1, 0, 0.5], [0.1, 0, 1.2]]
    energy = rod.energy(positions, [[1, 0, 0, 0]] * 2)
    assert energy.total == 0
    assert np.isfinite(energy.gradient).all()
