"""How far the invariants of polylines are from those of the smooth curves they are taken from."""

from __future__ import annotations

import numpy as np

from gallery.known import Known
from pyrod.curve import FramedCurve, Polyline
from pyrod.rotation import to_matrix

Array = np.ndarray
EDGES = (64, 128, 256, 512, 1024)
UNIFORM = (None,)
RANDOM = (1, 2, 3, 4, 5)  # seeds of the random grids; errors are geometric means over them
PI2 = 2 * np.pi
LABELS = {
    "length": "length",
    "tangents": "edge tangents",
    "curvature": "κ = θ/Δς at the vertex",
    "curvature, place": "κ at the mean of the three vertices",
    "torsion": "τ = α/ℓ at the edge",
    "torsion, place": "α/(mean of three ℓ) at the mean of four vertices",
    "Frenet": "Frenet frames of the edges",
    "Bishop": "Bishop frames of the edges",
    "holonomy": "holonomy",
    "writhe": "writhe",
}


def whole_turns(x: float) -> float:
    """The angle without whole turns."""
    return abs((x + np.pi) % PI2 - np.pi)


def angle(found: Array, exact: Array) -> float:
    """Largest angle [rad] between frames that are near to each other."""
    return float(np.linalg.norm(found - exact, axis=(1, 2)).max() / np.sqrt(2))


def largest(found: Array, exact: Array, scale: Array) -> float:
    return float(np.abs(found - exact).max() / np.abs(scale).max())


def local_errors(known: Known, t: Array, p: Polyline) -> dict[str, float]:
    """Of curvature and torsion away from the ends, relative to the largest of the curve."""
    last = p.edges  # inner vertices are 1 ... n - 1 also of a closed arc, which is cut at 0
    inner = slice(1, last)
    kappa, alpha = p.curvature()[inner], p.dihedral_angles[1:-1]
    three = (t[2:] + t[1:-1] + t[:-2]) / 3
    four = (t[3:] + t[2:-1] + t[1:-2] + t[:-3]) / 4
    centre = (t[1:] + t[:-1])[1:-1] / 2
    h = p.edge_lengths
    mean = (h[2:] + h[1:-1] + h[:-2]) / 3
    K, T = known.curvature, known.torsion
    return {
        "curvature": largest(kappa, K(t[inner]), K(t)),
        "curvature, place": largest(kappa, K(three), K(t)),
        "torsion": largest(p.torsion()[1:-1], T(centre), T(t)),
        "torsion, place": largest(alpha / mean, T(four), T(t)),
    }


def frame_errors(known: Known, t: Array, p: Polyline) -> dict[str, float]:
    """Of directions and frames [rad] at the middle of each interval of the parameter."""
    centre = (t[1:] + t[:-1]) / 2
    frenet, bishop = known.frenet(centre), known.bishop(t[0], centre)
    found = p.bishop(normal=bishop[0, :, 0]) if p.closed else p.bishop(frame=known.frame(t[0]))
    return {
        "tangents": float(np.linalg.norm(p.tangents - frenet[..., 2], axis=1).max()),
        "Frenet": angle(p.frenet().matrices[1:-1], frenet[1:-1]),
        "Bishop": angle(found.matrices, bishop),
    }


def errors(known: Known, n: int, seed: int | None = None) -> dict[str, float]:
    """Largest errors of all invariants on n edges."""
    t = known.parameters(n, seed)
    p = known.polyline(t)
    length = known.length()
    out = {"length": abs(p.length - length) / length}
    out |= local_errors(known, t, p) | frame_errors(known, t, p)
    if known.closed:
        out["holonomy"] = whole_turns(p.holonomy() + known.length(known.torsion))
    if known.writhe is not None:
        out["writhe"] = abs(p.writhe() - known.writhe)
    return out


def averaged(known: Known, n: int, seeds: tuple[int | None, ...]) -> dict[str, float]:
    """Geometric means over several grids."""
    each = [errors(known, n, seed) for seed in seeds]
    return {key: float(np.exp(np.mean([np.log(e[key]) for e in each]))) for key in each[0]}


def order(coarse: float, fine: float, ratio: float) -> float:
    return float(np.log(coarse / fine) / np.log(ratio))


def given_curvature(known: Known, t: Array) -> tuple[Array, Array]:
    """Exact lengths of the intervals, and K at the vertices in Bishop frames."""
    h = known.integral(np.ones_like, t)
    beta = np.concatenate([[0.0], np.cumsum(known.integral(known.torsion, t))])
    return h, known.curvature(t)[:, None] * np.stack(
        [-np.sin(beta), np.cos(beta), np.zeros_like(beta)], axis=1
    )


def rebuilt(known: Known, n: int, seed: int | None = None) -> tuple[Array, FramedCurve]:
    """Parameters, and the curve made of its curvature at these and nothing else but its start."""
    t = known.parameters(n, seed)
    start = known.position(t[:1])[0]
    return t, FramedCurve.from_strains(
        *given_curvature(known, t), position=start, frame=known.frame(t[0])
    )


def rebuilding_errors(known: Known, n: int, seed: int | None = None) -> tuple[float, float]:
    """Of positions, relative to the length, and of frames [rad]."""
    t, curve = rebuilt(known, n, seed)
    r = np.linalg.norm(curve.polyline.positions - known.position(t), axis=1)
    exact = known.bishop(t[0], (t[1:] + t[:-1]) / 2)
    return float(r.max() / known.length()), angle(to_matrix(curve.frames), exact)
