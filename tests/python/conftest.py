"""Settings of all Python tests: the property tests draw the same examples in every run."""

import matplotlib as mpl
from hypothesis import settings

mpl.use("Agg")
settings.register_profile("fixed", derandomize=True, deadline=None, database=None, max_examples=40)
settings.load_profile("fixed")
