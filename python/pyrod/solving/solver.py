"""A scene that is solved again and again while its numbers change."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from threading import Lock, get_ident
from time import perf_counter
from typing import Any

import pyrod._core as _core
from pyrod._core import Options
from pyrod.base.words import shortly
from pyrod.result.equilibrium import Equilibrium
from pyrod.scene.changes import KINDS, Parts, changed
from pyrod.scene.numbers import NewNumbers
from pyrod.scene.scene import Scene, checked_scene, compiled_of
from pyrod.solving.job import DEFAULTS, How, equilibrium_later, equilibrium_of
from pyrod.solving.run import judge


class Solver:
    """Solves a scene again and again, each time with other numbers and from the last shape.

    Where there are several shapes, the one that belongs to the last is found, if it is stable
    still: full turns that the ends make little by little stay in the rod. If nothing is found from
    the last shape, or ``turns`` or the edges of a rod change, the solver begins afresh, as `solve`
    does. One thread at a time may solve; others wait.

    Parameters
    ----------
    scene : `Scene`
        What is solved first. Positions and frames of supports, loads, stiffnesses and curvatures at
        rest may change; how the unknowns are numbered is kept as long as nothing else does.
    options, tol, stable, eigenvalue, strict : see `solve`
    """

    def __init__(
        self,
        scene: Scene,
        options: Options | None = None,
        *,
        tol: float | None = None,
        stable: bool = True,
        eigenvalue: bool = False,
        strict: bool = True,
    ) -> None:
        self._numbers = NewNumbers(checked_scene(scene))
        self._how = How(options or DEFAULTS, stable, eigenvalue, tol).checked()
        self._strict = strict
        # of the rods with the vertices of places: rows of loads have as many as these have edges
        self._solver = _core.Solver(compiled_of(scene))
        self._in_step = True  # what the compiled solver has is the scene; Ctrl-C may part them
        self._busy = Lock()
        self._thread: int | None = None  # which solves now

    @property
    def scene(self) -> Scene:
        """The scene as it was solved last."""
        return self._numbers.scene

    def solve(self, changes: Mapping[str, Any] | Scene | None = None) -> Equilibrium:
        """The equilibrium of the scene with these changes, which stay.

        Parameters
        ----------
        changes : mapping or `Scene`
            New values by their paths, as ``{"loads.0.force": (0, 0, -2), "supports.1.position.2":
            0.4}``: ``rods``, ``supports``, ``joints``, ``loads`` or ``actuators``, the number of
            one, what it takes, and perhaps a component of that. Or another scene; default: none.

        Raises
        ------
        ValueError, TypeError
            There is no such entry, or what it says cannot be solved; the scene is what it was.
        NotConverged
            No equilibrium was found, if the solver is strict.
        """
        result = self.unjudged(changes)
        judge(result, self._strict)
        return result

    def unjudged(self, changes: Mapping[str, Any] | Scene | None = None) -> Equilibrium:
        """As ``solve``, but whatever is found is returned without a warning."""
        if not isinstance(changes, (Scene, Mapping, type(None))):
            raise TypeError(
                f"changes: expected new values by their paths, or a Scene, got {shortly(changes)}"
            )
        if self._thread == get_ident():
            raise RuntimeError("Solver: it is solving already; make another one")
        with self._busy:
            self._thread = get_ident()
            in_step = self._in_step
            try:
                return self._found(changes or {})
            except Exception:  # which leaves the compiled solver what it was
                self._in_step = in_step
                raise
            finally:
                self._thread = None

    def forget(self) -> None:
        """Starts the next solve afresh, as if nothing had been found yet."""
        if self._thread == get_ident():
            raise RuntimeError("Solver: it is solving; it cannot forget what it has not found yet")
        with self._busy:
            self._solver.forget()

    def _found(self, changes: Mapping[str, Any] | Scene) -> Equilibrium:
        began = perf_counter()
        in_step, self._in_step = self._in_step, False
        if (
            in_step
            and isinstance(changes, Mapping)
            and (values := self._numbers.read(changes)) is not None
        ):
            found = self._solver.solve_numbers(values, *self._how)
            self._numbers = numbers = self._numbers.with_these(changes)
            self._in_step = True
            if found.accuracy is None:
                return equilibrium_later(
                    numbers.made, numbers.rods, found, self._how, perf_counter() - began
                )
            return equilibrium_of(numbers.scene, found, self._how, perf_counter() - began)
        new: Parts | None = None
        if isinstance(changes, Scene):
            scene = changes
        else:
            scene, new = changed(self.scene, changes)
        rods, supports, joints, loads, actuators = compiled_parts(new or {})
        given: Any = None if new is not None and in_step else compiled_of(scene)
        found = self._solver.solve(given, rods, supports, joints, loads, actuators, *self._how)
        self._numbers = NewNumbers(scene)
        self._in_step = True
        return equilibrium_of(scene, found, self._how, perf_counter() - began)

    def __reduce__(self) -> tuple[Callable[..., Solver], tuple[Any, ...]]:
        return _again, (self.scene, self._how, self._strict)

    def __repr__(self) -> str:
        return f"Solver({self.scene!r})"


def _again(scene: Scene, how: How, strict: bool) -> Solver:
    options, stable, eigenvalue, tol = how
    return Solver(scene, options, tol=tol, stable=stable, eigenvalue=eigenvalue, strict=strict)


def compiled_parts(new: Mapping[str, Mapping[int, Any]]) -> list[list[tuple[int, Any]]]:
    return [[(i, part._compiled) for i, part in new.get(kind, {}).items()] for kind in KINDS]
