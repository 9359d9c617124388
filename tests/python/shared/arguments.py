"""Tables of arguments that are numbers, arrays or frames: their names, and calls that take them."""

from __future__ import annotations

import re
import warnings
from collections.abc import Callable
from typing import Any

import numpy as np
import pint
import pytest

import pyrod
from pyrod import Outline, Rod, Scene, Section, curve, rotation
from pyrod.curve import FramedCurve, Polyline

UNITS = pint.UnitRegistry()
STEEL = pyrod.Material(200e9)
SOFT = Section(1.0, 1.0, 1.0)
ROD = Rod.straight(1.0, 4, SOFT)
HELD = Scene(ROD, pyrod.Clamp(), pyrod.Force((0.01, 0, 0)))
S = np.linspace(0, 1, 5)
POINTS = np.column_stack([np.cos(S), np.sin(S), 0.3 * S])
ARC = Polyline(POINTS)
FRAMED = ARC.bishop()
RING = Polyline([[1, 0, 0], [0, 1, 0.1], [-1, 0, 0], [0, -1, 0.1]], closed=True)
Q = FRAMED.frames
H = FRAMED.edge_lengths
E3 = (0.0, 0.0, 1.0)
PLACES = np.array([[0.0, 0, 0], [0, 0, 0.5], [0, 0, 1.0]])
TWO = Rod.straight(1.0, 2, SOFT)
NO_TURN = np.tile([1.0, 0, 0, 0], (2, 1))

Call = Callable[[Any], Any]

NUMBERS: dict[str, tuple[str, Call]] = {
    "Material.E": ("E", lambda x: pyrod.Material(x)),
    "Material.nu": ("nu", lambda x: pyrod.Material(1.0, x)),
    "Material.density": ("density", lambda x: pyrod.Material(1.0, 0.3, x)),
    "Section.EI1": ("EI1", lambda x: Section(x, 1, 1)),
    "Section.EI2": ("EI2", lambda x: Section(1, x, 1)),
    "Section.GJ": ("GJ", lambda x: Section(1, 1, x)),
    "Section.GA1": ("GA1", lambda x: Section(1, 1, 1, x, 1, 1)),
    "Section.GA2": ("GA2", lambda x: Section(1, 1, 1, 1, x, 1)),
    "Section.EA": ("EA", lambda x: Section(1, 1, 1, EA=x)),
    "Section.mass": ("mass_per_length", lambda x: Section(1, 1, 1, mass_per_length=x)),
    "circle": ("radius", lambda x: Section.circle(x, STEEL)),
    "tube": ("outer_radius", lambda x: Section.tube(x, 0.1, STEEL)),
    "tube, inner": ("inner_radius", lambda x: Section.tube(9, x, STEEL)),
    "rectangle": ("width", lambda x: Section.rectangle(x, 0.1, STEEL)),
    "rectangle, height": ("height", lambda x: Section.rectangle(0.1, x, STEEL)),
    "Outline.circle": ("radius", Outline.circle),
    "Outline.tube": ("outer_radius", lambda x: Outline.tube(x, 0.1)),
    "Outline.tube, inner": ("inner_radius", lambda x: Outline.tube(9, x)),
    "Outline.rectangle": ("width", lambda x: Outline.rectangle(x, 1)),
    "Outline.rectangle, height": ("height", lambda x: Outline.rectangle(1, x)),
    "loops": ("sides", lambda x: Outline.circle(1).loops(x)),
    "towards": ("part", lambda x: Outline.circle(1).towards(Outline.circle(2), x)),
    "straight": ("length", lambda x: Rod.straight(x, 4, SOFT)),
    "straight, edges": ("edges", lambda x: Rod.straight(1.0, x, SOFT)),
    "precurved": ("length", lambda x: Rod.precurved(x, 4, SOFT, (0, 1, 0))),
    "Clamp.at": ("at", lambda x: pyrod.Clamp(at=x)),
    "Clamp.at, rod 0": ("at", lambda x: pyrod.Clamp(at=(0, x))),
    "Force.at": ("at", lambda x: pyrod.Force(E3, x)),
    "Clamp.turns": ("turns", lambda x: pyrod.Clamp(turns=x)),
    "Joint.turns": ("turns", lambda x: pyrod.Joint(("start", "end"), turns=x)),
    "Spring": ("stiffness", pyrod.Spring),
    "Spring.torsion": ("torsion", lambda x: pyrod.Spring(1.0, x)),
    "DistributedForce.rod": ("rod", lambda x: pyrod.DistributedForce(E3, x)),
    "DistributedMoment.rod": ("rod", lambda x: pyrod.DistributedMoment(E3, x)),
    "solve.tol": ("tol", lambda x: pyrod.solve(HELD, tol=x)),
    "smallest_model.tol": ("tol", lambda x: pyrod.smallest_model(HELD, x)),
    "critical_load.upper": ("upper", lambda x: pyrod.critical_load(HELD, x)),
    "critical_load.rtol": ("rtol", lambda x: pyrod.critical_load(HELD, rtol=x)),
    "solve_many.threads": ("threads", lambda x: pyrod.solve_many([HELD], threads=x)),
    "Options": ("trust", lambda x: pyrod.Options(trust=x)),
    "Polyline.straight": ("straight", lambda x: Polyline(POINTS, straight=x)),
    "Polyline.resolution": ("resolution", lambda x: Polyline(POINTS, resolution=x)),
    "without_repeats": ("distance", lambda x: curve.without_repeats(POINTS, False, x)),
    "sampled": ("length", lambda x: FramedCurve.sampled(x, 4, E3)),
    "sampled, edges": ("edges", lambda x: FramedCurve.sampled(1.0, x, E3)),
    "adapted": ("limit", FRAMED.adapted),
    "edge": ("distance", FRAMED.edge),
    "closed_ribbon": ("link", RING.closed_ribbon),
    "writhe": ("threads", RING.writhe),
    "frenet_link": ("threads", RING.frenet_link),
    "self_approach": ("threads", RING.self_approach),
    "approach": ("threads", lambda x: RING.approach(ARC, x)),
    "linking_number": ("threads", lambda x: curve.linking_number(RING, RING, x)),
}

