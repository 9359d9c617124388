"""What a result holds and tells: shapes, strains, pickles, words, and its iterations."""

from __future__ import annotations

import pickle
from dataclasses import FrozenInstanceError, fields

import numpy as np
import pytest
from support import ROUND, SOFT, solved

import pyrod
from pyrod import Clamp, DistributedForce, Force, Moment, Rod, Scene

BENT = Scene(Rod.straight(1.0, 32, ROUND), Clamp(), Force((10, 0, 0)))


def rich_result() -> pyrod.Equilibrium:
    rod = Rod.precurved(1.0, 6, SOFT, (1, 2, 3))
    return solved(rod, Force((1, 2, 3)), DistributedForce(lambda s: (s, 1, 0)), Moment((0.1, 0, 0)))


def arrays(result: pyrod.Equilibrium) -> dict[str, np.ndarray]:
    (rod,) = result.rods
    values = {f.name: getattr(rod, f.name) for f in fields(rod)}
    return {k: v for k, v in values.items() if isinstance(v, np.ndarray)}


def test_shapes_and_consistency() -> None:
    result = rich_result()
    rows = {name: value.shape for name, value in arrays(result).items()}
    assert rows == {
        **dict.fromkeys(("positions", "K", "moment", "material_moment", "load"), (7, 3)),
        **dict.fromkeys(("vertex_force", "vertex_force_before", "backbone_force"), (7, 3)),
        **dict.fromkeys(("K_before", "moment_before"), (7, 3)),
        "load_moment": (3,),
        **dict.fromkeys(("Gamma", "force", "material_force"), (6, 3)),
        "frames": (6, 4),
        "vertex_frames": (7, 4),
    }
    np.testing.assert_array_equal(result.s, result.scene.rod.arc_lengths)
    np.testing.assert_array_equal(result.tip, result.positions[-1])
    np.testing.assert_array_equal(result.tip_frame, result.vertex_frames[-1])
    assert result.energy == result.bend_twist_energy + result.stretch_shear_energy
    assert result.time > 0


def test_strains_are_those_of_the_curve() -> None:
    result = rich_result()
    rod = result.scene.rod
    K, Gamma = pyrod.curve.strains(
        rod.edge_lengths, result.positions, result.frames, result.vertex_frames[0], result.tip_frame
    )
    np.testing.assert_allclose(K, result.K, rtol=0, atol=1e-13)
    np.testing.assert_allclose(Gamma, result.Gamma, rtol=0, atol=1e-13)
    np.testing.assert_allclose(
        result.material_moment, rod.bending * (K - rod.K0), rtol=0, atol=1e-12
    )
    np.testing.assert_allclose(
        result.Gamma - [0, 0, 1], result.material_force / rod.stretching, rtol=0, atol=1e-15
    )


@pytest.mark.parametrize(("model", "rigid"), [("extensible", [0, 1]), ("inextensible", [0, 1, 2])])
def test_excluded_strains_are_zero_exactly(model: str, rigid: list[int]) -> None:
    result = solved(Rod.straight(1.0, 8, SOFT, model), Force((5, -4, 3)))
    np.testing.assert_array_equal(result.Gamma[:, rigid], np.tile(np.eye(3)[2][rigid], (8, 1)))


def test_results_do_not_change() -> None:
    result = rich_result()
    with pytest.raises(FrozenInstanceError):
        result.status = "fine"
    for array in (*arrays(result).values(), *result.record.values()):
        with pytest.raises(ValueError, match="read-only"):
            array[...] = 0


def test_results_are_pickled_and_stay_read_only() -> None:
    result = rich_result()
    copy = pickle.loads(pickle.dumps(result))
    for name, array in arrays(copy).items():
        np.testing.assert_array_equal(array, getattr(result, name), err_msg=name)
        assert not array.flags.writeable, name
    for name in ("status", "advice", "index", "residual", "energy", "iterations", "time"):
        assert getattr(copy, name) == getattr(result, name)
    for column, values in result.record.items():
        np.testing.assert_array_equal(copy.record[column], values)
        assert not copy.record[column].flags.writeable, column
    np.testing.assert_array_equal(copy.reaction, result.reaction)
    assert repr(copy) == repr(result)


def test_equal_scenes_have_equal_results() -> None:
    def result(force: float) -> pyrod.Equilibrium:
        return solved(Rod.straight(1.0, 6, SOFT), Force((force, 0, 0)))

    assert result(1.0) == result(1.0)
    assert result(1.0) != result(2.0)


def test_repr_tells_what_was_found() -> None:
    result = solved(Rod.straight(1.0, 6, SOFT), Moment((0, 1.3, 0)), space="planar")
    text = repr(result)
    for part in (
        "Equilibrium(Rod(cosserat, straight, length=1, edges=6)",
        "1 iterations",
        "stable",
        "energy=0.65,",
        f"tip=({result.tip[0]:.6g}, 0, {result.tip[2]:.6g})",
        "ms)",
    ):
        assert part in text
    assert "no potential" in repr(rich_result())


def test_record_has_a_line_per_iteration() -> None:
    result = pyrod.solve(BENT)
    of_a_step = {"exact", "energy", "residual", "step", "fraction", "shift"}
    assert set(result.record) == of_a_step | {"factorisations", "unknowns"}
    assert {len(column) for column in result.record.values()} == {result.iterations}
    assert result.record["exact"][-1]
    assert not result.record["exact"][0]
    assert (result.record["factorisations"][:-1] >= 1).all()
    assert result.record["factorisations"][-1] >= 0  # with that of the step before
    assert (result.record["unknowns"] == result.unknowns).all()
    assert result.record["residual"][0] > 1e-2 > 1e-12 > result.residual


def test_verbose_prints_a_line_per_iteration(capsys: pytest.CaptureFixture[str]) -> None:
    result = pyrod.solve(BENT, verbose=True)
    *lines, summary = capsys.readouterr().out.splitlines()
    assert summary == (
        f"converged: {result.iterations} iterations, {result.unknowns} unknowns of which "
        "0 multipliers, fill 1.00"
    )
    for line, residual, step in zip(
        lines, result.record["residual"], result.record["step"], strict=True
    ):
        assert f"residual {residual:.2e}" in line
        assert f"step {step:.2e} rad" in line
    pyrod.solve(BENT)
    assert capsys.readouterr().out == ""


def test_verbose_does_not_change_the_result() -> None:
    assert pyrod.solve(BENT, verbose=True) == pyrod.solve(BENT)
