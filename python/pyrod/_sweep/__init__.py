"""Many solves of one scene whose parameters change, anywhere: see `sweep`."""

from pyrod._sweep.run import sweep
from pyrod._sweep.table import Failure, Sweep

__all__ = ["Failure", "Sweep", "sweep"]
