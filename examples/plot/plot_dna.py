"""
Rings of DNA
============

Bending a short piece of DNA to a ring costs energy, and more if the turns of its helix do not fit.
The rods are those of the page *A ring of DNA*, whose code is run first.
"""

import numpy as np
from gallery import page
from gallery.style import BLUE, GREY, ORANGE, draw_ribbon, plt, space

told = page.run("howto/dna_ring")
figure = plt.figure(figsize=(10.4, 3.6))
grid = figure.add_gridspec(1, 3, width_ratios=(1, 1, 2))

# Left: 336 base pairs, relaxed and with one turn too many. Right: every length, computed and by
# the formula.

for k, turns in enumerate((0, 1)):
    result = told.ring(turns)
    ax = space(figure, grid[k], elev=35, azim=-60)
    draw_ribbon(ax, result, 4.0, zoom=1.2)
    ax.set_title(f"ΔLk = {turns}: {result.energy:.1f} kT", y=0.88)

pieces = np.arange(200, 401)
ax = figure.add_subplot(grid[2])
ax.plot(pieces, [told.closed(n) for n in pieces], ".-", color=BLUE, ms=3, lw=0.8, label="rings")
ax.plot(pieces, 2 * np.pi**2 * told.bend / (told.rise * pieces), "--", color=ORANGE, label="bend")
ax.axvline(told.bp, color=GREY, lw=0.8, ls=":")
ax.set(xlabel="base pairs", ylabel="energy [kT]", ylim=(0, None))
ax.legend(loc="lower left")
