"""Robots of one wire and its tendons, in SI units."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

import pyrod
from pyrod import Clamp, Rod, Scene, Section, Tendon

LENGTH, DISTANCE = 0.242, 8e-3
STEEL = pyrod.Material(E=210e9, nu=0.3125)
WIRE = replace(Section.circle(0.4e-3, STEEL), GA1=np.inf, GA2=np.inf, EA=np.inf)
TIP_FORCE = (0.05, 0.1, -0.05)


def helix(s):
    turn = 2 * np.pi * s / LENGTH
    return DISTANCE * np.cos(turn), DISTANCE * np.sin(turn)


def converging(s):
    return DISTANCE * (1 - 0.7 * s / LENGTH), 0.0


def robot(tendons, loads=(), edges=8, space="spatial", rod=None, clamp=None):
    rod = rod or Rod.straight(LENGTH, edges, WIRE, "inextensible")
    return Scene(rod, clamp or Clamp(), loads, space, actuators=tendons)


PARALLEL = Tendon((DISTANCE, 0), 5)
HELICAL = Tendon(helix, 5)
