"""Prints the tables of convergence of docs/curves.md."""

from __future__ import annotations

from gallery.convergence import (
    EDGES,
    LABELS,
    RANDOM,
    UNIFORM,
    averaged,
    order,
    rebuilding_errors,
)
from gallery.known import CUBIC, CURVES, HELIX, TREFOIL, Known

Seeds = tuple[int | None, ...]


def row(cells: list[str]) -> None:
    print("| " + " | ".join(cells) + " |")


def head(cells: list[str]) -> None:
    row(cells)
    print("|" + "---|" * len(cells))


def table_of(known: Known, seeds: Seeds) -> None:
    """One curve: errors against n, and the order over all of them."""
    levels = [averaged(known, n, seeds) for n in EDGES]
    head([known.name, *(f"n = {n}" for n in EDGES), "order"])
    for key in levels[0]:
        e = [level[key] for level in levels]
        p = order(e[0], e[-1], EDGES[-1] / EDGES[0])
        row([LABELS[key], *(f"{x:.1e}" for x in e), f"{p:.2f}"])


def table_of_orders(seeds: Seeds) -> None:
    """All curves: the error with the largest n, and the order over all n."""
    head(["", *(known.name for known in CURVES)])
    coarse = [averaged(known, EDGES[0], seeds) for known in CURVES]
    fine = [averaged(known, EDGES[-1], seeds) for known in CURVES]
    for key, label in LABELS.items():
        cells = []
        for a, b in zip(coarse, fine, strict=True):
            exact = key not in b or b[key] < 1e-14
            p = "" if exact else f" ({order(a[key], b[key], EDGES[-1] / EDGES[0]):.1f})"
            cells.append(f"{b[key]:.0e}{p}" if key in b else "")
        row([label, *cells])


def table_of_rebuilding() -> None:
    head(["curve", "grid", *(f"n = {n}" for n in EDGES), "order"])
    for known in (HELIX, CUBIC, TREFOIL):
        for grid, seed in (("uniform", None), ("random", 1)):
            e = [rebuilding_errors(known, n, seed) for n in EDGES]
            p = [order(e[0][i], e[-1][i], EDGES[-1] / EDGES[0]) for i in (0, 1)]
            cells = [f"{r:.1e}, {q:.1e}" for r, q in e]
            row([known.name, grid, *cells, f"{p[0]:.2f}, {p[1]:.2f}"])


def main() -> None:
    for title, seeds in (("Uniform grids", UNIFORM), ("Random grids", RANDOM)):
        print(f"\n{title}\n")
        table_of(TREFOIL, seeds)
        print(f"\n{title}, n = {EDGES[-1]}\n")
        table_of_orders(seeds)
    print("\nRebuilt from the curvature: positions / length, frames\n")
    table_of_rebuilding()


if __name__ == "__main__":
    main()
