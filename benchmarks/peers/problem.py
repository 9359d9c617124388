"""A rod to solve: plain numbers, for solvers that know nothing of pyrod.

Conventions are those of tests/reference: frames R = (a1, a2, a3) as quaternions, scalar first, a3
along the rod; curvature K0 at rest in the components of the frame.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import inf
from typing import Any

import numpy as np

Array = np.ndarray
STIFFNESS = ("EI1", "EI2", "GJ", "GA1", "GA2", "EA")


@dataclass(frozen=True)
class Problem:
    """Clamped at s = 0. At s = L a dead force and moment act, or the pose (r, q) is given."""

    L: float
    K0: Array
    stiffness: dict[str, float]
    start: tuple[Array, Array]
    force: Array
    moment: Array
    pose: tuple[Array, Array] | None = None
    planar: bool = False
    ring: bool = False

    @property
    def bending(self) -> Array:
        return np.array([self.stiffness[k] for k in STIFFNESS[:3]])

    @property
    def stretching(self) -> Array:
        return np.array([self.stiffness[k] for k in STIFFNESS[3:]])

    def rest(self, s: Array) -> tuple[Array, Array]:
        """Positions and frames (as quaternions) at rest: a helix, as K0 is constant."""
        s = np.asarray(s, dtype=float)
        k = float(np.linalg.norm(self.K0))
        r, q = self.start
        axis = self.K0 / k if k else np.array([0.0, 0.0, 1.0])
        turns = np.hstack([np.cos(k * s / 2)[:, None], np.sin(k * s / 2)[:, None] * axis])
        e3 = np.array([0.0, 0.0, 1.0])
        along, across = axis * axis[2], np.cross(axis, e3)
        x = k * s[:, None]
        sine = s[:, None] * np.sinc(x / np.pi)
        cosine = s[:, None] * x / 2 * np.sinc(x / 2 / np.pi) ** 2
        local = s[:, None] * along + sine * (e3 - along) + cosine * across
        return r + local @ matrix(q).T, product(q, turns)

    def scaled(self) -> Problem:
        """The same in units of the length and of EI2/L²."""
        force = self.stiffness["EI2"] / self.L**2
        unit = dict.fromkeys(STIFFNESS[:3], force * self.L**2) | dict.fromkeys(STIFFNESS[3:], force)
        pose = None if self.pose is None else (self.pose[0] / self.L, self.pose[1])
        return replace(
            self,
            L=1.0,
            K0=self.K0 * self.L,
            stiffness={k: v / unit[k] for k, v in self.stiffness.items()},
            start=(self.start[0] / self.L, self.start[1]),
            force=self.force / force,
            moment=self.moment / (force * self.L),
            pose=pose,
        )


def from_reference(data: dict[str, Any]) -> Problem:
    """From the format of tests/reference."""
    end, start = data["bc"]["sL"], data["bc"]["s0"]
    held = end["type"] == "clamped"
    q = np.array(data["q"], dtype=float) if data.get("q") else None
    pose = None
    if held:  # q at the end as it is along the rod: its sign tells how often the rod turns
        pose = (np.array(end["r"], dtype=float), np.array(end["q"] if q is None else q[-1]))
    zero = np.zeros(3)
    return Problem(
        L=float(data["L"]),
        K0=np.array(data["K0"], dtype=float),
        stiffness={
            k: inf if data["stiffness"][k] is None else float(data["stiffness"][k])
            for k in STIFFNESS
        },
        start=(np.array(start["r"], dtype=float), np.array(start["q"], dtype=float)),
        force=zero if held else np.array(end["n"], dtype=float),
        moment=zero if held else np.array(end["m"], dtype=float),
        pose=pose,
        planar=bool(data["planar"]),
        ring=data["id"].startswith("S7_ring"),
    )


def product(p: Array, q: Array) -> Array:
    """Hamilton product of quaternions along the last axis."""
    a, b = np.moveaxis(np.asarray(p), -1, 0), np.moveaxis(np.asarray(q), -1, 0)
    return np.stack(
        [
            a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
            a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
            a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
            a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0],
        ],
        axis=-1,
    )


def conjugate(q: Array) -> Array:
    return np.asarray(q) * np.array([1.0, -1.0, -1.0, -1.0])


def matrix(q: Array) -> Array:
    """Rotation matrices (..., 3, 3), the directors as columns."""
    q = np.asarray(q, dtype=float)
    columns = [product(product(q, np.array([0.0, *e])), conjugate(q))[..., 1:] for e in np.eye(3)]
    return np.stack(columns, axis=-1)


def rotation_vector(q: Array) -> Array:
    """Of a quaternion; its sign counts, so that angles reach 2π."""
    size = float(np.linalg.norm(q[1:]))
    return np.zeros(3) if size == 0 else 2 * np.arctan2(size, q[0]) * q[1:] / size


def turned(q: Array, vector: Array) -> Array:
    """q turned by a rotation vector in its own components."""
    angle = float(np.linalg.norm(vector))
    half = np.hstack([np.cos(angle / 2), np.sinc(angle / 2 / np.pi) * np.asarray(vector) / 2])
    return product(q, half)
