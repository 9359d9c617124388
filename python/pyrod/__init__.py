"""Elastic rods, discretised geometrically: equilibria of Cosserat and Kirchhoff rods.

SI units or any other consistent set. Vectors are arrays of three numbers, frames are unit
quaternions ``(w, x, y, z)`` whose rotation matrix has the directors a1, a2, a3 as columns; a3 is
the normal of the cross-section.
"""

import typing as _typing
from importlib import import_module as _import_module
from importlib.metadata import version as _version

from pyrod import curve, jax, rotation, torch
from pyrod._core import Options
from pyrod.base.folders import get_cmake_dir, get_include
from pyrod.base.words import meant as _meant
from pyrod.curve._warning import CurveWarning
from pyrod.document.errors import SceneFileError
from pyrod.files import load, save
from pyrod.files.curves import LoadedCurve, load_curves
from pyrod.linear import Linearised, Modes, SingularEquilibrium, StabilityModes, linearised
from pyrod.models.choice import Choice, smallest_model
from pyrod.models.effects import Effect, effect, out_of_plane_index
from pyrod.models.solve import solve
from pyrod.paths import Branch, BranchPoint, Diagram, SpecialPoint, diagram, follow
from pyrod.result.accuracy import Accuracy
from pyrod.result.equilibrium import Equilibrium
from pyrod.result.errors import (
    AccuracyWarning,
    NotConverged,
    StrainWarning,
    UnstableWarning,
)
from pyrod.result.rods import Reaction, RodEquilibrium, TendonEquilibrium
from pyrod.result.told import Largest, RodAt
from pyrod.rod.energy import Energy
from pyrod.rod.outline import Outline
from pyrod.rod.rod import Rod
from pyrod.rod.section import Material, Section
from pyrod.scene.actuators import Tendon
from pyrod.scene.joints import Joint
from pyrod.scene.loads import (
    DistributedForce,
    DistributedMoment,
    Force,
    Gravity,
    Moment,
    PointMass,
)
from pyrod.scene.planarity import Planarity, is_planar
from pyrod.scene.scene import Scene
from pyrod.scene.supports import Clamp, Hinge, Pivot, Sleeve, Slider, Spring
from pyrod.solving.many import solve_many
from pyrod.solving.solver import Solver
from pyrod.stability.critical import Critical, critical_load
from pyrod.sweeps import Sweep, sweep

__version__ = _version("pyrod")

if not _typing.TYPE_CHECKING:  # who would find every name

    def __getattr__(name: str) -> object:
        """Modules that are imported when they are first asked for."""
        if name in ("plot", "reference"):
            return _import_module(f"pyrod.{name}")
        guess = "" if name[0] == "_" else _meant(name, __all__)
        raise AttributeError(
            f"module 'pyrod' has no attribute {name!r}{guess}", name=name, obj=None
        )


__all__ = [
    "Accuracy",
    "AccuracyWarning",
    "Branch",
    "BranchPoint",
    "Choice",
    "Clamp",
    "Critical",
    "CurveWarning",
    "Diagram",
    "DistributedForce",
    "DistributedMoment",
    "Effect",
    "Energy",
    "Equilibrium",
    "Force",
    "Gravity",
    "Hinge",
    "Joint",
    "Largest",
    "Linearised",
    "LoadedCurve",
    "Material",
    "Modes",
    "Moment",
    "NotConverged",
    "Options",
    "Outline",
    "Pivot",
    "Planarity",
    "PointMass",
    "Reaction",
    "Rod",
    "RodAt",
    "RodEquilibrium",
    "Scene",
    "SceneFileError",
    "Section",
    "SingularEquilibrium",
    "Sleeve",
    "Slider",
    "Solver",
    "SpecialPoint",
    "Spring",
    "StabilityModes",
    "StrainWarning",
    "Sweep",
    "Tendon",
    "TendonEquilibrium",
    "UnstableWarning",
    "critical_load",
    "curve",
    "diagram",
    "effect",
    "follow",
    "get_cmake_dir",
    "get_include",
    "is_planar",
    "jax",
    "linearised",
    "load",
    "load_curves",
    "out_of_plane_index",
    "rotation",
    "save",
    "smallest_model",
    "solve",
    "solve_many",
    "sweep",
    "torch",
]
