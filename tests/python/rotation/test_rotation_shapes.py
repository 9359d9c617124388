"""Rotations of arrays: leading axes, broadcasting, and what is refused."""

from __future__ import annotations

import numpy as np
import pytest
from support import random_frames, unit

from pyrod import rotation

RNG = np.random.default_rng(3)
ONE_ARGUMENT = [
    (rotation.exp, (3,), (4,)),
    (rotation.log, (4,), (3,)),
    (rotation.cayley, (3,), (4,)),
    (rotation.inverse_cayley, (4,), (3,)),
    (rotation.conjugate, (4,), (4,)),
    (rotation.to_matrix, (4,), (3, 3)),
]


@pytest.mark.parametrize("lead", [(), (1,), (5,), (2, 3), (0,)])
@pytest.mark.parametrize(("function", "inner", "outer"), ONE_ARGUMENT)
def test_leading_axes_are_kept(function, inner, outer, lead) -> None:
    values = RNG.normal(size=lead + inner)
    values = unit(values) if inner == (4,) else values
    out = function(values)
    assert out.shape == lead + outer
    for place in np.ndindex(*lead):
        np.testing.assert_array_equal(out[place], function(values[place]))


@pytest.mark.parametrize("lead", [(), (5,), (2, 3), (0,)])
def test_matrices_keep_leading_axes(lead: tuple[int, ...]) -> None:
    q = random_frames(RNG, *lead)
    assert rotation.from_matrix(rotation.to_matrix(q)).shape == q.shape


@pytest.mark.parametrize(("a", "b"), [((), (5,)), ((5,), ()), ((2, 1), (1, 3)), ((4,), (4,))])
def test_products_broadcast(a: tuple[int, ...], b: tuple[int, ...]) -> None:
    q, p, v = random_frames(RNG, *a), random_frames(RNG, *b), RNG.normal(size=(*b, 3))
    shape = np.broadcast_shapes(a, b)
    Q, P, V = (
        np.broadcast_to(q, (*shape, 4)),
        np.broadcast_to(p, (*shape, 4)),
        np.broadcast_to(v, (*shape, 3)),
    )
    np.testing.assert_array_equal(rotation.multiply(q, p), rotation.multiply(Q, P))
    np.testing.assert_array_equal(rotation.rotate(q, v), rotation.rotate(Q, V))
    assert rotation.multiply(q, p).shape == (*shape, 4)


@pytest.mark.parametrize(
    ("function", "values"),
    [
        (rotation.exp, np.zeros(4)),
        (rotation.exp, 1.0),
        (rotation.log, np.zeros(3)),
        (rotation.to_matrix, np.zeros((4, 2))),
        (rotation.from_matrix, np.zeros((3, 4))),
        (rotation.conjugate, np.zeros(3)),
    ],
)
def test_wrong_shapes_are_refused(function, values) -> None:
    with pytest.raises(ValueError, match=r"expected .*shape"):
        function(values)


def test_products_refuse_wrong_shapes() -> None:
    with pytest.raises(ValueError, match="shape"):
        rotation.multiply([1, 0, 0, 0], [1, 0, 0])
    with pytest.raises(ValueError, match="shape"):
        rotation.rotate([1, 0, 0, 0], [1, 0, 0, 0])
    with pytest.raises(ValueError, match="shape"):
        rotation.rotate([1, 0, 0], [1, 0, 0])
    with pytest.raises(ValueError, match=r"broadcast|shape"):
        rotation.rotate(random_frames(RNG, 2), np.zeros((3, 3)))


@pytest.mark.parametrize("values", [[1.0, np.nan, 0.0], [np.inf, 0.0, 0.0]])
def test_numbers_that_are_not_finite_are_refused(values: list[float]) -> None:
    with pytest.raises(ValueError, match="finite"):
        rotation.exp(values)


@pytest.mark.parametrize("length", [0.0, 0.999, 1.00001])
def test_quaternions_that_are_not_unit_are_refused(length: float) -> None:
    with pytest.raises(ValueError, match=r"quaternion\[1\]: expected a unit quaternion"):
        rotation.log([[1.0, 0.0, 0.0, 0.0], [length, 0.0, 0.0, 0.0]])
