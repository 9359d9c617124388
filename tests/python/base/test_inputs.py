"""Whatever is given for a number or an array: taken as it is meant, or refused in plain words."""

from __future__ import annotations

import re
import warnings
from collections.abc import Callable
from decimal import Decimal
from fractions import Fraction
from typing import Any

import numpy as np
import pandas as pd
import pint
import pytest
from scipy.spatial.transform import Rotation

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

RECORDS = np.zeros(4, dtype=[("x", "f8"), ("y", "f8"), ("z", "f8")])
STRANGE: dict[str, tuple[Any, str]] = {
    "quantity": (np.ones(3) * UNITS.kN, "kilonewton; give its magnitude in SI units"),
    "quantities": ([1 * UNITS.mm, 2 * UNITS.mm, 3 * UNITS.mm], "millimeter; give its magnitude"),
    "masked": (
        np.ma.masked_equal([[1.0, -1.0, 2.0]] * 4, -1),
        r"\[0, 1\]: is masked, as are 4 num",
    ),
    "masked, one": (np.ma.masked, "is masked"),
    "complex": (np.ones(3) * 1j, r"got complex ones; take their real part"),
    "complex, one": (1 + 1j, r"got complex ones; take their real part"),
    "ragged": ([[1.0, 2.0, 3.0], [4.0, 5.0]], "in rows of one length"),
    "text": ("1 m", "got '1 m'; texts with units are for scene files"),
    "texts": (["1", "2", "3"], "texts with units are for scene files"),
    "NA": ([1.0, pd.NA, 2.0], "expected numbers, got a NAType among them"),
    "none": ([1.0, None, 2.0], "expected numbers, got None among them"),
    "records": (RECORDS, "fields x, y, z; stack their columns"),
    "dict": ({"x": 1.0}, "expected numbers, got a dict"),
    "map": (map(float, [1, 2, 3]), "expected numbers, got a map"),
    "dates": (np.zeros(3, dtype="M8[s]"), "expected numbers, got"),
    "huge": ([10**400, 1, 1], "too large"),
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


PLAIN_NUMBERS = {name: entry for name, entry in NUMBERS.items() if name not in OTHER_WORDS}


@pytest.mark.parametrize(
    ("argument", "call"), named(PLAIN_NUMBERS) + named(ARRAYS | FRAMES | MANY_FRAMES)
)
def test_strange_things(argument: str, call: Call) -> None:
    for value, words in STRANGE.values():
        text = refused(call, value)
        assert text.startswith(argument)
        assert_matches(words, text)


@pytest.mark.parametrize("name", sorted(OTHER_WORDS))
def test_places_and_options(name: str) -> None:
    argument, call = NUMBERS[name]
    for value, _ in STRANGE.values():
        assert refused(call, value).startswith(argument)


@pytest.mark.parametrize(("argument", "call"), named(PLAIN_NUMBERS))
def test_one_number_is_wanted(argument: str, call: Call) -> None:
    text = refused(call, np.eye(3))
    assert text.startswith((argument, "edges"))


@pytest.mark.parametrize("name", [k for k in NUMBERS if k not in {"Section.GA1", "Section.GA2"}])
def test_no_number(name: str) -> None:
    argument, call = NUMBERS[name]
    if name != "Section.EA":  # infinite is a stiffness, too; NaN is none
        assert argument in refused(call, np.nan)
    assert argument in refused(call, -np.inf)


LET_THROUGH = ("vector", "values", "force_per_length", "moment_per_length")
"""Rotations and averages of NaN are NaN; loads along rods meet their rod in the scene."""


@pytest.mark.parametrize(
    ("argument", "call"),
    named({k: entry for k, entry in ARRAYS.items() if entry[0] not in LET_THROUGH}),
)
def test_arrays_with_nan(argument: str, call: Call) -> None:
    for shape in ((3,), (4, 3), (5, 3)):
        text = refused(call, np.full(shape, np.nan))
        assert argument in text or (argument == "curvature" and text.startswith("K0"))


ONE = {
    "0-d": np.array,
    "of one": lambda x: np.array([x]),
    "float32": np.float32,
    "fraction": lambda x: Fraction(x).limit_denominator(1000),
    "decimal": lambda x: Decimal(str(x)),
    "series": lambda x: pd.Series([x]),
    "unmasked": lambda x: np.ma.array([x]),
}


@pytest.mark.parametrize("form", ONE)
def test_one_number_in_any_form(form: str) -> None:
    one = ONE[form]
    assert Section(EI1=one(0.5), EI2=one(0.25), GJ=one(2)) == Section(0.5, 0.25, 2.0)
    assert Section.circle(one(0.5), STEEL) == Section.circle(0.5, STEEL)
    assert Outline.rectangle(one(0.5), one(2)) == Outline.rectangle(0.5, 2)
    assert Rod.straight(one(0.5), one(4), SOFT).length == 0.5
    assert pyrod.Force(E3, at=one(0.5)).at == 0.5
    assert pyrod.Clamp(turns=one(2)).turns == 2
    assert pyrod.Spring(one(0.5)).stiffness == 0.5
    assert RING.closed_ribbon(one(0)).link() == 0


@pytest.mark.parametrize(
    "form",
    [
        lambda x: x.astype(np.float32),
        lambda x: x.tolist(),
        lambda x: [tuple(row) for row in x],
        np.asfortranarray,
        lambda x: np.ma.array(x, mask=False),
        pd.DataFrame,
        lambda x: x.astype(object),
        lambda x: [[Fraction(v) for v in row] for row in x],
    ],
)
def test_tables_in_any_form(form: Callable[[Any], Any]) -> None:
    points = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [1, 1, 0.5]])
    assert Polyline(form(points)) == Polyline(points)


