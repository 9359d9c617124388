"""
A column that buckles
=====================

Euler's column beyond its critical load, and columns that were bent a little from the start. The
rods are those of the page *A column that buckles*, whose code is run first.
"""

import numpy as np
from gallery import page
from gallery.style import BLUE, GREEN, GREY, ORANGE, RED, plt
from scipy.special import ellipe, ellipk

import pyrod

told = page.run("howto/buckling")
figure = plt.figure(figsize=(10.4, 3.9))
left, right = figure.subplots(1, 2)

# Left: shapes beyond the critical load, lying down. The dots are ends of the exact elastica.

for share, colour in ((1.02, BLUE), (1.15, GREEN), (1.5, ORANGE), (2.0, RED)):
    r = pyrod.solve(told.column(share * told.euler)).positions
    left.plot(r[:, 2], np.abs(r[:, 0]), color=colour, label=f"{share} P_c")
for degrees in np.arange(15, 150, 15):
    k2 = np.sin(np.radians(degrees) / 2) ** 2
    K, E = ellipk(k2), ellipe(k2)
    left.plot(2 * E / K - 1, 0, "o", color=GREY, ms=4, mfc="white", clip_on=False, zorder=3)
left.set(aspect="equal", xlabel="z [m]", ylabel="x [m]", xlim=(-0.25, 1), ylim=(0, 0.6))
left.set_title("Bent columns; exact ends of others (dots)")
left.legend(loc="upper right", ncols=2)

# Right: the bend in the middle against the load, for columns that were not straight. Each load is
# solved for from the shape under the one before.

shares = np.linspace(0.02, 1.1, 55)
for bow, colour in ((1e-4, BLUE), (1e-3, GREEN), (1e-2, ORANGE)):
    middle, start = [], None
    for share in shares:
        start = pyrod.solve(told.column(share * told.euler, told.bowed_by(bow)), start=start)
        middle.append(abs(start.positions[32, 0]))
    right.plot(middle, shares, color=colour, label=f"bent by {1e3 * bow:g} mm at rest")
    below = shares[shares < 0.97]
    right.plot(bow / (1 - below), below, ":", color=colour)
right.axhline(1, color=GREY, ls="--", lw=1)
right.set(xlabel="bend in the middle [m]", ylabel="P / P_c", xlim=(0, 0.3), ylim=(0, 1.12))
right.set_title("Columns that were not straight; dotted: Southwell")
right.legend(loc="lower right")
