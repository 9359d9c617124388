"""Sweeps of scenes from files and documents, whose entries are named by path."""

from __future__ import annotations

from concurrent.futures import Executor
from pathlib import Path

import numpy as np
import pytest
from support import SOFT, same_sweep
from sweeps import pool, sweep

import pyrod
from pyrod import Clamp, Force, Rod, Scene, document, solve

SCENE = Scene(Rod.straight(1.0, 8, SOFT), Clamp(), Force((1.0, 0.5, -2.0)))
PATH = "loads.0.force.2"
VALUES = [-2.0, 0.0, 3.0]


@pytest.fixture
def expected() -> list[pyrod.Equilibrium]:
    rod = Rod.straight(1.0, 8, SOFT)
    return [solve(Scene(rod, Clamp(), Force((1.0, 0.5, z)))) for z in VALUES]


@pytest.fixture
def path(tmp_path: Path) -> Path:
    file = tmp_path / "scene.toml"
    file.write_text(
        "rods = [{length = 1.0, edges = 8, section = 'soft'}]\n"
        "supports = [{kind = 'clamp'}]\n"
        "loads = [{kind = 'force', force = [1.0, 0.5, -2.0]}]\n"
        f"[sections.soft]\nEI1 = {SOFT.EI1}\nEI2 = {SOFT.EI2}\nGJ = {SOFT.GJ}\n"
        f"GA1 = {SOFT.GA1}\nGA2 = {SOFT.GA2}\nEA = {SOFT.EA}\n"
    )
    return file


@pytest.mark.parametrize("kind", ["scene", "document", "path", "text"])
def test_entries_are_named_by_path(
    kind: str, path: Path, expected: list[pyrod.Equilibrium]
) -> None:
    written = document.write(SCENE)
    source = {"scene": SCENE, "document": written, "path": path, "text": str(path)}[kind]
    done = sweep(source, {PATH: VALUES})
    assert not done.failures
    np.testing.assert_array_equal(done["tip"], [one.tip for one in expected])
    assert written == document.write(SCENE)  # it was left as it is
    assert done.to_xarray().sizes[PATH] == 3


def test_several_entries_change_together() -> None:
    done = sweep(SCENE, [{PATH: 0.0, "rods.0.length": 2.0}])
    alone = solve(Scene(Rod.straight(2.0, 8, SOFT), Clamp(), Force((1.0, 0.5, 0.0))))
    np.testing.assert_array_equal(done["tip"][0], alone.tip)


def test_documents_are_sent_to_processes_and_stored(tmp_path: Path) -> None:
    store = tmp_path / "store"
    processes: Executor
    with pool("spawn") as processes:
        done = sweep(SCENE, {PATH: VALUES}, executor=processes, store=store)
    same_sweep(done, sweep(SCENE, {PATH: VALUES}))
    other = Scene(Rod.straight(1.1, 8, SOFT), Clamp(), Force((1.0, 0.5, -2.0)))
    with pytest.raises(ValueError, match="is of another sweep: scene differ"):
        sweep(other, {PATH: VALUES}, store=store)


@pytest.mark.parametrize(
    ("path", "message"),
    [
        ("loads.1.force.2", "'loads.1.force.2' is no entry; loads has 0"),
        ("loads.0.force.3", "is no entry; loads.0.force has 0, 1, 2"),
        ("lods.0", "is no entry; the scene has .*loads"),
        ("loads.0.force.2.x", "is no entry; loads.0.force.2 has no entries"),
        ("load", "'load' is no entry; the scene has"),
    ],
)
def test_entries_that_are_not_there_are_refused(path: str, message: str) -> None:
    with pytest.raises(ValueError, match=f"parameters: .*{message}"):
        sweep(SCENE, {path: [1.0]})


def test_values_that_make_no_scene_are_failures() -> None:
    done = sweep(SCENE, {"rods.0.length": [1.0, -1.0, "long"]})
    assert [f.case for f in done.failures] == [1, 2]
    assert "length" in done.failures[0].error


def test_each_case_is_what_it_is_whatever_the_others_are() -> None:
    done = sweep(SCENE, {"loads.0.force.1": [1.0, "2 N", True]}, progress=False)
    assert np.isfinite(done["tip"][:2]).all()
    assert "True" in done["error"][2]
    alone = sweep(SCENE, {"loads.0.force.1": [2.0]}, progress=False)
    assert np.array_equal(done["tip"][1], alone["tip"][0])
