"""Error against time, log-log: a panel for each case, a line for each solver."""

from __future__ import annotations

from pathlib import Path

import matplotlib as mpl
from matplotlib.figure import Figure

from peers.cases import CASES
from peers.report import Row, compared, of_case, right

COLUMNS = 3


def front(rows: list[Row]) -> list[Row]:
    """Those that nothing cheaper beats, from cheap to dear."""
    best: list[Row] = []
    for row in sorted((r for r in rows if right(r)), key=lambda row: row["time_s"]):
        if not best or row["error"] < best[-1]["error"]:
            best.append(row)
    return best


def draw(rows: list[Row], file: Path) -> None:
    cases = compared(rows)
    solvers = list(dict.fromkeys(r["solver"] for r in rows if r["case"] in cases and right(r)))
    colours = dict(zip(solvers, mpl.colormaps["tab20"].colors * 2, strict=False))
    high = max(1, -(-len(cases) // COLUMNS))
    figure = Figure(figsize=(4 * COLUMNS, 3.2 * high), layout="constrained")
    panels = figure.subplots(high, COLUMNS, squeeze=False).ravel()
    for panel, case in zip(panels, cases, strict=False):
        for solver in solvers:
            points = front([r for r in of_case(rows, case) if r["solver"] == solver])
            mine = solver.startswith("pyrod")
            panel.loglog(
                [1e3 * r["time_s"] for r in points],
                [r["error"] for r in points],
                "o-" if mine else ".-",
                color=colours[solver],
                linewidth=2.2 if mine else 1.2,
                markersize=4,
                label=solver,
            )
        panel.set_title(CASES[case].title, fontsize=8)
        panel.grid(alpha=0.3)
        panel.set(xlabel="time [ms]", ylabel="error / L")
    for panel in panels[len(cases) :]:
        panel.set_axis_off()
    handles, labels = panels[0].get_legend_handles_labels() if cases else ([], [])
    if handles:
        figure.legend(handles, labels, loc="outside lower center", ncols=5, fontsize=8)
    figure.savefig(file, dpi=110)
