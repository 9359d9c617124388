"""Equilibria, followed as a parameter of the scene changes, through folds and bifurcations."""

from pyrod.paths.branch import Branch, BranchPoint, SpecialPoint
from pyrod.paths.diagram import Diagram, diagram
from pyrod.paths.follow import follow

__all__ = ["Branch", "BranchPoint", "Diagram", "SpecialPoint", "diagram", "follow"]
