"""Rods that are longer than the way over their supports, regular and random ones."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product

import numpy as np

from pyrod import (
    Clamp,
    DistributedForce,
    Force,
    Hinge,
    Joint,
    Pivot,
    Rod,
    Scene,
    Section,
    Sleeve,
    Slider,
    Spring,
)

Array = np.ndarray
Z = np.array([0.0, 0.0, 1.0])
INNER = ("hinge", "clamp", "sleeve", "pivot", "slider", "spring")


def regular_scenes() -> Iterator[tuple[str, Scene, float | None]]:
    """64 scenes with one inner support: their names, themselves, and the tolerance."""
    for space, d, at, kind, n in product(
        ("planar", "spatial"), (0.9, 0.8, 0.6, 0.4), (0.5, 0.37), (Hinge, Clamp), (64, None)
    ):
        rod = Rod.straight(1.0, n, Section(1, 1, 0.7))
        held = [Clamp(), kind((0, 0, at * d), at=at), Clamp((0, 0, d), at="end")]
        name = f"{space}, d={d}, {kind.__name__} at {at}, n={n}"
        yield name, Scene(rod, held, [], space), None if n else 1e-6


class _Draw:
    """A random scene of one rod; its spans are about as long as EI and forces are large: 1."""

    def __init__(self, seed: int) -> None:
        self.rng = np.random.default_rng(seed)
        self.inner = int(self.rng.integers(1, 13))
        self.planar = bool(self.rng.random() < 0.4)
        self.lengths = self.rng.uniform(0.5, 1.5, self.inner + 1)
        self.s = np.concatenate([[0.0], np.cumsum(self.lengths)])
        self.space = "planar" if self.planar else "spatial"

    def scene(self) -> tuple[str, Scene, float | None]:
        rng = self.rng
        rod = self._rod()
        points, chords = self._points()
        held = [Clamp()]
        kinds = rng.choice(INNER, self.inner)
        for i, kind in enumerate(kinds, 1):
            held.append(self._support(kind, i, points[i], chords[i - 1] + chords[i]))
        end = rng.choice(("clamp", "clamp", "hinge", "sleeve", "slider", "free"))
        if end != "free":
            held.append(self._support(end, self.inner + 1, points[-1], chords[-1]))
        tol = float(rng.choice([1e-4, 1e-6])) if rng.random() < 0.25 else None
        name = f"{self.space}, {'-'.join(kinds)}-{end}, n={rod.edges}, tol={tol}"
        return name, Scene(rod, held, self._loads(), self.space), tol

    def _rod(self) -> Rod:
        rng = self.rng
        least = 6 * (self.inner + 1)
        n = int(max(least, round(2 ** rng.uniform(4, 9))))
        EI1 = 1.0 if rng.random() < 0.5 else float(rng.uniform(0.3, 3))
        stretch = [{}, {"EA": 1e4}, {"EA": 300.0, "GA1": 200.0, "GA2": 250.0}][rng.integers(3)]
        section = Section(EI1, 1.0, float(rng.uniform(0.5, 1.2)), **stretch)
        if rng.random() < 0.6:
            return Rod.straight(self.s[-1], n, section)
        K = rng.normal(size=3) * rng.choice([0.1, 0.5, 2.0])
        if self.planar:
            K[[0, 2]] = 0
        return Rod.precurved(self.s[-1], n, section, K)

    def _points(self) -> tuple[Array, Array]:
        """Where the rod is held, and the directions between."""
        rng = self.rng
        slack = rng.uniform(0, 0.7) * rng.choice([1.0, 1.0, 0.3])
        slacks = slack * (1 if rng.random() < 0.3 else rng.uniform(0.3, 1.0, len(self.lengths)))
        bend = rng.choice([0.0, 0.05, 0.3])
        chords = np.tile(Z, (len(self.lengths), 1))
        chords = chords + bend * np.cumsum(self._across(len(self.lengths)), axis=0)
        chords /= np.linalg.norm(chords, axis=1)[:, None]
        steps = chords * (self.lengths * (1 - np.maximum(slacks, 0.005)))[:, None]
        return np.concatenate([[np.zeros(3)], np.cumsum(steps, axis=0)]), chords

    def _across(self, count: int) -> Array:
        a = self.rng.normal(size=(count, 3))
        a[:, 2] = 0
        if self.planar:
            a[:, 1] = 0
        return a

    def _support(self, kind: str, i: int, r: Array, along: Array):
        rng = self.rng
        at = "end" if i == self.inner + 1 else float(self.s[i])
        t = along / np.linalg.norm(along) + rng.choice([0.0, 0.2]) * self._across(1)[0]
        normal = (0.0, -1.0, 0.0) if self.planar else rng.choice([0.0, 0.3]) * self._across(1)[0]
        # a1 in the plane of a planar scene
        normal = np.cross((0, 1, 0), t) if self.planar else np.array([1.0, 0, 0]) + normal
        if kind == "hinge":
            return Hinge(r, at=at)
        if kind == "clamp":
            turns = int(rng.choice([0, 0, 0, 0, 1, -1])) if not self.planar else 0
            return Clamp(r, tangent=t, normal=normal, at=at, turns=turns)
        if kind == "sleeve":
            return Sleeve(r, tangent=t, normal=normal, at=at)
        if kind == "pivot":
            axis = (0, 1, 0) if self.planar else np.cross(t, rng.normal(size=3))
            return Pivot(axis, r, Clamp(tangent=t, normal=normal).frame, at=at)
        if kind == "slider":
            return Slider(t, position=r, at=at)
        return Spring(float(10 ** rng.uniform(1, 3)), position=r, at=at)

    def _loads(self) -> list:
        rng, loads = self.rng, []
        if rng.random() < 0.4:
            loads.append(DistributedForce(self._force(10 ** rng.uniform(-1, 1.5))))
        for _ in range(int(rng.choice([0, 0, 1, 3]))):
            at = float(rng.uniform(0, self.s[-1]))
            loads.append(Force(self._force(10 ** rng.uniform(-1, 1)), at=at))
        return loads

    def _force(self, size: float) -> Array:
        f = self.rng.normal(size=3) * (1, 0 if self.planar else 1, 0.3)
        return size * f / np.linalg.norm(f)


def random_scene(seed: int) -> tuple[str, Scene, float | None]:
    """A random rod over 1 to 12 inner supports: its name, itself, and the tolerance."""
    return _Draw(seed).scene()


def random_frame(seed: int) -> tuple[str, Scene, float | None]:
    """A random tree or a portal frame, with ends held nearer or farther than at rest."""
    rng = np.random.default_rng(seed)
    planar = bool(rng.random() < 0.5)
    return (_portal if rng.random() < 0.5 else _tree)(rng, "planar" if planar else "spatial")


def _portal(rng: np.random.Generator, space: str) -> tuple[str, Scene, float | None]:
    """Columns and beams of several bays and storeys, joined rigidly, pushed and weighed down."""
    bays, storeys = int(rng.integers(1, 4)), int(rng.integers(1, 4))
    n = int(rng.integers(8, 65))
    section = Section(1.0, 1.0 if rng.random() < 0.5 else 1.6, 0.8, EA=1e4)
    rods, ends = [], {}
    for i, k in product(range(bays + 1), range(storeys)):
        ends.setdefault((i, k), []).append((len(rods), "start"))
        ends.setdefault((i, k + 1), []).append((len(rods), "end"))
        rods.append(Rod.straight(1.0, n, section).placed((i, 0, k), tangent=Z, normal=(1, 0, 0)))
    for i, k in product(range(bays), range(1, storeys + 1)):
        ends[i, k].append((len(rods), "start"))
        ends[i + 1, k].append((len(rods), "end"))
        rods.append(Rod.straight(1.0, n, section).placed((i, 0, k), tangent=(1, 0, 0), normal=-Z))
    held = [
        (Clamp if rng.random() < 0.7 or i == 0 else Hinge)(at=ends[i, 0][0])
        for i in range(bays + 1)
    ]
    kind = rng.choice(["rigid", "rigid", "ball"]) if storeys == 1 and bays == 1 else "rigid"
    joints = [Joint(tuple(p), kind) for (_, k), p in ends.items() if k > 0]
    size = 10 ** rng.uniform(-1, 1.2) / storeys
    side = rng.normal(size=3) * (1, space == "spatial", 0.2)
    loads = [
        Force(size * side, at=(0, "end")),
        Force((0, 0, -size), at=(len(rods) - 1, 0.5)),
    ]
    return f"portal {bays}x{storeys}, {space}, n={n}", Scene(rods, held, loads, space, joints), None


def _tree(rng: np.random.Generator, space: str) -> tuple[str, Scene, float | None]:
    """A trunk with branches, some of whose tips are held elsewhere than at rest."""
    n = int(rng.integers(12, 65))
    planar = space == "planar"
    section = Section(1.0, 1.0 if rng.random() < 0.5 else 1.5, 0.8)
    rods = [Rod.straight(1.0, n, section)]
    tips = [(np.array([0, 0, 1.0]), Z)]
    depth = [1]
    joints, loads = [], []
    held = [Clamp()]
    for i in range(1, int(rng.integers(2, 7))):
        parent = int(rng.integers(0, i))
        r, t = tips[parent]
        t = t + 0.7 * rng.normal(size=3) * (1, not planar, 1)
        t /= np.linalg.norm(t)
        normal = np.cross((0, 1, 0), t) if planar else np.cross(t, rng.normal(size=3))
        rods.append(Rod.straight(1.0, n, section).placed(r, tangent=t, normal=normal))
        tips.append((r + t, t))
        depth.append(depth[parent] + 1)
        joints.append((parent, i))
    groups: dict[int, list] = {}
    for parent, i in joints:
        groups.setdefault(parent, [(parent, "end")]).append((i, "start"))
    for i, (r, t) in enumerate(tips):
        if i in groups:
            continue
        fate = rng.random()
        if fate < 0.35:  # drawn towards its start, and aside
            aside = 0.2 * rng.normal(size=3) * (1, not planar, 1)
            r = r - rng.uniform(0.05, 0.6) * t + aside
            held.append(Hinge(r * min(1, 0.95 * depth[i] / np.linalg.norm(r)), at=(i, "end")))
        elif fate < 0.6:
            loads.append(
                Force(
                    10 ** rng.uniform(-1, 1) * rng.normal(size=3) * (1, not planar, 1),
                    at=(i, "end"),
                )
            )
    kinds = [
        Joint(
            tuple(p),
            rng.choice(["rigid", "rigid", "ball"])
            if len(p) == 2 and any(s.at == (p[1][0], "end") for s in held[1:])
            else "rigid",
        )
        for p in groups.values()
    ]
    if rng.random() < 0.5:
        loads.append(DistributedForce((0, 0, -(10 ** rng.uniform(-1, 1)))))
    return f"tree of {len(rods)}, {space}, n={n}", Scene(rods, held, loads, space, kinds), None
