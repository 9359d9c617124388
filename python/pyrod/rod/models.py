"""Which strains a model has."""

from __future__ import annotations

from pyrod.rod.section import Model

STRAINS: dict[Model, tuple[bool, bool, bool]] = {
    "inextensible": (False, False, False),
    "extensible": (False, False, True),
    "cosserat": (True, True, True),
}
"""Shear along a1 and a2, and stretch; from the poorest model to the richest."""
MODELS: tuple[Model, ...] = tuple(STRAINS)
