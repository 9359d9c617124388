"""Orders of convergence to smooth curves with exact curvature, torsion and frames.

Evenly spaced vertices, in the parameter or in arc length, give second order in all (Linn A.3,
A.4). Elsewhere a binormal is that of the mean of three neighbouring vertices, and a curvature that
of the middle between two edge centres: away from the vertex by a third and by a quarter of the
difference of its edges. What that leaves of each order is asserted, from both sides.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from support import (
    CUBIC,
    HELIX,
    KNOTS,
    SMOOTH,
    VIVIANI,
    SmoothCurve,
    angle_between,
    differences,
    orders,
)

from pyrod import curve, rotation

MEASURES = ("log", "chord", "cayley")
Errors = dict[str, float]


def largest(error: np.ndarray) -> float:
    return float(np.abs(error).max())


def typical(error: np.ndarray) -> float:
    return float(np.sqrt(np.mean(error**2)))


Size = Callable[[np.ndarray], float]


def vertex_errors(smooth: SmoothCurve, t: np.ndarray, size: Size) -> Errors:
    """At the vertices; those at the ends of open curves, which have half cells, apart."""
    arc = smooth.polyline(t)
    t = t[: len(arc.positions)]
    kappa, _, R = smooth.frenet(t)
    b = R[..., 1]
    inner = slice(None) if smooth.closed else slice(1, -1)
    error = {"binormals": arc.binormals - b}
    for measure in MEASURES:
        error[f"kappa {measure}"] = arc.curvature(measure) - kappa
        error[f"kappa b {measure}"] = arc.curvature_binormals(measure) - kappa[:, None] * b
    error["vertex frames"] = angle_between(arc.vertex_frenet_frames(), rotation.from_matrix(R))
    return {name: size(e[inner]) for name, e in error.items()}


def edge_errors(smooth: SmoothCurve, t: np.ndarray, size: Size) -> Errors:
    """At the middle of the parameter; torsion and Frenet frames not on edges with an end."""
    arc, middle = smooth.polyline(t), (t[1:] + t[:-1]) / 2
    _, tau, R = smooth.frenet(middle)
    inner = slice(None) if smooth.closed else slice(1, -1)
    frames = angle_between(arc.frenet().frames, rotation.from_matrix(R))
    out = {
        "tangents": size(arc.tangents - R[..., 2]),
        "centres": size(arc.centres - smooth.derivative(middle)),
        "edge frames": size(frames[inner]),
        "arc length": size(arc.arc_lengths - smooth.arc_lengths(t)[: len(arc.positions)]),
    }
    for measure in (*MEASURES, "sauer"):
        out[f"tau {measure}"] = size((arc.torsion(measure) - tau)[inner])
    return out


def bishop_errors(smooth: SmoothCurve, t: np.ndarray, size: Size) -> Errors:
    """Against the Frenet frame turned by minus the integral of torsion."""
    arc, middle = smooth.polyline(t), (t[1:] + t[:-1]) / 2
    start = middle[0] if smooth.closed else t[0]
    exact = rotation.from_matrix(smooth.bishop(np.append(start, middle[smooth.closed :])))
    framed = arc.bishop(frame=exact[0])
    at_vertices = rotation.from_matrix(smooth.bishop(np.append(start, t[1:-1])))[1:]
    return {
        "Bishop, edges": size(angle_between(framed.frames, exact[not smooth.closed :])),
        "Bishop, vertices": size(angle_between(framed.vertex_frames[1 : arc.edges], at_vertices)),
    }


def integral_errors(smooth: SmoothCurve, t: np.ndarray) -> Errors:
    """Of closed curves; the torsion of Viviani's vanishes by symmetry, also the discrete one."""
    arc, exact = smooth.polyline(t), smooth.data["values"]
    out = {
        "length": arc.length - exact["length"],
        "total curvature": arc.turning_angles.sum() - exact["total_curvature"],
        "square": arc.curvature() ** 2 @ arc.cell_lengths - exact["int_kappa2_ds"],
    }
    if smooth is not VIVIANI:
        out["total torsion"] = arc.dihedral_angles.sum() - exact["total_torsion"]
        out["writhe"] = arc.writhe() - exact["writhe"]
        turn = arc.holonomy() - exact["bishop_holonomy_mod_2pi"]
        out["holonomy"] = np.remainder(turn + np.pi, 2 * np.pi) - np.pi
    return {name: abs(e) for name, e in out.items()}


def all_errors(smooth: SmoothCurve, t: np.ndarray, size: Size = largest) -> Errors:
    out = vertex_errors(smooth, t, size) | edge_errors(smooth, t, size)
    out |= bishop_errors(smooth, t, size)
    return out | (integral_errors(smooth, t) if smooth.closed else {})


def assert_ratios(levels: list[Errors], low: float = 3.6, high: float = 4.4) -> None:
    for name in levels[0]:
        e = np.array([level[name] for level in levels])
        assert ((low < e[:-1] / e[1:]) & (e[:-1] / e[1:] < high)).all(), (name, e)


