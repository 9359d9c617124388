"""Equilibria: what was found, how accurate it is, and what is raised or warned of."""
