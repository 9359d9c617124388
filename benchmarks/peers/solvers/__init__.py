"""One module per solver, all with the same interface; `measure.py` says which."""
