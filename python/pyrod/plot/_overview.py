"""All that is known of an equilibrium in one figure."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from pyrod.base.optional import need
from pyrod.plot._along import PANELS, draw_panel
from pyrod.plot._mode import draw_mode, stability
from pyrod.plot._shape import draw_shape, new_axes
from pyrod.result.equilibrium import Equilibrium
from pyrod.rod.models import STRAINS

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def overview(result: Equilibrium) -> Figure:
    """The shape, the mode if it is known, the way to the equilibrium, strains, forces and moments.

    Parameters
    ----------
    result : `pyrod.Equilibrium`
        What to draw.

    Returns
    -------
    Figure
        A new one of matplotlib; its title tells status, stability, energy, errors and time.

    Raises
    ------
    ImportError
        matplotlib is not installed: ``pip install 'pyrod[plot]'``.
    """
    pyplot = need("matplotlib.pyplot", "plot")
    names = [name for pair in PANELS.values() for name in pair if _has(result, name)]
    figure = pyplot.figure(figsize=(13, 8), layout="constrained")
    figure.suptitle(_headline(result))
    left, right = figure.add_gridspec(1, 2, width_ratios=(3, 2))
    _draw_shapes(result, figure, left)
    for name, place in zip(names, right.subgridspec(len(names), 1), strict=True):
        ax = figure.add_subplot(place)
        draw_panel(result, name, ax, {})
        ax.set_xlabel("arc length s [m]" if name == names[-1] else "")
    return figure


def _draw_shapes(result: Equilibrium, figure: Any, place: Any) -> None:
    upper, lower = place.subgridspec(2, 1, height_ratios=(3, 2))
    ax = draw_shape(result, new_axes(result, figure, upper), True, None, {})
    ax.set_title("shape", fontsize="medium")
    parts = list(lower.subgridspec(1, 2 if result.mode is not None else 1))
    if result.mode is not None:
        draw_mode(result, new_axes(result, figure, parts[1]), {})
    _draw_record(result, figure.add_subplot(parts[0]))


def _draw_record(result: Equilibrium, ax: Any) -> None:
    """How far from balance the iterates were."""
    residual = result.record["residual"]
    if (residual > 0).any():
        ax.semilogy(range(1, len(residual) + 1), residual, marker=".")
    ax.set(xlabel="iteration", ylabel="residual [N m]")
    ax.set_title("way to the equilibrium", fontsize="medium")


def _has(result: Equilibrium, name: str) -> bool:
    return name != "Gamma" or any(any(STRAINS[rod.rod.model]) for rod in result.rods)


def _headline(result: Equilibrium) -> str:
    rods = f"{len(result.rods)} rods" if len(result.rods) > 1 else repr(result.scene.rod)
    facts = [result.status, stability(result), f"energy {result.energy:.6g} J"]
    if result.accuracy is not None:
        facts.append(str(result.accuracy))
    facts.append(f"{result.iterations} iterations, {1e3 * result.time:.3g} ms")
    return f"{rods}\n{', '.join(facts)}"
