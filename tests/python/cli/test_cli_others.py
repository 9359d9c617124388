"""``pyrod sweep``, ``check``, ``info`` and ``demo``, as a shell sees them."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from command import FAILED, TIP, pyrod_command

import pyrod
from pyrod import reference

pytestmark = pytest.mark.outside

# sweep --------------------------------------------------------------------------------------------


def test_sweep_makes_a_table(scene: Path) -> None:
    run = pyrod_command(
        *("sweep", scene, "loads.0.force.0=1:10:4", "loads.0.force.1=0,2", "-j", "2"),
        *("-o", "table.csv"),
        cwd=scene.parent,
    )
    assert run.returncode == 0, run.stderr
    assert "8/8" in run.stderr  # the progress bar
    pandas = pytest.importorskip("pandas")
    table = pandas.read_csv(scene.parent / "table.csv")
    assert len(table) == 8
    last = table[(table["loads.0.force.0"] == 10) & (table["loads.0.force.1"] == 0)]
    assert last["tip.0"].item() == pytest.approx(TIP, abs=2e-4)


def test_sweep_keeps_failures(scene: Path) -> None:
    run = pyrod_command(
        *("sweep", scene, "rods.0.length=1.0,-1.0", "-j", "1", "--json"), cwd=scene.parent
    )
    told = json.loads(run.stdout)
    assert run.returncode == 0
    assert told["cases"] == 2
    (failure,) = told["failures"]
    assert failure["case"] == 1
    assert "length" in failure["error"]
    assert told["table"]["energy"][1] is None


def test_a_sweep_goes_on_from_its_store(scene: Path) -> None:
    arguments = ("sweep", scene, "loads.0.force.0=1:3:3", "-j", "1", "--store", "s.jsonl", "--json")
    first = json.loads(pyrod_command(*arguments, cwd=scene.parent).stdout)
    again = json.loads(pyrod_command(*arguments, cwd=scene.parent).stdout)
    assert again["table"] == first["table"]  # with the times of the first


def test_a_sweep_in_which_all_fails_failed(scene: Path) -> None:
    run = pyrod_command(
        *("sweep", scene, "rods.0.length=-2.0,-1.0", "-j", "1", "-q"), cwd=scene.parent
    )
    assert run.returncode == FAILED


# follow -------------------------------------------------------------------------------------------


def test_follow_tells_what_is_special(tmp_path: Path) -> None:
    text = """
    [sections.strip]
    EI1 = 4.0
    EI2 = 1.0
    GJ = 1.0
    [[rods]]
    length = "1 m"
    edges = 16
    section = "strip"
    [[supports]]
    kind = "clamp"
    [[loads]]
    kind = "force"
    force = [0, 0, -1]
    at = "end"
    """
    (tmp_path / "column.toml").write_text(text)
    run = pyrod_command(
        *("follow", "column.toml", "loads.0.force.2", "0", "-4", "--json"),
        *("-o", "path.csv", "--plot", "path.png"),
        cwd=tmp_path,
    )
    assert run.returncode == 0, run.stderr
    told = json.loads(run.stdout)
    (point,) = told["special"]
    assert point["kind"] == "supercritical pitchfork"
    assert point["value"] == pytest.approx(-((32 * np.sin(np.pi / 64)) ** 2), rel=1e-10)
    assert (told["ended"], told["values"][0], told["values"][-1]) == ("reached", 0.0, -4.0)
    assert len((tmp_path / "path.csv").read_text().splitlines()) == 1 + len(told["values"])
    assert (tmp_path / "path.png").stat().st_size > 1000
    words = pyrod_command("follow", "column.toml", "loads.0.force.2", "0", "-4", cwd=tmp_path)
    assert "SpecialPoint(supercritical pitchfork at -2.46" in words.stdout
    wrong = pyrod_command("follow", "column.toml", "loads.0.forces", "0", "-4", cwd=tmp_path)
    assert wrong.returncode == 2


# check, info, demo --------------------------------------------------------------------------------


def test_check_prints_the_errors(tmp_path: Path) -> None:
    run = pyrod_command("check", "P1_F1_*", "S2_*", "--tol", "1e-7", cwd=tmp_path)
    assert run.returncode == 0, run.stdout
    rows = [line.split() for line in run.stdout.splitlines() if line.startswith(("P1", "S2"))]
    assert len(rows) >= 5
    assert {"planar", "spatial"} == {row[1] for row in rows}
    for row in rows:
        assert float(row[5]) <= float(row[4]) <= 1e-7


def test_check_fails_where_a_case_fails(tmp_path: Path) -> None:
    """An exact solution that is none."""
    source = reference.folder() / "P1_F1_a90.json"
    data = json.loads(source.read_text())
    data["r"][-1][0] += 1e-3
    (tmp_path / "wrong.json").write_text(json.dumps(data))
    run = pyrod_command("check", "--folder", tmp_path, "--json", cwd=tmp_path)
    told = json.loads(run.stdout)
    assert run.returncode == FAILED
    assert told["passed"] is False
    assert {row["quantity"] for row in told["rows"]} == {"positions"}
    assert told["rows"][0]["error"] == pytest.approx(1e-3, rel=1e-3)


def test_check_lists_cases(tmp_path: Path) -> None:
    run = pyrod_command("check", "--list", cwd=tmp_path)
    assert run.returncode == 0
    assert len(run.stdout.splitlines()) > 60


def test_info_tells_of_this_pyrod(tmp_path: Path) -> None:
    run = pyrod_command("info", "--json", cwd=tmp_path)
    told = json.loads(run.stdout)
    assert told["pyrod"] == pyrod.__version__
    assert told["cholmod"].count(".") == 2
    assert told["instructions"] in ("baseline", "avx2", "avx512")
    assert Path(told["include"], "pyrod", "pyrod.hpp").is_file()
    assert told["numpy"] == np.__version__


def test_info_tells_what_files_hold(scene: Path) -> None:
    assert "Scene(Rod(" in pyrod_command("info", scene, cwd=scene.parent).stdout
    pyrod_command("solve", scene, "-o", "out.npz", cwd=scene.parent)
    told = json.loads(pyrod_command("info", "out.npz", "--json", cwd=scene.parent).stdout)
    assert told["kind"] == "equilibrium"
    assert told["converged"] is True


def test_demo_draws(tmp_path: Path) -> None:
    run = pyrod_command("demo", "picture.png", cwd=tmp_path)
    assert run.returncode == 0, run.stderr
    assert (tmp_path / "picture.png").stat().st_size > 50_000
    errors = [line.split() for line in run.stdout.splitlines() if " 1024 " in line]
    assert len(errors) == 4


def test_help_names_the_commands(tmp_path: Path) -> None:
    shown = pyrod_command(cwd=tmp_path).stdout
    for command in ("solve", "sweep", "check", "info", "demo"):
        assert command in shown
        assert pyrod_command(command, "--help", cwd=tmp_path).returncode == 0


def test_the_script_is_installed(tmp_path: Path) -> None:
    script = Path(sys.executable).with_name("pyrod")
    shown = subprocess.run([script, "--version"], check=True, capture_output=True, text=True)
    assert shown.stdout.strip() == pyrod.__version__
