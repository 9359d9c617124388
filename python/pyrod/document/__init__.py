"""Scenes as plain documents, of which files in TOML and JSON consist; see docs/files.md."""

from __future__ import annotations

from typing import Any

from pyrod.document.errors import SceneFileError
from pyrod.document.files import load_file
from pyrod.document.problems import Refused
from pyrod.document.reading import Content, content
from pyrod.document.writing import write
from pyrod.scene.scene import Scene

__all__ = ["Content", "load_file", "read", "write"]


def read(document: dict[str, Any], where: str = "scene") -> Scene:
    """The scene that a document tells.

    Parameters
    ----------
    document : dict
        As `write` makes it, or a file of a scene tells it.
    where : str
        What the document is called in errors.

    Raises
    ------
    SceneFileError
        What is wrong, all at once.
    """
    try:
        return content(document).scene
    except Refused as refused:
        raise SceneFileError(where, refused.told()) from None
