"""Compute four rods, compare them with exact solutions, time them and draw them.

Prints a table of errors and times, and writes a picture.
"""

from __future__ import annotations

import argparse
import time
from pathlib import Path
from statistics import median
from typing import TYPE_CHECKING, Any

import numpy as np

import pyrod
from pyrod import reference
from pyrod.base.optional import need
from pyrod.cli.output import Output
from pyrod.files.atomic import check_place
from pyrod.reference import Case

if TYPE_CHECKING:
    from matplotlib.axes import Axes

NAME = "demo"
HELP = "compute, check and draw four rods"
EDGES = (32, 64, 128, 256, 512, 1024)
DRAWN = 64  # edges of the rods in the pictures
SCENES = {
    "elastica, F L²/EI = 10": "P1_F10_a90",
    "elastica, F L²/EI = 1000": "P1_F1000_a90",
    "helix under an end moment": "S1_moment_a",
    "45° bend in space": "S2_bathe_P600_Jpolar_k5-6",
}
FAMILY = ("P1_F1_a90", "P1_F10_a90", "P1_F100_a90", "P1_F1000_a90")


Points = dict[str, list[tuple[float, float]]]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """What the command takes."""
    parser.add_argument(
        "picture",
        type=Path,
        nargs="?",
        default=Path("pyrod-demo.png"),
        help="default: pyrod-demo.png",
    )


def run(args: argparse.Namespace, output: Output) -> int:
    """Computes, prints, draws."""
    need("matplotlib", "plot").use("Agg")
    check_place(args.picture)
    rows: list[dict[str, Any]] = []
    curves = table(output, rows)
    draw_panels(curves, args.picture)
    output.text(f"\nrods drawn with n = {DRAWN}: {args.picture.resolve()}")
    output.result({"rows": rows, "picture": str(args.picture.resolve())})
    return 0


def case(name: str) -> Case:
    """An exact solution of the package."""
    return reference.load(reference.folder() / f"{name}.json")[0]


def timed(scene: pyrod.Scene, repeats: int = 15) -> tuple[pyrod.Equilibrium, float]:
    """The equilibrium, and the median time [s] of solving for it, up to the positions."""
    seconds = []
    for _ in range(repeats):
        began = time.perf_counter()
        result = pyrod.solve(scene)
        _ = result.positions  # worked out when they are asked for
        seconds.append(time.perf_counter() - began)
    return result, median(seconds)


def table(output: Output, rows: list[dict[str, Any]]) -> Points:
    """Prints a line per scene and n, and adds it to the rows; returns (time, error) of each."""
    output.text(f"{'scene':28s} {'n':>5s} {'position':>9s} {'frame':>9s} {'energy':>9s}  it   time")
    curves: Points = {}
    for title, name in SCENES.items():
        exact = case(name)
        curves[title] = []
        for n in EDGES:
            result, seconds = timed(exact.scene(n))
            e = exact.errors(result)
            curves[title].append((seconds, e["positions"]))
            rows.append(
                {"scene": title, "edges": n, "errors": e, "iterations": result.iterations}
                | {"seconds": seconds}
            )
            output.text(
                f"{title:28s} {n:5d} {e['positions']:9.1e} {e['frames']:9.1e} {e['energy']:9.1e} "
                f"{result.iterations:3d} {1e3 * seconds:6.2f} ms"
            )
    return curves


def draw_elastica(ax: Axes) -> None:
    for name in FAMILY:
        exact = case(name)
        pyrod.solve(exact.scene(DRAWN)).plot(ax, label=f"F L²/EI = {exact.data['params']['F']}")
        r = exact.sampled("r")
        ax.plot(r[:, 2], r[:, 0], "k.", markersize=3)
    ax.plot([], [], "k.", markersize=3, label="exact")
    ax.set_title("Elastica under a dead tip force")
    ax.set(xlabel="x / L", ylabel="y / L")
    ax.legend(loc="upper right", fontsize=8)


def draw_helix(ax: Any) -> None:
    exact = case("S1_moment_a")
    pyrod.solve(exact.scene(DRAWN)).plot(ax, color="C4")
    ax.plot(*exact.sampled("r").T, "k.", markersize=3)
    ax.set_title("Straight rod under a dead end moment")
    ax.set(xlabel="x / L", ylabel="y / L", zlabel="z / L")
    ax.locator_params(nbins=4)
    ax.view_init(elev=14, azim=-62)


def draw_bend(ax: Any) -> None:
    rest = case("S2_bathe_P600_Jpolar_k5-6")
    scene = rest.scene(DRAWN)
    ax.plot(*scene.rod.at_rest(scene.clamp_position, scene.clamp_frame)[0].T, "--", color="0.6")
    for name, color in (("S2_bathe_P300_Jpolar_k5-6", "C2"), ("S2_bathe_P600_Jpolar_k5-6", "C3")):
        exact = case(name)
        pyrod.solve(exact.scene(DRAWN)).plot(
            ax, color=color, label=f"P = {exact.data['params']['P']}"
        )
        ax.plot(*exact.sampled("r").T, "k.", markersize=3)
    ax.set_title("45° bend, lifted at its tip")
    ax.set(xlabel="x", ylabel="y", zlabel="z")
    ax.legend(loc="upper left", fontsize=8)
    ax.locator_params(nbins=4)
    ax.view_init(elev=22, azim=-38)


def draw_errors(ax: Axes, curves: Points) -> None:
    from matplotlib.ticker import LogLocator

    for (title, points), color in zip(curves.items(), ("C1", "C3", "C4", "C2"), strict=True):
        t, e = np.array(points).T
        ax.loglog(1e3 * t, e, "o-", color=color, markersize=4, label=title)
    for n, (t, e) in zip(EDGES, points, strict=True):
        ax.annotate(f" n = {n}", (1e3 * t, e), fontsize=6, color="0.4")
    ax.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    ax.xaxis.set_major_formatter("{x:g}")
    ax.xaxis.set_minor_formatter("")
    ax.set(xlabel="time of one solve [ms], start straight", ylabel="largest position error / L")
    ax.set_title("Error against time")
    ax.grid(alpha=0.3, which="both")
    ax.legend(fontsize=8)


def draw_panels(curves: Points, picture: Path) -> None:
    """Four panels."""
    from matplotlib import pyplot as plt

    figure = plt.figure(figsize=(12, 9.5), layout="constrained")
    draw_elastica(figure.add_subplot(2, 2, 1))
    draw_helix(figure.add_subplot(2, 2, 2, projection="3d"))
    draw_bend(figure.add_subplot(2, 2, 3, projection="3d"))
    draw_errors(figure.add_subplot(2, 2, 4), curves)
    figure.suptitle("pyrod: computed rods (lines) and exact solutions (dots)")
    figure.savefig(picture, dpi=130)
    plt.close(figure)