ARRAYS: dict[str, tuple[str, Call]] = {
    "Force": ("force", pyrod.Force),
    "Moment": ("moment", pyrod.Moment),
    "DistributedForce": ("force_per_length", pyrod.DistributedForce),
    "DistributedMoment": ("moment_per_length", pyrod.DistributedMoment),
    "DistributedForce, function": (
        "force_per_length",
        lambda x: Scene(ROD, pyrod.Clamp(), pyrod.DistributedForce(lambda s: x)),
    ),
    "Gravity": ("acceleration", pyrod.Gravity),
    "Clamp": ("position", pyrod.Clamp),
    "Clamp.tangent": ("tangent", lambda x: pyrod.Clamp(tangent=x)),
    "Clamp.normal": ("normal", lambda x: pyrod.Clamp(tangent=E3, normal=x)),
    "Hinge": ("position", pyrod.Hinge),
    "Sleeve": ("position", pyrod.Sleeve),
    "Slider": ("along", pyrod.Slider),
    "Slider.normal": ("normal", lambda x: pyrod.Slider(normal=x)),
    "Slider.position": ("position", lambda x: pyrod.Slider(E3, position=x)),
    "Pivot": ("axis", pyrod.Pivot),
    "Pivot.along": ("along", lambda x: pyrod.Pivot(E3, along=x)),
    "Pivot.position": ("position", lambda x: pyrod.Pivot(E3, x)),
    "Spring.position": ("position", lambda x: pyrod.Spring(1.0, 0.0, x)),
    "Joint": ("axis", lambda x: pyrod.Joint(("start", "end"), "hinge", axis=x)),
    "Rod": ("edge_lengths", lambda x: Rod(x, PLACES, PLACES, PLACES, "cosserat")),
    "Rod.bending": ("bending", lambda x: Rod([1.0], x, PLACES, PLACES, "cosserat")),
    "Rod.stretching": ("stretching", lambda x: Rod([1.0], [[1, 1, 1]] * 2, x, PLACES, "cosserat")),
    "Rod.K0": (
        "K0",
        lambda x: Rod([1.0], [[1, 1, 1]] * 2, [[1, 1, 1]], x, "cosserat"),
    ),
    "Rod.mass": (
        "mass_per_length",
        lambda x: Rod([1.0], [[1, 1, 1]] * 2, [[1, 1, 1]], [E3] * 2, "cosserat", mass_per_length=x),
    ),
    "precurved": ("curvature", lambda x: Rod.precurved(1.0, 4, SOFT, x)),
    "precurved, lengths": ("length", lambda x: Rod.precurved(x, None, SOFT, E3)),
    "precurved, free": ("curvature", lambda x: Rod.precurved(1.0, None, SOFT, x)),
    "precurved, function": ("curvature", lambda x: Rod.precurved(1.0, 4, SOFT, lambda s: x)),
    "from_curve": ("positions", lambda x: Rod.from_curve(x, Q, SOFT)),
    "placed": ("position", ROD.placed),
    "placed, tangent": ("tangent", lambda x: ROD.placed(tangent=x)),
    "with_vertices": ("at", ROD.with_vertices),
    "at_rest": ("position", ROD.at_rest),
    "energy": ("positions", lambda x: TWO.energy(x, NO_TURN)),
    "Outline.polygon": ("points", Outline.polygon),
    "Outline.polygon, hole": (
        "hole",
        lambda x: Outline.polygon([[0, 0], [1, 0], [1, 1], [0, 1]], x),
    ),
    "Polyline": ("positions", Polyline),
    "Polyline.start_tangent": ("start_tangent", lambda x: Polyline(POINTS, start_tangent=x)),
    "Polyline.end_tangent": ("end_tangent", lambda x: Polyline(POINTS, end_tangent=x)),
    "derivative": ("parameter", ARC.derivative),
    "bishop": ("normal", ARC.bishop),
    "bishop, angles": ("angles", lambda x: ARC.bishop(angles=x)),
    "ribbon, normal": ("normal", lambda x: RING.closed_ribbon(0, x)),
    "at_vertices": ("values", ARC.at_vertices),
    "at_centres": ("values", ARC.at_centres),
    "approach, other": ("other", ARC.approach),
    "linking_number, a": ("a", lambda x: curve.linking_number(x, RING)),
    "linking_number, b": ("b", lambda x: curve.linking_number(RING, x)),
    "without_repeats": ("positions", curve.without_repeats),
    "bishop_from_frenet": ("curvature", lambda x: curve.bishop_from_frenet(x, [1.0])),
    "bishop_from_frenet, angles": (
        "dihedral_angles",
        lambda x: curve.bishop_from_frenet([1.0, 1.0], x),
    ),
    "frenet_from_bishop": ("K", curve.frenet_from_bishop),
    "FramedCurve": ("positions", lambda x: FramedCurve(x, Q)),
    "FramedCurve.edge_lengths": ("edge_lengths", lambda x: FramedCurve(ARC, Q, x)),
    "from_strains": ("edge_lengths", lambda x: FramedCurve.from_strains(x, PLACES)),
    "from_strains, K": ("K", lambda x: FramedCurve.from_strains([1, 1], x)),
    "from_strains, Gamma": ("Gamma", lambda x: FramedCurve.from_strains([1, 1], PLACES, x)),
    "from_strains, position": (
        "position",
        lambda x: FramedCurve.from_strains([1, 1], PLACES, None, x),
    ),
    "from_frenet": ("edge_lengths", lambda x: FramedCurve.from_frenet(x, [1, 1], [1])),
    "from_frenet, curvature": ("curvature", lambda x: FramedCurve.from_frenet([1], x, [1])),
    "from_frenet, torsion": ("torsion", lambda x: FramedCurve.from_frenet([1], [0, 0], x)),
    "from_frenet, position": (
        "position",
        lambda x: FramedCurve.from_frenet([1], [0, 0], [1], x),
    ),
    "sampled": ("K", lambda x: FramedCurve.sampled(1.0, 4, x)),
    "sampled, function": ("K", lambda x: FramedCurve.sampled(1.0, 4, lambda s: x)),
    "sampled, Gamma": ("Gamma", lambda x: FramedCurve.sampled(1.0, 4, E3, x)),
    "turned": ("angles", FRAMED.turned),
    "strains": ("edge_lengths", lambda x: curve.strains(x, PLACES, NO_TURN)),
    "strains, positions": ("positions", lambda x: curve.strains([0.5, 0.5], x, NO_TURN)),
    "reconstruct": ("edge_lengths", lambda x: curve.reconstruct(x, PLACES)),
    "reconstruct, K": ("K", lambda x: curve.reconstruct([1, 1], x)),
    "exp": ("vector", rotation.exp),
    "cayley": ("vector", rotation.cayley),
    "rotate": ("vector", lambda x: rotation.rotate([1, 0, 0, 0], x)),
    "from_matrix": ("matrix", rotation.from_matrix),
    "frame_along": ("tangent", rotation.frame_along),
    "frame_along, normal": ("normal", lambda x: rotation.frame_along(E3, x)),
}

