"""Scenes: rods, what holds and joins them, what acts on them, and whether they lie in a plane."""

from pyrod.scene.actuators import Tendon
from pyrod.scene.joints import Joint
from pyrod.scene.loads import (
    DistributedForce,
    DistributedMoment,
    Force,
    Gravity,
    Load,
    Moment,
    PointMass,
)
from pyrod.scene.planarity import Planarity, is_planar
from pyrod.scene.scene import Scene
from pyrod.scene.supports import Clamp, Hinge, Pivot, Sleeve, Slider, Spring, Support

__all__ = [
    "Clamp",
    "DistributedForce",
    "DistributedMoment",
    "Force",
    "Gravity",
    "Hinge",
    "Joint",
    "Load",
    "Moment",
    "Pivot",
    "Planarity",
    "PointMass",
    "Scene",
    "Sleeve",
    "Slider",
    "Spring",
    "Support",
    "Tendon",
    "is_planar",
]
