"""What pyrod raises besides ``ValueError`` (a refused argument) and ``TypeError``."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pyrod.equilibrium import Equilibrium


class NotConverged(RuntimeError):
    """No equilibrium was reached; ``result`` holds the last iterate and its record."""

    def __init__(self, result: Equilibrium) -> None:
        super().__init__(result)
        self.result = result

    def __str__(self) -> str:
        r = self.result
        return f"{r.status} after {r.iterations} iterations: {r.advice}"


class UnstableWarning(UserWarning):
    """The equilibrium found is unstable: the rod would leave it."""


class StrainWarning(UserWarning):
    """The equilibrium found strains the rod beyond what the model or the edges can mean."""
