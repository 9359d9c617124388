"""Tell what this pyrod is and runs on, or what a scene or result file holds."""

from __future__ import annotations

import argparse
import os
import platform
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

import pyrod
import pyrod._core as _core
from pyrod.cli.output import Output
from pyrod.cli.summary import in_numbers, lines

NAME = "info"
HELP = "versions and paths, or what a file holds"
OPTIONAL = ("matplotlib", "pyvista", "plotly", "pint", "trimesh", "pandas", "xarray", "scipy")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """What the command takes."""
    parser.add_argument("file", type=Path, nargs="?", help="a scene or a result")


def run(args: argparse.Namespace, output: Output) -> int:
    """Prints."""
    if args.file is not None:
        return _describe(args.file, output)
    told = {
        "pyrod": pyrod.__version__,
        "python": platform.python_version(),
        "platform": platform.platform(),
        "cores": os.cpu_count(),
        **_core.build(),
        "package": str(Path(pyrod.__path__[0])),
        "include": str(pyrod.get_include()),
        "cmake": str(pyrod.get_cmake_dir()),
        "numpy": version("numpy"),
        **{name: _version(name) for name in OPTIONAL},
    }
    for name, value in told.items():
        output.text(f"{name:13s} {'not installed' if value is None else value}")
    output.result(told)
    return 0


def _version(package: str) -> str | None:
    try:
        return version(package)
    except PackageNotFoundError:
        return None


def _describe(file: Path, output: Output) -> int:
    held = pyrod.load(file)
    if isinstance(held, pyrod.Equilibrium):
        for line in lines(held):
            output.text(line)
        output.result({"kind": "equilibrium", **in_numbers(held)})
        return 0
    output.text(repr(held))
    for i, rod in enumerate(held.rods):
        output.text(f"  rod {i}: {rod!r}")
    for support in held.supports:
        output.text(f"  {type(support).__name__} at {support.at}")
    for joint in held.joints:
        output.text(f"  {joint.kind} joint of {', '.join(map(str, joint.points))}")
    for load in held.loads:
        output.text(f"  {type(load).__name__}" + (" that follows" if load.follower else ""))
    for actuator in held.actuators:
        output.text(f"  {type(actuator).__name__}, {actuator.given}")
    output.result(
        {
            "kind": "scene",
            "space": held.space,
            "rods": [{"model": r.model, "length": r.length, "edges": r.edges} for r in held.rods],
            "supports": [type(support).__name__ for support in held.supports],
            "joints": [joint.kind for joint in held.joints],
            "loads": [type(load).__name__ for load in held.loads],
            "actuators": [type(actuator).__name__ for actuator in held.actuators],
        }
    )
    return 0
