"""What a scene consists of in a document: the one table that reading and writing go by."""

from __future__ import annotations

from typing import NamedTuple, get_args

from pyrod._core import Options
from pyrod.base.immutable import Array
from pyrod.document import units as u
from pyrod.document.tables import REQUIRED, Form, Key, Listed, Named, OneOf, OneOrEach
from pyrod.document.types import (
    FLAG,
    TEXT,
    Name,
    Number,
    Numbers,
    PlaceOnRod,
    RodNumber,
    Type,
    Words,
    vector_in,
    whole_number,
)
from pyrod.rod.outline import Outline
from pyrod.rod.section import Material, Model, Section
from pyrod.scene.actuators import Tendon
from pyrod.scene.joints import Joint
from pyrod.scene.loads import (
    DistributedForce,
    DistributedMoment,
    Force,
    Gravity,
    Moment,
    PointMass,
)
from pyrod.scene.scene import Scene, Space
from pyrod.scene.supports import Clamp, Hinge, Pivot, Sleeve, Slider, Spring

MOST_EDGES = 10**6
"""Of one rod in a document: a slip of the hand must not fill the memory."""

_AT = PlaceOnRod()
_POINT = vector_in(u.LENGTH)
_DIRECTION = vector_in(u.NONE)
_FRAME = Numbers(u.NONE, ((4,), (3, 3)))
_PLACED = {"position": _POINT, "frame": _FRAME}
_TURNED = {**_PLACED, "tangent": _DIRECTION, "normal": _DIRECTION}
_EACH = ((None, 3),)
_ALONG = ((3,), (None, 3))
_LENGTHS = Numbers(u.LENGTH, ((None,),))

MATERIAL = Form.of(
    "material", Material, E=Number(u.PRESSURE), nu=Number(u.NONE), density=Number(u.DENSITY)
)

_length, _corners = Number(u.LENGTH), Numbers(u.LENGTH, ((None, 2),))
SHAPES = {
    "circle": Form.of("circle", Outline.circle, radius=_length),
    "tube": Form.of("tube", Outline.tube, outer_radius=_length, inner_radius=_length),
    "rectangle": Form.of("rectangle", Outline.rectangle, width=_length, height=_length),
    "polygon": Form.of("polygon", Outline.polygon, points=_corners, hole=_corners),
}
OUTLINE = Form("outline", dict, {name: Key(shape) for name, shape in SHAPES.items()})
STIFFNESSES = Form.of(
    "section",
    Section,
    EI1=Number(u.BENDING_STIFFNESS),
    EI2=Number(u.BENDING_STIFFNESS),
    GJ=Number(u.BENDING_STIFFNESS),
    GA1=Number(u.FORCE),
    GA2=Number(u.FORCE),
    EA=Number(u.FORCE),
    mass_per_length=Number(u.MASS_PER_LENGTH),
)
SECTION = Form(
    "section",
    Section,
    {
        "material": Key(Name("materials")),
        **OUTLINE.keys,
        **{name: Key(key.type) for name, key in STIFFNESSES.keys.items()},
    },
)


class Jump(NamedTuple):
    """What jumps at an inner vertex of a rod, just before and just behind it."""

    vertex: int
    bending: Array  #: (2, 3)
    K0: Array  #: (2, 3)


JUMP = Form.of(
    "jump",
    Jump,
    vertex=whole_number(1),
    bending=Numbers(u.BENDING_STIFFNESS, ((2, 3),)),
    K0=Numbers(u.CURVATURE, ((2, 3),)),
)
ROD = Form(
    "rod",
    dict,
    {
        "name": Key(TEXT),
        "section": Key(Name("sections", many=True)),
        "length": Key(Number(u.LENGTH)),
        "edges": Key(whole_number(1, MOST_EDGES)),
        "edge_lengths": Key(_LENGTHS),
        "curvature": Key(Numbers(u.CURVATURE, _ALONG)),
        "model": Key(Words(get_args(Model))),
        "position": Key(_POINT),
        "frame": Key(_FRAME),
        "tangent": Key(_DIRECTION),
        "normal": Key(_DIRECTION),
        "vertices": Key(_LENGTHS),
        "positions": Key(Numbers(u.LENGTH, _EACH)),
        "frames": Key(Numbers(u.NONE, ((None, 4), (None, 3, 3)))),
        "bending": Key(Numbers(u.BENDING_STIFFNESS, _EACH)),
        "stretching": Key(Numbers(u.FORCE, _EACH)),
        "K0": Key(Numbers(u.CURVATURE, _EACH)),
        "mass_per_length": Key(Numbers(u.MASS_PER_LENGTH, ((None,),))),
        "outlines": Key(OneOrEach(OUTLINE)),
        "jumps": Key(Listed(JUMP)),
        "corners": Key(FLAG),
        "grid": Key(_LENGTHS),
    },
)

