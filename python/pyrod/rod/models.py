"""Which strains a model has."""

from __future__ import annotations

from typing import Any, get_args

from pyrod.base.words import meant, shortly
from pyrod.rod.section import Model

STRAINS: dict[Model, tuple[bool, bool, bool]] = {
    "inextensible": (False, False, False),
    "extensible": (False, False, True),
    "cosserat": (True, True, True),
}
"""Shear along a1 and a2, and stretch; from the poorest model to the richest."""
MODELS: tuple[Model, ...] = tuple(STRAINS)


def check_model(model: Any) -> None:
    """Refuses what is none."""
    if not isinstance(model, str) or model not in get_args(Model):
        raise ValueError(
            f"model: expected one of {', '.join(get_args(Model))}, got {shortly(model)}"
            f"{meant(str(model), get_args(Model))}"
        )


def checked_model(model: Model | None) -> Model | None:
    """The same, or None: the richest that finite stiffnesses allow."""
    if model is not None:
        check_model(model)
    return model
