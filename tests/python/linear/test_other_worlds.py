"""Equilibria inside of programs of JAX and PyTorch, where these are installed."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pyrod
from pyrod import Clamp, Force, Hinge, Rod, Scene, Section
from pyrod.linear.parametric import Parametric

ALONE = "PYROD_TESTS_ALONE"
EDGES = 10
POINT = {"force": np.array([0.4, 1.0, -0.2]), "EI": np.array(1.2), "K0": np.array([0.3, 0.5, 0.1])}
OUTPUTS = ["tip", "energy", "reactions.1.force", "moment"]


def imported(world: str) -> Any:
    """JAX has threads, which make later forks of a process warn: it gets one of its own."""
    if ALONE not in os.environ:
        pytest.skip("in a process of its own")
    return pytest.importorskip(world)


@pytest.mark.outside
def test_in_a_process_of_its_own() -> None:
    """All that follows."""
    if not any(map(find_spec, ("jax", "torch"))):
        pytest.skip("neither JAX nor PyTorch is there")
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", __file__]
    run = subprocess.run(
        [*command, "-k", "not process"],
        env={**os.environ, ALONE: "1"},
        capture_output=True,
        text=True,
    )
    assert run.returncode == 0, run.stdout + run.stderr
    assert " passed" in run.stdout


def scene_of(p: dict[str, Any]) -> Scene:
    EI = float(p["EI"])
    section = Section(EI1=EI, EI2=2 * EI**2, GJ=0.8, GA1=40.0, GA2=40.0, EA=60.0)
    rod = Rod.precurved(1.0, EDGES, section, lambda s: tuple(p["K0"]))
    supports = [Clamp((0, 0, 0), frame=(1, 0, 0, 0)), Hinge((0.1, 0.3, 0.8), at=0.8)]
    return Scene(rod, supports, Force(tuple(p["force"])))


def of_flat(p: np.ndarray) -> Scene:
    return scene_of({"force": p[:3], "EI": p[3], "K0": p[4:]})


FLAT = np.concatenate([np.reshape(POINT[name], -1) for name in ("force", "EI", "K0")])


def values(p: np.ndarray) -> np.ndarray:
    """Of all outputs, one after another."""
    result = pyrod.solve(of_flat(p), pyrod.Options(tolerance=1e-12))
    energy = result.bend_twist_energy + result.stretch_shear_energy
    told = [result.tip, [energy], result.reactions[1].force, result.moment.reshape(-1)]
    return np.concatenate(told)


def jacobian() -> np.ndarray:
    """By differences of solves, of sixth order."""
    h, columns = 0.01, []
    for e in np.eye(len(FLAT)):
        ends = [values(FLAT + k * h * e) - values(FLAT - k * h * e) for k in (1, 2, 3)]
        columns.append((45 * ends[0] - 9 * ends[1] + ends[2]) / (60 * h))
    return np.stack(columns, axis=1)


@pytest.fixture(scope="module")
def jax() -> Any:
    jax = imported("jax")
    jax.config.update("jax_enable_x64", True)
    return jax


def flat_solver(jax: Any) -> Any:
    solve = pyrod.jax.solver(of_flat, OUTPUTS)
    return lambda p: jax.numpy.concatenate([solve(p)[name].reshape(-1) for name in OUTPUTS])


def test_jax_values(jax: Any) -> None:
    solve = pyrod.jax.solver(scene_of, OUTPUTS)
    for run in (solve, jax.jit(solve)):
        told = run(POINT)
        assert told["moment"].shape == (EDGES + 1, 3)
        flat = np.concatenate([np.reshape(told[name], -1) for name in OUTPUTS])
        assert flat == pytest.approx(values(FLAT), abs=1e-10)


def test_jax_derivatives(jax: Any) -> None:
    """Forward and backward, compiled and not."""
    f, expected = flat_solver(jax), jacobian()
    size = np.abs(expected).max()
    for way in (jax.jacfwd, jax.jacrev):
        for run in (way(f), jax.jit(way(f))):
            assert np.asarray(run(FLAT)) == pytest.approx(expected, abs=2e-7 * size)


def test_jax_trees(jax: Any) -> None:
    solve = pyrod.jax.solver(scene_of, "energy")
    gradient = jax.jit(jax.grad(solve))(POINT)
    assert set(gradient) == set(POINT)
    assert gradient["EI"].shape == ()
    row = jacobian()[3]
    assert np.asarray(gradient["force"]) == pytest.approx(row[:3], abs=1e-7)
    assert np.asarray(gradient["K0"]) == pytest.approx(row[4:], abs=1e-7)


def test_jax_batches(jax: Any) -> None:
    """Of values and of derivatives, and derivatives of batches."""
    solve = pyrod.jax.solver(of_flat, "tip")
    many = FLAT + 0.1 * np.random.default_rng(1).standard_normal((4, len(FLAT)))
    alone = [np.asarray(solve(p)) for p in many]
    gradient = [np.asarray(jax.grad(lambda q: (solve(q) ** 2).sum())(p)) for p in many]
    assert np.array_equal(jax.jit(jax.vmap(solve))(many), alone)
    each = jax.vmap(jax.grad(lambda q: (solve(q) ** 2).sum()))
    for run in (each, jax.jit(each)):
        assert np.asarray(run(many)) == pytest.approx(np.array(gradient), abs=1e-13)
    of_sum = jax.grad(lambda all_: (jax.vmap(solve)(all_) ** 2).sum())(many)
    assert np.asarray(of_sum) == pytest.approx(np.array(gradient), abs=1e-13)
    ahead = jax.vmap(jax.jacfwd(solve))(many)
    assert np.asarray(ahead) == pytest.approx(np.asarray(jax.vmap(jax.jacrev(solve))(many)))


def test_jax_has_no_second_derivatives(jax: Any) -> None:
    solve = pyrod.jax.solver(of_flat, "energy")
    for way in (jax.jacfwd, jax.jacrev):
        with pytest.raises(NotImplementedError, match="second"):
            way(jax.grad(solve))(FLAT)


def test_jax_refuses_32_bits(jax: Any) -> None:
    jax.config.update("jax_enable_x64", False)
    try:
        with pytest.raises(ValueError, match="64 bits"):
            pyrod.jax.solver(of_flat, "tip")(FLAT)
    finally:
        jax.config.update("jax_enable_x64", True)


def test_the_printed_example_runs(jax: Any) -> None:
    page = Path(__file__).parents[3] / "docs" / "linear_response.md"
    (block,) = re.findall(r"^```py\n(.*?)^```", page.read_text(), re.DOTALL | re.MULTILINE)
    names: dict[str, Any] = {"np": np, "pyrod": pyrod, **vars(pyrod)}
    exec(block, names)
    tips = []
    for EI in (1.99, 2.01):
        scene = names["scene_of"]({**names["start"], "EI": EI})
        tips.append(pyrod.solve(scene).tip[0])
    assert float(names["gradient"]["EI"]) == pytest.approx(np.diff(tips)[0] / 0.02, rel=1e-4)


@pytest.mark.parametrize("world", ["jax", "torch"])
def test_outputs_that_are_turned(world: str) -> None:
    imported(world)
    solver = getattr(pyrod, world).solver
    for wrong in ("tip_frame", ["tip", "frames"], []):
        with pytest.raises(ValueError, match="outputs"):
            solver(of_flat, wrong)


def test_products_in_numpy_agree() -> None:
    """What both worlds are made of, without either."""
    of = Parametric(lambda arrays: of_flat(arrays[0]), [FLAT.shape], OUTPUTS)
    assert of.output_size == 7 + 3 * (EDGES + 1)
    assert of.solve(FLAT) == pytest.approx(values(FLAT), abs=1e-10)
    expected = jacobian()
    forward = np.array([of.push(FLAT, e) for e in np.eye(len(FLAT))]).T
    backward = np.array([of.pull(FLAT, e) for e in np.eye(of.output_size)])
    assert forward == pytest.approx(backward, abs=1e-12 * np.abs(forward).max())
    assert forward == pytest.approx(expected, abs=2e-7 * np.abs(expected).max())


def test_shapes_that_are_not_known() -> None:
    """Before a first scene, where there is none of parameters that are all one."""

    def softer(arrays: list[np.ndarray]) -> Scene:
        EI = float(1 - arrays[0])
        rod = Rod.straight(1.0, 8, Section(EI1=EI, EI2=1.0, GJ=0.8))
        return Scene(rod, Clamp(), Force((0.1, 0.1, 0)))

    of = Parametric(softer, [()], ["tip"])
    with pytest.raises(ValueError, match="without jit"):
        of.output_shapes()
    assert of.solve(np.array([0.5])).shape == (3,)
    assert of.output_shapes() == [(3,)]


def test_scenes_that_jump() -> None:
    def jumps(arrays: list[np.ndarray]) -> Scene:
        stiff = 2.0 if arrays[0] > 1 else 1.0
        rod = Rod.straight(1.0, 8, Section(EI1=stiff, EI2=1.0, GJ=0.8))
        return Scene(rod, Clamp(), Force((0.1, 0.1, 0)))

    of = Parametric(jumps, [()], ["tip"])
    with pytest.raises(ValueError, match="parameter 0"):
        of.push(np.array([1.0]), np.array([1.0]))


def test_torch_gradients() -> None:
    torch = imported("torch")
    solve = pyrod.torch.solver(lambda *p: of_flat(np.hstack(p)), OUTPUTS)
    parts = [torch.tensor(a, requires_grad=True) for a in (FLAT[:3], FLAT[3:4], FLAT[4:])]
    told = solve(*parts)
    flat = torch.cat([told[name].reshape(-1) for name in OUTPUTS])
    assert flat.detach().numpy() == pytest.approx(values(FLAT), abs=1e-10)
    weights = np.cos(np.arange(len(flat)))
    (flat * torch.tensor(weights)).sum().backward()
    gradient = np.concatenate([part.grad.numpy() for part in parts])
    expected = weights @ jacobian()
    assert gradient == pytest.approx(expected, abs=2e-7 * np.abs(expected).max())
    with pytest.raises(ValueError, match="64 bits"):
        solve(*[part.float() for part in parts])
