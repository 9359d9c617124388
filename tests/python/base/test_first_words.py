"""What is mistaken first: refused with what would be right."""

from __future__ import annotations

import inspect
import pickle
import traceback
import warnings
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from arguments import (
    ARC,
    E3,
    FRAMED,
    HELD,
    NO_TURN,
    PLACES,
    ROD,
    SOFT,
    STEEL,
    UNITS,
    assert_matches,
    refused,
)

import pyrod
from pyrod import Rod, Scene, Section, curve, rotation
from pyrod.base.calls import spelled

WIRE = Section.circle(1e-3, STEEL)
BENT = pyrod.solve(HELD)
ENDS = ("start", "end")
CALLS: list[tuple[Callable[[], Any], str]] = [
    # things in a wrong place
    (
        lambda: pyrod.Force(0, 0, -2),
        r"force: expected 3 numbers in one tuple.*, as in \(0, 0, -2",
    ),
    (lambda: pyrod.Force(0, 0, -2, "end"), r"too many arguments; write Force\(force, at='end', fo"),
    (lambda: pyrod.Moment(1), "moment: expected 3 numbers in one tuple"),
    (lambda: pyrod.Gravity(9.81), "acceleration: expected 3 numbers in one tuple"),
    (lambda: Rod(1.0), r"make one with Rod.straight\(length, edges, section\)"),
    (lambda: Rod.straight(1.0, 4, 3.0), "section: expected a Section, as Section.circle.*a float"),
    (lambda: Rod.straight(1.0, 4, STEEL), r"section: expected a Section, as Section.circle\("),
    (lambda: Section.circle(1.0, 200e9), r"material: expected a Material, as Material\(E="),
    (lambda: Section.circle(1.0, "steel"), r"material: expected a Material, as Material\(E="),
    (lambda: Scene(WIRE, pyrod.Clamp()), r"rods: cannot use a Section; make a rod.*straight"),
    (lambda: Scene(ROD, pyrod.Force(E3), pyrod.Clamp()), "a Force belongs to loads: Scene"),
    (lambda: Scene(ROD, pyrod.Clamp(), pyrod.Hinge()), "a Hinge belongs to supports"),
    (lambda: Scene(pyrod.Clamp(), ROD), "rods: cannot use a Clamp; .* belongs to supports"),
    (
        lambda: Scene(ROD, pyrod.Clamp(), (), pyrod.Joint(ENDS)),
        "space: .*a Joint belongs to joints: Scene",
    ),
    (lambda: Scene(ROD, 3), "supports: cannot use a int"),
    (lambda: Scene(ROD, (), pyrod.Force(E3)), "supports: nothing holds the rod.*give a Clamp"),
    (lambda: pyrod.Joint(0, 1), "points: expected places in one tuple, as "),
    (lambda: pyrod.Clamp((0, 0, 0), (1, 0, 0)), "directions of a3 and a1 there are tangent and"),
    (lambda: pyrod.solve(ROD), r"scene: expected a Scene, got a Rod; hold it: Scene\(rod, Cl"),
    (lambda: pyrod.solve([HELD]), "scene: expected a Scene, got a list; .*solve_many"),
    (lambda: pyrod.solve(ROD, pyrod.Clamp(), ()), r"solve: there are too many arguments; write so"),
    (lambda: pyrod.solve(HELD, 1e-6), "options: .*a tolerance is given by name, tol=1e-06"),
    (lambda: pyrod.solve_many(HELD), "scenes: expected several.*solve"),
    (lambda: pyrod.critical_load(ROD), "scene: expected a Scene, got a Rod"),
    (lambda: pyrod.critical_load(BENT), "scene: expected a Scene, got an Equilibrium; it has one"),
    (lambda: pyrod.smallest_model(ROD, 1e-3), "scene: expected a Scene, got a Rod"),
    (lambda: pyrod.is_planar(ROD), "scene: expected a Scene, got a Rod"),
    (
        lambda: BENT.plot("strains"),
        "ax: expected axes of matplotlib.*pictures go by what='str",
    ),
    (lambda: FRAMED.angles_from(ARC), "other: expected a FramedCurve, got a Polyline"),
    # names
    (lambda: pyrod.Force(E3, location=0.5), "Force: there is no location; did you mean at?"),
    (lambda: pyrod.Force(E3, follow=True), "there is no follow; did you mean follower?"),
    (lambda: pyrod.Force(z=-2), "Force: there is no z; it takes force, at, follower"),
    (lambda: pyrod.Gravity(g=E3), "there is no g; did you mean acceleration?"),
    (lambda: Rod.straight(lenght=1, edges=4, section=SOFT), "there is no lenght; did you mean len"),
    (
        lambda: Rod.straight(1.0, n=4, section=SOFT),
        "straight: there is no n; did you mean edges",
    ),
    (lambda: pyrod.Material(youngs_modulus=2e11), "no youngs_modulus; did you mean E?"),
    (lambda: pyrod.Material(2e11, rho=7850), "no rho; did you mean density?"),
    (lambda: Section.circle(diameter=1e-3, material=STEEL), "no diameter; did you mean radius?"),
    (lambda: Section(EI=1.0, GJ=1.0), "Section: there is no EI; did you mean EI1?"),
    (lambda: pyrod.Clamp(direction=E3), "Clamp: there is no direction; did you mean tangent?"),
    (lambda: pyrod.Spring(k=3.0), "Spring: there is no k; did you mean stiffness?"),
    (lambda: Scene(ROD, clamp=pyrod.Clamp()), "Scene: there is no clamp; did you mean supports?"),
    (lambda: Scene(ROD, pyrod.Clamp(), force=()), "Scene: there is no force; did you mean loads?"),
    (lambda: pyrod.solve(HELD, tolerance=1e-6), "solve: there is no tolerance; did you mean tol?"),
    (lambda: pyrod.solve(HELD, max_iterations=5), r"one of options=Options\(max_iterations=...\)"),
    (lambda: BENT.plot(color_by="K"), "it is written colour_by"),
    (lambda: BENT.show(color_by="K"), "there is no color_by; did you mean colour_by?"),
    # what is missing
    (lambda: pyrod.Force(), r"force is missing; write Force\(force, at='end', follower=False\)"),
    (lambda: Rod.straight(1.0), r"edges and section are missing; write Rod.straight\(length, edge"),
    (lambda: pyrod.Material(), r"E is missing; write Material\(E, nu=0.3, density=0.0\)"),
    (lambda: Section.circle(1.0), r"material is missing; write Section.circle\(radius, material\)"),
    (lambda: pyrod.Pivot(), r"axis is missing; write Pivot\(axis, position=None"),
    (lambda: pyrod.solve(), r"scene is missing; write solve\(scene, options=None, \*, tol=None"),
    (lambda: pyrod.sweep(HELD), r"parameters is missing; write sweep\(scene, parameters"),
    # values
    (lambda: pyrod.Force(E3, "tip"), "at: .*got 'tip'; did you mean end?"),
    (lambda: pyrod.Clamp(at="left"), "at: .*got 'left'; did you mean start?"),
    (
        lambda: Rod.straight(1.0, 4, SOFT, "kirchhoff"),
        "'kirchhoff'; did you mean inextensible",
    ),
    (lambda: Rod.straight(1.0, 4, SOFT, "Cosserat"), "got 'Cosserat'; did you mean cosserat?"),
    (lambda: Section(np.eye(3), 1, 1), r"EI1: expected a number, got .* shape \(3, 3\)"),
    (lambda: Rod.straight("1 m", 4, SOFT), "length: .*give the number in SI units"),
    (
        lambda: Rod.straight(1e3 * UNITS.mm, 4, SOFT),
        "length: .*millimeter; give its magnitude",
    ),
    (lambda: pyrod.Force([0, 0, -2] * UNITS.kN), "force: .*kilonewton; give its magnitude in SI"),
    (lambda: pyrod.Options(3), "Options: give them by keyword"),
    (lambda: pyrod.Options(max_edges=1.5), "max_edges: expected a whole number, got 1.5"),
    (lambda: rotation.multiply(np.ones((2, 4)), np.ones((3, 4))), "a, b: as many of one"),
    (lambda: curve.strains([1], PLACES[:2], NO_TURN[:1], measure=3), "measure: .*got 3"),
    (lambda: BENT.plot(what="moments"), "what: .*got 'moments'; did you mean forces?"),
    (lambda: BENT.plot(colour_by="curvature"), "got 'curvature'; did you mean K?"),
    (lambda: BENT.largest("moments"), "there is no 'moments'; did you mean moment?"),
    (lambda: BENT.at("middle"), "at: expected 'start', 'end' or an arc length, got 'middle'"),
]
NAMES: list[tuple[Callable[[], Any], str]] = [
    (lambda: BENT.forces, "Equilibrium has no 'forces'; did you mean force?"),
    (lambda: BENT.position, "Equilibrium has no 'position'; did you mean at or positions?"),
    (lambda: BENT.curvature, "Equilibrium has no 'curvature'; did you mean K?"),
    (lambda: WIRE.EI, "Section has no 'EI'; did you mean EI1?"),
    (lambda: STEEL.youngs_modulus, "Material has no 'youngs_modulus'; did you mean E?"),
    (lambda: ROD.n, "Rod has no 'n'; did you mean edges?"),
    (lambda: HELD.clamp, "Scene has no 'clamp'; did you mean supports?"),
    (lambda: pyrod.Beam, "module 'pyrod' has no attribute 'Beam'; did you mean Rod?"),
    (lambda: pyrod.solv, "module 'pyrod' has no attribute 'solv'; did you mean solve"),
]


