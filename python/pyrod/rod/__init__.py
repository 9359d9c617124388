"""Rods: sections, outlines, the laws along a rod, and the rod itself."""

from pyrod.rod.energy import Energy
from pyrod.rod.outline import Outline
from pyrod.rod.rod import Rod
from pyrod.rod.section import Material, Section

__all__ = ["Energy", "Material", "Outline", "Rod", "Section"]