FRAMES: dict[str, tuple[str, Call]] = {
    "Clamp": ("frame", lambda x: pyrod.Clamp(frame=x)),
    "Sleeve": ("frame", lambda x: pyrod.Sleeve(frame=x)),
    "Slider": ("frame", lambda x: pyrod.Slider(E3, frame=x)),
    "Pivot": ("frame", lambda x: pyrod.Pivot(E3, frame=x)),
    "Spring": ("frame", lambda x: pyrod.Spring(0.0, 1.0, frame=x)),
    "placed": ("frame", lambda x: ROD.placed(frame=x)),
    "at_rest": ("frame", lambda x: ROD.at_rest(frame=x)),
    "energy, start": ("start_frame", lambda x: TWO.energy(PLACES, NO_TURN, x)),
    "energy, end": ("end_frame", lambda x: TWO.energy(PLACES, NO_TURN, None, x)),
    "FramedCurve, start": ("start_frame", lambda x: FramedCurve(ARC, Q, None, x)),
    "FramedCurve, end": ("end_frame", lambda x: FramedCurve(ARC, Q, None, None, x)),
    "strains, start": ("start_frame", lambda x: curve.strains([1, 1], PLACES, NO_TURN, x)),
    "strains, end": ("end_frame", lambda x: curve.strains([1, 1], PLACES, NO_TURN, None, x)),
    "reconstruct": ("frame", lambda x: curve.reconstruct([1, 1], PLACES, frame=x)),
    "from_strains": ("frame", lambda x: FramedCurve.from_strains([1, 1], PLACES, frame=x)),
    "from_frenet": ("frame", lambda x: FramedCurve.from_frenet([1], [0, 0], [1], frame=x)),
    "sampled": ("frame", lambda x: FramedCurve.sampled(1.0, 4, E3, frame=x)),
    "bishop": ("frame", lambda x: ARC.bishop(frame=x)),
}
"""One frame each."""

