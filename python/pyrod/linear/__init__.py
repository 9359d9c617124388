"""How equilibria answer to small changes: exact derivatives, compliance, vibration."""

from pyrod._core import SingularEquilibrium
from pyrod.linear.response import Linearised, linearised
from pyrod.linear.stability_modes import StabilityModes
from pyrod.linear.vibration import Modes

__all__ = ["Linearised", "Modes", "SingularEquilibrium", "StabilityModes", "linearised"]
