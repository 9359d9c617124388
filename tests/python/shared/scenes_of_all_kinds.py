"""Scenes with all that a scene may have, for property tests."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from hypothesis import assume
from hypothesis import strategies as st
from support import frames, vectors

import pyrod
from pyrod import Outline, Rod, Section

STEEL = {"E": "200 GPa", "density": "7850 kg/m^3"}
WIRE = {"circle": {"radius": "1 mm"}, "material": "steel"}


def document(**changes: Any) -> dict[str, Any]:
    """A clamped wire, with other keys on top."""
    return {
        "materials": {"steel": STEEL},
        "sections": {"wire": WIRE},
        "rods": [{"name": "wire", "length": "1 m", "edges": 8, "section": "wire"}],
        "supports": [{"kind": "clamp"}],
        **changes,
    }


POSITIVE = st.floats(0.01, 100.0)
DIRECTIONS = vectors().filter(lambda v: np.linalg.norm(v) > 0.1)
PARTS = st.floats(0.05, 0.95).map(lambda x: round(x, 3))

outlines = st.one_of(
    st.builds(Outline.circle, POSITIVE),
    st.builds(lambda r, part: Outline.tube(r, part * r), POSITIVE, PARTS),
    st.builds(Outline.rectangle, POSITIVE, POSITIVE),
    st.just(Outline.polygon([(0, 0), (0.1, 0), (0, 0.3)])),
    st.just(Outline.polygon([(-1, -1), (1, -1), (0, 1)], [(0, -0.1), (0.1, -0.1), (0, 0.1)])),
)
materials = st.builds(pyrod.Material, st.floats(1, 1e12), st.floats(-0.5, 0.5), st.floats(0, 1e4))


@st.composite
def sections(draw: Any) -> Section:
    """By stiffnesses, some infinite, with an outline or without; or by a shape and a material."""
    if draw(st.booleans()):
        return Section.circle(draw(POSITIVE), draw(materials))
    EI1, EI2, GJ = draw(st.tuples(POSITIVE, POSITIVE, POSITIVE))
    EA = draw(st.one_of(st.just(np.inf), POSITIVE))
    GA = st.just(np.inf) if np.isinf(EA) else st.one_of(st.just(np.inf), POSITIVE)
    GA1 = draw(GA)
    GA2 = np.inf if np.isinf(GA1) else draw(POSITIVE)
    mass = draw(st.floats(0, 10))
    return Section(EI1, EI2, GJ, GA1, GA2, EA, mass, outline=draw(st.none() | outlines))


def _straight(draw: Any) -> Rod:
    edges = draw(st.one_of(st.none(), st.integers(1, 9)))
    return Rod.straight(draw(POSITIVE), edges, draw(sections()))


def _bent(draw: Any) -> Rod:
    n = draw(st.integers(1, 6))
    length = draw(POSITIVE)
    curvature = np.array([draw(vectors()) for _ in range(n + 1)]) / length
    return Rod.precurved(length, n, draw(sections()), curvature)


def _uneven(draw: Any) -> Rod:
    h = draw(st.lists(st.floats(0.1, 0.3), min_size=2, max_size=5))
    many = [draw(sections()) for _ in h]
    return Rod.precurved(h, None, many, draw(vectors()))


def _free(draw: Any) -> Rod:
    length = draw(POSITIVE)
    return Rod.precurved(length, None, draw(sections()), draw(vectors()) / length)


def _curve(draw: Any) -> Rod:
    steps = [draw(vectors(0.2)) + np.eye(3)[0] for _ in range(3)]
    polyline = pyrod.curve.Polyline(np.cumsum([draw(vectors(3.0)), *steps], axis=0))
    return Rod.from_curve(polyline.positions, polyline.bishop().frames, draw(sections()))


def _arrays(draw: Any) -> Rod:
    rod = _uneven(draw)
    return replace(rod, bending=rod.bending * 1.1, mass_per_length=0.3)


def _tapered(draw: Any) -> Rod:
    """Functions of arc length, which jump: as their values, as in a pickle."""
    a, b = draw(sections()), draw(sections())
    rod = Rod.precurved(1.0, 4, lambda s: a if s < 0.5 else b, lambda s: (0, s, 0))
    return _with_values(rod.with_vertices(0.5))


def _with_values(rod: Rod) -> Rod:
    copy = object.__new__(Rod)
    copy.__setstate__(rod.__getstate__())
    return copy


@st.composite
def rods(draw: Any) -> Rod:
    """Made in every way, cut, placed, with another model."""
    makers = [_straight, _bent, _uneven, _free, _curve, _arrays, _tapered]
    rod = draw(st.sampled_from(makers))(draw)
    if draw(st.booleans()):
        rod = rod.with_vertices(draw(PARTS) * rod.length)
    if draw(st.booleans()):
        rod = replace(rod, model="inextensible")
    if draw(st.booleans()):
        rod = rod.placed(draw(vectors()), draw(frames()))
    return rod


def _supports(draw: Any, number: int, rod: Rod) -> list[Any]:
    """A clamp at the start, and maybe another support elsewhere."""
    at = draw(st.one_of(st.just("end"), PARTS.map(lambda part: part * rod.length)))
    at = (number, at) if number or draw(st.booleans()) else at
    position, frame = draw(st.none() | vectors()), draw(st.none() | frames())
    direction = draw(DIRECTIONS)
    other = draw(
        st.sampled_from(
            [
                pyrod.Clamp(position, frame, at=at, turns=draw(st.integers(-3, 3))),
                pyrod.Hinge(position, at=at),
                pyrod.Slider(direction, position=position, frame=frame, at=at),
                pyrod.Slider(normal=direction, clamped=draw(st.booleans()), at=at),
                pyrod.Sleeve(position, frame, at=at),
                pyrod.Pivot(direction, position, frame, at=at),
                pyrod.Pivot(direction, at=at, along=draw(DIRECTIONS)),
                pyrod.Spring(draw(POSITIVE), draw(st.floats(0, 2)), position, frame, at=at),
                None,
            ]
        )
    )
    first = pyrod.Clamp(draw(st.none() | vectors()), at=(number, "start"))
    return [first] if other is None else [first, other]


def _loads(draw: Any, number: int, rod: Rod) -> list[Any]:
    at, follower = (number, draw(PARTS) * rod.length), draw(st.booleans())
    return [
        pyrod.Force(draw(vectors()), at, follower),
        pyrod.Moment(draw(vectors()), (number, "end"), follower),
        pyrod.DistributedForce(draw(vectors()), number, follower),
        pyrod.PointMass(draw(POSITIVE), at, draw(st.none() | st.just((1.0, 2.0, 2.5)))),
    ]


def _along(draw: Any, number: int, rod: Rod) -> pyrod.DistributedMoment:
    """One value for each edge, of which there are as many as the scene makes."""
    first = draw(vectors())
    return pyrod.DistributedMoment(np.arange(rod.edges)[:, None] * first, number)


@st.composite
def scenes(draw: Any) -> pyrod.Scene:
    """One rod or two, with supports, loads and joints."""
    some = draw(st.lists(rods(), min_size=1, max_size=2))
    supports = [s for i, rod in enumerate(some) for s in _supports(draw, i, rod)]
    loads = [x for i, rod in enumerate(some) for x in _loads(draw, i, rod)]
    loads = draw(st.lists(st.sampled_from(loads), max_size=4))
    joints = _joints(draw, some) if len(some) > 1 else []
    try:
        cut = pyrod.Scene(some, supports, loads, "spatial", joints).rods
        loads += draw(st.just([]) | st.just([_along(draw, i, rod) for i, rod in enumerate(cut)]))
        if any(rod.mass_per_length.any() for rod in cut):
            loads += draw(st.just([]) | st.just([pyrod.Gravity(draw(vectors(10.0)))]))
        return pyrod.Scene(cut, supports, loads, "spatial", joints)
    except ValueError:  # held twice, or against the other supports
        assume(False)
        raise


def _joints(draw: Any, some: list[Rod]) -> list[pyrod.Joint]:
    kind = draw(st.sampled_from(["rigid", "hinge", "ball"]))
    points = [(i, round(0.97 * rod.length, 6)) for i, rod in enumerate(some)]
    return [
        pyrod.Joint(
            tuple(points),
            kind,
            draw(st.integers(-2, 2)) if kind == "rigid" else 0,
            draw(st.sampled_from([None, True, False])),
            draw(DIRECTIONS) if kind == "hinge" else None,
        )
    ]
