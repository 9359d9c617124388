"""Simple polygons in a plane: checks, areas, and triangles that fill them."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pyrod.base.arrays import Array, array, transposed

Corners = tuple[tuple[float, float], ...]


def signed_area(loop: Array) -> float:
    """Positive if the (k, 2) corners go round counter-clockwise."""
    return float(_cross(loop, np.roll(loop, -1, axis=0)).sum() / 2)


def first_moments(loop: Array) -> Array:
    """(2,) integrals of x and y inside of (k, 2) corners that go round counter-clockwise."""
    following = np.roll(loop, -1, axis=0)
    return (_cross(loop, following)[:, None] * (loop + following)).sum(axis=0) / 6


def second_moments(loop: Array) -> Array:
    """(3,) integrals of x^2, y^2 and x y there."""
    a, b = loop, np.roll(loop, -1, axis=0)
    squares = a**2 + a * b + b**2
    mixed = (a[:, 0] * b[:, 1] + b[:, 0] * a[:, 1]) / 2 + a.prod(axis=1) + b.prod(axis=1)
    rows = np.column_stack([squares, mixed])
    return (_cross(a, b)[:, None] * rows).sum(axis=0) / [12, 12, 12]


def corners(points: ArrayLike, name: str) -> Corners:
    """The corners of a simple polygon, counter-clockwise; refuses what is none."""
    loop = array(points, name)
    if loop.ndim != 2 or loop.shape[1] != 2 or len(loop) < 3:
        raise ValueError(
            f"{name}: expected (k, 2) corners, k at least 3, got shape {loop.shape}"
            f"{transposed(loop, 2)}"
        )
    if not np.isfinite(loop).all():
        raise ValueError(f"{name}: expected finite numbers")
    area, extent = signed_area(loop - loop[0]), np.ptp(loop, axis=0).max()
    if not abs(area) > 1e-12 * extent**2:
        raise ValueError(f"{name}: the corners enclose no area, got {area:g}")
    if _crosses_itself(loop):
        raise ValueError(f"{name}: sides cross or touch; give the corners in order, each once")
    ordered = loop if area > 0 else loop[::-1]
    return tuple((float(x), float(y)) for x, y in ordered)


def is_inside(inner: Corners, outer: Corners) -> bool:
    """Whether a polygon is inside of another, without touching it."""
    a, b = np.array(inner), np.array(outer)
    if _meet(*_sides(a), *_sides(b)).any():
        return False
    return _crossings(a[0], b) % 2 == 1


def _crossings(point: Array, loop: Array) -> int:
    """How often a ray from the point along the first axis crosses a loop."""
    a, b = _sides(loop)
    straddles = (a[:, 1] > point[1]) != (b[:, 1] > point[1])
    a, b = a[straddles], b[straddles]
    x = a[:, 0] + (point[1] - a[:, 1]) / (b[:, 1] - a[:, 1]) * (b[:, 0] - a[:, 0])
    return int((x > point[0]).sum())


def _crosses_itself(loop: Array) -> bool:
    """Whether sides that are no neighbours meet, as they do where corners coincide."""
    k = len(loop)
    apart = (np.arange(k)[:, None] - np.arange(k)) % k
    others = (apart > 1) & (apart < k - 1)
    return bool((_meet(*_sides(loop), *_sides(loop)) & others).any())


def _sides(loop: Array) -> tuple[Array, Array]:
    return loop, np.roll(loop, -1, axis=0)


def _meet(a: Array, b: Array, c: Array, d: Array) -> NDArray[np.bool_]:
    """(k, l) whether the sides a-b and c-d, k and l of them, have a point in common."""
    a, b = a[:, None], b[:, None]
    near = np.minimum(a, b) <= np.maximum(c, d)
    near &= np.minimum(c, d) <= np.maximum(a, b)  # sides on one line may still be apart
    across = (_turn(a, b, c) * _turn(a, b, d) <= 0) & (_turn(c, d, a) * _turn(c, d, b) <= 0)
    return near.all(axis=-1) & across


def _turn(a: Array, b: Array, c: Array) -> Array:
    """Positive where c is to the left of the line from a to b."""
    return _cross(b - a, c - a)


def _cross(a: Array, b: Array) -> Array:
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


# Triangles ----------------------------------------------------------------------------------------


def triangles(loops: tuple[Array, ...]) -> Array:
    """Triangles that fill a polygon, by cutting ears.

    Parameters
    ----------
    loops : sequence of (k, 2) arrays
        The outer loop, counter-clockwise, and that of a hole, clockwise.

    Returns
    -------
    (m, 3) array
        Corners of each, counted through all loops; every side of a loop is in one triangle.
    """
    points = np.vstack(loops)
    left = list(range(len(loops[0])))
    if len(loops) > 1:
        left = _bridged(*loops)
    found = []
    while len(left) > 3:
        ear = next((i for i in range(len(left)) if _is_ear(points, left, i)), 0)
        found.append([left[ear - 1], left[ear], left[(ear + 1) % len(left)]])
        del left[ear]
    return np.array([*found, left])


def _is_ear(points: Array, left: list[int], i: int) -> bool:
    """Whether the triangle at a corner that is left is empty."""
    triangle = points[[left[i - 1], left[i], left[(i + 1) % len(left)]]]
    a, b, c = triangle
    if _turn(a, b, c) <= 0:
        return False
    others = points[left]
    inside = (_turn(a, b, others) >= 0) & (_turn(b, c, others) >= 0) & (_turn(c, a, others) >= 0)
    own = (others[:, None] == triangle).all(axis=2).any(axis=1)
    return not (inside & ~own).any()


def _bridged(outer: Array, hole: Array) -> list[int]:
    """One loop out of two: to the hole and back along the shortest way that meets no side."""
    distances = np.linalg.norm(outer[:, None] - hole, axis=2)
    order = np.argsort(distances, axis=None, kind="stable")
    pairs = (divmod(int(pair), len(hole)) for pair in order)
    i, j = next(pair for pair in pairs if _sees(outer, hole, *pair))
    around = len(outer) + (j + np.arange(len(hole) + 1)) % len(hole)
    return [*range(i + 1), *around.tolist(), *range(i, len(outer))]


def _sees(outer: Array, hole: Array, i: int, j: int) -> bool:
    """Whether the way from corner i of one loop to corner j of the other meets no other side."""
    sides = [np.stack(_sides(loop), axis=1) for loop in (outer, hole)]
    apart = [np.delete(of, [at - 1, at], axis=0) for of, at in zip(sides, (i, j), strict=True)]
    c, d = np.vstack(apart).swapaxes(0, 1)
    return not _meet(outer[i : i + 1], hole[j : j + 1], c, d).any()
