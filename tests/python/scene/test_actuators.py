"""What tendons may be, and what of scenes knows them."""

from __future__ import annotations

import pickle
from dataclasses import replace

import numpy as np
import pytest

import pyrod
from pyrod import Clamp, Force, Rod, Scene, Section, Solver, Tendon

ROD = Rod.straight(1.0, 8, Section(1, 1, 0.8))


def helix(s):
    return 0.05 * np.cos(3 * s), 0.05 * np.sin(3 * s)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"length": 1}, "give a tendon its tension or its length"),
        ({"tension": None}, "give a tendon its tension or its length"),
        ({"EA": 10}, "EA: goes with the length"),
        ({"tension": None, "length": -1}, "length: must be positive"),
        ({"tension": 0}, "tension: must be positive and finite"),
        ({"tension": -1}, "tension: must be positive and finite"),
        ({"tension": np.inf}, "tension: must be positive and finite"),
        ({"offset": (1, 2, 3)}, "offset: expected 2 numbers"),
        ({"offset": 0.1}, "offset: expected 2 numbers"),
        ({"offset": (np.nan, 0)}, "offset: expected finite"),
        ({"offset": np.zeros((3, 3))}, "offset: expected 2 numbers"),
        ({"start": "start"}, "start: expected an arc length"),
        ({"start": np.nan}, "start: must be a finite"),
        ({"rod": 0.5}, "rod"),
    ],
)
def test_what_is_no_tendon_is_refused(arguments, words):
    with pytest.raises((ValueError, TypeError), match=words):
        Tendon(**{"offset": (0.1, 0), "tension": 1, **arguments})


@pytest.mark.parametrize(
    ("tendon", "words"),
    [
        (Tendon((0.1, 0), 1, start=0.5, end=0.5), "start, end: must be arc lengths"),
        (Tendon((0.1, 0), 1, start=0.7, end=0.2), "in their order"),
        (Tendon((0.1, 0), 1, end=1.2), "on the rod"),
        (Tendon((0.1, 0), 1, start=-0.1), "on the rod"),
        (Tendon((0.1, 0), 1, rod=1), "there is no rod 1"),
        (Tendon(np.zeros((5, 2)), 1), r"9 times 2 \(one per vertex\)"),
    ],
)
def test_what_does_not_fit_its_rod_is_refused(tendon, words):
    with pytest.raises(ValueError, match=words):
        pyrod.solve(Scene(ROD, Clamp(), actuators=tendon))


def test_functions_are_looked_at():
    with pytest.raises(ValueError, match="offset: expected 2 numbers"):
        pyrod.solve(Scene(ROD, Clamp(), actuators=Tendon(lambda s: (s, s, s), 1)))
    with pytest.raises(ValueError, match="offset: expected finite numbers"):
        pyrod.solve(Scene(ROD, Clamp(), actuators=Tendon(lambda s: (np.inf, s), 1)))


def test_rods_that_stretch_are_refused():
    rod = Rod.straight(1.0, 8, Section(1, 1, 0.8, EA=1e4))
    with pytest.raises(ValueError, match="inextensible"):
        pyrod.solve(Scene(rod, Clamp(), actuators=Tendon((0.1, 0), 1)))


def test_scenes_take_one_or_several():
    tendon = Tendon((0.1, 0), 1)
    assert Scene(ROD, Clamp(), actuators=tendon).actuators == (tendon,)
    assert len(Scene(ROD, Clamp(), actuators=[tendon, tendon]).actuators) == 2
    assert "2 Tendons" in repr(Scene(ROD, Clamp(), actuators=[tendon, tendon]))
    with pytest.raises(TypeError, match="belongs to actuators"):
        Scene(ROD, Clamp(), tendon)


def test_in_the_plane_or_not():
    assert pyrod.is_planar(Scene(ROD, Clamp(), actuators=Tendon((0.1, 0), 1))).plane == "a1-a3"
    assert pyrod.is_planar(Scene(ROD, Clamp(), actuators=Tendon((0, 0.1), 1))).plane == "a2-a3"
    found = pyrod.is_planar(Scene(ROD, Clamp(), actuators=Tendon(helix, 1)))
    assert not found
    assert "tendon 0" in found.why
    with pytest.raises(ValueError, match="off the plane"):
        pyrod.solve(Scene(ROD, Clamp(), space="planar", actuators=Tendon((0, 0.1), 1)))


def test_a_tip_moves_as_its_linear_response_says():
    scene = Scene(ROD, Clamp(), Force((0.1, 0.2, 0)), actuators=Tendon(helix, 4))
    linear = pyrod.linearised(pyrod.solve(scene))
    told = linear.jvp({"actuators.0.tension": 1.0})
    step = 1e-4

    def at(tension):
        return pyrod.solve(replace(scene, actuators=Tendon(helix, tension)))

    ahead, behind = at(4 + step), at(4 - step)
    for name in ("positions", "K", "moment", "force"):
        slope = (getattr(ahead, name) - getattr(behind, name)) / (2 * step)
        rows = slice(1, -1) if name == "K" else slice(None)  # at the ends it is told by the moment
        assert np.abs(told[name] - slope)[rows].max() < 1e-6 * max(np.abs(slope).max(), 1e-3)
    assert np.isnan(told["K"][[0, -1]]).all()
    length = (ahead.tendons[0].length - behind.tendons[0].length) / (2 * step)
    assert told["tendons.0.length"] == pytest.approx(length, rel=1e-6)
    energy = (ahead.energy - behind.energy) / (2 * step)
    assert told["energy"] == pytest.approx(energy, rel=1e-6)
    back = linear.vjp({"tip": [1, 2, 3], "tendons.0.length": 0.5}, "actuators.0.tension")
    forth = told["tip"] @ [1, 2, 3] + 0.5 * told["tendons.0.length"]
    assert back["actuators.0.tension"] == pytest.approx(forth, rel=1e-10)
    compliance = linear.compliance()
    assert np.abs(compliance - compliance.T).max() < 1e-9 * np.abs(compliance).max()


