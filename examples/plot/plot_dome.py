"""
A dome of laths
===============

Laths that lie flat at rest are pinned where they cross; their feet are drawn in, and they are
lifted. Snow on one side pushes the dome through.
"""

from typing import Any

import numpy as np
from gallery.style import fit, plt, space

from pyrod import (
    DistributedForce,
    Equilibrium,
    Gravity,
    Hinge,
    Joint,
    Material,
    Rod,
    Scene,
    Section,
    solve,
)

LATH = Section.rectangle(0.02, 0.04, Material(E=10e9, nu=0.3, density=600))  # timber


def shell(count: int, loads: list[Any], length: float = 10.0) -> Scene:
    """Laths of 10 m, flat at rest and pinned where they cross; their ends are drawn inwards.

    Those in the middle are drawn in by 14 %, the outermost by 6 %.
    """
    places = length * np.linspace(0, 1, count + 2)[1:-1]
    rods, feet = [], []
    for along in np.eye(3)[:2]:
        for y in places:
            beside = y * (np.array([1.0, 1.0, 0.0]) - along)
            short = 0.02 + 0.12 * np.sin(np.pi * y / length)
            number = len(rods)
            rods.append(Rod.straight(length, 72, LATH, "inextensible").placed(
                beside, tangent=along, normal=(0, 0, 1)))  # fmt: skip
            for end, part in (("start", short / 2), ("end", 1 - short / 2)):
                feet.append(Hinge(beside + part * length * along, at=(number, end)))
    joints = [
        Joint(((i, x), (count + k, y)), kind="ball")
        for i, y in enumerate(places)
        for k, x in enumerate(places)
    ]
    return Scene(rods, feet, loads, joints=joints)


def draw_shell(ax: Any, result: Equilibrium, title: str) -> Any:
    """Each edge in the colour of its bending strain."""
    from mpl_toolkits.mplot3d.art3d import Line3DCollection

    for rod in result.rods:
        r = rod.positions
        kappa = np.linalg.norm(rod.K[:, :2], axis=1)
        lines = Line3DCollection(np.stack([r[:-1], r[1:]], axis=1), cmap="viridis", lw=1.8)
        lines.set(array=(kappa[1:] + kappa[:-1]) / 2, clim=(0, 0.6))
        lines.set_clip_on(False)
        ax.add_collection3d(lines)
    fit(ax, np.vstack([rod.positions for rod in result.rods]), zoom=1.25)
    ax.set_title(title)
    return lines


count = 9
numbers = range(2 * count)
lifted = solve(shell(count, [DistributedForce((0, 0, 1.0), i) for i in numbers]))
standing = solve(shell(count, [Gravity()]), start=lifted)
snow = [DistributedForce((0, 0, -60.0 if i < count // 2 else 0.0), i) for i in range(count)]
loaded = solve(shell(count, [Gravity(), *snow]), start=standing)
figure = plt.figure(figsize=(10.4, 3.7))
axes = []
shown = {"its own weight": standing, "snow on one side, 60 N/m": loaded}
for k, (what, result) in enumerate(shown.items()):
    axes.append(space(figure, 1, 2, k + 1, elev=24, azim=-50))
    z = np.concatenate([rod.positions[:, 2] for rod in result.rods])
    heights = f"heights {round(z.min(), 2) + 0:.2f} to {z.max():.2f} m"  # no -0.00
    lines = draw_shell(axes[-1], result, f"{what}\n{heights}")
figure.colorbar(lines, ax=axes, shrink=0.7, pad=0.04, label="curvature [1/m]")
