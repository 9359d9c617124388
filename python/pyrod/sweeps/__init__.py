"""Many solves of one scene whose parameters change, anywhere: see `sweep`."""

from pyrod.sweeps.run import sweep
from pyrod.sweeps.table import Failure, Sweep

__all__ = ["Failure", "Sweep", "sweep"]
