"""Solve a scene file, print what is found, and write files and a picture of it."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

import pyrod
from pyrod.cli.output import Output
from pyrod.cli.summary import in_numbers, lines
from pyrod.document import load_file
from pyrod.files import check_target
from pyrod.result.equilibrium import Equilibrium

NAME = "solve"
HELP = "solve a scene file"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """What the command takes."""
    parser.add_argument("scene", type=Path, help="scene file (.toml or .json)")
    parser.add_argument("--tol", type=float, help="largest relative error; default: the file's")
    parser.add_argument(
        "--model",
        choices=["auto", "cosserat", "extensible", "inextensible"],
        help="model of all rods; auto: the smallest that will do",
    )
    parser.add_argument(
        *("-o", "--output"),
        type=Path,
        action="append",
        default=[],
        help="file for the result, by its suffix (.vtp .vtu .csv .npz .json .obj .glb .html ...); "
        "may be given more than once",
    )
    parser.add_argument("--plot", type=Path, help="picture of the shape (.png .svg .pdf)")
    parser.add_argument(
        "--eigenvalue", action="store_true", help="find the lowest eigenvalue and mode, too"
    )
    parser.add_argument(
        "--any", action="store_true", help="take an unstable equilibrium if it is the nearest"
    )
    parser.add_argument(
        *("-v", "--verbose"), action="store_true", help="print a line per iteration"
    )
    parser.add_argument(*("-q", "--quiet"), action="store_true", help="no progress bar, no summary")


def run(args: argparse.Namespace, output: Output) -> int:
    """Solves, reports, writes."""
    content = load_file(args.scene)
    targets = [*args.output, *([args.plot] if args.plot else [])]
    for path in targets:
        check_target(path)
    with output.heeding():
        result = _solved(content.scene, {**content.options, **_given(args)}, args, output)
    for path in targets:
        result.save(path)
    if not args.quiet:
        for line in lines(result):
            output.text(line)
        for path in targets:
            output.text(f"wrote {path}")
    output.result(
        {"scene": str(args.scene), **in_numbers(result), "files": list(map(str, targets))}
    )
    return 0


def _given(args: argparse.Namespace) -> dict[str, Any]:
    """What the command line says; it has precedence over the file."""
    given: dict[str, Any] = {}
    if args.tol is not None:
        given["tol"] = args.tol
    if args.model is not None:
        given["model"] = args.model
    if args.eigenvalue:
        given["eigenvalue"] = True
    if args.any:
        given["stable"] = False
    return given


def _solved(
    scene: pyrod.Scene, how: dict[str, Any], args: argparse.Namespace, output: Output
) -> Equilibrium:
    verbose = args.verbose and not output.json
    progress = not (args.quiet or output.json)
    return pyrod.solve(scene, verbose=verbose, progress=progress, **how)
