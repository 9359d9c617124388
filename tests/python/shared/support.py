"""Rods, scenes, comparisons and missing packages that several test files use."""

from __future__ import annotations

import json
import sys
from itertools import pairwise
from math import factorial
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import strategies as st

import pyrod
from pyrod import curve, rotation

Array = np.ndarray
MODELS = ("cosserat", "extensible", "inextensible")
SPACES = ("planar", "spatial")
SOFT = pyrod.Section(EI1=1.0, EI2=1.3, GJ=0.8, GA1=60.0, GA2=80.0, EA=150.0)
"""A section for unit length whose shear and stretch are seen; anisotropic."""
ROUND = pyrod.Section(EI1=1.0, EI2=1.0, GJ=0.7)
"""An isotropic section, neither shearable nor extensible."""
REFERENCE = Path(__file__).parents[2] / "reference"
IDENTITY = np.array([1.0, 0.0, 0.0, 0.0])
X, Y, Z = np.eye(3)
FLAT = pyrod.Section(EI1=4.0, EI2=1.0, GJ=2.0)
"""Softest in the plane of a1 and a3, where its bending stiffness is 1; else rigid."""


def work(result: pyrod.Equilibrium) -> float:
    """Iterations on all grids, as so many on the finest."""
    return float(np.sum(result.record["unknowns"]) / result.unknowns)


def unit(vector: Any) -> Array:
    """The vector, or each row, divided by its length."""
    vector = np.asarray(vector, dtype=float)
    return vector / np.linalg.norm(vector, axis=-1, keepdims=True)


def random_frames(rng: np.random.Generator, *shape: int) -> Array:
    """Unit quaternions, evenly distributed."""
    return unit(rng.normal(size=(*shape, 4)))


def vectors(largest: float = 1.0) -> st.SearchStrategy[Array]:
    """Vectors in a cube, for property tests; rounded, so that no product of two underflows."""
    number = st.floats(-largest, largest).map(lambda x: round(x, 12))
    return st.tuples(number, number, number).map(np.array)


def frames() -> st.SearchStrategy[Array]:
    """Unit quaternions of both signs, for property tests."""
    number = st.floats(-1, 1, allow_subnormal=False)
    quadruples = st.tuples(number, number, number, number).map(np.array)
    return quadruples.filter(lambda q: np.linalg.norm(q) > 0.1).map(unit)


def angle_between(a: Array, b: Array) -> Array:
    """Angle [rad] between frames, whatever the signs of the quaternions."""
    turn = rotation.multiply(rotation.conjugate(a), b)
    return 2 * np.arctan2(np.linalg.norm(turn[..., 1:], axis=-1), np.abs(turn[..., 0]))


def solved(
    rod: pyrod.Rod,
    *loads: Any,
    clamp: pyrod.Clamp | None = None,
    space: str = "spatial",
    **more: Any,
) -> pyrod.Equilibrium:
    """Solves a rod clamped at its start."""
    return pyrod.solve(pyrod.Scene(rod, clamp or pyrod.Clamp(), loads, space), **more)


def orders(errors: Any, ratio: float = 2.0) -> Array:
    """Observed orders of convergence between neighbouring levels."""
    errors = np.asarray(errors, dtype=float)
    return np.log(errors[:-1] / errors[1:]) / np.log(ratio)


def extrapolated(values: Any, powers: tuple[int, ...] = (2, 3, 4, 5)) -> Any:
    """The limit of values on n, 2n, 4n, ... edges whose errors are sums of these powers of 1/n."""
    values = [np.asarray(v, dtype=float) for v in values]
    for p in powers[: len(values) - 1]:
        values = [(2**p * b - a) / (2**p - 1) for a, b in pairwise(values)]
    return values[0]


def table(name: str) -> dict[str, Any]:
    """A table of the reference data."""
    return json.loads((REFERENCE / f"{name}.json").read_text())


def about_y(angle: float) -> Array:
    """The frame that is turned by an angle [rad] about y: in the plane x, z."""
    return rotation.exp(angle * Y)


def pin(at: Any, along: Any = None) -> pyrod.Pivot:
    """Held in place, free to turn in the plane x, z: a hinge that keeps the rod from spinning."""
    return pyrod.Pivot(Y, at=at, along=along)


