"""Elastic rods, discretised geometrically: equilibria of Cosserat and Kirchhoff rods.

SI units or any other consistent set. Vectors are arrays of three numbers, frames are unit
quaternions ``(w, x, y, z)`` whose rotation matrix has the directors a1, a2, a3 as columns; a3 is
the normal of the cross-section.
"""

from importlib.metadata import version as _version

from pyrod import curve, rotation
from pyrod._choice import Choice, smallest_model
from pyrod._core import Options
from pyrod._critical import Critical, critical_load
from pyrod._effects import Effect, effect, out_of_plane_index
from pyrod._energy import Energy
from pyrod._files import load, save
from pyrod._folders import get_cmake_dir, get_include
from pyrod._many import solve_many
from pyrod._planarity import Planarity, is_planar
from pyrod._solve import solve
from pyrod._sweep import Sweep, sweep
from pyrod.accuracy import Accuracy
from pyrod.equilibrium import Equilibrium, Reaction, RodEquilibrium
from pyrod.errors import (
    AccuracyWarning,
    CurveWarning,
    NotConverged,
    SceneFileError,
    StrainWarning,
    UnstableWarning,
)
from pyrod.joints import Joint
from pyrod.loads import DistributedForce, DistributedMoment, Force, Gravity, Moment
from pyrod.outline import Outline
from pyrod.rod import Rod
from pyrod.scene import Scene
from pyrod.section import Material, Section
from pyrod.supports import Clamp, Hinge, Pivot, Sleeve, Slider, Spring

__version__ = _version("pyrod")

__all__ = [
    "Accuracy",
    "AccuracyWarning",
    "Choice",
    "Clamp",
    "Critical",
    "CurveWarning",
    "DistributedForce",
    "DistributedMoment",
    "Effect",
    "Energy",
    "Equilibrium",
    "Force",
    "Gravity",
    "Hinge",
    "Joint",
    "Material",
    "Moment",
    "NotConverged",
    "Options",
    "Outline",
    "Pivot",
    "Planarity",
    "Reaction",
    "Rod",
    "RodEquilibrium",
    "Scene",
    "SceneFileError",
    "Section",
    "Sleeve",
    "Slider",
    "Spring",
    "StrainWarning",
    "Sweep",
    "UnstableWarning",
    "critical_load",
    "curve",
    "effect",
    "get_cmake_dir",
    "get_include",
    "is_planar",
    "load",
    "out_of_plane_index",
    "rotation",
    "save",
    "smallest_model",
    "solve",
    "solve_many",
    "sweep",
]
