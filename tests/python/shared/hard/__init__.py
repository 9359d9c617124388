"""Hard cases: scenes that solvers of rods fail at, each with what is known of its equilibrium.

`test_hard_cases.py` tests them, and `benchmarks/hard_cases.py` prints a table of them.
"""

from hard.cantilevers import CANTILEVERS
from hard.case import Hard
from hard.columns import COLUMNS
from hard.networks import NETWORKS
from hard.spans import SPANS

CASES: list[Hard] = [*CANTILEVERS, *COLUMNS, *SPANS, *NETWORKS]
