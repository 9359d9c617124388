"""
Twisted rings
=============

The ends of a straight rod are brought together, after some turns of one of them. A circle bears
up to √3 EI/GJ = 2.31 turns; let go, a ring with three of them passes through itself.
"""

from gallery.style import draw_ribbon, plt, space

from pyrod import Equilibrium, Joint, Rod, Scene, Section, solve


def joined(turns: int, stable: bool = True) -> Equilibrium:
    """The ends of a straight rod brought together, after that many turns of one of them."""
    rod = Rod.straight(1.0, 256, Section(EI1=1.0, EI2=1.0, GJ=0.75))
    return solve(Scene(rod, joints=Joint(("start", "end"), turns=turns)), stable=stable)


figure = plt.figure(figsize=(10.4, 3.3))
shapes = [(1, True), (2, True), (3, False), (3, True)]
for k, (turns, stable) in enumerate(shapes):
    result = joined(turns, stable)
    ax = space(figure, 1, len(shapes), k + 1, elev=35, azim=-60)
    draw_ribbon(ax, result, 0.03, zoom=1.2)
    what = "stable" if result.index == 0 else f"unstable, index {result.index}"
    if turns == 3 and stable:
        what = "let go"
    ax.set_title(
        f"{turns} turn{'s' * (turns > 1)}, {what}\nenergy {result.energy:.1f} EI/L", y=0.88
    )