def test_inner_ends_and_derivatives():
    scene = Scene(ROD, Clamp(), Force((0.1, 0.2, 0)), actuators=Tendon(helix, 4, end=0.5))
    told = pyrod.linearised(pyrod.solve(scene)).jvp({"actuators.0.tension": 1.0})
    step = 1e-4
    ahead, behind = (
        pyrod.solve(replace(scene, actuators=Tendon(helix, 4 + x, end=0.5))) for x in (step, -step)
    )
    for name in ("positions", "moment"):
        slope = (getattr(ahead, name) - getattr(behind, name)) / (2 * step)
        assert np.abs(told[name] - slope).max() < 1e-6 * np.abs(slope).max()


def test_what_has_no_derivative_is_refused():
    linear = pyrod.linearised(pyrod.solve(Scene(ROD, Clamp(), actuators=Tendon((0.1, 0), 1))))
    with pytest.raises(ValueError, match="offset of a tendon"):
        linear.jvp({"actuators.0.offset": (1, 0)})
    with pytest.raises(ValueError, match="length of a rod with tendons"):
        linear.jvp({"rods.0.edge_lengths": np.ones(8)})


def test_solvers_take_other_tensions_and_places():
    scene = Scene(ROD, Clamp(), Force((0, 0.1, 0)), actuators=[Tendon((0.1, 0), 1)])
    solver = Solver(scene)
    solver.solve()
    for changes in (
        {"actuators.0.tension": 3.0},
        {"actuators.0.end": 0.55},
        {"loads.0.force.1": 0.3},
    ):
        found = solver.solve(changes)
        afresh = pyrod.solve(solver.scene)
        assert np.abs(found.positions - afresh.positions).max() < 1e-12
    assert solver.scene.actuators[0].end == 0.55
    assert solver.scene.actuators[0].tension == 3


@pytest.mark.parametrize("offset", [(0.1, 0.02), np.full((9, 2), 0.05), helix])
def test_scenes_can_be_kept(offset, tmp_path):
    scene = Scene(ROD, Clamp(), Force((0, 0.1, 0)), actuators=Tendon(offset, 2, start=0.1, end=0.9))
    result = pyrod.solve(scene)
    again = pickle.loads(pickle.dumps(scene))
    assert np.abs(pyrod.solve(again).positions - result.positions).max() < 1e-11
    pyrod.save(scene, tmp_path / "scene.toml")
    read = pyrod.load(tmp_path / "scene.toml")
    far = 1e-12 if not callable(offset) else 1e-2
    assert np.abs(pyrod.solve(read).positions - result.positions).max() < far
    for name in ("result.npz", "result.json"):
        pyrod.save(result, tmp_path / name)
        loaded = pyrod.load(tmp_path / name)
        assert loaded.tendons[0].length == result.tendons[0].length
        assert np.array_equal(loaded.tendons[0].force_on_base, result.tendons[0].force_on_base)
        assert np.array_equal(loaded.backbone_force, result.backbone_force)


def test_without_tendons_the_backbone_carries_all():
    result = pyrod.solve(Scene(ROD, Clamp(), Force((0, 0.1, 0))))
    assert np.array_equal(result.backbone_force, result.vertex_force)
    assert result.tendons == ()


def test_a_tendon_does_not_end_in_a_ball_joint_that_is_held_for_another_rod():
    arm = Rod.straight(1.0, 4, Section(1, 1, 0.8))
    arm = arm.placed((0, 0, 0.5), tangent=(1, 0, 0), normal=(0, 0, -1))
    joint = pyrod.Joint(((0, 0.5), (1, "start")), "ball")
    held = [Clamp(), pyrod.Hinge(at=(1, "end"))]
    beside = Scene([ROD, arm], held, joints=joint, actuators=Tendon((0.05, 0), 1, end=0.5))
    assert pyrod.solve(beside).converged
    held[1] = Clamp(at=(1, "start"))
    with pytest.raises(ValueError, match="ends, or has a kink, in a ball joint"):
        pyrod.solve(replace(beside, supports=held))


def test_a_function_is_asked_once_for_each_arc_length() -> None:
    asked: list[float] = []

    def routing(s: float) -> tuple[float, float]:
        asked.append(s)
        return helix(s)

    tendon = Tendon(routing, 1.0)
    scene = Scene(ROD, Clamp(), Force((0.1, 0.2, 0)), actuators=[tendon])
    pyrod.solve(scene)
    assert 0 < len(asked) == len({*asked})
    count = len(asked)
    solver = Solver(scene)
    for tension in (1.1, 1.2):
        found = solver.solve({"actuators.0.tension": tension})
    assert len(asked) == count
    again = Scene(ROD, Clamp(), Force((0.1, 0.2, 0)), actuators=[Tendon(helix, 1.2)])
    np.testing.assert_allclose(found.positions, pyrod.solve(again).positions, atol=1e-12)
    assert replace(tendon, tension=2.0).offset == tendon.offset == Tendon(routing, 1.0).offset
    assert tendon.offset != Tendon(helix, 1.0).offset
    assert pickle.loads(pickle.dumps(Tendon(helix, 1.0))).offset == Tendon(helix, 1.0).offset