COLUMNS = {
    "clamped-free": [pyrod.Clamp()],
    "pinned-pinned": [pin("start"), pin("end", Z)],
    "clamped-pinned": [pyrod.Clamp(), pin("end", Z)],
    "clamped-clamped": [pyrod.Clamp(), pyrod.Slider(Z, clamped=True)],
    "clamped-guided": [pyrod.Clamp(), pyrod.Slider(normal=Y, clamped=True)],
}
EULER = {row["ends"]: float(row["P"]) for row in table("S5_euler")["rows"]}
"""Columns along z by their ends, and their critical loads."""


def differences(a: Any, b: Any) -> float:
    """Largest difference relative to the largest entry of b."""
    a, b = np.asarray(a), np.asarray(b)
    return float(np.abs(a - b).max() / (np.abs(b).max() or 1.0))


def same_sweep(a: pyrod.Sweep, b: pyrod.Sweep, but: tuple[str, ...] = ("time",)) -> None:
    """Refuses sweeps that differ in a bit, but for some quantities."""
    assert list(a.columns) == list(b.columns)
    assert (a.grid, a.shape) == (b.grid, b.shape)
    for name in a.columns.keys() - set(but):
        assert a[name].dtype == b[name].dtype
        np.testing.assert_array_equal(a[name], b[name], name)


class Missing:
    """A finder of modules that does not find one package, as where it is not installed."""

    def __init__(self, package: str) -> None:
        self.package = package

    def find_spec(self, name: str, *_: Any) -> None:
        if name.partition(".")[0] == self.package:
            raise ModuleNotFoundError(f"No module named {self.package!r}", name=self.package)


def uninstall(monkeypatch: pytest.MonkeyPatch, package: str) -> None:
    """Makes imports of a package fail, also where it was imported before."""
    for name in [name for name in sys.modules if name.partition(".")[0] == package]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setattr(sys, "meta_path", [Missing(package), *sys.meta_path])


def within(found: pyrod.Critical, exact: float, relative: float) -> None:
    """The error is less than it is told to be, and than it should be."""
    assert abs(found.factor - exact) <= found.error + relative * exact
    assert abs(found.factor / exact - 1) < relative
    assert found.error < 2e-3 * exact


# Smooth curves ------------------------------------------------------------------------------------

NODES, WEIGHTS = np.polynomial.legendre.leggauss(16)


