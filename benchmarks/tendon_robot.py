"""A robot of four tendons, two parallel and two that wind by a quarter of a turn, with a weight at
its tip: time against error of the tip, of pyrod from Python and of shooting, in C++ and by SciPy.

Usage: tendon_robot.py PROGRAM, with PROGRAM the compiled tendon_shooting.cpp (``make bench`` does
both). Medians of one run, from the description to the tip; each starts from the straight robot.
"""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from functools import partial
from math import cos, sin
from statistics import median
from time import perf_counter

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import fsolve

import pyrod

LENGTH, DISTANCE = 0.24, 8e-3
WIRE = pyrod.Section.circle(0.4e-3, pyrod.Material(E=210e9, nu=0.3))
TENSIONS = (4.0, 1.0, 2.0, 2.0)
ANGLES = np.pi / 2 * np.arange(4)  # of the tendons at the base
TURNS = np.pi / 2 * np.array([0, 0, 1, 1])  # and what is added up to the tip
FORCE = np.array([0.0, 0.05, 0.0])


def offset(start: float, turn: float, s: float) -> tuple[float, float]:
    angle = start + turn * s / LENGTH
    return DISTANCE * cos(angle), DISTANCE * sin(angle)


def scene(edges: int | None) -> pyrod.Scene:
    rod = pyrod.Rod.straight(LENGTH, edges, WIRE, "inextensible")
    ways = [partial(offset, *way) for way in zip(ANGLES.tolist(), TURNS.tolist(), strict=True)]
    tendons = [pyrod.Tendon(*one) for one in zip(ways, TENSIONS, strict=True)]
    return pyrod.Scene(rod, pyrod.Clamp(), pyrod.Force(FORCE), actuators=tendons)


def by_scipy(tolerance: float) -> np.ndarray:
    """The equations of tendon_shooting.cpp, by DOP853 and MINPACK."""
    stiffness = np.array([WIRE.EI1, WIRE.EI2, WIRE.GJ])
    T = np.array(TENSIONS)
    e3 = np.array([0.0, 0.0, 1.0])
    rates = (TURNS / LENGTH)[:, None]

    def routed(s: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        angles = ANGLES + TURNS * s / LENGTH
        c, d = np.cos(angles), np.sin(angles)
        at = DISTANCE * np.stack([c, d, 0 * c], axis=-1)
        across = DISTANCE * np.stack([-d, c, 0 * c], axis=-1)
        return at, rates * across, -(rates**2) * at

    def moment(s: float, u: np.ndarray) -> np.ndarray:
        d, d1, _ = routed(s)
        v = e3 + d1 + np.cross(u, d)
        t = v / np.linalg.norm(v, axis=1, keepdims=True)
        return stiffness * u + T @ np.cross(d, t)

    def rate(s: float, y: np.ndarray) -> np.ndarray:
        R, u = y[3:12].reshape(3, 3), y[12:]
        d, d1, d2 = routed(s)
        v = e3 + d1 + np.cross(u, d)
        size = np.linalg.norm(v, axis=1)
        t = v / size[:, None]
        k = np.diag(stiffness)
        given = T @ np.cross(d1, t)
        for i in range(len(T)):
            D = np.array([np.cross(d[i], e) for e in np.eye(3)]).T
            across = (np.eye(3) - np.outer(t[i], t[i])) / size[i]
            given = given + T[i] * D @ across @ (d2[i] + np.cross(u, d1[i]))
            k = k - T[i] * D @ across @ D
        m = stiffness * u + T @ np.cross(d, t)
        change = np.cross(m, u) - np.cross(e3, R.T @ FORCE)
        spin = np.cross(np.eye(3), u)  # rows e_i x u
        return np.concatenate([R[:, 2], (R @ -spin.T).ravel(), np.linalg.solve(k, change - given)])

    def at_tip(u: np.ndarray) -> np.ndarray:
        start = np.concatenate([np.zeros(3), np.eye(3).ravel(), u])
        run = solve_ivp(rate, (0, LENGTH), start, "DOP853", rtol=tolerance, atol=tolerance)
        return run.y[:, -1]

    u = fsolve(lambda u: moment(LENGTH, at_tip(u)[12:]), np.zeros(3), xtol=tolerance)
    return at_tip(u)[:3]


def timed(call: Callable[[], np.ndarray], repeats: int) -> tuple[float, np.ndarray]:
    times = []
    for _ in range(repeats):
        began = perf_counter()
        tip = call()
        times.append(perf_counter() - began)
    return median(times), tip


def main() -> None:
    exact = pyrod.solve(scene(None), tol=1e-11).tip
    print(f"{'':34}{'ms':>9}{'error / L':>11}")

    def row(name: str, seconds: float, tip: np.ndarray) -> None:
        print(f"{name:34}{1e3 * seconds:9.3f}{np.abs(tip - exact).max() / LENGTH:11.1e}")

    for edges in (8, 16, 32, 64, 128, 256):
        row(f"pyrod, {edges} edges", *timed(lambda n=edges: pyrod.solve(scene(n)).tip, 51))
    for tol in (1e-4, 1e-6, 1e-8, 1e-10):
        row(f"pyrod, tol={tol:g}", *timed(lambda t=tol: pyrod.solve(scene(None), tol=t).tip, 51))
    solver = pyrod.Solver(scene(32))
    forces = iter(np.linspace(0.05, 0.06, 400))

    def again() -> np.ndarray:
        return solver.solve({"actuators.0.tension": 4.0, "loads.0.force.1": next(forces)}).tip

    print(f"{'Solver, 32 edges, next force':34}{1e3 * timed(again, 51)[0]:9.3f}")
    for line in subprocess.check_output([sys.argv[1]], text=True).splitlines():
        steps, seconds, *tip = map(float, line.split())
        row(f"C++ shooting, {steps:.0f} Runge-Kutta steps", seconds, np.array(tip))
    for tolerance in (1e-6, 1e-9):
        row(f"SciPy shooting, {tolerance:g}", *timed(lambda t=tolerance: by_scipy(t), 3))


if __name__ == "__main__":
    main()
