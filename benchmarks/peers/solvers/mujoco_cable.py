"""MuJoCo's cable: rigid bodies on ball joints with springs, relaxed under damping.

Inextensible. The first body is welded; where it is centred on the clamp (a chain longer by half a
body) the clamp is of second order. Springs act explicitly, so the bodies are nearly without mass
and damping sets one time constant for all joints; time step in units of it: `dt`.
"""

from __future__ import annotations

import math

import mujoco
import numpy as np

from peers.measure import Cannot, Plan, Setting, Shape, clock, thinned
from peers.problem import Array, Problem

ABOUT = (
    f"MuJoCo {mujoco.__version__}, plugin mujoco.elasticity.cable; implicitfast, no contacts; half "
    "a body before the clamp; joint damping EI/h; mass and time step the best found for each case"
)
NAMES = ["MuJoCo cable"]
STEPS = [10, 14, 20, 28, 40, 57, 80, 113, 160, 226, 320, 640, 1280, 2560, 5120]


def plan(case: str, name: str) -> Plan:
    reasons = {
        "precurved": "its frames cannot be twisted at rest",
        "clamped": "no weld of the other end without soft constraints",
        "ring": "no closed cable without soft constraints",
        "model-cost": "one model only",
        "scaling": "explicit springs: steps grow with n²",
    }
    if case in reasons:
        raise Cannot(reasons[case])
    tried = [(0.5, 1e-3), (0.25, 1e-3), (0.1, 1e-3), (0.25, 1e-2), (0.1, 1e-2), (0.05, 1e-2)]
    return Plan(
        ["inextensible"],
        [[{"n": n, "dt": dt, "mass": m} for dt, m in tried] for n in (8, 16, 32, 64, 128)],
    )


def solve(problem: Problem, name: str, setting: Setting) -> list[Shape]:
    began = clock()
    model, h = _chain(problem, setting["n"], setting["dt"], setting["mass"])
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    built = clock()
    spent, done, shapes = 0.0, 0, []
    for target in STEPS:
        start = clock()
        _step(model, data, problem, h, target - done)
        spent, done = spent + clock() - start, target
        if data.time < (target - 1) * model.opt.timestep:  # MuJoCo starts anew after a blow-up
            break
        s, r = _points(problem, data, h)
        speed = float(np.abs(data.qvel).max())
        text = f"n={setting['n']}, dt={setting['dt']:g}, mass={setting['mass']:g}, {target} steps"
        shapes.append(Shape(spent, built - began, s, r, speed < 0.1, target, text))
        if speed < 1e-9 or spent > 5:
            break
    if not shapes:
        raise ArithmeticError("the motion blows up")
    return shapes


def _chain(problem: Problem, n: int, dt: float, mass: float) -> tuple[mujoco.MjModel, float]:
    h = problem.L / (n - 0.5)
    r, _ = problem.rest(np.arange(n + 1) * h - h / 2)
    EI, radius = problem.stiffness["EI2"], 0.1 * h
    E, G = 4 * EI / (math.pi * radius**4), 2 * problem.stiffness["GJ"] / (math.pi * radius**4)
    density = mass * EI / problem.L**4 / (math.pi * radius**2)
    vertices = " ".join(f"{x:.15g}" for x in r.ravel())
    text = f"""<mujoco><extension><plugin plugin="mujoco.elasticity.cable"/></extension>
      <compiler autolimits="true"/><size memory="64M"/>
      <option gravity="0 0 0" timestep="{dt:.15g}" integrator="implicitfast">
        <flag contact="disable" constraint="disable"/></option>
      <worldbody><composite type="cable" vertex="{vertices}" initial="none">
        <plugin plugin="mujoco.elasticity.cable"><config key="twist" value="{G:.15g}"/>
          <config key="bend" value="{E:.15g}"/><config key="flat" value="false"/></plugin>
        <joint kind="main" damping="{EI / h:.15g}"/>
        <geom type="cylinder" size="{radius:.15g}" density="{density:.15g}"/>
      </composite></worldbody></mujoco>"""
    return mujoco.MjModel.from_xml_string(text), h


def _step(model: mujoco.MjModel, data: mujoco.MjData, problem: Problem, h: float, n: int) -> None:
    """The dead force acts at the end of the last body, MuJoCo's on its centre of mass."""
    last = model.nbody - 1
    wrench, centre = data.xfrc_applied[last], data.xipos[last]
    position, frame = data.xpos[last], data.xmat[last]
    fx, fy, fz = map(float, problem.force)
    mx, my, mz = map(float, problem.moment)
    wrench[:] = fx, fy, fz, mx, my, mz
    if not problem.force.any():
        mujoco.mj_step(model, data, n)
        return
    for _ in range(n):
        x = position[0] + frame[0] * h - centre[0]
        y = position[1] + frame[3] * h - centre[1]
        z = position[2] + frame[6] * h - centre[2]
        wrench[3:] = mx + y * fz - z * fy, my + z * fx - x * fz, mz + x * fy - y * fx
        mujoco.mj_step(model, data)


def _points(problem: Problem, data: mujoco.MjData, h: float) -> tuple[Array, Array]:
    """Ends of bodies, without the one that is before the clamp."""
    last = data.xpos[-1] + data.xmat[-1].reshape(3, 3)[:, 0] * h
    r = np.vstack([data.xpos[2:], last])
    s = (np.arange(1, len(r) + 1) - 0.5) * h
    some = thinned(len(r) - 1, 17)
    return s[some], r[some]
