"""A scene that is solved again and again while its numbers change."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import cache
from inspect import signature
from threading import Lock
from time import perf_counter
from typing import Any

import numpy as np

import pyrod._core as _core
from pyrod._core import Options
from pyrod.base.words import listed, shortly
from pyrod.result.equilibrium import Equilibrium
from pyrod.rod.rod import Rod
from pyrod.scene.scene import Scene, checked_scene
from pyrod.solving.job import DEFAULTS, How, equilibrium_of
from pyrod.solving.run import judge

KINDS = ("rods", "supports", "joints", "loads")
PLACES = ("at", "rod", "points")
"""Entries that decide where rods have vertices."""


class Solver:
    """Solves a scene again and again, each time with other numbers and from the last shape.

    Where there are several shapes, the one that belongs to the last is found, if it is stable
    still. If nothing is found from the last shape, the solver begins afresh, as `solve` does. One
    thread at a time may solve; others wait.

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
        self._scene = checked_scene(scene)
        self._how = How(options or DEFAULTS, stable, eigenvalue, tol).checked()
        self._strict = strict
        self._solver = _core.Solver(scene._compiled)
        self._busy = Lock()

    @property
    def scene(self) -> Scene:
        """The scene as it was solved last."""
        return self._scene

    def solve(self, changes: Mapping[str, Any] | Scene | None = None) -> Equilibrium:
        """The equilibrium of the scene with these changes, which stay.

        Parameters
        ----------
        changes : mapping or `Scene`
            New values by their paths, as ``{"loads.0.force": (0, 0, -2), "supports.1.position.2":
            0.4}``: ``rods``, ``supports``, ``joints`` or ``loads``, the number of one, what it
            takes, and perhaps a component of that. Or another scene; default: none.

        Raises
        ------
        ValueError, TypeError
            There is no such entry, or what it says cannot be solved; the scene is what it was.
        NotConverged
            No equilibrium was found, if the solver is strict.
        """
        with self._busy:
            began = perf_counter()
            options, stable, eigenvalue, tol = self._how
            new: Parts | None = None
            if isinstance(changes, Scene):
                scene = changes
            else:
                scene, new = changed(self._scene, changes or {})
            whole = scene._compiled if new is None else None
            rods, supports, joints, loads = compiled_parts(new or {})
            found = self._solver.solve(
                whole,  # type: ignore[arg-type]
                rods,
                supports,
                joints,
                loads,
                options,
                tol,
                stable,
                eigenvalue,
            )
            self._scene = scene
        result = equilibrium_of(scene, found, self._how, perf_counter() - began)
        judge(result, self._strict)
        return result

    def __reduce__(self) -> tuple[Callable[..., Solver], tuple[Any, ...]]:
        return _again, (self._scene, self._how, self._strict)

    def __repr__(self) -> str:
        return f"Solver({self._scene!r})"


def _again(scene: Scene, how: How, strict: bool) -> Solver:
    options, stable, eigenvalue, tol = how
    return Solver(scene, options, tol=tol, stable=stable, eigenvalue=eigenvalue, strict=strict)


def compiled_parts(new: Mapping[str, Mapping[int, Any]]) -> list[list[tuple[int, Any]]]:
    return [[(i, part._compiled) for i, part in new.get(kind, {}).items()] for kind in KINDS]


Parts = dict[str, dict[int, Any]]
"""Parts of a scene by kind and number."""


def changed(scene: Scene, values: Mapping[str, Any]) -> tuple[Scene, Parts | None]:
    """The scene with other values of these entries.

    And its new parts, if they are all that has changed; else None: rods or places are others.
    """
    new: Parts = {}
    moved = False
    for path, value in values.items():
        kind, number, *rest = part_keys(scene, path)
        parts = new.setdefault(kind, {})
        old = parts[number] if number in parts else getattr(scene, kind)[number]
        parts[number] = _with_entry(old, path, value, *rest) if rest else value
        moved = moved or not rest or kind == "rods" or rest[0] in PLACES
    entries = {name: getattr(scene, name) for name in ("rods", "supports", "loads", "joints")}
    for kind, parts in new.items():
        entries[kind] = tuple([parts.get(i, old) for i, old in enumerate(entries[kind])])
    if moved:
        return Scene(space=scene.space, **entries), None
    made = object.__new__(Scene)  # the compiled solver checks the parts as it takes them
    made.__dict__.update(entries, space=scene.space)
    return made, new


def part_keys(scene: Scene, path: str) -> list[Any]:
    """Kind, number, and the rest of the path, of which the first is a name."""
    kind, _, rest = path.partition(".")
    if kind not in KINDS:
        raise ValueError(f"{shortly(path)}: is no entry; a scene has {listed(KINDS)}")
    number, _, rest = rest.partition(".")
    parts = getattr(scene, kind)
    if not number.isdecimal() or int(number) >= len(parts):
        there = listed(range(len(parts))) if parts else "none"
        raise ValueError(f"{shortly(path)}: is no entry; of {kind} there are {there}")
    return [kind, int(number), *rest.split(".")] if rest else [kind, int(number)]


def _with_entry(part: Any, path: str, value: Any, name: str, *component: str) -> Any:
    """The part with another value, or with another component of what it has."""
    names = entries_of(type(part))  # type: ignore[arg-type]
    if name not in names or len(component) > 1:
        raise ValueError(
            f"{shortly(path)}: is no entry; a {type(part).__name__} has {listed(names)}"
        )
    if component:
        value = _with_component(getattr(part, name), path, component[0], value)
    if isinstance(part, Rod):
        return replace(part, **{name: value})
    return type(part)(**{n: value if n == name else getattr(part, n) for n in names})


@cache
def entries_of(kind: type) -> tuple[str, ...]:
    """What a part takes and has."""
    has = kind.__dataclass_fields__  # type: ignore[attr-defined]
    return tuple(name for name in signature(kind).parameters if name in has)


def _with_component(old: Any, path: str, component: str, value: Any) -> Any:
    if not isinstance(old, np.ndarray) or old.ndim != 1:
        raise ValueError(f"{shortly(path)}: has no components; give it as a whole")
    if not component.isdecimal() or int(component) >= len(old):
        raise ValueError(f"{shortly(path)}: is no entry; its components are 0 to {len(old) - 1}")
    new = old.copy()
    new[int(component)] = value
    return new
