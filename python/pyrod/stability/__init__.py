"""Where an equilibrium loses its stability as its loads grow."""
