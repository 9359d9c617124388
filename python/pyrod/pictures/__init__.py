"""Pictures of equilibria: what is drawn, and with pyvista and plotly how; see also `pyrod.plot`."""
