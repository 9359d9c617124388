"""The largest eigenvalues of operators that are known by what they do to vectors, with SciPy."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pyrod.base.immutable import Array
from pyrod.base.optional import need

Apply = Callable[[Array], Array]
AnyArray = NDArray[Any]

_DENSE = 100
"""Rows up to which an operator is written out."""
_ROUGHLY = 1e-4
"""Of vectors, where the square of it will do for eigenvalues."""
_NOTHING = 1e-13
"""Of the largest eigenvalue: zero but for rounding."""


def largest(
    apply: Apply, size: int, count: int, symmetric: bool = True
) -> tuple[AnyArray, AnyArray]:
    """Eigenvalues (k,) of a real operator, the largest first, and their vectors (size, k).

    Of a symmetric one these are its largest, and vectors are orthonormal; of another the largest by
    magnitude, complex. Fewer than ``count`` if all others are zero. Lanczos' and Arnoldi's methods
    see one vector of several that have one eigenvalue: what they have left out is looked for beside
    what they have found, until nothing is.
    """
    if size <= max(_DENSE, 4 * count):
        values, vectors = _ritz(apply, np.eye(size), symmetric)
    else:
        values, vectors = _by_parts(apply, size, count, symmetric)
    there = np.abs(values) > _NOTHING * np.abs(values[0])
    if symmetric:
        there &= values > 0
    return values[there][:count], vectors[:, there][:, :count]


def _by_parts(apply: Apply, size: int, count: int, symmetric: bool) -> tuple[AnyArray, AnyArray]:
    basis = _by_scipy(apply, size, count, symmetric)
    while True:
        values, vectors = _ritz(apply, basis, symmetric)
        least = _order(values[:count][-1], symmetric)
        rest = _beside(apply, basis, least if symmetric else 0.0)
        nearly = _by_scipy(rest, size, 1, symmetric, _ROUGHLY)
        if _order(_ritz(apply, nearly, symmetric)[0][0], symmetric) <= least * (1 + 1e-9):
            return values, vectors
        more = _by_scipy(_beside(apply, basis, 0.0), size, 1, symmetric)
        basis = _orthonormal(np.hstack([basis, more]))


def _order(value: Any, symmetric: bool) -> Any:
    return value if symmetric else np.abs(value)


def _ritz(apply: Apply, basis: Array, symmetric: bool) -> tuple[AnyArray, AnyArray]:
    """All eigenvalues in a space that the operator maps onto itself."""
    images = np.stack([apply(v) for v in basis.T], axis=1)
    small = basis.T @ images
    if symmetric:
        values, parts = np.linalg.eigh((small + small.T) / 2)
    else:
        values, parts = np.linalg.eig(small)
    order = np.argsort(-_order(values, symmetric), kind="stable")
    return values[order], basis @ parts[:, order]


def _by_scipy(apply: Apply, size: int, count: int, symmetric: bool, tol: float = 0.0) -> Array:
    """An orthonormal basis of the vectors that SciPy finds."""
    linalg = need("scipy.sparse.linalg", "all")
    operator = linalg.LinearOperator((size, size), matvec=apply, dtype=np.float64)
    start = np.random.default_rng(1).standard_normal(size)
    ncv = min(size - 1, max(2 * count + 2, 24))
    try:
        if symmetric:
            return linalg.eigsh(operator, count, which="LA", v0=start, ncv=ncv, tol=tol)[1]
        vectors = linalg.eigs(operator, count, which="LM", v0=start, ncv=ncv, tol=tol)[1]
    except linalg.ArpackError as error:
        raise ArithmeticError(
            f"modes: {count} were not found to the digits there are; ask for fewer"
        ) from error
    return _orthonormal(np.hstack([vectors.real, vectors.imag]))


def _orthonormal(vectors: Array) -> Array:
    """A basis of what they span."""
    left, sizes, _ = np.linalg.svd(vectors, full_matrices=False)
    return left[:, sizes > 1e-8 * sizes[0]]


def _beside(apply: Apply, basis: Array, more: float) -> Apply:
    """The operator, and so much more, on what is orthogonal to a space that it maps onto itself;
    there it is zero. Without more an eigenvalue of zero could not be found to relative digits."""

    def outside(v: Array) -> Array:
        v = v - basis @ (basis.T @ v)
        image = apply(v)
        return image - basis @ (basis.T @ image) + more * v

    return outside
