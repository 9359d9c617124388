"""
Slack and twist
===============

A rod between clamps at 0.8 of its length, one of which was turned about the line between them.
Half a turn is in the frame of the clamp, whole turns are told by ``turns``.
"""

import numpy as np
from gallery.style import draw_ribbon, plt, space

from pyrod import Clamp, Equilibrium, Rod, Scene, Section, solve
from pyrod.rotation import exp


def twisted(turns: float) -> Equilibrium:
    """Between clamps at 0.8 of its length, of which one was turned about the line between them."""
    rod = Rod.straight(1.0, 256, Section(EI1=1.0, EI2=1.5, GJ=0.8))
    whole = int(turns)
    end = Clamp((0, 0, 0.8), exp((0, 0, 2 * np.pi * (turns - whole))), at="end", turns=whole)
    return solve(Scene(rod, [Clamp(), end]))


figure = plt.figure(figsize=(10.4, 4.2))
for k, turns in enumerate((0.5, 1, 2, 4)):
    result = twisted(turns)
    ax = space(figure, 2, 2, k + 1, elev=18, azim=-70)
    draw_ribbon(ax, result, 0.05, zoom=2.1)
    name = "½ a turn" if turns == 0.5 else f"{turns} turn{'s' * (turns > 1)}"
    ax.set_title(f"{name}: energy {result.energy:.1f} EI/L, index {result.index}", y=0.98)
