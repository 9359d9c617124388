"""The smallest model of a scene whose error is below a tolerance."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace

import numpy as np

from pyrod.base.arrays import number
from pyrod.base.calls import spelled
from pyrod.base.immutable import Array, Immutable
from pyrod.models.effects import Of, Quantity, effect, out_of_plane_index
from pyrod.result.equilibrium import Equilibrium
from pyrod.result.errors import NotConverged
from pyrod.rod.models import MODELS
from pyrod.rod.section import Model
from pyrod.scene.planarity import is_planar
from pyrod.scene.scene import Scene, Space, checked_scene
from pyrod.solving.run import solved


@dataclass(frozen=True, eq=False)
class Choice(Immutable):
    """The smallest model of a scene whose error is below a tolerance."""

    space: Space  #: in which the scene is solved
    model: Model  #: of all its rods
    error: float  #: what the strains that the model leaves out would change, to first order
    sizes: dict[str, float]
    """What each would change, "extension" and "shear" in the poorest model that was solved,
    "space" in the planar solution. Infinite: it cannot be left out."""
    text: str  #: the choice in words
    scene: Scene = field(repr=False)  #: the scene in this model
    result: Equilibrium = field(repr=False)  #: its equilibrium on the edges that it has


@spelled
def smallest_model(scene: Scene, tol: float, quantity: Quantity | None = None) -> Choice:
    """The smallest model whose results differ by less than a tolerance from those of the richest.

    The richest has all strains whose stiffnesses are finite, whatever the models of the rods, and
    is spatial unless the scene is declared planar. A spatial scene that lies in the plane of a1 and
    a3 becomes planar, if its planar solution is stable out of the plane. All is solved on the
    scene's own edges, so a coarse scene will do.

    Parameters
    ----------
    scene : `Scene`
        A scene.
    tol : float
        The largest change that may be left out: of `Effect.size`, or of the quantity.
    quantity : function
        A function of an `Equilibrium` whose relative change counts instead.

    Raises
    ------
    NotConverged
        No equilibrium is found even in the richest model.
    """
    checked_scene(scene)
    tol = number(tol, "tol")
    if not tol > 0:
        raise ValueError(f"tol: must be positive, got {tol}")
    plane = is_planar(scene)
    if plane.plane != "a1-a3" and scene.space == "spatial":
        why = "it lies in the plane of a2 and a3" if plane else plane.why
        return _climb(scene, "spatial", tol, quantity, f" ({why})")
    planar = _climb(scene, "planar", tol, quantity)
    index = None if plane.why else out_of_plane_index(planar.result)
    if index and scene.space == "spatial":
        return _climb(scene, "spatial", tol, quantity, " (in its plane it is unstable)")
    told = f"; out of the plane it is {'unstable' if index else 'stable'}"
    if index is None:
        told = f"; in space {plane.why or 'the loads have no potential'}"
    sizes = {**planar.sizes, "space": _size_of_effect(planar.result, "space", quantity)}
    return replace(planar, sizes=sizes, text=planar.text + told)


def _climb(
    scene: Scene, space: Space, tol: float, quantity: Quantity | None, why: str = ""
) -> Choice:
    """From the poorest model up, until what is left out is below the tolerance."""
    sizes: dict[str, float] = {}
    for model in MODELS[:-1]:
        modelled = in_model(scene, model, space)
        try:
            result = solved(modelled.refined(0))
        except (NotConverged, ValueError):  # such as clamps that are too far apart
            sizes["extension" if model == "inextensible" else "shear"] = np.inf
            continue
        for of in ("extension", "shear"):
            sizes.setdefault(of, _size_of_effect(result, of, quantity))
        error = _size_of_effect(result, "strains", quantity)
        if error <= tol:
            break
    else:
        model, error = MODELS[-1], 0.0
        modelled = in_model(scene, model, space)
        result = solved(modelled.refined(0))
    text = f"{space}{why}, {model}: {_sizes_in_words(sizes, tol)}"
    return Choice(space, model, error, sizes, text, modelled, result)


def in_model(scene: Scene, model: Model, space: Space | None = None) -> Scene:
    """The scene with another model of all rods, and perhaps in another space."""
    rods = tuple(rod.in_model(model) for rod in scene.rods)
    return replace(scene, rods=rods, space=space or scene.space)


def _size_of_effect(result: Equilibrium, of: Of, quantity: Quantity | None) -> float:
    try:
        found = effect(result, of, quantity)
    except NotConverged:
        return np.inf
    if quantity is None or found.quantity is None:
        return found.size
    largest = max(_most(quantity(result)), _most(quantity(found.predicted)))
    return _most(found.quantity) / (largest or 1.0)


def _most(values: float | Array) -> float:
    return float(np.abs(values).max())


def _sizes_in_words(sizes: dict[str, float], tol: float) -> str:
    def words() -> Iterator[str]:
        for of, size in sizes.items():
            if np.isinf(size):
                yield f"{of} cannot be left out"
            elif size == 0:
                yield f"{of} would change nothing"
            else:
                yield f"{of} changes results by {size:.2g}"

    return f"{', '.join(words())} (tol {tol:g})"