@pytest.mark.parametrize("smooth", SMOOTH, ids=repr)
def test_the_curves_are_those_of_the_reference_data(smooth: SmoothCurve) -> None:
    data, t = smooth.data, np.array(smooth.data["t"])
    kappa, tau, R = smooth.frenet(t)
    found = {"r": smooth.derivative(t), "kappa": kappa, "tau": tau, "s": smooth.arc_lengths(t)}
    found |= {name: R[..., k] for k, name in enumerate("NBT")}
    for name, values in found.items():
        assert differences(values, data[name]) < 1e-14, name
    np.testing.assert_allclose(smooth.parameters_at(np.array(data["s"])), t, rtol=0, atol=1e-12)


@pytest.mark.parametrize("by", ["parameter", "arc length"])
@pytest.mark.parametrize("smooth", SMOOTH, ids=repr)
def test_second_order_on_even_grids(smooth: SmoothCurve, by: str) -> None:
    assert_ratios([all_errors(smooth, smooth.even(n, by)) for n in (128, 256, 512)])


# Ends ---------------------------------------------------------------------------------------------


def end_errors(n: int, held: bool) -> Errors:
    t = CUBIC.even(n)
    arc = CUBIC.polyline(t) if held else curve.Polyline(CUBIC.derivative(t))
    kappa, tau, R = CUBIC.frenet(t[[0, -1]])
    return {
        "curvature": largest(arc.curvature()[[0, -1]] - kappa),
        "binormal": largest(arc.binormals[[0, -1]] - R[..., 1]),
        "torsion": largest(arc.torsion()[[0, -1]] / tau - (2 / 3 if held else 0)),
        "total torsion": arc.dihedral_angles.sum()
        - CUBIC.integral(lambda x: CUBIC.frenet(x)[1], t)[-1],
    }


def test_held_ends_are_first_order() -> None:
    """Half a cell is bent as at its quarter, and its binormal is that of a third of the edge: the
    two ends of the first edge stand at 1/3 and at 1, so that it sees two thirds of its torsion."""
    assert_ratios([end_errors(n, True) for n in (256, 512, 1024)], 1.9, 2.1)


def test_free_ends_are_neither_bent_nor_twisted() -> None:
    levels = [end_errors(n, False) for n in (256, 512, 1024)]
    kappa = CUBIC.frenet(np.array([-1.0, 1.0]))[0].max()
    assert [e.pop("torsion") for e in levels] == pytest.approx([0] * 3, abs=1e-14)
    assert [e.pop("curvature") for e in levels] == pytest.approx([kappa] * 3, rel=1e-14)
    assert_ratios(levels, 1.9, 2.1)


# Uneven grids -------------------------------------------------------------------------------------

SECOND = ("tangents", "centres", "arc length", "Bishop, edges", "Bishop, vertices")
INTEGRALS = ("length", "total curvature", "square", "total torsion", "holonomy", "writhe")
FIRST = ("kappa", "kappa b", "binormals", "vertex frames", "edge frames")
EXPECTED = dict.fromkeys((*SECOND, *INTEGRALS), 2) | dict.fromkeys(FIRST, 1) | {"tau": 0}


def expected_order(smooth: SmoothCurve, name: str) -> int:
    """Constant curvature is of second order on any grid."""
    name = name.removesuffix(" log").removesuffix(" chord").removesuffix(" cayley")
    name = name.removesuffix(" sauer")
    return 2 if smooth is HELIX and name == "kappa" else EXPECTED[name]


def redrawn(smooth: SmoothCurve, n: int) -> Errors:
    """Means over grids drawn anew; root mean squares, since the largest of more random numbers
    would be larger."""
    rng = np.random.default_rng(n)
    draws = [all_errors(smooth, smooth.uneven(n, rng), typical) for _ in range(4)]
    return {name: typical(np.array([e[name] for e in draws])) for name in draws[0]}


def bisected(smooth: SmoothCurve, n: int) -> Errors:
    t = smooth.uneven(64, np.random.default_rng(2))
    while len(t) <= n:
        t = np.sort(np.append(t, (t[1:] + t[:-1]) / 2))
    return all_errors(smooth, t)


@pytest.mark.parametrize("smooth", SMOOTH, ids=repr)
@pytest.mark.parametrize("refined", [redrawn, bisected])
def test_orders_on_uneven_grids(
    smooth: SmoothCurve, refined: Callable[[SmoothCurve, int], Errors]
) -> None:
    """Bisected in the parameter, most vertices get equal neighbours, but the first ones never."""
    coarse, fine = refined(smooth, 512), refined(smooth, 2048)
    for name in coarse:
        order = orders([coarse[name], fine[name]], 4.0)[0]
        assert abs(order - expected_order(smooth, name)) < 0.15, (name, order)


@pytest.mark.parametrize("smooth", KNOTS, ids=repr)
def test_dihedral_angles_on_uneven_grids_count_three_edges(smooth: SmoothCurve) -> None:
    """The limit of the angle is torsion times the mean of three lengths, so alpha/length has none
    where the lengths stay different; in the mean of three it is first order."""
    e = []
    for n in (256, 512, 1024, 2048):
        t = smooth.uneven(n, np.random.default_rng(n))
        arc = smooth.polyline(t)
        h, tau = arc.edge_lengths, smooth.frenet((t[1:] + t[:-1]) / 2)[1]
        e.append(largest(arc.dihedral_angles / ((np.roll(h, 1) + h + np.roll(h, -1)) / 3) - tau))
    assert abs(orders([e[0], e[-1]], 8.0)[0] - 1) < 0.25, e
