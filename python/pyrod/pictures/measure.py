"""One number per vertex or edge out of a quantity, to colour rods by."""

from __future__ import annotations

from typing import NamedTuple

from pyrod.base.immutable import Array
from pyrod.base.words import shortly
from pyrod.result.equilibrium import Equilibrium
from pyrod.result.fields import FRAME, KINDS, Carrier, Kind, between_edges, field


class Colouring(NamedTuple):
    """A component or the magnitude of a quantity, of each rod."""

    label: str  #: with symbol and unit
    place: Carrier
    values: tuple[Array, ...]  #: (n + 1,) or (n,) of each rod

    @property
    def at_vertices(self) -> list[Array]:
        """(n + 1,) of each rod; those of edges are means of neighbours, at the ends theirs."""
        if self.place == "vertex":
            return list(self.values)
        return [between_edges(v) for v in self.values]

    @property
    def limits(self) -> tuple[float, float]:
        """Least and largest value of all rods."""
        return min(v.min() for v in self.values), max(v.max() for v in self.values)


def measure(result: Equilibrium, of: str) -> Colouring:
    """What a name stands for.

    Parameters
    ----------
    result : `Equilibrium`
        The equilibrium.
    of : str
        Name of a quantity (`KINDS`), for its magnitude or, of a scalar, its value; or, after a
        point, a component, too: "moment", "moment.x", "material_moment.1".

    Raises
    ------
    ValueError
        No such quantity or component; those that are, are told.
    """
    name, point, component = of.partition(".")
    found = [field(rod, name) for rod in result.rods]
    kind = KINDS[name]
    if not point:
        symbol = f"|{kind.symbol}|" if kind.components else kind.symbol
        return Colouring(labelled(kind, symbol), kind.place, tuple(one.magnitude for one in found))
    if component not in kind.components:
        there = ", ".join(f"{name}.{c}" for c in kind.components) or "no components"
        raise ValueError(f"quantity: {name} has {there}; got {shortly(of)}")
    column = kind.components.index(component)
    values = tuple(one.values[:, column] for one in found)
    return Colouring(labelled(kind, symbol_of(kind, component)), kind.place, values)


def measures() -> tuple[str, ...]:
    """All names that `measure` takes: of each quantity the magnitude, then the components."""
    return tuple(
        name
        for quantity, kind in KINDS.items()
        for name in (quantity, *(f"{quantity}.{c}" for c in kind.components))
    )


def symbol_of(kind: Kind, component: str) -> str:
    """As in docs/notation.md, with the component: m_x, M1, qw."""
    if component.startswith(kind.symbol):
        return component
    return f"{kind.symbol}{'' if kind.components == FRAME else '_'}{component}"


def labelled(kind: Kind, symbol: str) -> str:
    """The quantity in words, its symbol and its unit."""
    return f"{kind.label} {symbol} [{kind.unit or '1'}]"
