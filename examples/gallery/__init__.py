"""Pictures and tables of the geometry of framed curves."""
