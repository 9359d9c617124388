"""
A catheter
==========

A precurved tube is pushed out of a guide and turned at its base; a force across its plane bends
and twists it. The rods are those of the page *A catheter, or any other continuum robot*, whose
code is run first.
"""

import numpy as np
from gallery import page
from gallery.style import BLUE, GREY, RED, fit, plt, space

import pyrod

told = page.run("howto/continuum_robot")
figure = plt.figure(figsize=(10.4, 4.2))
grid = figure.add_gridspec(1, 2, width_ratios=(1.2, 1))

# Left: every length and every angle, the tips as dots. Right: the tip under a force.

ax = space(figure, grid[0], elev=14, azim=-65)
colours = plt.get_cmap("viridis")(np.linspace(0, 0.85, len(told.lengths)))
for angle in told.angles:
    for length, colour in zip(told.lengths, colours, strict=True):
        r = pyrod.solve(told.catheter(length, angle, pyrod.Gravity((0, -9.81, 0)))).positions
        if length == told.lengths[-1]:
            ax.plot(*r.T, color="0.75", lw=1)
        ax.plot(*r[-1:].T, "o", color=colour, ms=3.5)
ax.plot(*np.array([[0, 0, -0.04], [0, 0, 0]]).T, color="k", lw=4)
fit(ax, told.tips.reshape(-1, 3), zoom=1.4)
ax.set_title("tips for lengths of 30 to 180 mm")

forces = np.linspace(0, 1.0, 21)
tips = [pyrod.solve(told.catheter(0.1, loads=pyrod.Force((0, f, 0)))).tip for f in forces]
ax = figure.add_subplot(grid[1])
ax.plot(forces, 1e3 * np.array(tips)[:, 1], color=BLUE, label="across")
ax.plot(forces, 1e3 * (told.free.tip - tips)[:, 0], color=RED, label="in the plane of the curve")
ax.plot(forces, 1e3 * forces * told.textbook / told.force, "--", color=GREY, label="Castigliano")
ax.set(xlabel="force across the tip [N]", ylabel="the tip moves by [mm]", ylim=(-10, 100))
ax.set_title("100 mm of tube give way")
ax.legend(loc="upper left")
