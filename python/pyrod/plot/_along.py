"""Quantities along the rods: strains, section forces and moments."""

from __future__ import annotations

from typing import Any

import numpy as np

from pyrod.base.immutable import Array
from pyrod.base.optional import need
from pyrod.pictures.measure import symbol_of
from pyrod.result.equilibrium import Equilibrium
from pyrod.result.fields import KINDS, field
from pyrod.result.rods import RodEquilibrium
from pyrod.rod.models import STRAINS

PANELS = {"strains": ("K", "Gamma"), "forces": ("force", "moment")}
"""The quantities of a picture, one below the other."""
AT_REST = {"K": " - K0", "Gamma": " - e3"}
"""What is subtracted, so that a rod at rest has none."""
LINES = ("-", "--", ":")
MOST_MARKERS = 40  # more vertices need none to be seen


def draw_along(
    result: Equilibrium, names: tuple[str, ...], axes: Any, style: dict[str, Any]
) -> Any:
    """One panel per quantity."""
    if axes is None:
        pyplot = need("matplotlib.pyplot", "plot")
        _, axes = pyplot.subplots(len(names), sharex=True, layout="constrained")
    axes = np.ravel(axes)
    if len(axes) != len(names):
        raise ValueError(f"ax: expected {len(names)} axes for {', '.join(names)}, got {len(axes)}")
    for ax, name in zip(axes, names, strict=True):
        draw_panel(result, name, ax, style)
    for ax in axes[:-1]:
        ax.set_xlabel("")
    return axes


def draw_panel(result: Equilibrium, name: str, ax: Any, style: dict[str, Any]) -> None:
    """The components of a quantity over arc length.

    Of one rod the components have a colour each, of several the rods, and components a line style.
    """
    kind, several = KINDS[name], len(result.rods) > 1
    for number, rod in enumerate(result.rods):
        values = field(rod, name).values - _at_rest(rod, name)
        for i in _components(rod, name):
            symbol = symbol_of(kind, kind.components[i])
            look = {"color": f"C{number}", "linestyle": LINES[i]} if several else {"color": f"C{i}"}
            look["label"] = f"rod {number}: {symbol}" if several else symbol
            _draw_values(ax, rod, kind.place, values[:, i], {**look, **style})
    ax.axhline(0.0, color="0.8", linewidth=0.8, zorder=0)
    ax.set(
        xlabel="arc length s [m]",
        ylabel=f"{kind.label}\n{kind.symbol}{AT_REST.get(name, '')} [{kind.unit or '1'}]",
    )
    _draw_legend(result, name, ax)


def _draw_legend(result: Equilibrium, name: str, ax: Any) -> None:
    """Of several rods one entry for each in its colour, and one for each component in its style."""
    handles = ax.get_legend_handles_labels()[0]
    if not handles:
        ax.text(0.5, 0.5, "the model has none", ha="center", transform=ax.transAxes)
    elif len(result.rods) == 1:
        ax.legend(fontsize="small")
    else:
        line = need("matplotlib.lines", "plot").Line2D
        rods = range(len(result.rods))
        entries = [line([], [], color=f"C{i}", label=f"rod {i}") for i in rods]
        entries += [
            line([], [], color="0.3", linestyle=style, label=symbol_of(KINDS[name], component))
            for style, component in zip(LINES, KINDS[name].components, strict=True)
        ]
        ax.legend(handles=entries, fontsize="small", ncols=2)


def _at_rest(rod: RodEquilibrium, name: str) -> Any:
    if name == "K":
        return rod.rod.K0
    return np.array([0.0, 0.0, 1.0]) if name == "Gamma" else 0.0


def _components(rod: RodEquilibrium, name: str) -> tuple[int, ...]:
    """Those that the model has: stretch only, or shear as well."""
    if name != "Gamma":
        return 0, 1, 2
    return tuple(i for i, has in enumerate(STRAINS[rod.rod.model]) if has)


def _draw_values(
    ax: Any, rod: RodEquilibrium, place: str, values: Array, style: dict[str, Any]
) -> None:
    if place == "edge":
        ax.stairs(values, rod.s, baseline=None, **{"linewidth": 1.5, **style})
    else:
        marker = "." if len(rod.s) <= MOST_MARKERS else None
        ax.plot(rod.s, values, **{"marker": marker, **style})
