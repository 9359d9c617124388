"""Rods: how they are made, what they refuse, and what they are as objects."""

from __future__ import annotations

import pickle
from dataclasses import FrozenInstanceError
from math import inf, nan

import numpy as np
import pytest
from support import MODELS, ROUND, SOFT, differences, random_frames, solved

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


def with_model(rod: Rod, model: str) -> Rod:
    return Rod(rod.edge_lengths, rod.bending, rod.stretching, rod.K0, model)


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