SUPPORTS = OneOf(
    "support",
    {
        "clamp": Form.of("clamp", Clamp, at=_AT, **_TURNED, turns=whole_number()),
        "hinge": Form.of("hinge", Hinge, at=_AT, position=_POINT),
        "slider": Form.of(
            "slider",
            Slider,
            at=_AT,
            along=_DIRECTION,
            normal=_DIRECTION,
            **_PLACED,
            clamped=FLAG,
        ),
        "sleeve": Form.of("sleeve", Sleeve, at=_AT, **_TURNED),
        "pivot": Form.of("pivot", Pivot, at=_AT, axis=_DIRECTION, **_PLACED, along=_DIRECTION),
        "spring": Form.of(
            "spring",
            Spring,
            at=_AT,
            stiffness=Number(u.FORCE_PER_LENGTH),
            torsion=Number(u.MOMENT),
            **_PLACED,
        ),
    },
)

_along: dict[str, Type] = {"rod": RodNumber(), "follower": FLAG}
LOADS = OneOf(
    "load",
    {
        "force": Form.of("force", Force, force=vector_in(u.FORCE), at=_AT, follower=FLAG),
        "moment": Form.of("moment", Moment, moment=vector_in(u.MOMENT), at=_AT, follower=FLAG),
        "distributed_force": Form.of(
            "distributed force",
            DistributedForce,
            force_per_length=Numbers(u.FORCE_PER_LENGTH, _ALONG),
            **_along,
        ),
        "distributed_moment": Form.of(
            "distributed moment",
            DistributedMoment,
            moment_per_length=Numbers(u.FORCE, _ALONG),
            **_along,
        ),
        "gravity": Form.of("gravity", Gravity, acceleration=vector_in(u.ACCELERATION)),
        "point_mass": Form.of(
            "point mass",
            PointMass,
            mass=Number(u.MASS),
            at=_AT,
            inertia=Numbers(u.MOMENT_OF_INERTIA, ((3,), (3, 3))),
        ),
    },
)

JOINT = Form.of(
    "joint",
    Joint,
    points=Listed(_AT, 2),
    kind=Words(("rigid", "hinge", "ball")),
    turns=whole_number(),
    aligned=FLAG,
    axis=_DIRECTION,
)

ACTUATORS = OneOf(
    "actuator",
    {
        "tendon": Form.of(
            "tendon",
            Tendon,
            offset=Numbers(u.LENGTH, ((2,), (None, 2))),
            tension=Number(u.FORCE),
            length=Number(u.LENGTH),
            EA=Number(u.FORCE),
            start=Number(u.LENGTH),
            end=Number(u.LENGTH),
            rod=RodNumber(),
        ),
    },
)

OPTIONS = {
    name: whole_number() if isinstance(value, int) else Number(u.NONE)
    for name, value in Options().__getstate__().items()
}
SOLVE = Form(
    "solve",
    dict,
    {
        "tol": Key(Number(u.NONE)),
        "model": Key(Words(("auto", *get_args(Model)))),
        "stable": Key(FLAG),
        "eigenvalue": Key(FLAG),
        **{name: Key(key) for name, key in OPTIONS.items()},
    },
)

SCENE = Form(
    "scene",
    Scene,
    {
        "title": Key(TEXT),
        "space": Key(Words(get_args(Space)), "spatial"),
        "materials": Key(Named(MATERIAL)),
        "sections": Key(Named(SECTION)),
        "rods": Key(Listed(ROD, 1), REQUIRED),
        "supports": Key(Listed(SUPPORTS)),
        "loads": Key(Listed(LOADS)),
        "joints": Key(Listed(JOINT)),
        "actuators": Key(Listed(ACTUATORS)),
        "solve": Key(SOLVE),
    },
)
