"""Scenes in files, as TOML or JSON; see docs/files.md."""

from __future__ import annotations

import json
import re
import tomllib
from functools import partial
from pathlib import Path
from typing import Any

from pyrod.document.errors import SceneFileError, SceneFileProblem
from pyrod.document.lines import line_of
from pyrod.document.problems import Refused
from pyrod.document.reading import Content, content
from pyrod.document.toml import dumps
from pyrod.document.writing import write
from pyrod.scene.scene import Scene

MOST_BYTES = 100 * 10**6


def load_file(path: str | Path) -> Content:
    """What a file of a scene tells: its scene, the options of its table "solve", its title.

    Raises
    ------
    SceneFileError
        What is wrong with the file, with lines and keys.
    FileNotFoundError
        There is none.
    """
    path = Path(path)
    text = text_of(path)
    document = parsed(path, text)
    if path.suffix == ".json":
        return content_of(path, document)
    return content_of(path, document, text)


def content_of(path: Path, document: dict[str, Any], toml: str | None = None) -> Content:
    """What the document of a file tells; its text, if it is TOML, for the lines of errors."""
    try:
        return content(document)
    except Refused as refused:
        problems = refused.told() if toml is None else refused.told(partial(line_of, toml))
        raise SceneFileError(str(path), problems) from None


def text_of(path: Path) -> str:
    """The text of a file that is not too large."""
    if path.is_dir():
        raise _refusal(path, "it is a folder; give a file")
    if path.stat().st_size > MOST_BYTES:
        raise _refusal(path, f"it is larger than {MOST_BYTES / 1e6:g} MB, so hardly a scene")
    try:
        return path.read_bytes().decode()
    except UnicodeDecodeError as error:
        raise _refusal(path, f"it is not UTF-8 text ({error}); save it as such") from None


def parsed(path: Path, text: str) -> dict[str, Any]:
    """The document of a file in TOML or JSON."""
    if not text.strip():
        raise _refusal(path, 'it is empty; a scene needs at least "rods"')
    try:
        if path.suffix != ".json":
            return tomllib.loads(text + "\n")  # without, errors at the end have no line
        document = json.loads(text, object_pairs_hook=_without_repeats)
    except ValueError as error:
        line = re.search(r"line (\d+)", str(error))
        raise _refusal(path, f"cannot be parsed: {error}", line and int(line[1])) from None
    except RecursionError:
        raise _refusal(path, "cannot be parsed: it is nested too deep") from None
    if not isinstance(document, dict):
        raise _refusal(path, "expected an object with keys such as rods")
    return document


def _without_repeats(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    out: dict[str, Any] = {}
    for key, value in pairs:
        if key in out:
            raise ValueError(f'the key "{key}" is given twice')
        out[key] = value
    return out


def _refusal(path: Path, what: str, line: int | None = None) -> SceneFileError:
    return SceneFileError(str(path), (SceneFileProblem(line, "", what),))


def scene_text(scene: Scene, suffix: str) -> str:
    """The text of a file of a scene."""
    document = write(scene)
    return dumps(document) if suffix == ".toml" else json_text(document, indent=1)


def json_text(document: Any, indent: int | None = None) -> str:
    """JSON in which numbers that are not finite are texts, "inf", for it has none of these."""
    return json.dumps(_finite(document), indent=indent, allow_nan=False) + "\n"


def _finite(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _finite(one) for key, one in value.items()}
    if isinstance(value, list):
        return [_finite(one) for one in value]
    if isinstance(value, float) and value - value != 0:
        return str(value)
    return value