@pytest.mark.parametrize(("call", "words"), CALLS)
def test_first_words(call: Callable[[], Any], words: str) -> None:
    assert_matches(words, refused(lambda _: call(), None))


@pytest.mark.parametrize(("call", "words"), NAMES)
def test_names(call: Callable[[], Any], words: str) -> None:
    with pytest.raises(AttributeError) as told:
        call()
    assert_matches(words, str(told.value))


def test_errors_that_nobody_asked_for() -> None:
    with pytest.raises(KeyError, match=r"where one is asked for, solve\(scene, tol=...\)"):
        BENT.errors["positions"]
    assert not BENT.errors
    assert "no tolerance" in repr(BENT.errors)


def test_there_are_many() -> None:
    assert len(CALLS) + len(NAMES) > 70


def test_names_of_one_rod_are_looked_for_among_several(joined_rods: pyrod.Equilibrium) -> None:
    with pytest.raises(AttributeError, match=r"no 'curvature'; did you mean rods\[i\].K\?"):
        joined_rods.curvature  # noqa: B018
    assert not hasattr(joined_rods, "__array_interface__")


def test_python_guesses_no_second_time() -> None:
    with pytest.raises(AttributeError) as caught:
        BENT.forces  # noqa: B018
    assert "".join(traceback.format_exception(caught.value)).count("force?") == 1


