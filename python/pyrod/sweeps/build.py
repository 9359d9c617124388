"""How a sweep makes its scenes: by a function, or from a document whose entries change."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from copy import deepcopy
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Any, Union

from pyrod.base.words import listed, shortly
from pyrod.scene.changes import are_entries, changed
from pyrod.scene.scene import Scene

Source = Union[Callable[..., Scene], Scene, str, "PathLike[str]", Mapping[str, Any]]


@dataclass(frozen=True)
class Edited:
    """Scenes that differ in some entries of a document."""

    document: Mapping[str, Any]

    def __call__(self, **entries: Any) -> Scene:
        """The scene with other values of these entries, named by path: ``loads.0.force.2``."""
        from pyrod.document import read

        document = deepcopy(dict(self.document))
        for path, value in entries.items():
            *above, last = _keys(document, path)
            place: Any = document
            for key in above:
                place = place[key]
            place[last] = value
        return read(document)


@dataclass(frozen=True)
class Changed:
    """Scenes that differ in some entries of one, as `pyrod.Solver` changes them."""

    scene: Scene

    @property
    def document(self) -> Mapping[str, Any]:
        """What tells it from other scenes."""
        return _document(self.scene)

    def __call__(self, **entries: Any) -> Scene:
        """The scene with other values of these entries."""
        if any(isinstance(value, (str, bool, Mapping)) for value in entries.values()):
            return Edited(self.document)(**entries)  # which may have units, or is none
        return changed(self.scene, entries)[0]


def builder_of(source: Source, example: Mapping[str, Any]) -> Callable[..., Scene]:
    """A function that makes the scenes; ``example`` are parameters that it must take.

    Raises
    ------
    ValueError, TypeError
        It does not take them; there is no such entry.
    """
    if callable(source):
        _refuse_arguments(source, example)
        return source
    if isinstance(source, Scene) and are_entries(source, example):
        return Changed(source)
    edited = Edited(_document(source))
    for path in example:
        _keys(edited.document, path)
    return edited


def _document(source: Any) -> Mapping[str, Any]:
    if isinstance(source, Mapping):
        return source
    if isinstance(source, Scene):
        from pyrod.document import write

        return write(source)
    if not isinstance(source, (str, PathLike)):
        raise TypeError(
            "scene: expected a function that returns a Scene, a Scene, a scene file or its "
            f"content, got a {type(source).__name__}"
        )
    from pyrod.document.files import parsed, text_of

    path = Path(source)
    return parsed(path, text_of(path))


def _refuse_arguments(function: Callable[..., Scene], example: Mapping[str, Any]) -> None:
    try:
        inspect.signature(function).bind(**example)
    except ValueError:
        return  # it does not tell what it takes
    except TypeError as error:
        name = getattr(function, "__name__", "the function")
        raise TypeError(
            f"scene: {name}({', '.join(example)}) cannot be called with these parameters: {error}"
        ) from None


def _keys(document: Any, path: str) -> list[str | int]:
    """The keys along a path, which leads to an entry."""
    keys: list[str | int] = []
    for word in path.split("."):
        choice = _choice(document)
        if word not in choice:
            there = ".".join(map(str, keys)) or "the scene"
            entries = listed(choice) or "no entries"
            raise ValueError(f"parameters: {shortly(path)} is no entry; {there} has {entries}")
        keys.append(choice[word])
        document = document[keys[-1]]
    return keys


def _choice(document: Any) -> dict[str, str | int]:
    if isinstance(document, Mapping):
        return {str(key): key for key in document}
    if isinstance(document, list):
        return {str(number): number for number in range(len(document))}
    return {}
