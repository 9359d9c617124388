"""
How a preloaded spring vibrates
===============================

Frequencies of a coil spring that is pressed together, along its axis and across, and the two modes.
The spring is that of the page *The frequencies of a preloaded spring*, whose code is run first.
"""

import numpy as np
from gallery import page
from gallery.style import BLUE, GREY, ORANGE, plt

import pyrod

told = page.run("howto/spring_frequency")
figure = plt.figure(figsize=(10.4, 4.2))
left = figure.add_subplot(1, 3, 1)

# Left: along the axis preload changes little; across, the spring buckles.

left.plot(100 * told.shares, told.surges, "o-", color=BLUE, label="along the axis")
left.plot(100 * told.shares, told.sways, "o-", color=ORANGE, label="across")
left.axhline(0.5 * np.sqrt(told.k / told.m), color=GREY, ls="--", lw=1, label="½ √(k/m)")
left.axvline(100 * told.haringx, color=GREY, ls=":", lw=1, label="buckles (Haringx)")
left.set(xlabel="pressed together by [%]", ylabel="frequency [Hz]", ylim=(0, None))
left.legend()

# Right: the modes, between the shapes farthest out.

modes = pyrod.linearised(pyrod.solve(told.pressed(0.1))).modes(6)
along = (told.masses * modes.shapes[0][:, :, 2] ** 2).sum(axis=1) > 0.5
for place, number, colour in ((2, np.argmin(along), ORANGE), (3, np.argmax(along), BLUE)):
    motion = modes.motion(int(number))
    ax = figure.add_subplot(1, 3, place)
    for phase, shade, x in ((0.0, colour, 0.0), (0.5, GREY, 0.05)):
        (r,) = motion.shapes(phase)
        ax.plot(r[:, 0] + x, r[:, 2], color=shade, lw=1)
    ax.set(aspect="equal", xlabel="x [m]", ylabel="z [m]")
    ax.set_title(f"{modes.frequencies[number]:.1f} Hz")
