"""Bodies on rods: their weight, and that scenes know them everywhere."""

from __future__ import annotations

import pickle
from pathlib import Path

import numpy as np
import pytest
from support import FLAT, X, Y, Z

import pyrod
from pyrod import Clamp, Force, Gravity, PointMass, Rod, Scene, Section, Solver

HEAVY = Section(EI1=4.0, EI2=1.0, GJ=2.0, mass_per_length=0.1)


@pytest.mark.parametrize("at", ["end", 0.5, 0.37])
@pytest.mark.parametrize("tol", [None, 1e-6])
def test_its_weight_is_a_force(at: float | str, tol: float | None) -> None:
    rod = Rod.straight(1.0, 8, HEAVY)
    gravity = Gravity((1.0, 2.0, -3.0))
    ours = pyrod.solve(Scene(rod, Clamp(), [gravity, PointMass(0.7, at)]), tol=tol)
    theirs = pyrod.solve(Scene(rod, Clamp(), [gravity, Force((0.7, 1.4, -2.1), at)]), tol=tol)
    assert ours.positions == pytest.approx(theirs.positions, abs=1e-13)
    assert ours.reaction.force == pytest.approx(theirs.reaction.force, abs=1e-12)


def test_all_gravity_pulls_at_it() -> None:
    rod = Rod.straight(1.0, 8, FLAT)  # without a mass of its own
    body = PointMass(2.0, at=0.5)
    found = pyrod.solve(Scene(rod, Clamp(), [Gravity(X), body, Gravity(0.5 * X)]))
    expected = pyrod.solve(Scene(rod, Clamp(), Force(3.0 * X, at=0.5)))
    assert found.positions == pytest.approx(expected.positions, abs=1e-13)


def test_without_gravity_it_does_nothing() -> None:
    rod = Rod.straight(1.0, 8, FLAT)
    with_it, without = (
        pyrod.solve(Scene(rod, Clamp(), [Force(X), *more])) for more in ([PointMass(3.0)], [])
    )
    assert np.array_equal(with_it.positions, without.positions)


def test_in_the_plane() -> None:
    rod = Rod.straight(1.0, 8, FLAT)
    flat = Scene(rod, Clamp(), [Gravity(X - Z), PointMass(1.0)])
    assert pyrod.is_planar(flat)
    planar = Scene(rod, Clamp(), flat.loads, space="planar")
    assert pyrod.solve(planar).tip == pytest.approx(pyrod.solve(flat).tip, abs=1e-9)
    aslant = pyrod.is_planar(Scene(rod, Clamp(), [PointMass(2.0), Gravity(X + Y)]))
    assert aslant.why == "load 0 (PointMass) has a component 2 along a2"
    with pytest.raises(ValueError, match="leaves the plane"):
        pyrod.solve(Scene(rod, Clamp(), [PointMass(2.0), Gravity(Y)], space="planar"))


def test_it_may_change(tmp_path: Path) -> None:
    """In sweeps, solvers, derivatives, files and pickles."""
    rod = Rod.straight(1.0, 8, HEAVY)
    scene = Scene(rod, Clamp(), [Gravity(X), PointMass(0.7, at=0.8, inertia=(1, 2, 2.5))])
    solver = Solver(scene)
    solver.solve()
    heavier = Scene(rod, Clamp(), [Gravity(X), PointMass(1.4, at=0.8)])
    expected = pyrod.solve(heavier).tip
    assert solver.solve({"loads.1.mass": 1.4}).tip == pytest.approx(expected, abs=1e-10)
    for suffix in (".toml", ".json"):
        path = tmp_path / f"scene{suffix}"
        scene.save(path)
        assert pyrod.load(path).loads == scene.loads  # type: ignore[union-attr]
    assert pickle.loads(pickle.dumps(scene)).loads == scene.loads
    assert "PointMass" in repr(scene)
    assert "PointMass 0.7" in scene._repr_html_()
    h = 1e-4
    tips = [solver.solve({"loads.1.mass": 0.7 + s * h}).tip for s in (1, -1)]
    lin = pyrod.linearised(pyrod.solve(scene))
    slope = lin.jacobian("tip", "loads.1.mass")["loads.1.mass"]
    assert slope == pytest.approx((tips[0] - tips[1]) / (2 * h), rel=1e-6, abs=1e-9)
    assert lin.vjp({"tip": X})["loads.1.mass"] == pytest.approx(slope[0], rel=1e-10)


def test_a_scene_file_with_units(tmp_path: Path) -> None:
    path = tmp_path / "scene.toml"
    path.write_text(
        """
        rods = [{ length = 1.0, edges = 8, section = "wire" }]
        supports = [{ kind = "clamp" }]
        sections.wire = { EI1 = 1, EI2 = 1, GJ = 1 }
        [[loads]]
        kind = "point_mass"
        mass = "300 g"
        inertia = ["2 kg cm^2", 1e-4, 2e-4]
        """,
        encoding="utf-8",
    )
    pytest.importorskip("pint", reason="units need pint")
    (body,) = pyrod.load(path).loads  # type: ignore[union-attr]
    assert body == PointMass(0.3, inertia=(2e-4, 1e-4, 2e-4))


def test_a_critical_load_is_its_weight() -> None:
    """Masses do not grow; what pulls at them does."""
    rod = Rod.straight(1.0, 16, FLAT)
    light = pyrod.critical_load(Scene(rod, Clamp(), [Gravity(-Z), PointMass(2.0)], space="planar"))
    force = pyrod.critical_load(Scene(rod, Clamp(), Force(-2 * Z), space="planar"))
    assert light.factor == pytest.approx(force.factor, rel=1e-9)
    with pytest.raises(ValueError, match="masses do not grow"):
        pyrod.critical_load(Scene(rod, Clamp(), [Gravity(-Z), PointMass(2.0)]), loads=[1])


def test_refusals() -> None:
    for wrong in (0, -1.0, np.inf, np.nan):
        with pytest.raises(ValueError, match="mass"):
            PointMass(wrong)
    for inertia in (
        (1, 1, 3),
        (1, -1, 1),
        (1, 1),
        [[1, 1, 0], [0, 1, 0], [0, 0, 1]],
        (1, 1, np.nan),
    ):
        with pytest.raises(ValueError, match="inertia"):
            PointMass(1.0, inertia=inertia)
    with pytest.raises(ValueError, match="at"):
        PointMass(1.0, at="middle")
    rod = Rod.straight(1.0, 8, FLAT)
    with pytest.raises(ValueError, match="at: "):
        pyrod.solve(Scene(rod, Clamp(), PointMass(1.0, at=2.0)))
    with pytest.raises(ValueError, match="no rod 3"):
        pyrod.solve(Scene(rod, Clamp(), PointMass(1.0, at=(3, "end"))))
