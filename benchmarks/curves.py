"""What the geometry of polylines costs from Python: nanoseconds per vertex, medians of one run.

Every stage gets a new object, because objects keep what they have computed.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from statistics import median
from typing import Any

import numpy as np

from pyrod.curve import FramedCurve, Polyline

SIZES = {10_000: 41, 100_000: 15, 1_000_000: 7}  # vertices: repeats
PAIRS = 5000
WRITHE = -3.51823923103886  # of the smooth trefoil
LINK = -6  # of its Frenet ribbon


def trefoil(n: int) -> np.ndarray:
    t = 2 * np.pi * np.arange(n) / n
    r = 2 + np.cos(3 * t)
    return np.stack([r * np.cos(2 * t), r * np.sin(2 * t), np.sin(3 * t)], axis=1)


def seconds(new: Callable[[], Any], stage: Callable[[Any], object], repeats: int) -> float:
    """Median time of the stage on a new object each; making that does not count."""
    times = []
    for _ in range(repeats):
        thing = new()
        began = time.perf_counter()
        stage(thing)
        times.append(time.perf_counter() - began)
    return median(times)


def everything(r: np.ndarray) -> None:
    p = Polyline(r, closed=True)
    bishop, frenet = p.bishop(), p.frenet()
    p.curvature(), p.torsion(), p.tangents
    for framed in (bishop, frenet):
        framed.K, framed.Gamma, framed.twist  # noqa: B018


def stages(r: np.ndarray) -> dict[str, tuple[Callable[[], Any], Callable[[Any], object]]]:
    """Name: what it starts from, and what it does."""
    frames = Polyline(r, closed=True).bishop().frames

    def polyline() -> Polyline:
        return Polyline(r, closed=True)

    def with_binormals() -> Polyline:
        p = polyline()
        p.binormals  # noqa: B018
        return p

    def with_torsion() -> Polyline:
        p = with_binormals()
        p.torsion()
        return p

    def framed() -> FramedCurve:
        return FramedCurve(polyline(), frames)

    return {
        "copy of the input, NumPy": (lambda: r, np.copy),
        "polyline, with checks": (lambda: r, lambda r: Polyline(r, closed=True)),
        "lengths and tangents": (polyline, lambda p: (p.edge_lengths, p.tangents)),
        "curvature": (polyline, Polyline.curvature),
        "binormals": (polyline, lambda p: p.binormals),
        "torsion from these": (with_binormals, Polyline.torsion),
        "Frenet frames, checked": (with_torsion, Polyline.frenet),
        "Bishop frames, checked": (polyline, Polyline.bishop),
        "given frames, checks and twist": (polyline, lambda p: FramedCurve(p, frames).twist),
        "strains": (framed, lambda c: (c.K, c.Gamma)),
        "vertex frames": (framed, lambda c: c.vertex_frames),
        "everything": (lambda: r, everything),
    }


def per_vertex() -> None:
    curves = {n: stages(trefoil(n)) for n in SIZES}
    print("ns per vertex" + " " * 20 + "".join(f"{f'n = {n:.0e}':>12s}" for n in SIZES))
    for name in curves[next(iter(SIZES))]:
        times = [1e9 / n * seconds(*curves[n][name], SIZES[n]) for n in SIZES]
        print(f"{name:33s}" + "".join(f"{t:12.1f}" for t in times))


def pairs() -> None:
    """What takes all pairs of edges."""
    p = Polyline(trefoil(PAIRS), closed=True)
    count = PAIRS * (PAIRS - 3) / 2
    print(f"\nn = {PAIRS}            1 thread   2 threads   ns per pair on one")
    for name, stage in (("writhe", p.writhe), ("self_approach", p.self_approach)):
        one, two = (seconds(lambda k=k: k, stage, 7) for k in (1, 2))
        print(f"{name:14s} {1e3 * one:9.1f} ms {1e3 * two:8.1f} ms {1e9 * one / count:12.2f}")
    writhe = p.writhe()
    turns = p.dihedral_angles.sum() / (2 * np.pi)
    print(f"writhe: {writhe:.12f}, off the smooth curve's by {writhe - WRITHE:.1e}")
    print(f"writhe + total torsion / 2 pi: off {LINK} by {abs(writhe + turns - LINK):.1e}")


if __name__ == "__main__":
    per_vertex()
    pairs()
