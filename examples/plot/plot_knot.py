"""
A knot with three ribbons
=========================

The linking number of a ribbon's two edges is the sum of its twist and of its writhe. The writhe
is that of the curve alone; so a ribbon of the same curve with another link has another twist.
"""

import numpy as np
from gallery.knots import EDGES, WIDTH, knot
from gallery.style import BLUE, GREY, ORANGE, fit, plt, ribbon, space

from pyrod.rotation import rotate

p = knot()
figure = plt.figure(figsize=(10, 3.9))
for k, wanted in enumerate((0, 1, 3)):
    framed = p.closed_ribbon(wanted)
    ax = space(figure, 1, 3, k + 1, elev=62, azim=-12)
    around = np.r_[np.arange(EDGES), 0]
    a1 = rotate(framed.vertex_frames, np.array([1.0, 0.0, 0.0]))
    ribbon(ax, p.positions[around], a1[around], WIDTH, BLUE, ORANGE)
    fit(ax, p.positions, zoom=1.2)
    ax.set_title(f"Lk = {framed.link()}", fontsize=12)
    sum_of = f"Tw + Wr = {framed.twist:.4f} + {p.writhe():.4f}".replace("-", "−")
    ax.text2D(0.5, -0.03, sum_of, ha="center", transform=ax.transAxes, color=GREY)
figure.suptitle("The same knot with three ribbons: link = twist + writhe")
