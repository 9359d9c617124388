"""Values as messages tell them: in few words, whatever they are."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches
from reprlib import Repr
from typing import Any

_SHORT = Repr()
_SHORT.maxstring = _SHORT.maxother = 80


def shortly(value: Any) -> str:
    """Its ``repr``; of long ones the beginning and the end, on one line."""
    return " ".join(_SHORT.repr(value).split())


def listed(names: Any, most: int = 30) -> str:
    """Names behind each other; of many the first, and how many more there are."""
    names = list(map(str, names))
    more = f" and {len(names) - most} more" if len(names) > most else ""
    return ", ".join(names[:most]) + more


SYNONYMS = {
    "acceleration": ("g", "gravity"),
    "Clamp": ("Fixed", "FixedSupport", "Support", "FixedBC", "OneEndFixedBC", "Encastre"),
    "Force": ("PointLoad", "PointForce", "Load", "EndpointForces", "EndForce"),
    "Hinge": ("BallJoint", "Pin", "PinnedSupport"),
    "Rod": ("Beam", "Cable", "CosseratRod", "Wire", "StraightRod", "Strip"),
    "Scene": ("Model", "System", "Structure", "Simulator", "Problem", "Assembly"),
    "Section": ("CrossSection", "Profile"),
    "Tendon": ("String", "Muscle", "Actuator"),
    "actuators": ("tendons", "cables", "muscles"),
    "at": ("position", "place", "where", "s", "point", "location"),
    "bending": ("stiffness",),
    "colour_by": ("color_by", "color", "colour", "c"),
    "converged": ("success", "ok"),
    "curvature": ("kappa", "K0", "curvatures"),
    "density": ("rho", "mass_density"),
    "E": ("youngs_modulus", "young", "modulus", "youngs", "young_modulus"),
    "cosserat": ("timoshenko", "simo-reissner", "shearable"),
    "edge_lengths": ("lengths", "h", "ds"),
    "edges": ("n", "n_edges", "num_edges", "elements", "n_elements", "segments", "nodes", "number"),
    "EI1": ("EI", "I1", "bending_stiffness"),
    "end": ("stop", "to", "right", "tip", "top", "last", "free"),
    "follower": ("follows", "following", "local", "body"),
    "force": ("forces", "F", "internal_force", "n", "section_force"),
    "forces": ("moments", "moment", "force", "internal"),
    "force_per_length": ("force", "load", "q"),
    "frame": ("orientation", "rotation", "quaternion", "director", "directors"),
    "frames": ("directors", "orientations", "quaternions", "rotations", "Q"),
    "Gamma": ("strain", "strains", "gamma", "sigma"),
    "GJ": ("torsion", "GI", "torsional_stiffness", "GIt"),
    "height": ("h", "thickness", "depth"),
    "inextensible": ("kirchhoff", "Kirchhoff", "euler", "bernoulli", "euler-bernoulli"),
    "index": ("stability", "stability_index", "morse_index"),
    "K": ("curvature", "curvatures", "kappa", "bending"),
    "length": ("L", "base_length"),
    "mass_per_length": ("rhoA", "mass", "linear_density", "density"),
    "moment": ("moments", "M", "torque", "couple", "internal_moment"),
    "moment_per_length": ("moment", "torque", "q"),
    "nu": ("poisson", "poisson_ratio", "poissons_ratio"),
    "outer_radius": ("radius", "r", "outer", "R"),
    "positions": ("x", "r", "points", "coordinates", "centerline", "centreline", "position"),
    "radius": ("r", "diameter", "base_radius"),
    "reactions": ("support_forces", "support_reactions"),
    "rods": ("rod", "beams"),
    "section": ("cross_section", "profile", "material"),
    "solve": ("run", "simulate", "equilibrium", "equilibrate", "minimize", "statics"),
    "stable": ("is_stable",),
    "start": ("left", "base", "root", "first", "bottom", "begin", "origin"),
    "stiffness": ("k", "constant"),
    "supports": ("support", "clamp", "clamps", "bc", "bcs", "boundary_conditions", "constraints"),
    "loads": ("load", "force", "forces"),
    "tangent": ("direction", "axis"),
    "tip": ("end", "tip_position", "end_position"),
    "tol": ("tolerance", "rtol", "atol", "eps", "accuracy"),
    "torsion": ("torsional_stiffness", "rotational_stiffness", "kt"),
    "width": ("w", "b", "breadth"),
}
"""What others call what has these names here."""


def meant(word: str, names: Iterable[str]) -> str:
    """What was meant, as the end of a sentence; nothing if no name is near.

    First a name that others spell so, then those that look alike, then those that have it in them.
    """
    names = list(names)
    found = [name for name in names if word in SYNONYMS.get(name, ())]
    if not found:
        low = {name.lower(): name for name in reversed(names)}
        found = [low[near] for near in get_close_matches(word.lower(), low, 2, 0.7)]
    if not found and len(word) > 2:
        found = [name for name in names if word.lower() in name.lower()][:3]
    return f"; did you mean {' or '.join(found)}?" if found else ""
