"""Pictures of equilibria: what is drawn, and with pyvista and plotly how; see also `pyrod.plot`."""

from pyrod.pictures.methods import Pictures

__all__ = ["Pictures"]
