"""Follow the equilibria of a scene file as one of its entries changes.

The entry is a number, named by its path in the scene, lists counted from 0: loads.0.force.2. The
path goes through folds and bifurcations; these are printed.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import pyrod
from pyrod.cli.output import Output
from pyrod.document import load_file
from pyrod.scene.changes import changed
from pyrod.sweeps.table import check_table

NAME = "follow"
HELP = "follow equilibria as an entry changes, through folds and bifurcations"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """What the command takes."""
    parser.add_argument("scene", type=Path, help="scene file (.toml or .json)")
    parser.add_argument("entry", help="of the scene, a number: loads.0.force.2")
    parser.add_argument("start", type=float, help="its value at the start")
    parser.add_argument("stop", type=float, help="its value at which the path ends")
    parser.add_argument("--tol", type=float, help="largest relative error of special values")
    parser.add_argument("--points", type=int, default=500, help="at the most; default: 500")
    parser.add_argument(*("-o", "--output"), type=Path, help="table of the points to write (.csv)")
    parser.add_argument("--plot", type=Path, help="picture of the path (.png .svg .pdf)")
    parser.add_argument(
        *("-y", "--quantity"), default="tip.0", help="what it shows over the entry; default: tip.0"
    )
    parser.add_argument(*("-q", "--quiet"), action="store_true", help="no progress bar, no table")


def run(args: argparse.Namespace, output: Output) -> int:
    """Follows, prints what is special, writes; 1 if the path was lost."""
    if args.output is not None:
        check_table(args.output)
    scene = changed(load_file(args.scene).scene, {args.entry: 0.0})[0]
    with output.heeding():
        branch = pyrod.follow(
            (scene, args.entry, 1.0),
            args.start,
            args.stop,
            args.tol,
            max_points=args.points,
            progress=not (args.quiet or output.json),
        )
    if args.output is not None:
        branch.to_pandas().to_csv(args.output)
    if args.plot is not None:
        branch.plot(y=args.quantity).figure.savefig(args.plot)
    if not args.quiet:
        output.text(repr(branch))
        for point in branch.special:
            output.text(repr(point))
    special = [
        {"kind": p.kind, "value": p.value, "error": p.error, "behind": p.behind}
        for p in branch.special
    ]
    output.result(
        {
            "values": branch.values,
            "indices": branch.indices,
            "special": special,
            "ended": branch.ended,
            "reason": branch.reason,
        }
    )
    return int(branch.ended == "lost")