# Rotations ----------------------------------------------------------------------------------------

TURN = Rotation.from_euler("xyz", [0.3, -0.2, 0.5])
MATRIX = TURN.as_matrix()


@pytest.mark.parametrize(("argument", "call"), named(FRAMES))
def test_a_rotation_is_a_frame(argument: str, call: Call) -> None:
    """As a quaternion, the scalar first, or a matrix: the same."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        made = [call(x) for x in (TURN, MATRIX, TURN.as_quat(scalar_first=True))]
    assert not isinstance(made[0], pyrod.Clamp) or made[0].frame == pytest.approx(
        TURN.as_quat(scalar_first=True), abs=1e-15
    )
    for other in made[1:]:
        alike(made[0], other)


def alike(a: Any, b: Any) -> None:
    if isinstance(a, tuple):
        for x, y in zip(a, b, strict=True):
            alike(x, y)
    elif isinstance(a, np.ndarray):
        np.testing.assert_allclose(a, b, atol=1e-14)
    elif isinstance(a, FramedCurve):
        np.testing.assert_allclose(a.matrices, b.matrices, atol=1e-14)
    elif isinstance(a, pyrod.Energy):
        assert a.bend_twist == pytest.approx(b.bend_twist, rel=1e-12)
    elif isinstance(a, Rod):
        np.testing.assert_allclose(a.placement[1], b.placement[1], atol=1e-14)
    else:
        np.testing.assert_allclose(a.frame, b.frame, atol=1e-14)


def test_rotations_where_quaternions_are_taken() -> None:
    q = TURN.as_quat(scalar_first=True)
    assert rotation.log(TURN) == pytest.approx(TURN.as_rotvec(), abs=1e-15)
    assert rotation.rotate(TURN, E3) == pytest.approx(TURN.apply(E3), abs=1e-15)
    assert rotation.multiply(TURN, TURN) == pytest.approx(rotation.multiply(q, q), abs=1e-15)
    assert rotation.to_matrix(TURN) == pytest.approx(MATRIX, abs=1e-15)


def test_a_start_of_rotations() -> None:
    found = pyrod.solve(HELD)
    again = pyrod.solve(HELD, start=Rotation.from_quat(found.frames, scalar_first=True))
    assert again.tip == pytest.approx(found.tip, abs=1e-12)
    assert again.iterations <= 1


@pytest.mark.parametrize("where", [pyrod.Force, pyrod.Clamp, Polyline, rotation.exp])
def test_a_rotation_is_no_vector(where: Call) -> None:
    assert "got a Rotation; give .as_rotvec()" in refused(where, TURN)


def test_frames_lie_on_their_side() -> None:
    assert "got shape (4, 5); transpose it" in refused(
        lambda x: FramedCurve(ARC, x), np.ones((4, 5))
    )


# Words --------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (
            lambda: pyrod.Force(0, 0, -2),
            r"force: expected 3 numbers in one tuple or array, as in \(",
        ),
        (lambda: pyrod.Moment(1), "moment: expected 3 numbers in one tuple"),
        (lambda: Rod(1.0), r"make one with Rod.straight\(length, edges, section\)"),
        (lambda: pyrod.solve(ROD), r"scene: expected a Scene, got a Rod; hold it: Scene\(rod, Cl"),
        (lambda: pyrod.solve([HELD]), "scene: expected a Scene, got a list; .*solve_many"),
        (lambda: pyrod.solve_many(HELD), "scenes: expected several.*solve"),
        (lambda: pyrod.critical_load(ROD), "scene: expected a Scene, got a Rod"),
        (lambda: pyrod.smallest_model(ROD, 1e-3), "scene: expected a Scene, got a Rod"),
        (lambda: pyrod.is_planar(ROD), "scene: expected a Scene, got a Rod"),
        (lambda: Scene(ROD, pyrod.Force(E3), pyrod.Clamp()), "a Force belongs to loads: Scene"),
        (lambda: Scene(ROD, pyrod.Clamp(), pyrod.Hinge()), "a Hinge belongs to supports"),
        (lambda: Scene(pyrod.Clamp(), ROD), "rods: cannot use a Clamp; .* belongs to supports"),
        (
            lambda: Scene(ROD, pyrod.Clamp(), (), pyrod.Joint(("start", "end"))),
            "space: .*a Joint belongs to joints: Scene",
        ),
        (lambda: Scene(ROD, 3), "supports: cannot use a int"),
        (lambda: Section.circle(1.0, 200e9), r"material: expected a Material, as Material\(E="),
        (lambda: Rod.straight(1.0, 4, 3.0), "section: expected a Section, got a float"),
        (lambda: Section(np.eye(3), 1, 1), r"EI1: expected a number, got .* shape \(3, 3\)"),
        (lambda: Rod.straight("1 m", 4, SOFT), "length: .*give the number in SI units"),
        (lambda: pyrod.Options(3), "Options: give them by keyword"),
        (lambda: pyrod.Options(max_edges=1.5), "max_edges: expected a whole number, got 1.5"),
        (lambda: rotation.multiply(np.ones((2, 4)), np.ones((3, 4))), "a, b: as many of one"),
        (lambda: FRAMED.angles_from(ARC), "other: expected a FramedCurve, got a Polyline"),
        (lambda: curve.strains([1], PLACES[:2], NO_TURN[:1], measure=3), "measure: .*got 3"),
    ],
)
def test_first_words(call: Callable[[], Any], words: str) -> None:
    assert_matches(words, refused(lambda _: call(), None))


def test_color_by() -> None:
    result = pyrod.solve(HELD)
    assert "colour_by" in refused(lambda x: result.plot(color_by=x), "K")


# Strains ------------------------------------------------------------------------------------------


def test_a_wire_in_gigapascals_is_loud() -> None:
    wire = Rod.straight(1.0, 8, Section.circle(1e-3, pyrod.Material(E=200)))
    scene = Scene(wire, pyrod.Clamp(), pyrod.Force((0, 0, 5.86)))
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        pyrod.solve(scene)
    texts = [str(w.message) for w in told if w.category is pyrod.StrainWarning]
    assert len(texts) == 1
    assert_matches(r"edge \d is stretched to 93\d\d times its length.*units", texts[0])


@pytest.mark.parametrize(
    ("force", "words"),
    [((0, 0, 440.0), None), ((0, 0, 460.0), "stretched"), ((190.0, 0, 0), "sheared")],
)
def test_strains_beyond_those_of_rubber(force: tuple[float, ...], words: str | None) -> None:
    section = Section(1e6, 1e6, 1e6, 60.0, 60.0, 150.0)
    scene = Scene(Rod.straight(1.0, 4, section), pyrod.Clamp(), pyrod.Force(force))
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        pyrod.solve(scene)
    assert [w.category for w in told] == ([pyrod.StrainWarning] if words else [])
    assert not words or words in str(told[0].message)


# Default places -----------------------------------------------------------------------------------

ALONG_X = pyrod.Clamp(tangent=(1, 0, 0), normal=(0, 0, 1))
SHEARED = Section(1.0, 1.3, 0.8, 600.0, 800.0, 1500.0)
SUPPORTS = [
    pyrod.Clamp(at="end"),
    pyrod.Hinge(at="end"),
    pyrod.Slider(along=(1, 0, 0), at="end"),
    pyrod.Pivot((0, 1, 0), at="end"),
    pyrod.Sleeve(at="end"),
    pyrod.Spring(3.0, 2.0),
    pyrod.Slider(along=(1, 0, 0), clamped=True, at="end"),
]


@pytest.mark.parametrize("space", ["planar", "spatial"])
@pytest.mark.parametrize("support", SUPPORTS, ids=lambda s: type(s).__name__)
@pytest.mark.parametrize("curved", [False, True])
def test_default_places_follow_the_first_clamp(support: Any, space: Any, curved: bool) -> None:
    """Without loads, the rod is at rest where the clamp takes it."""
    rod = Rod.precurved(1.0, 16, SHEARED, (0, 0.7, 0) if curved else (0, 0, 0))
    result = pyrod.solve(Scene(rod, [ALONG_X, support], space=space))
    expected = rod.at_rest((0, 0, 0), ALONG_X.frame)
    np.testing.assert_allclose(result.positions, expected[0], atol=1e-12)
    np.testing.assert_allclose(rotation.to_matrix(result.frames), rotation.to_matrix(expected[1]),
                               atol=1e-12)  # fmt: skip
    assert result.energy < 1e-20


def test_the_place_of_a_clamp_inside() -> None:
    """It carries the rod by its point, and a turned frame at rest stays part of the shape."""
    rod = Rod.precurved(1.0, 16, SHEARED, (0.3, 0.7, 0.2)).placed((1, 2, 3), tangent=(0, 1, 0))
    clamp = pyrod.Clamp((4, 0, 0), tangent=(1, 0, 0), normal=(0, 0, 1), at=0.25)
    scene = Scene(rod, [clamp, pyrod.Clamp(at="end")])
    result = pyrod.solve(scene)
    assert result.energy < 1e-20
    np.testing.assert_allclose(result.positions[4], (4, 0, 0), atol=1e-12)


def test_the_reactions_of_a_beam_that_is_clamped_along_x() -> None:
    """Clamped at both ends, a force in the middle: half of it each, F L/8."""
    rod = Rod.straight(1.0, 64, Section(1.0, 1.0, 1.0, 1e9, 1e9, 1e9))
    load = pyrod.Force((0, 0, -1e-3), at=0.5)
    result = pyrod.solve(Scene(rod, [ALONG_X, pyrod.Clamp(at="end")], load))
    for reaction in result.reactions:
        assert reaction.force[1:] == pytest.approx([0, 0.5e-3], rel=1e-6, abs=1e-12)
        assert np.abs(reaction.moment) == pytest.approx([0, 1e-3 / 8, 0], rel=2e-3, abs=1e-12)


@pytest.mark.parametrize("order", [1, -1])
def test_a_default_start_stays_where_it_is(order: int) -> None:
    """Buckled between the start at rest and an end that was moved, in whatever order."""
    rod = Rod.straight(1.0, 16, Section(1.0, 1.3, 0.8))
    supports = [pyrod.Clamp(), pyrod.Clamp((0, 0, 0.9), at="end")][::order]
    result = pyrod.solve(Scene(rod, supports))
    assert result.positions[0] == pytest.approx([0, 0, 0], abs=1e-14)
    assert result.energy > 1


def test_a_hinge_without_a_place_before_the_clamp_stays() -> None:
    rod = Rod.straight(1.0, 16, SHEARED)
    scene = Scene(rod, [pyrod.Hinge(), pyrod.Clamp((0, 0, 0.95), at="end")])
    assert scene._held(0)[0] == pytest.approx([0, 0, 0])
    assert scene._held(1)[1] == pytest.approx([1, 0, 0, 0])


def test_other_rods_stay_where_they_are() -> None:
    rods = [ROD, ROD.placed((1, 0, 0))]
    clamps = [ALONG_X, pyrod.Clamp(at=(1, "start")), pyrod.Hinge(at=(1, "end"))]
    scene = Scene(rods, clamps)
    assert scene._held(1)[0] == pytest.approx([1, 0, 0])
    assert scene._held(2)[0] == pytest.approx([1, 0, 1])
