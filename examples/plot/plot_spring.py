"""
A helical spring
================

A spring is a rod whose shape at rest is a helix. Colours tell the torque in the wire. The rods are
those of the page *A helical spring*, whose code is run first.
"""

import numpy as np
from gallery import page
from gallery.style import BLUE, GREY, fit, plt, space
from mpl_toolkits.mplot3d.art3d import Line3DCollection

import pyrod

told = page.run("howto/spring")
figure = plt.figure(figsize=(10.4, 4.2))
left, right = figure.add_gridspec(1, 2)

# Left: at rest, and drawn out by 60 and 150 mm.

ax = space(figure, left, elev=12, azim=-90)
for k, extension in enumerate((0.0, 0.06, 0.15)):
    result = pyrod.solve(told.drawn(extension))
    r = result.positions + np.array([0.06 * k, 0, 0])
    wire = Line3DCollection(np.stack([r[:-1], r[1:]], axis=1), cmap="viridis", lw=2.5)
    wire.set(array=np.abs(result.material_moment[1:, 2]), clim=(0, 4))
    ax.add_collection3d(wire)
fit(ax, np.array([[-0.01, -0.01, 0], [0.13, 0.01, 0.19]]), zoom=1.5)
figure.colorbar(wire, ax=ax, shrink=0.6, label="torque [N m]")

# Right: the force that draws it.

extensions = np.linspace(0, 0.2, 41)
forces, result = [], None
for x in extensions:
    result = pyrod.solve(told.drawn(x), start=result)
    forces.append(told.pull(result))
ax = figure.add_subplot(right)
ax.plot(1e3 * extensions, forces, color=BLUE, label="the rod")
ax.plot(1e3 * extensions, told.textbook * extensions, "--", color=GREY, label="G d⁴ / 8 D³ N")
ax.set(xlabel="drawn out by [mm]", ylabel="force [N]")
ax.legend(loc="upper left")
