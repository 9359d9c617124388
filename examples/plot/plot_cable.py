"""
A cable between two connectors
==============================

A cable hangs between a wall socket and a plug. The rods are those of the page *A cable between two
connectors*, whose code is run first.
"""

import numpy as np
from gallery import page
from gallery.style import BLUE, GREY, fit, plt, space

from pyrod.rotation import rotate

told = page.run("howto/cable_routing")
figure = plt.figure(figsize=(10.4, 4.2))
grid = figure.add_gridspec(1, 2, width_ratios=(1.2, 1))

# Left: cables of four lengths; the connectors are black. Right: the smallest bending radius.

ax = space(figure, grid[0], elev=16, azim=-60)
shown = [told.results[i] for i in (1, 6, 12, 24)]
for result, colour in zip(shown, plt.get_cmap("viridis")(np.linspace(0, 0.85, 4)), strict=True):
    ax.plot(*result.positions.T, color=colour, lw=3, label=f"{result.rod.length:.2f} m")
for end, way in ((0, -0.05), (-1, 0.05)):
    r, q = shown[0].positions[end], shown[0].vertex_frames[end]
    ax.plot(*np.array([r, r + rotate(q, [0, 0, way])]).T, color="k", lw=7)
fit(ax, np.vstack([result.positions for result in shown]), zoom=1.1)
ax.legend(loc="upper right", title="length")

ax = figure.add_subplot(grid[1])
ax.plot(told.lengths, 1e3 * told.radii, "o-", color=BLUE, ms=4)
ax.axhline(1e3 * told.smallest_radius, color=GREY, ls="--", lw=1)
ax.annotate(
    "7.5 diameters", (1.15, 1e3 * told.smallest_radius), (0, 4),
    textcoords="offset points", color=GREY,
)  # fmt: skip
ax.set(xlabel="length of the cable [m]", ylabel="smallest bending radius [mm]", ylim=(0, None))
