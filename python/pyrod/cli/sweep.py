"""Solve a scene file for many values of its entries, on several cores, into one table.

An entry is named by its path in the file, lists counted from 0: loads.0.force.2=-1:-10:100 solves
for 100 values from -1 to -10; sections.wire.circle.radius=1e-3,2e-3 for two. Of several entries all
combinations are solved.
"""

from __future__ import annotations

import argparse
import os
from concurrent.futures import ProcessPoolExecutor
from contextlib import nullcontext
from pathlib import Path
from typing import Any

import numpy as np

import pyrod
from pyrod.cli.output import Output
from pyrod.document import load_file
from pyrod.sweeps.table import check_table

NAME = "sweep"
HELP = "solve a scene file for many values of its entries"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """What the command takes."""
    parser.add_argument("scene", type=Path, help="scene file (.toml or .json)")
    parser.add_argument(
        "entries",
        nargs="+",
        metavar="ENTRY=VALUES",
        type=_entry,
        help="first:last:count, or values with commas between",
    )
    parser.add_argument("--tol", type=float, help="largest relative error; default: the file's")
    parser.add_argument(
        *("-j", "--jobs"),
        type=int,
        default=0,
        help="processes; default: as many as there are cores; 1: none besides this",
    )
    parser.add_argument(*("-o", "--output"), type=Path, help="table to write (.csv)")
    parser.add_argument(
        "--store",
        type=Path,
        help="file to which what is done is added at once, "
        "and from which a sweep that was stopped goes on",
    )
    parser.add_argument(*("-q", "--quiet"), action="store_true", help="no progress bar, no table")


def _entry(text: str) -> tuple[str, list[Any]]:
    path, equals, values = text.partition("=")
    if not (path and equals and values):
        raise argparse.ArgumentTypeError(f"expected ENTRY=VALUES, got {text!r}")
    return path, _read_values(values)


def _read_values(text: str) -> list[Any]:
    """Numbers where they are numbers; else text, such as "2 mm"."""
    if ":" not in text:
        return [_number(one) for one in text.split(",")]
    try:
        first, last, count = text.split(":")
        numbers = np.linspace(float(first), float(last), max(int(count), 0)).tolist()
    except ValueError:
        raise argparse.ArgumentTypeError(f"expected first:last:count, got {text!r}") from None
    if not numbers:
        raise argparse.ArgumentTypeError(f"count must be at least 1, got {count}")
    return numbers


def _number(text: str) -> int | float | str:
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            continue
    return text


def run(args: argparse.Namespace, output: Output) -> int:
    """Solves, prints a table, writes it; 1 if all cases failed."""
    entries = dict(args.entries)
    if len(entries) < len(args.entries):
        raise ValueError("entries: one is given twice; put its values together, with commas")
    if args.jobs < 0:
        raise ValueError(f"jobs: must not be negative, got {args.jobs}")
    if args.output is not None:
        check_table(args.output)
    options = load_file(args.scene).options
    if args.tol is not None:
        options["tol"] = args.tol
    jobs = args.jobs or os.cpu_count() or 1
    with ProcessPoolExecutor(jobs) if jobs > 1 else nullcontext() as executor:
        table = pyrod.sweep(
            args.scene,
            entries,
            executor=executor,
            store=args.store,
            progress=not (args.quiet or output.json),
            **options,
        )
    if args.output is not None:
        table.save(args.output)
    if not args.quiet:
        _print(table, args.output, output)
    output.result(
        {
            "cases": len(table),
            "seconds": table.elapsed,
            "failures": [failure._asdict() for failure in table.failures],
            "table": {name: table.columns[name] for name in table.columns},
        }
    )
    return int(len(table.failures) == len(table))


def _print(table: pyrod.Sweep, written: Path | None, output: Output) -> None:
    output.text(repr(table))
    for failure in table.failures[:5]:
        output.text(f"case {failure.case} {failure.parameters}: {failure.error}")
    if len(table.failures) > 5:
        output.text(f"... and {len(table.failures) - 5} more")
    if written is not None:
        output.text(f"wrote {written}")
    else:
        output.text(table.to_pandas().to_string(max_rows=20))
