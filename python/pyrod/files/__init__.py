"""Saving and loading scenes and results; the suffix of a file tells its format."""

from __future__ import annotations

from collections.abc import Callable
from inspect import Parameter, signature
from pathlib import Path
from typing import Any

from pyrod.base.calls import spelled
from pyrod.document.files import content_of, load_file, parsed, scene_text, text_of
from pyrod.files.archives import is_result, load_json, load_npz, save_json, save_npz
from pyrod.files.atomic import check_place, replacing
from pyrod.files.pictures import save_html, save_picture
from pyrod.files.sheet import save_csv
from pyrod.files.solids import save_painted, save_stl
from pyrod.files.vtk import save_vtp, save_vtu
from pyrod.result.equilibrium import Equilibrium
from pyrod.scene.scene import Scene


def _save_scene(scene: Scene, path: Path) -> None:
    path.write_text(scene_text(scene, path.suffix), encoding="utf-8")


_SCENES: dict[str, Callable[..., None]] = {".toml": _save_scene, ".json": _save_scene}
_RESULTS: dict[str, Callable[..., None]] = {
    ".npz": save_npz,
    ".json": save_json,
    ".csv": save_csv,
    ".vtp": save_vtp,
    ".vtu": save_vtu,
    ".stl": save_stl,
    **dict.fromkeys((".obj", ".ply", ".glb"), save_painted),
    **dict.fromkeys((".png", ".svg", ".pdf"), save_picture),
    ".html": save_html,
}


@spelled
def save(what: Scene | Equilibrium, path: str | Path, **options: Any) -> None:
    """Writes a scene or a result to a file, whose suffix tells the format; see docs/files.md.

    Parameters
    ----------
    what : `Scene` or `Equilibrium`
        A scene (.toml, .json), or a result: exact and to be loaded again (.npz, .json); a table
        (.csv); for ParaView (.vtp, .vtu); the solid (.stl, .obj, .ply, .glb); a picture (.png,
        .svg, .pdf) or a page to look at (.html).
    path : str or Path
        A file that is there is replaced, but only if nothing fails.
    options : bool, int or str
        Of .vtp and .vtu: ``solid=True`` for the surface in place of the centrelines, ``title``; of
        all solids ``sides``, the number of chords of a circle (24); of .obj, .ply and .glb
        ``colour_by``, a quantity such as "moment"; of pictures those of `Equilibrium.plot`.

    Raises
    ------
    ValueError
        An unknown suffix, or one that does not go with ``what``.
    TypeError
        Neither a scene nor a result; an option that the format does not have.
    FileNotFoundError
        There is no such folder.
    ImportError
        The format needs a package that is not installed; which, is told.
    """
    path = Path(path)
    if not isinstance(what, (Scene, Equilibrium)):
        raise TypeError(f"what: expected a Scene or an Equilibrium, got a {type(what).__name__}")
    writer = _writer(type(what), path)
    _check_options(writer, path, options)
    with replacing(path) as temporary:
        writer(what, temporary, **options)


def check_target(path: Path) -> None:
    """Refuses a path to which a result cannot be saved, before there is one.

    Raises
    ------
    ValueError, FileNotFoundError, IsADirectoryError
        As `save`.
    """
    _writer(Equilibrium, path)
    check_place(path)


def _writer(kind: type[Scene] | type[Equilibrium], path: Path) -> Callable[..., None]:
    known = _SCENES if issubclass(kind, Scene) else _RESULTS
    if path.suffix not in known:
        raise ValueError(
            f"{path}: the suffix tells the format, for {kind.__name__} one of {', '.join(known)}"
        )
    return known[path.suffix]


def _check_options(writer: Callable[..., None], path: Path, options: dict[str, Any]) -> None:
    parameters = signature(writer).parameters.values()
    if any(p.kind is Parameter.VAR_KEYWORD for p in parameters):
        return
    known = [p.name for p in parameters if p.kind is Parameter.KEYWORD_ONLY]
    for name in options:
        if name not in known:
            there = ", ".join(known) or "none"
            raise TypeError(f"{name}: {path.suffix} files have the options: {there}")


@spelled
def load(path: str | Path) -> Any:
    """The scene (.toml, .json) or the result (.npz, .json) that a file holds.

    No file makes code run or opens another one.

    Parameters
    ----------
    path : str or Path
        The file.

    Raises
    ------
    SceneFileError
        What is wrong with a scene, with lines and keys; see docs/files.md.
    ValueError
        An unknown suffix; a file of a result that is damaged.
    FileNotFoundError
        There is no such file.
    """
    path = Path(path)
    if path.suffix == ".toml":
        return load_file(path).scene
    if path.suffix == ".npz":
        return load_npz(path)
    if path.suffix != ".json":
        raise ValueError(
            f"{path}: expected a scene (.toml, .json) or a result (.npz, .json); other formats "
            "hold too little to be loaded"
        )
    document = parsed(path, text_of(path))
    return load_json(path, document) if is_result(document) else content_of(path, document).scene
