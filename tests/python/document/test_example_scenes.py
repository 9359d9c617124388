"""The example scenes: each is loaded, solved and compared with what is known of it."""

from __future__ import annotations

from math import cos, cosh, pi, sinh
from pathlib import Path

import numpy as np
import pytest

import pyrod
from pyrod.document import load_file

FOLDER = Path(__file__).parents[3] / "examples" / "scenes"


def solved(name: str) -> pyrod.Equilibrium:
    scene, options, _ = load_file(FOLDER / f"{name}.toml")
    return pyrod.solve(scene, **options)


def test_a_weight_on_a_cantilever() -> None:
    """The moment at the clamp is that of the weight by its lever, and the rod bends as it says."""
    wire = solved("cantilever")
    assert wire.accuracy.reached < 1e-7
    EI = 200e9 * pi / 4 * 1e-3**4
    assert wire.reaction.force[2] == pytest.approx(0.4, rel=1e-9)
    assert wire.reaction.moment[1] == pytest.approx(-0.4 * wire.tip[0], rel=1e-6)
    assert np.linalg.norm(wire.K[0]) == pytest.approx(0.4 * wire.tip[0] / EI, rel=1e-6)


def test_a_buckled_column() -> None:
    """Euler's elastica: at 80 % of the distance of the ends the force is above pi^2 EI/L^2."""
    from scipy.optimize import brentq
    from scipy.special import ellipe, ellipk

    column = solved("column")
    assert column.stable
    m = brentq(lambda m: 2 * ellipe(m) / ellipk(m) - 1 - 0.8, 1e-6, 0.9)
    assert abs(column.reactions[1].force[2]) == pytest.approx(4 * ellipk(m) ** 2, rel=1e-3)
    assert np.abs(column.positions[:, 0]).max() == pytest.approx(m**0.5 / ellipk(m), rel=1e-3)


def test_a_cable_hangs_in_a_catenary() -> None:
    """But for its small stiffness: the sag of a chain of the same length, within a few per cent."""
    from scipy.optimize import brentq

    cable = solved("cable")
    a = brentq(lambda a: 2 * a * sinh(0.6 / a) - 2, 0.1, 10)
    sag = a * (cosh(0.6 / a) - 1)
    assert cable.positions[:, 2].min() == pytest.approx(-sag, rel=0.05)
    weight = 2 * 9.81 * 7850 * pi * 0.5e-3**2
    total = sum(reaction.force[2] for reaction in cable.reactions)
    assert total == pytest.approx(weight, rel=1e-9)


def test_a_twisted_ring_of_dna() -> None:
    """One turn too many is borne by a circle, below Michell's limit."""
    ring = solved("mini_ring")
    assert ring.stable
    bend, twist = 205e-12 * 1e-18, 300e-12 * 1e-18
    energy = 2 * pi**2 * (bend + twist) / 50e-9
    assert ring.energy == pytest.approx(energy, rel=1e-3)
    radius = np.linalg.norm(ring.positions - ring.positions[:-1].mean(axis=0), axis=1)
    np.testing.assert_allclose(radius, 50e-9 / (2 * pi), rtol=1e-3)


def test_a_frame_carries_its_load() -> None:
    """And its corner stays a right angle."""
    frame = solved("frame")
    assert sum(reaction.force[2] for reaction in frame.reactions) == pytest.approx(50, rel=1e-9)
    post, beam = frame.rods
    np.testing.assert_allclose(post.positions[-1], beam.positions[0], atol=1e-12)
    a3 = [pyrod.rotation.to_matrix(q)[:, 2] for q in (post.tip_frame, beam.vertex_frames[0])]
    assert abs(a3[0] @ a3[1]) < 1e-9
    assert max(frame.balance) < 1e-9


def test_a_catheter_is_pushed_back_and_bends() -> None:
    """Its tip turns further than at rest, by the curvature that the moment of the wall adds."""
    catheter = solved("catheter")
    assert catheter.reaction.force[2] == pytest.approx(0.02, rel=1e-9)
    EI = 1.5e9 * pi / 4 * (1e-3**4 - 0.6e-3**4)
    lever = catheter.tip[0] - catheter.positions[:, 0]
    rest = [0, 10, 20, 20, 20, 20]
    # at the ends the curvature is a mean over half an edge
    np.testing.assert_allclose(catheter.K[1:-1, 1], rest[1:-1] + 0.02 * lever[1:-1] / EI, rtol=1e-5)
    turn = 2 * np.arctan2(catheter.tip_frame[2], catheter.tip_frame[0])
    at_rest = 0.06 * 5 + 0.01 * (15 + 3 * 20)
    assert turn > at_rest
    assert cos(turn) < cos(at_rest)


@pytest.mark.parametrize("path", sorted(FOLDER.glob("*.toml")), ids=lambda path: path.stem)
def test_every_example_has_a_title_and_is_the_same_when_saved(path: Path, tmp_path: Path) -> None:
    scene, _, title = load_file(path)
    assert title
    for suffix in ("toml", "json"):
        scene.save(tmp_path / f"again.{suffix}")
        assert pyrod.load(tmp_path / f"again.{suffix}") == scene


def test_all_examples_are_tested_here() -> None:
    text = Path(__file__).read_text()
    assert all(f'solved("{path.stem}")' in text for path in FOLDER.glob("*.toml"))
