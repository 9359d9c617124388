"""A catheter whose tip follows a moving target at 1 kHz.

Every millisecond its base is moved by what the tip is off, and the shape is solved for again from
the last one. A number of steps may be given: ``python realtime.py 5000``; 60 000 are a minute.
"""

import sys
from time import perf_counter

import numpy as np

from pyrod import Clamp, Force, Gravity, Material, Rod, Scene, Section, Solver


def target(t: float) -> np.ndarray:
    """Where the tip shall be, from where it is at first [m]."""
    return 0.01 * np.array([np.sin(2 * t), np.sin(3 * t), 1 - np.cos(t)])


def main(steps: int) -> None:
    """Follows the target for so many milliseconds."""
    tube = Section.circle(0.8e-3, Material(E=5e9, nu=0.4, density=1100))
    rod = Rod.precurved(0.2, 32, tube, (8.0, 0.0, 0.0))
    thrust = Force((0, 0.02, 0), follower=True)  # across the tip, wherever that turns
    solver = Solver(Scene(rod, Clamp((0, 0, 0), (1, 0, 0, 0)), [Gravity(), thrust]))

    base = np.zeros(3)
    start = tip = solver.solve().tip
    times, off, residual = np.empty(steps), 0.0, 0.0
    for k in range(steps):
        t = 1e-3 * k
        wanted = start + target(t)
        base = base + wanted - tip
        began = perf_counter()
        result = solver.solve(
            {"supports.0.position": base, "loads.1.force.1": 0.02 * np.cos(2 * t)}
        )
        tip = result.tip
        times[k] = perf_counter() - began
        off = max(off, float(np.linalg.norm(tip - wanted)))
        residual = max(residual, result.residual)
    median, most = np.percentile(times, [50, 99.9]) * 1e6
    print(
        f"per step: median {median:.0f}, 99.9 % below {most:.0f}, longest {times.max() * 1e6:.0f} "
        f"microseconds; largest residual {residual:.1e} N m; the tip is at most {off * 1e3:.3f} mm "
        "off"
    )


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 60_000)