MANY_FRAMES: dict[str, tuple[str, Call]] = {
    "from_curve": ("frames", lambda x: Rod.from_curve(POINTS, x, SOFT)),
    "energy": ("frames", lambda x: TWO.energy(PLACES, x)),
    "solve": ("start", lambda x: pyrod.solve(HELD, start=x)),
    "critical_load": ("start", lambda x: pyrod.critical_load(HELD, start=x)),
    "FramedCurve": ("frames", lambda x: FramedCurve(ARC, x)),
    "from_vertex_frames": ("frames", lambda x: FramedCurve.from_vertex_frames(ARC, x)),
    "strains": ("frames", lambda x: curve.strains([0.5, 0.5], PLACES, x)),
    "continued": ("frames", rotation.continued),
    "log": ("quaternion", rotation.log),
    "inverse_cayley": ("quaternion", rotation.inverse_cayley),
    "conjugate": ("quaternion", rotation.conjugate),
    "to_matrix": ("quaternion", rotation.to_matrix),
    "multiply": ("a", lambda x: rotation.multiply(x, [1, 0, 0, 0])),
    "multiply, b": ("b", lambda x: rotation.multiply([1, 0, 0, 0], x)),
    "rotate": ("quaternion", lambda x: rotation.rotate(x, E3)),
}
FOREIGN = (  # words of NumPy, pybind11 and Python that say nothing about the argument
    "incompatible",
    "ufunc",
    "inhomogeneous",
    "setting an array element",
    "could not convert",
    "Unable to cast",
    "isfinite",
    "float()",
    "operand",
    "supported argument",
    "has no attribute",
)
OTHER_WORDS = {"Clamp.at", "Clamp.at, rod 0", "Force.at", "Options"}
"""Take texts, or are told by the core."""


def refused(call: Call, value: Any) -> str:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises((ValueError, TypeError)) as told:
            call(value)
    text = str(told.value)
    assert not any(word in text for word in FOREIGN), text
    return text


def named(table: dict[str, tuple[str, Call]]) -> list[Any]:
    return [pytest.param(*entry, id=name) for name, entry in table.items()]


def assert_matches(words: str, text: str) -> None:
    assert re.search(words, text), text
