"""Equilibria as texts, numbers and arrays: what the files of results consist of."""

from __future__ import annotations

from dataclasses import fields
from typing import Any, NamedTuple

import numpy as np

from pyrod.base.immutable import sealed
from pyrod.document import read, write
from pyrod.result.accuracy import Accuracy
from pyrod.result.equilibrium import Equilibrium
from pyrod.result.fields import KINDS
from pyrod.result.rods import Reaction, RodEquilibrium, TendonEquilibrium
from pyrod.scene.scene import Scene

FORMAT = "pyrod result 1"
"""Told in every file; the number grows when older readers cannot read newer files."""

_ARRAYS = {"record", "mode", "rods", "reactions", "tendons"}
_PARTS = {"scene", "accuracy"} | _ARRAYS
_PLAIN = tuple(f.name for f in fields(Equilibrium) if f.name not in _PARTS)
_ROD = tuple(f.name for f in fields(RodEquilibrium) if f.name not in ("rod", "accuracy"))
_ENERGIES = ("bend_twist_energy", "stretch_shear_energy")
_LARGEST = ("largest_K", "largest_force", "largest_moment")
_ROD_ARRAYS = tuple(name for name in _ROD if name not in _ENERGIES + _LARGEST)


class Parts(NamedTuple):
    """A result in parts that every format can hold."""

    head: dict[str, Any]  #: texts, numbers, flags; lists and dicts of them
    arrays: dict[str, np.ndarray]  #: by names such as "rods/0/positions"


def taken_apart(result: Equilibrium) -> Parts:
    """All that is to be known of a result, but for functions of arc length in its scene."""
    head: dict[str, Any] = {"format": FORMAT, "scene": write(result.scene)}
    head |= {name: getattr(result, name) for name in _PLAIN}
    head["energies"] = [[getattr(rod, name) for name in _ENERGIES] for rod in result.rods]
    head["largest"] = [[getattr(rod, name) for name in _LARGEST] for rod in result.rods]
    known = result.accuracy
    head["accuracy"] = known and {f.name: getattr(known, f.name) for f in fields(known)}
    arrays = {f"record/{name}": values for name, values in result.record.items()}
    for number, rod in enumerate(result.rods):
        arrays |= {f"rods/{number}/{name}": getattr(rod, name) for name in _ROD_ARRAYS}
    for number, reaction in enumerate(result.reactions):
        arrays |= {f"reactions/{number}/{k}": v for k, v in reaction._asdict().items()}
    for number, tendon in enumerate(result.tendons):
        arrays[f"tendons/{number}"] = np.array(
            [tendon.tension, tendon.length, *tendon.force_on_base, tendon.slack]
        )
    if result.mode is not None:
        arrays["mode"] = result.mode
    return Parts(head, arrays)


def put_together(parts: Parts) -> Equilibrium:
    """The result whose parts these are.

    Raises
    ------
    ValueError, KeyError, TypeError
        Parts are missing or of a wrong shape.
    """
    head, arrays = parts
    if head["format"] != FORMAT:
        raise ValueError(f'expected the format "{FORMAT}", got {head["format"]!r}')
    scene = read(head["scene"])
    known = head["accuracy"]
    state = {name: head[name] for name in _PLAIN}
    state["accuracy"] = None if known is None else Accuracy(**known)
    state["scene"] = scene
    state["rods"] = _rods(scene, head, arrays, state["accuracy"])
    state["reactions"] = tuple(_reaction(i, arrays) for i in range(len(scene.supports)))
    state["tendons"] = tuple(_tendon(i, arrays) for i in range(len(scene.actuators)))
    state["record"] = {
        name.removeprefix("record/"): values
        for name, values in arrays.items()
        if name.startswith("record/")
    }
    edges = sum(rod.edges for rod in scene.rods)
    state["mode"] = _of_shape(arrays, "mode", (edges, 3)) if "mode" in arrays else None
    return Equilibrium(**sealed(state))


def _rods(
    scene: Scene, head: dict[str, Any], arrays: dict[str, np.ndarray], accuracy: Accuracy | None
) -> tuple[RodEquilibrium, ...]:
    out = []
    sums = zip(scene.rods, head["energies"], head["largest"], strict=True)
    for number, (rod, energy, largest) in enumerate(sums):
        bare = arrays.get(f"rods/{number}/vertex_force")  # files from before there were tendons
        if bare is not None:
            arrays.setdefault(f"rods/{number}/backbone_force", bare)
        values: dict[str, Any] = {
            name: _of_shape(arrays, f"rods/{number}/{name}", _shape(name, rod.edges))
            for name in _ROD_ARRAYS
        }
        values |= zip(_ENERGIES, energy, strict=True)
        values |= zip(_LARGEST, largest, strict=True)
        out.append(RodEquilibrium(rod, **sealed(values), accuracy=accuracy))
    return tuple(out)


def _shape(name: str, edges: int) -> tuple[int, ...]:
    if name not in KINDS:  # the sum of the moments
        return (3,)
    kind = KINDS[name]
    return (edges + (kind.place == "vertex"), len(kind.components))


def _reaction(number: int, arrays: dict[str, np.ndarray]) -> Reaction:
    names = Reaction._fields
    return Reaction(*(_of_shape(arrays, f"reactions/{number}/{name}", (3,)) for name in names))


def _tendon(number: int, arrays: dict[str, np.ndarray]) -> TendonEquilibrium:
    tension, length, *force, slack = _of_shape(arrays, f"tendons/{number}", (6,))
    return TendonEquilibrium(float(tension), float(length), np.array(force), bool(slack))


def _of_shape(arrays: dict[str, np.ndarray], name: str, shape: tuple[int, ...]) -> np.ndarray:
    array = arrays[name]
    if array.shape != shape or array.dtype != np.float64:
        raise ValueError(f"{name}: expected numbers of shape {shape}, got {array.shape}")
    return array
