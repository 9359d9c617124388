"""Curves rebuilt from exact strains are of second order, in every measure; Sauer's torsion."""

from __future__ import annotations

from functools import cache
from typing import NamedTuple

import numpy as np
import pytest
from support import HELIX, SMOOTH, SmoothCurve, angle_between, differences
from test_curve_convergence import MEASURES, Errors, assert_ratios, largest

from pyrod import curve, rotation

# Reconstruction -----------------------------------------------------------------------------------


def frenet_strains(smooth: SmoothCurve, t: np.ndarray) -> np.ndarray:
    kappa, tau, _ = smooth.frenet(t)
    return np.stack([0 * t, kappa, tau], axis=-1)


def bishop_strains(smooth: SmoothCurve, t: np.ndarray) -> np.ndarray:
    kappa, _, R = smooth.frenet(t)
    return np.einsum("jik,ji->jk", smooth.bishop(t), kappa[:, None] * R[..., 1])


STRAINS = {"Frenet": frenet_strains, "Bishop": bishop_strains}


class Exact(NamedTuple):
    """A smooth curve where edges of given lengths have their vertices and centres."""

    smooth: SmoothCurve
    kind: str
    h: np.ndarray
    t: np.ndarray
    frames: np.ndarray
    K: np.ndarray


def exact_on(smooth: SmoothCurve, h: np.ndarray, kind: str) -> Exact:
    s = np.append(0, np.cumsum(h))
    t = smooth.parameters_at(s)
    middle = np.append(t[0], smooth.parameters_at(s[1:] - h / 2))
    R = smooth.frenet(middle)[2] if kind == "Frenet" else smooth.bishop(middle)
    return Exact(smooth, kind, h, t, rotation.from_matrix(R), STRAINS[kind](smooth, t))


@cache
def exact_on_even(smooth: SmoothCurve, n: int, kind: str) -> Exact:
    """The same for all measures."""
    return exact_on(smooth, np.full(n, smooth.data["values"]["length"] / n), kind)


def reconstruction_errors(exact: Exact, measure: str) -> Errors:
    smooth, kind, h, t, frames, K = exact
    start = smooth.derivative(t[0]), frames[0]
    if measure == "log":
        made = curve.FramedCurve.sampled(h, None, K, (0, 0, 1), *start)
    else:
        made = curve.FramedCurve.from_strains(h, K, None, *start, measure=measure)
    error = {"positions": largest(made.polyline.positions - smooth.derivative(t))}
    turned = largest(angle_between(made.frames, frames[1:]))
    if smooth is HELIX and kind == "Frenet" and measure == "log":
        assert turned < 1e-12  # exact for constant strain; the rest is rounding
        return error
    return error | {"frames": turned}


@pytest.mark.parametrize("measure", MEASURES)
@pytest.mark.parametrize("kind", ["Frenet", "Bishop"])
@pytest.mark.parametrize("smooth", SMOOTH, ids=repr)
def test_reconstruction_is_second_order(smooth: SmoothCurve, kind: str, measure: str) -> None:
    exact = [exact_on_even(smooth, n, kind) for n in (512, 1024, 2048)]
    assert_ratios([reconstruction_errors(e, measure) for e in exact])


@pytest.mark.parametrize("kind", ["Frenet", "Bishop"])
@pytest.mark.parametrize("smooth", SMOOTH, ids=repr)
def test_reconstruction_on_bisected_uneven_grids_is_second_order(
    smooth: SmoothCurve, kind: str
) -> None:
    h, levels = np.random.default_rng(3).uniform(1, 3, 256), []
    h *= smooth.data["values"]["length"] / h.sum()
    for _ in range(3):
        levels.append(reconstruction_errors(exact_on(smooth, h, kind), "log"))
        h = np.repeat(h / 2, 2)
    assert_ratios(levels)


# Sauer's torsion ----------------------------------------------------------------------------------


@pytest.mark.parametrize("smooth", SMOOTH, ids=repr)
def test_sauers_torsion_differs_by_a_sixth_of_the_cube(smooth: SmoothCurve) -> None:
    """sin(alpha)/l is alpha/l - tau^3 l^2/6: also of second order, with another constant."""
    arc, middle = smooth.polyline(smooth.even(2048)), smooth.even(4096)[1::2]
    tau = smooth.frenet(middle)[1]
    inner = slice(None) if smooth.closed else slice(1, -1)
    difference = (arc.torsion() - arc.torsion("sauer"))[inner]
    expected = (tau**3 * arc.edge_lengths**2 / 6)[inner]
    assert differences(difference, expected) < 2e-3
