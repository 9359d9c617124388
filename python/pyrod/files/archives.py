"""Results in NPZ and in JSON: exact, and read again without running any code."""

from __future__ import annotations

import io
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from pyrod.base.words import shortly
from pyrod.document.files import json_text
from pyrod.files.results import FORMAT, Parts, put_together, taken_apart
from pyrod.result.equilibrium import Equilibrium

_HEAD = "head"
_TYPES = ("float64", "int64", "int32", "bool")


def save_npz(result: Equilibrium, path: Path) -> None:
    """Arrays as they are, and one text in JSON for all else."""
    head, arrays = taken_apart(result)
    with path.open("wb") as file:
        np.savez_compressed(file, **{_HEAD: np.array(json_text(head))}, **arrays)  # type: ignore[arg-type]


def save_json(result: Equilibrium, path: Path) -> None:
    """Numbers as the shortest decimals that are read as the same doubles."""
    head, arrays = taken_apart(result)
    plain = {
        name: {"type": str(values.dtype), "shape": values.shape, "values": values.ravel().tolist()}
        for name, values in arrays.items()
    }
    path.write_text(json_text({**head, "arrays": plain}), encoding="utf-8")


def load_npz(path: Path) -> Equilibrium:
    """What `save_npz` wrote."""
    data = path.read_bytes()

    def parts() -> Parts:
        with np.load(io.BytesIO(data), allow_pickle=False) as archive:
            arrays = {name: archive[name] for name in archive.files}
        return Parts(_with_numbers(json.loads(str(arrays.pop(_HEAD)))), arrays)

    return _loaded(path, parts)


def is_result(document: dict[str, Any]) -> bool:
    """Whether a document in JSON is a result, not a scene."""
    return "format" in document


def load_json(path: Path, document: dict[str, Any]) -> Equilibrium:
    """What `save_json` wrote."""

    def parts() -> Parts:
        head = _with_numbers(document)
        return Parts(head, {name: _array(**plain) for name, plain in head["arrays"].items()})

    return _loaded(path, parts)


def _array(type: str, shape: list[int], values: list[Any]) -> np.ndarray:
    if type not in _TYPES:
        raise ValueError(f"arrays are of the types {', '.join(_TYPES)}, not {shortly(type)}")
    return np.array(values, dtype=type).reshape(shape)


def _with_numbers(document: dict[str, Any]) -> dict[str, Any]:
    """Numbers that are not finite in place of their names."""
    return {key: value if key == "scene" else _numbers(value) for key, value in document.items()}


def _numbers(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _numbers(one) for key, one in value.items()}
    if isinstance(value, list):
        return [_numbers(one) for one in value]
    return float(value) if isinstance(value, str) and value in ("inf", "-inf", "nan") else value


def _loaded(path: Path, parts: Callable[[], Parts]) -> Equilibrium:
    try:
        return put_together(parts())
    except Exception as error:  # whatever a foreign or damaged file leads to
        raise ValueError(
            f'{path}: no "{FORMAT}", or damaged ({type(error).__name__}: {error}); save it again'
        ) from None