class SmoothCurve:
    """A curve of the reference data at any parameter: a sum of waves, and a polynomial.

    A wave is (frequency, coefficients of the cosine, of the sine), all that the formulae of
    tests/reference/G_*.json consist of; so derivatives are exact.
    """

    def __init__(self, name: str, end: float, waves: Any, powers: Any = (), start: float = 0.0):
        self.name, self.start, self.end = name, start, end
        self.frequencies = np.array([w for w, _, _ in waves], dtype=float)
        self.cosines = np.reshape([c for _, c, _ in waves], (-1, 3)).astype(float)
        self.sines = np.reshape([s for _, _, s in waves], (-1, 3)).astype(float)
        self.powers = np.reshape(powers, (-1, 3)).astype(float)
        self.data = json.loads((REFERENCE / f"G_{name}.json").read_text())
        self.closed = self.data["closed"]
        self._table = np.linspace(start, end, 257)
        self._lengths = self.arc_lengths(self._table)

    def __repr__(self) -> str:
        return self.name

    def derivative(self, t: Array, order: int = 0) -> Array:
        """The derivative of the position by the parameter, (..., 3)."""
        return self.derivatives(t, order)[0]

    def derivatives(self, t: Array, *orders: int) -> list[Array]:
        """Several of them, with the waves computed once."""
        t, w = np.asarray(t, dtype=float)[..., None], self.frequencies
        c, s = np.cos(w * t), np.sin(w * t)
        waves = [(c, s), (-s, c), (-c, -s), (s, -c)]  # differentiated so many times
        out = []
        for order in orders:
            cosine, sine = waves[order % 4]
            scale = w[:, None] ** order
            value = cosine @ (scale * self.cosines) + sine @ (scale * self.sines)
            for k, coefficient in enumerate(self.powers[order:], order):
                value += factorial(k) / factorial(k - order) * t ** (k - order) * coefficient
            out.append(value)
        return out

    def frenet(self, t: Array) -> tuple[Array, Array, Array]:
        """Curvature, torsion, and the matrices (n, b, t)."""
        d1, d2, d3 = self.derivatives(t, 1, 2, 3)
        speed = np.linalg.norm(d1, axis=-1)
        across = np.cross(d1, d2)
        area = np.linalg.norm(across, axis=-1)
        tangent, binormal = unit(d1), unit(across)
        R = np.stack([np.cross(binormal, tangent), binormal, tangent], axis=-1)
        return area / speed**3, np.sum(across * d3, axis=-1) / area**2, R

    def integral(self, density: Any, t: Array) -> Array:
        """The integral of density(t) ds from the first t to each, to rounding."""
        half = np.diff(t)[:, None] / 2
        x = t[:-1, None] + half * (1 + NODES)
        speed = np.linalg.norm(self.derivative(x, 1), axis=-1)
        return np.concatenate([[0.0], np.cumsum((half * speed * density(x)) @ WEIGHTS)])

    def arc_lengths(self, t: Array) -> Array:
        return self.integral(np.ones_like, t)

    def bishop(self, t: Array) -> Array:
        """The matrices of the frames that do not twist and start as Frenet's at the first t."""
        R = self.frenet(t)[2]
        angle = -self.integral(lambda x: self.frenet(x)[1], t)[:, None]
        n, b = R[..., 0], R[..., 1]
        turned = np.cos(angle) * n + np.sin(angle) * b, np.cos(angle) * b - np.sin(angle) * n
        return np.stack([*turned, R[..., 2]], axis=-1)

    def parameters_at(self, s: Array) -> Array:
        """The parameters of arc lengths: Newton's method from a table."""
        t = np.interp(s, self._lengths, self._table)
        for _ in range(5):
            i = np.clip(np.searchsorted(self._table, t) - 1, 0, len(self._table) - 2)
            half = (t - self._table[i])[:, None] / 2
            x = self._table[i][:, None] + half * (1 + NODES)
            along = (half * np.linalg.norm(self.derivative(x, 1), axis=-1)) @ WEIGHTS
            t = t - (self._lengths[i] + along - s) / np.linalg.norm(self.derivative(t, 1), axis=-1)
        return t

    def even(self, n: int, by: str = "parameter") -> Array:
        """n + 1 parameters, evenly spaced in the parameter or in arc length."""
        if by == "parameter":
            return np.linspace(self.start, self.end, n + 1)
        return self.parameters_at(np.linspace(0, self._lengths[-1], n + 1))

    def uneven(self, n: int, rng: np.random.Generator) -> Array:
        """The same with random steps of the parameter that differ by up to 3."""
        steps = np.cumsum(rng.uniform(1, 3, n))
        return np.concatenate(
            [[self.start], self.start + (self.end - self.start) * steps / steps[-1]]
        )

    def polyline(self, t: Array) -> curve.Polyline:
        """Through the points at t; closed without the last; open with the tangents at the ends."""
        r = self.derivative(t)
        if self.closed:
            return curve.Polyline(r[:-1], closed=True)
        ends = self.derivative(t[[0, -1]], 1)
        return curve.Polyline(r, False, *ends)


def _torus_knot(p: int, q: int, R: float) -> SmoothCurve:
    waves = [(p, (R, 0, 0), (0, R, 0)), (q, (0, 0, 0), (0, 0, 1))]
    waves += [(w, (0.5, 0, 0), (0, 0.5, 0)) for w in (p + q, p - q)]
    return SmoothCurve(f"torus_knot_{p}_{q}", 2 * np.pi, waves)


HELIX = SmoothCurve("helix", 4 * np.pi, [(1, (1, 0, 0), (0, 1, 0))], [(0, 0, 0), (0, 0, 0.3)])
CUBIC = SmoothCurve("twisted_cubic", 1.0, [], [(0, 0, 0), *np.eye(3)], start=-1.0)
VIVIANI = SmoothCurve(
    "viviani", 4 * np.pi, [(1, (1, 0, 0), (0, 1, 0)), (0.5, (0, 0, 0), (0, 0, 2))], [(1, 0, 0)]
)
UNKNOT = SmoothCurve(
    "trig_unknot",
    2 * np.pi,
    [
        (1, (1, 0, 0), (0, 1, 0)),
        (2, (0.2, -0.15, 0.3), (0.1, 0, 0.25)),
        (3, (0, 0, 0), (0, 0, 0.1)),
    ],
)
KNOTS = [_torus_knot(2, 3, 2.0), _torus_knot(3, 2, 3.0), UNKNOT]
"""Closed, and without double points."""
SMOOTH = [HELIX, CUBIC, VIVIANI, *KNOTS]