def test_what_fails_inside_of_a_call_is_not_the_call() -> None:
    def broken(s: float) -> Any:
        return Section.circle(radius=s)  # type: ignore[call-arg]

    with pytest.raises(TypeError, match=r"^Section.circle: material is missing"):
        Rod.straight(1.0, 4, broken)

    @spelled
    def outer(a: float) -> Any:
        return len(a)  # type: ignore[arg-type]

    with pytest.raises(TypeError, match="object of type 'int' has no len"):
        outer(1)


def test_calls_look_as_they_did() -> None:
    """For editors, help and pickles."""
    assert str(inspect.signature(pyrod.Force)).startswith("(force")
    assert list(inspect.signature(pyrod.solve).parameters)[:2] == ["scene", "options"]
    assert pickle.loads(pickle.dumps(pyrod.solve)) is pyrod.solve
    assert pickle.loads(pickle.dumps(WIRE)) == WIRE


def test_warnings_name_the_line_of_the_user() -> None:
    wire = Rod.straight(1.0, 8, Section.circle(1e-3, pyrod.Material(E=200)))
    scene = Scene(wire, pyrod.Clamp(), pyrod.Force((0, 0, 5.86)))
    for call in (pyrod.solve, lambda one: pyrod.solve_many([one]), pyrod.Solver(scene).solve):
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            call(scene)
        assert pyrod.StrainWarning in {one.category for one in told}
        assert {one.filename for one in told} == {__file__}
