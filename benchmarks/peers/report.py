"""From rows of measurements to a page of Markdown and a figure."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Any

from peers.cases import CASES

Row = dict[str, Any]
INTRO = Path(__file__).with_name("intro.md")
LEVELS = (1e-3, 1e-6, 1e-9)
WRONG = 0.1
"""Errors above this are another equilibrium, or none."""


def ours(row: Row) -> bool:
    return row["solver"].startswith("pyrod")


def right(row: Row) -> bool:
    """It converged, and to the solution that is asked for."""
    return bool(row["converged"]) and row["error"] is not None and row["error"] < WRONG


def fastest(rows: Iterable[Row], level: float) -> Row | None:
    """The cheapest row whose error is below the level."""
    good = [row for row in rows if right(row) and row["error"] <= level]
    return min(good, key=lambda row: row["time_s"], default=None)


def ratio(rows: list[Row], peer: Row, level: float) -> float | None:
    """Time of a peer over that of pyrod to the same error in the same model."""
    same = [row for row in rows if ours(row) and row["model"] == peer["model"]]
    best = fastest(same, level)
    return None if best is None else peer["time_s"] / best["time_s"]


def of_case(rows: list[Row], case: str) -> list[Row]:
    return [row for row in rows if row["case"] == case]


def compared(rows: list[Row]) -> list[str]:
    """The cases in which solvers meet, in the order of the list of cases."""
    return [c for c in CASES if c not in ("model-cost", "scaling") and of_case(rows, c)]


def time(seconds: float) -> str:
    """Three digits, with a unit."""
    if seconds < 0.1:
        return f"{1e3 * seconds:.3g} ms"
    return f"{seconds:.3g} s"


def times(x: float) -> str:
    return f"{x:.2g} x" if x < 10 else f"{x:.0f} x"


def markdown_table(header: list[str], lines: Iterable[Iterable[str]]) -> str:
    texts = [header, ["---"] * len(header), *lines]
    return "\n".join("| " + " | ".join(line) + " |" for line in texts)


def summary(rows: list[Row]) -> str:
    """For each case and level: pyrod, the fastest peer, and how many times longer that takes."""
    lines = []
    for case in compared(rows):
        here, line = of_case(rows, case), [CASES[case].title]
        for level in LEVELS:
            peer = fastest((row for row in here if not ours(row)), level)
            same = [r for r in here if ours(r) and (peer is None or r["model"] == peer["model"])]
            mine = fastest(same, level)
            line.append(time(mine["time_s"]) if mine else "-")
            line.append(f"{peer['solver']}, {time(peer['time_s'])}" if peer else "none")
            line.append(times(peer["time_s"] / mine["time_s"]) if peer and mine else "-")
        lines.append(line)
    header = ["case"]
    for level in LEVELS:
        header += [f"pyrod to {level:.0e}", "fastest peer", "ratio"]
    return markdown_table(header, lines)


def _lines_of_case(rows: list[Row]) -> list[list[str]]:
    """One line for each solver and model that gave something right."""
    keys = list(dict.fromkeys((row["solver"], row["model"]) for row in rows))
    lines = []
    for solver, model in keys:
        mine = [row for row in rows if (row["solver"], row["model"]) == (solver, model)]
        good = [row for row in mine if right(row)]
        if not good:
            continue
        line = [solver, model]
        for level in LEVELS:
            best = fastest(good, level)
            if best is None:
                line.append("-")
                continue
            text = f"{time(best['time_s'])} ({best['setting']})"
            more = None if ours(best) else ratio(rows, best, level)
            line.append(text if more is None else f"{text}, {times(more)}")
        best = min(good, key=lambda row: row["error"])
        line += [time(best["build_s"]), f"{best['error']:.1e} in {time(best['time_s'])}"]
        lines.append(line)
    return lines


def _failures(rows: list[Row]) -> list[str]:
    """What did not work: a line for each solver and reason, with the first setting it hit."""
    said: dict[tuple[str, str], Row] = {}
    for row in rows:
        if row.get("note") and not right(row) and not _missing(row):
            said.setdefault((row["solver"], row["note"]), row)
    return [
        f"- {solver}{': ' + row['setting'] if row['setting'] else ''}: {note}"
        for (solver, note), row in said.items()
    ]


def case_page(rows: list[Row], case: str) -> str:
    here = of_case(rows, case)
    header = ["solver", "model", *(f"to {x:.0e}" for x in LEVELS), "build", "best error"]
    parts = [f"### {CASES[case].title}", markdown_table(header, _lines_of_case(here))]
    failures = _failures(here)
    if failures:
        parts.append("Did not work:\n\n" + "\n".join(failures))
    forces = _held(here)
    return "\n\n".join([*parts, forces] if forces else parts)


def _held(rows: list[Row]) -> str:
    """Force and energy at the most accurate row of each solver, where both ends are held."""
    lines = []
    for solver in dict.fromkeys(row["solver"] for row in rows if row.get("force_error")):
        mine = [r for r in rows if r["solver"] == solver and right(r) and r.get("force_error")]
        if not mine:
            continue
        best = min(mine, key=lambda row: row["force_error"])
        energy = best.get("energy_error")
        error = "-" if energy is None else f"{energy:.1e}"
        lines.append([solver, best["setting"], f"{best['error']:.1e}", f"{best['force_error']:.1e}",
                      error, time(best["time_s"])])  # fmt: skip
    header = ["solver", "setting", "positions", "section force", "energy", "time"]
    return markdown_table(header, lines) if lines else ""


def model_cost(rows: list[Row]) -> str:
    here = [row for row in of_case(rows, "model-cost") if right(row)]
    settings = list(dict.fromkeys(row["setting"] for row in here))
    lines = []
    for solver, space in (("pyrod", "planar"), ("pyrod spatial", "spatial")):
        for model in dict.fromkeys(row["model"] for row in here):
            found = {r["setting"]: r for r in here if (r["solver"], r["model"]) == (solver, model)}
            cells = [
                f"{time(found[k]['time_s'])}, {found[k]['error']:.1e}" if k in found else "-"
                for k in settings
            ]
            lines.append([space, model, *cells])
    return markdown_table(["space", "model", *settings], lines)


def scaling(rows: list[Row]) -> str:
    lines = []
    for row in of_case(rows, "scaling"):
        if not right(row):
            continue
        n = int(row["setting"].partition(",")[0].removeprefix("n="))
        each = f"{1e9 * row['time_s'] / n:.0f}"
        lines.append([row["solver"], row["setting"], time(row["time_s"]), each,
                      time(row["build_s"]), f"{row['error']:.1e}"])  # fmt: skip
    header = ["solver", "setting", "time", "ns per edge", "build", "error"]
    return markdown_table(header, lines)


def parallel(rows: list[Row]) -> str:
    here = of_case(rows, "parallel")
    lines = [
        [
            row["setting"],
            time(row["time_s"]),
            times(here[0]["time_s"] / row["time_s"]),
            row.get("note", ""),
        ]
        for row in here
    ]
    return markdown_table(["rods", "time per rod", "faster", ""], lines)


def _missing(row: Row) -> bool:
    return str(row.get("note")).startswith("not installed")


def _settings(about: dict[str, str]) -> str:
    """One line for all names of a solver."""
    names: dict[str, list[str]] = {}
    for solver, text in about.items():
        names.setdefault(text, []).append(solver)
    return "\n".join(f"- {', '.join(solvers)}: {text}" for text, solvers in names.items())


def _cpu() -> str:
    """The processor by name."""
    for line in Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.partition(":")[2].strip()
    return "an unknown processor"


def page(rows: list[Row], about: dict[str, str], figure: str) -> str:
    """The whole report; `figure`: where the picture is."""
    parts = [INTRO.read_text().format(cpu=_cpu()).strip(), f"![Error against time]({figure})"]
    parts += ["## Time to error", summary(rows), "## Case by case"]
    parts += [case_page(rows, case) for case in compared(rows)]
    if of_case(rows, "model-cost"):
        parts += ["### " + CASES["model-cost"].title + " (F L²/EI = 10)", model_cost(rows)]
    if of_case(rows, "scaling"):
        parts += ["### " + CASES["scaling"].title, scaling(rows)]
        failures = _failures(of_case(rows, "scaling"))
        parts += ["Did not work:\n\n" + "\n".join(failures)] if failures else []
    if of_case(rows, "parallel"):
        parts += ["### Many rods on all cores", parallel(rows)]
    parts += ["## Settings", _settings(about)]
    missing = dict.fromkeys(f"- {r['solver']}: {r['note']}" for r in rows if _missing(r))
    if missing:
        parts += ["Not there:", "\n".join(missing)]
    return "\n\n".join(parts) + "\n"
