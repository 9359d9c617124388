"""Frames turned about the tangents, and ribbons, whose frames are adapted: links and edges."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

import pyrod._core as _core
from pyrod.base.arrays import Array, array, number
from pyrod.curve._arc import require_closed
from pyrod.curve._framed import FramedCurve
from pyrod.curve._knots import nearest_whole
from pyrod.curve._polyline import Polyline
from pyrod.rotation import rotate


def link(ribbon: FramedCurve, threads: int = 0) -> int:
    """Linking number of a closed ribbon, twist plus writhe (Calugareanu, White, Fuller).
    O(n^2).

    The frames must be adapted: the twist is that about the edges.
    """
    require_closed(ribbon.polyline, "link")
    away = np.abs(rotate(ribbon.frames, [0.0, 0.0, 1.0]) - ribbon.polyline.tangents).max(axis=1)
    worst = int(np.argmax(away))
    if away[worst] > 1e-9:
        raise ValueError(
            f"frames[{worst}]: a3 is not along the edge; take adapted(), whose frames are"
        )
    return nearest_whole(ribbon.twist + ribbon.polyline.writhe(threads))


def edge(ribbon: FramedCurve, distance: float, threads: int = 0) -> Polyline:
    """The edge of the ribbon: each vertex moved by ``distance`` along a1 of its frame.

    It winds around a closed curve as often as `link` says if it stays near enough, and on the side
    to which the edges' a1 point: not where more than a right angle of a corner's turn belongs to
    the longer of its edges. O(n^2).

    Parameters
    ----------
    ribbon : `FramedCurve`
    distance : float [m]
    threads : int
        Default 0: as many as the machine has cores.

    Raises
    ------
    ValueError
        It is beyond half the `Polyline.self_approach`, where it could pass through another part of
        the curve.
    """
    distance = number(distance, "distance")
    nearest = ribbon.polyline.self_approach(threads)
    if not 0 < abs(distance) < nearest.distance / 2:
        raise ValueError(
            f"distance: must be less than {nearest.distance / 2:.3g}, half that of the edges "
            f"{nearest.edge} and {nearest.other}, and not 0; got {distance}"
        )
    a1 = rotate(ribbon.vertex_frames, np.array([1.0, 0.0, 0.0]))
    return Polyline(ribbon.polyline.positions + distance * a1, ribbon.polyline.closed)


def turned(curve: FramedCurve, angles: ArrayLike) -> FramedCurve:
    """Every frame turned about its a3 by an angle [rad], one for all or (n,)."""
    n = len(curve.frames)
    phi = array(angles, "angles")
    if phi.shape not in ((), (n,)):
        raise ValueError(f"angles: expected one or {n}, one per edge, got shape {phi.shape}")
    phi = np.array(np.broadcast_to(phi, n))
    ends = {}
    for name, angle in (("start_frame", phi[:1]), ("end_frame", phi[-1:])):
        frame = getattr(curve, name)
        if frame is not None:
            ends[name] = _core.curve.turned_about_tangents(frame[None], angle)[0]
    frames = _core.curve.turned_about_tangents(curve.frames, phi)
    return FramedCurve(curve.polyline, frames, curve.edge_lengths, **ends)


def adapted(curve: FramedCurve, limit: float = 0.5) -> FramedCurve:
    """Every frame turned the least way that brings a3 into the tangent: a ribbon.

    Raises ``ValueError`` where a3 is farther than ``limit`` [rad] from the tangent.
    """
    p, limit = curve.polyline, number(limit, "limit")
    if not limit >= 0:
        raise ValueError(f"limit: must be an angle, not negative, got {limit}")
    ends = {}
    for name, tangent in (("start_frame", p.start_tangent), ("end_frame", p.end_tangent)):
        frame = getattr(curve, name)
        if frame is not None and tangent is not None:
            frame = _core.curve.adapted(frame[None], tangent[None], limit)[0]
        ends[name] = frame
    frames = _core.curve.adapted(curve.frames, p.tangents, limit)
    return FramedCurve(p, frames, curve.edge_lengths, **ends)


def angles_from(curve: FramedCurve, other: FramedCurve) -> Array:
    """(n,) angles [rad] that turn the other frames about their tangents into these.

    For two framings of one curve that are both adapted; continued along it. The inverse of
    `turned`.
    """
    if not isinstance(other, FramedCurve):
        raise TypeError(f"other: expected a FramedCurve, got a {type(other).__name__}")
    return _core.curve.angles_about_tangents(other.frames, curve.frames)
