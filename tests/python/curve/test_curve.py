"""The discrete curve: strains and reconstruction are inverse, constant strain is an exact helix."""

from __future__ import annotations

import numpy as np
import pytest
from support import angle_between, random_frames, unit

from pyrod import curve, rotation

RNG = np.random.default_rng(1)


def random_strains(n: int, largest_turn: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Edge lengths that differ by up to 10, turns up to the largest, any shear and stretch."""
    h = RNG.uniform(0.1, 1.0, n)
    cells = np.concatenate([[h[0] / 2], (h[1:] + h[:-1]) / 2, [h[-1] / 2]])
    turns = unit(RNG.normal(size=(n + 1, 3))) * RNG.uniform(0, largest_turn, (n + 1, 1))
    return h, turns / cells[:, None], RNG.normal(size=(n, 3))


@pytest.mark.parametrize("largest_turn", [1e-6, 0.1, 3.0, 6.0])
@pytest.mark.parametrize("n", [1, 2, 3, 50])
def test_strains_of_the_reconstruction_are_those_given(n: int, largest_turn: float) -> None:
    h, K, Gamma = random_strains(n, largest_turn)
    q0 = random_frames(RNG)
    r, q, end = curve.reconstruct(h, K, Gamma, RNG.normal(size=3), q0)
    K_back, Gamma_back = curve.strains(h, r, q, q0, end)
    np.testing.assert_allclose(K_back, K, rtol=0, atol=1e-13 * np.abs(K).max() + 1e-14)
    np.testing.assert_allclose(Gamma_back, Gamma, rtol=0, atol=1e-13 * np.abs(Gamma).max())


@pytest.mark.parametrize("n", [1, 2, 3, 50])
def test_reconstruction_from_the_strains_is_the_curve_given(n: int) -> None:
    h, r = RNG.uniform(0.1, 1.0, n), RNG.normal(size=(n + 1, 3))
    q0, q, end = random_frames(RNG), random_frames(RNG, n), random_frames(RNG)
    K, Gamma = curve.strains(h, r, q, q0, end)
    r_back, q_back, end_back = curve.reconstruct(h, K, Gamma, r[0], q0)
    np.testing.assert_allclose(r_back, r, rtol=0, atol=1e-13)
    np.testing.assert_allclose(q_back, q, rtol=0, atol=1e-13)  # signs included
    np.testing.assert_allclose(end_back, end, rtol=0, atol=1e-13)


def test_an_end_without_a_frame_does_not_turn() -> None:
    h, r, q = np.ones(2), RNG.normal(size=(3, 3)), random_frames(RNG, 2)
    K, _ = curve.strains(h, r, q)
    np.testing.assert_array_equal(K[[0, -1]], np.zeros((2, 3)))
    K_held, _ = curve.strains(
        h, r, q, start_frame=-q[0] * [1, -1, -1, -1], end_frame=random_frames(RNG)
    )
    np.testing.assert_array_equal(K_held[1], K[1])
    assert K_held[[0, -1]].all()


def test_strains_of_a_single_edge_by_hand() -> None:
    q = rotation.exp([0.0, 0.4, 0.0])
    r = np.array([[0.0, 0, 0], rotation.rotate(q, [0.1, -0.2, 1.5])])
    K, Gamma = curve.strains([0.5], r, [q], start_frame=[1, 0, 0, 0], end_frame=q)
    np.testing.assert_allclose(K, [[0, 0.4 / 0.25, 0], [0, 0, 0]], rtol=0, atol=4e-16)
    np.testing.assert_allclose(Gamma, [[0.2, -0.4, 3.0]], rtol=0, atol=1e-15)


def test_gamma_defaults_to_neither_sheared_nor_stretched() -> None:
    h, K, _ = random_strains(5, 1.0)
    r, q, _ = curve.reconstruct(h, K)
    a3 = rotation.rotate(q, [0.0, 0.0, 1.0])
    np.testing.assert_allclose(np.diff(r, axis=0), h[:, None] * a3, rtol=0, atol=1e-15)
    np.testing.assert_array_equal(r[0], np.zeros(3))


# Measures and closed curves -----------------------------------------------------------------------

SIZES = {
    "log": lambda x: x,
    "chord": lambda x: 2 * np.sin(x / 2),
    "cayley": lambda x: 2 * np.tan(x / 2),
}


@pytest.mark.parametrize("measure", SIZES)
def test_measures_differ_in_the_size_of_a_turn_only(measure: str) -> None:
    """K along the same axis, of the length that the angle has in that measure."""
    h, K, _ = random_strains(30, 2.8)
    r, q, end = curve.reconstruct(h, K)
    cells = np.concatenate([[h[0] / 2], (h[1:] + h[:-1]) / 2, [h[-1] / 2]])
    angle = cells * np.linalg.norm(K, axis=1)
    found, Gamma = curve.strains(h, r, q, [1, 0, 0, 0], end, measure=measure)
    expected = unit(K) * (SIZES[measure](angle) / cells)[:, None]
    np.testing.assert_allclose(found, expected, rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(Gamma, np.tile([0, 0, 1.0], (30, 1)), rtol=0, atol=1e-14)


@pytest.mark.parametrize("measure", SIZES)
@pytest.mark.parametrize("n", [1, 2, 50])
def test_reconstruction_undoes_strains_in_every_measure(n: int, measure: str) -> None:
    h, K, Gamma = random_strains(n, 1.9)
    r, q, end = curve.reconstruct(h, K, Gamma, measure=measure)
    found = curve.strains(h, r, q, [1, 0, 0, 0], end, measure=measure)
    np.testing.assert_allclose(found[0], K, rtol=0, atol=1e-13 * np.abs(K).max())
    np.testing.assert_allclose(found[1], Gamma, rtol=0, atol=1e-13 * np.abs(Gamma).max())


def test_a_closed_curve_is_an_open_one_whose_ends_are_one_frame() -> None:
    """Whatever edge comes first: values are rolled along."""
    n = 9
    h, r, q = RNG.uniform(0.1, 1.0, n), RNG.normal(size=(n, 3)), random_frames(RNG, n)
    q = rotation.continued(q)
    K, Gamma = curve.strains(h, r, q, closed=True)
    assert K.shape == Gamma.shape == (n, 3)
    last = q[-1] * np.sign(q[-1] @ q[0])
    open_K, open_Gamma = curve.strains(h, np.vstack([r, r[:1]]), q, start_frame=last)
    np.testing.assert_allclose(K[1:], open_K[1:-1], rtol=1e-15)
    np.testing.assert_allclose(K[0] * (h[0] + h[-1]) / 2, open_K[0] * h[0] / 2, rtol=1e-14)
    np.testing.assert_allclose(Gamma, open_Gamma, rtol=1e-15)
    rolled = curve.strains(
        *(np.roll(x, -4, axis=0) for x in (h, r)),
        rotation.continued(np.roll(q, -4, axis=0)),
        closed=True,
    )
    np.testing.assert_allclose(rolled[0], np.roll(K, -4, axis=0), rtol=0, atol=1e-12)
    np.testing.assert_allclose(rolled[1], np.roll(Gamma, -4, axis=0), rtol=0, atol=1e-12)


def test_the_seam_of_a_closed_curve_takes_the_smaller_turn() -> None:
    """A ring turns its frames once: with the sign of a quaternion lost there would be 2 pi more."""
    n = 8
    q = rotation.exp(np.outer(np.arange(n) * 2 * np.pi / n, [0, 1, 0]))
    K, _ = curve.strains(np.ones(n), np.zeros((n, 3)), q, closed=True)
    np.testing.assert_allclose(K, np.tile([0, 2 * np.pi / n, 0], (n, 1)), rtol=0, atol=2e-15)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"measure": "angle"}, "measure: expected"),
        ({"closed": True}, "positions: expected 3 rows"),
        ({"closed": True, "positions": np.eye(3), "end_frame": [1, 0, 0, 0]}, "has no ends"),
        (
            {"measure": "cayley", "frames": rotation.exp(np.outer([0, 1, 2], [0, 3.2, 0]))},
            r"frames\[1\]: turned by pi or more from its neighbour, which the cayley measure",
        ),
    ],
)
def test_measures_and_closures_are_refused(change: dict[str, object], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        curve.strains(**{**GOOD, **change})


def test_chords_beyond_two_are_refused() -> None:
    K = np.zeros((4, 3))
    K[2, 1] = 2.0
    curve.reconstruct(np.ones(3), K, measure="chord")  # half a turn, which is the last
    K[2, 1] = 2.001
    with pytest.raises(
        ValueError, match=r"K\[2\]: a chord of length 2.001; no turn has one beyond"
    ):
        curve.reconstruct(np.ones(3), K, measure="chord")
    with pytest.raises(ValueError, match="measure: expected"):
        curve.reconstruct(np.ones(3), K, measure="angle")


# Helices ------------------------------------------------------------------------------------------


def distances_to_axis(r: np.ndarray, point: np.ndarray, axis: np.ndarray) -> np.ndarray:
    return np.linalg.norm(np.cross(r - point, axis), axis=1)


@pytest.mark.parametrize("K", [(0.0, 2.0, 0.0), (1.0, -0.5, 0.7), (0.3, 0.2, 5.0)])
@pytest.mark.parametrize("n", [3, 300])
def test_constant_strain_is_a_discrete_helix(n: int, K: tuple[float, ...]) -> None:
    """Every step is one screw motion: the vertices lie evenly on one cylinder, on any grid."""
    h = 2.0 / n
    r, q, _ = curve.reconstruct(
        np.full(n, h), np.tile(K, (n + 1, 1)), np.tile([0.1, 0.0, 1.1], (n, 1))
    )
    axis = unit(rotation.rotate(q[0], K))  # the same in space from every edge
    for frame in q:
        np.testing.assert_allclose(unit(rotation.rotate(frame, K)), axis, rtol=0, atol=1e-13)
    edges = np.diff(r, axis=0)
    np.testing.assert_allclose(edges @ axis, edges[0] @ axis, rtol=0, atol=1e-13)
    centre = _screw_centre(edges[0], axis, h * np.linalg.norm(K), r[0])
    distances = distances_to_axis(r, centre, axis)
    np.testing.assert_allclose(distances, distances[0], rtol=1e-12, atol=0)


def _screw_centre(
    edge: np.ndarray, axis: np.ndarray, angle: float, start: np.ndarray
) -> np.ndarray:
    """A point on the axis of the screw that takes ``start`` to ``start + edge``."""
    across = edge - (edge @ axis) * axis
    return start + across / 2 + np.cross(axis, across) / (2 * np.tan(angle / 2))


@pytest.mark.parametrize("turns", [1, 10])
def test_constant_bending_closes_after_whole_turns(turns: int) -> None:
    n = 64 * turns
    r, _, end = curve.reconstruct(np.full(n, 1 / n), np.tile([0, 2 * np.pi * turns, 0], (n + 1, 1)))
    np.testing.assert_allclose(r[-1], r[0], rtol=0, atol=1e-14)
    sign = (-1.0) ** turns
    np.testing.assert_allclose(end, [sign, 0, 0, 0], rtol=0, atol=1e-13)  # counts the turns


def test_rigid_motion_leaves_the_strains() -> None:
    h, K, Gamma = random_strains(20, 2.0)
    r, q, end = curve.reconstruct(h, K, Gamma)
    move = random_frames(RNG)
    moved = rotation.rotate(move, r) + RNG.normal(size=3)
    frames = [rotation.multiply(move, x) for x in ([1.0, 0, 0, 0], q, end)]
    K_moved, Gamma_moved = curve.strains(h, moved, frames[1], frames[0], frames[2])
    np.testing.assert_allclose(K_moved, K, rtol=0, atol=1e-12)
    np.testing.assert_allclose(Gamma_moved, Gamma, rtol=0, atol=1e-12)


def test_reversed_curve_has_reversed_strains() -> None:
    """Seen from the other end, with the frames turned about a1 so that a3 points along again."""
    h, K, Gamma = random_strains(20, 2.0)
    r, q, end = curve.reconstruct(h, K, Gamma)
    flip = np.array([0.0, 1.0, 0.0, 0.0])
    turned = [rotation.multiply(x, flip) for x in (end, q[::-1], [1.0, 0, 0, 0])]
    K_back, Gamma_back = curve.strains(h[::-1], r[::-1], turned[1], turned[0], turned[2])
    np.testing.assert_allclose(K_back, K[::-1] * [-1, 1, 1], rtol=0, atol=1e-12)
    np.testing.assert_allclose(Gamma_back, Gamma[::-1] * [-1, 1, 1], rtol=0, atol=1e-12)


# Refusals -----------------------------------------------------------------------------------------

GOOD = {
    "edge_lengths": np.ones(3),
    "positions": RNG.normal(size=(4, 3)),
    "frames": random_frames(RNG, 3),
}
BAD = [
    ("edge_lengths", np.ones((3, 1)), r"edge_lengths: expected one number each, shape \(n,\)"),
    ("edge_lengths", [], "edge_lengths: a rod needs at least one edge"),
    ("edge_lengths", [1, 0, 1], r"edge_lengths\[1\]: must be positive"),
    ("edge_lengths", [1, 1, -1], r"edge_lengths\[2\]: must be positive"),
    ("edge_lengths", [1, np.nan, 1], r"edge_lengths\[1\]: expected finite"),
    ("positions", np.zeros((3, 3)), "positions: expected 4 rows"),
    ("positions", np.zeros((4, 2)), r"positions: expected an array of shape \(n, 3\)"),
    ("positions", np.full((4, 3), np.inf), r"positions\[0\]: expected finite numbers"),
    ("frames", random_frames(RNG, 4), "frames: expected 3 rows"),
    ("frames", np.zeros((3, 3)), r"frames: expected an array of shape \(n, 4\)"),
    ("frames", np.zeros((3, 4)), r"frames\[0\]: expected a unit quaternion"),
    ("start_frame", [1.0, 0, 0], "start_frame: expected a quaternion"),
    ("end_frame", [1.0, 1.0, 0, 0], r"end_frame\[0\]: expected a unit quaternion"),
    ("end_frame", [np.nan, 1.0, 0, 0], "end_frame"),
]


@pytest.mark.parametrize(("name", "value", "message"), BAD)
def test_strains_refuse(name: str, value: object, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        curve.strains(**{**GOOD, name: value})


@pytest.mark.parametrize("place", [0, 1, 3])
def test_a_turn_of_two_pi_is_refused(place: int) -> None:
    all_frames = np.tile([1.0, 0, 0, 0], (5, 1))  # start, three edges, end
    all_frames[place + 1 :] *= -1
    start, frames, end = all_frames[0], all_frames[1:-1], all_frames[-1]
    with pytest.raises(ValueError, match=rf"frames\[{place}\]: turned by 2 pi from its neighbour"):
        curve.strains(np.ones(3), GOOD["positions"], frames, start, end)


def test_a_turn_just_below_two_pi_is_taken() -> None:
    frames = rotation.exp([[0, 0, 0], [0, 2 * np.pi - 1e-4, 0]])
    K, _ = curve.strains(np.ones(2), np.zeros((3, 3)), frames)
    np.testing.assert_allclose(K[1], [0, 2 * np.pi - 1e-4, 0], rtol=0, atol=1e-11)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"K": np.zeros((3, 3))}, "K: expected 4 rows"),
        ({"K": np.zeros(3)}, "K: expected an array"),
        ({"K": np.full((4, 3), np.nan)}, r"K\[0\]: expected finite"),
        ({"Gamma": np.zeros((4, 3))}, "Gamma: expected 3 rows"),
        ({"Gamma": np.full((3, 3), np.inf)}, r"Gamma\[0\]: expected finite"),
        ({"position": np.zeros(2)}, "position: expected 3 numbers"),
        ({"frame": np.zeros(4)}, "frame.*: expected a unit quaternion"),
    ],
)
def test_reconstruct_refuses(change: dict[str, object], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        curve.reconstruct(**{"edge_lengths": np.ones(3), "K": np.zeros((4, 3)), **change})


def test_frames_come_back_of_unit_length() -> None:
    h, K, _ = random_strains(1000, 3.0)
    _, q, _ = curve.reconstruct(h, K)
    np.testing.assert_allclose(np.linalg.norm(q, axis=1), 1, rtol=0, atol=4e-16)
    assert angle_between(q[:-1], q[1:]).max() > 1
