"""Solving scenes as they are, one or many."""
