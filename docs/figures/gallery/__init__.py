"""Pictures of framed curves and of rods in equilibrium, and tables of what converges."""
