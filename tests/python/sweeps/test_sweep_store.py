"""Sweeps that are stopped go on where they were, however they were stopped."""

from __future__ import annotations

import json
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path
from time import sleep
from typing import Any

import numpy as np
import pytest
import sweeps
from support import ROUND, same_sweep
from sweeps import GRID, cantilever, resumable, shape

import pyrod
from pyrod import Section, sweep

pytestmark = pytest.mark.outside


def stored(path: Path, **more: Any) -> pyrod.Sweep:
    settings = {"scene": cantilever, "parameters": GRID, "measure": shape, "progress": False}
    return sweep(**{**settings, **more}, store=path)


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "store"


def unexpected(**_: Any) -> Any:
    raise AssertionError("solved again")


def resumed(path: Path, monkeypatch: pytest.MonkeyPatch, **more: Any) -> pyrod.Sweep:
    """From the store alone: any solve is an error."""
    monkeypatch.setattr("pyrod.sweeps.work.found", unexpected)
    monkeypatch.setattr("pyrod.sweeps.work.Work._scene", unexpected)
    return stored(path, **more)


def test_what_is_stored_is_what_was_found(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    first = stored(path)
    same_sweep(first, sweep(cantilever, GRID, measure=shape, progress=False))
    assert len(path.read_bytes().splitlines()) == 31
    same_sweep(resumed(path, monkeypatch), first, but=())


def test_the_bar_begins_where_the_store_ends(
    path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    stored(path)
    stored(path, progress=True)
    assert "| 30/30 [" in capsys.readouterr().err


def numbers(result: pyrod.Equilibrium) -> dict[str, Any]:
    return {
        "nan": np.nan,
        "inf": np.inf,
        "ints": np.arange(3, dtype=np.int32),
        "single": np.float32(0.1) * np.ones((2, 2), np.float32),
        "yes": np.True_,
        "flags": np.array([True, False]),
        "tiny": 5e-324,
        "greek": 'κ, "quoted"\n',
    }


def test_all_kinds_of_numbers_come_back(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    first = stored(path, measure=numbers, parameters={"load": [1.0], "angle": [1.0]})
    assert not first.failures
    again = resumed(path, monkeypatch, measure=numbers, parameters={"load": [1.0], "angle": [1.0]})
    same_sweep(again, first, but=())


def test_a_killed_process_loses_only_what_it_was_at(tmp_path: Path) -> None:
    """By SIGKILL, in the middle of a line as well; what is in the store is not solved again."""
    code = f"import pathlib, sweeps; sweeps.resumable(pathlib.Path({str(tmp_path)!r}))"
    folder = Path(sweeps.__file__).parent
    path, log = tmp_path / "store", tmp_path / "log"
    with subprocess.Popen([sys.executable, "-c", code], cwd=folder) as process:
        while not path.exists() or path.read_bytes().count(b"\n") < 20:
            assert process.poll() is None
            sleep(0.002)
        process.kill()
    assert process.returncode == -9
    content = path.read_bytes()
    path.write_bytes(content[:-7])
    standing = {json.loads(line)["case"] for line in path.read_bytes().splitlines()[1:-1]}
    assert 18 <= len(standing) + 1 < 60
    done = resumable(tmp_path)
    solved = log.read_text().split()
    counts = [solved.count(str(load)) for load in done["load"][:, 0]]
    assert min(counts) == 1
    assert max(counts) <= 2
    assert {counts[case] for case in standing} == {1}
    assert len(solved) <= 60 + 2
    same_sweep(resumable(tmp_path), done, but=())
    assert log.read_text().split() == solved
    fresh = sweep(cantilever, {"load": list(done["load"][:, 0]), "angle": [1.0]}, progress=False)
    np.testing.assert_array_equal(done["tip"][:, 0], fresh["tip"][:, 0])


def test_ctrl_c_keeps_what_is_done(path: Path) -> None:
    def press(done: int, total: int) -> None:
        if done >= 12:
            raise KeyboardInterrupt

    for executor in (None, ThreadPoolExecutor(2)):
        path.unlink(missing_ok=True)
        with pytest.raises(KeyboardInterrupt):
            stored(path, executor=executor, progress=press)
        assert 12 <= len(path.read_bytes().splitlines()) - 1 < 30
        told: list[int] = []
        again = stored(path, progress=lambda done, total, told=told: told.append(done))
        assert told[0] == 13 or executor is not None
        same_sweep(again, sweep(cantilever, GRID, measure=shape, progress=False))
    executor.shutdown()


def flaky(load: float, flag: str) -> pyrod.Scene:
    if load == 2 and not Path(flag).exists():
        raise OSError("the licence server is away")
    return cantilever(load, 1.0)


def test_failures_are_tried_again_only_if_asked(path: Path, tmp_path: Path) -> None:
    flag = tmp_path / "flag"
    more: Any = {"scene": flaky, "parameters": {"load": [1.0, 2.0], "flag": [str(flag)]}}
    assert [f.error for f in stored(path, **more).failures] == [
        "OSError: the licence server is away"
    ]
    flag.touch()
    assert len(stored(path, **more).failures) == 1
    assert not stored(path, **more, retry_failed=True).failures
    assert not stored(path, **more).failures  # the later line counts


def test_lines_of_neighbours_are_done_whole(path: Path) -> None:
    first = stored(path, start="previous")
    lines = path.read_bytes().splitlines(keepends=True)
    path.write_bytes(b"".join(lines[:10]))  # the first line of six cases, and half of the second
    told: list[int] = []
    again = stored(path, start="previous", progress=lambda done, _: told.append(done))
    same_sweep(again, first)
    assert told == [12, 18, 24, 30]


# What is refused ----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("other", "named"),
    [
        ({"parameters": {**GRID, "load": [0.5, 1, 2, 5, 7]}}, "parameters"),
        ({"parameters": {**GRID, "load": [0.5]}}, "cases, parameters"),
        ({"measure": numbers}, "measure"),
        ({"scene": flaky, "parameters": {"load": [1.0], "flag": ["x"]}}, "cases, para.*, scene"),
        ({"tol": 1e-4}, "options"),
        ({"stable": False}, "options"),
        ({"model": "extensible"}, "model"),
        ({"start": "previous"}, "start"),
    ],
)
def test_the_store_of_another_sweep_is_refused(path: Path, other: Any, named: str) -> None:
    stored(path)
    before = path.read_bytes()
    with pytest.raises(ValueError, match=f"store: .*store is of another sweep: {named} differ; "):
        stored(path, **other)
    assert path.read_bytes() == before


@pytest.mark.parametrize("content", [b"my thesis\n", b"my thesis", b"[1, 2]\n", b'{"pyrod": 1}\n'])
def test_other_files_are_refused_and_left(path: Path, content: bytes) -> None:
    path.write_bytes(content)
    with pytest.raises(ValueError, match="is not the store of a sweep"):
        stored(path)
    assert path.read_bytes() == content


def test_a_store_that_was_only_begun_is_begun_anew(path: Path) -> None:
    first = stored(path)
    header = path.read_bytes().splitlines(keepends=True)[0]
    for length in (0, 1, len(header) - 1, len(header)):
        path.write_bytes(header[:length])
        same_sweep(stored(path), first)


@pytest.mark.parametrize("line", [b"{}\n", b"{\n", b"[]\n", b'{"case": 1, "values": 3}\n'])
def test_a_damaged_store_is_refused(path: Path, line: bytes) -> None:
    stored(path)
    lines = path.read_bytes().splitlines(keepends=True)
    path.write_bytes(b"".join([*lines[:3], line, *lines[3:]]))
    with pytest.raises(ValueError, match=r"store: .* is damaged at b'"):
        stored(path)


def test_what_cannot_be_told_apart_is_refused(path: Path) -> None:
    with pytest.raises(TypeError, match="store: a Section among the parameters"):
        stored(path, scene=by_section, parameters={"section": [ROUND]})
    with pytest.raises(ValueError, match="has no name by which it could be told"):
        stored(path, scene=partial(cantilever, edges=3))
    assert not path.exists()


def by_section(section: Section) -> pyrod.Scene:
    raise AssertionError(section)
