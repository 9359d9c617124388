"""The command ``pyrod``, as a shell sees it."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pyrod
from pyrod import reference
from pyrod.cli.output import Output

pytestmark = pytest.mark.outside

CANTILEVER = """
[sections.wire]
EI1 = 1.0
EI2 = 1.0
GJ = 0.7

[[rods]]
length = 1.0
edges = 64
section = "wire"

[[supports]]
kind = "clamp"

[[loads]]
kind = "force"
force = [10.0, 0.0, 0.0]
"""
TIP = 0.8106090248802964  # of the elastica, F L^2/EI = 10
FAILED, WRONG, STOPPED = 1, 2, 130


def pyrod_command(*arguments: object, cwd: Path, **more: Any) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-m", "pyrod", *map(str, arguments)],
        check=False,
        capture_output=True,
        text=True,
        cwd=cwd,
        timeout=120,
        **more,
    )


@pytest.fixture
def scene(tmp_path: Path) -> Path:
    path = tmp_path / "scene.toml"
    path.write_text(CANTILEVER)
    return path


# solve --------------------------------------------------------------------------------------------


def test_solve_tells_what_was_found(scene: Path) -> None:
    run = pyrod_command("solve", scene, "--tol", "1e-8", cwd=scene.parent)
    assert run.returncode == 0
    assert run.stderr == ""  # quick, so that there is no progress bar
    lines = dict(line.split(None, 1) for line in run.stdout.splitlines() if line[0] != " ")
    assert lines["status"].startswith("converged")
    assert lines["stable"] == "yes"
    assert f"{TIP:.6g}" in lines["rod"]
    assert "of 1e-08 allowed" in lines["error"]
    assert "exerts (-10, 0, 0) N" in lines["Clamp"]


def test_solve_prints_one_object_for_programs(scene: Path) -> None:
    run = pyrod_command("solve", scene, "--tol", "1e-8", "--json", "--eigenvalue", cwd=scene.parent)
    told = json.loads(run.stdout)
    assert run.returncode == 0
    assert told["converged"] is True
    assert told["stable"] is True
    assert abs(told["tips"][0][0] - TIP) < 1e-8
    assert max(told["errors"][name] for name in ("positions", "moments")) <= 1e-8
    np.testing.assert_allclose(told["reactions"][0]["force"], [-10, 0, 0], atol=1e-9)
    assert told["lowest_eigenvalue"] > 0
    assert told["files"] == []


def test_solve_writes_files_and_a_picture(scene: Path) -> None:
    run = pyrod_command(
        *("solve", scene, "-o", "out.vtp", "-o", "out.npz", "--plot", "out.png"), cwd=scene.parent
    )
    assert run.returncode == 0, run.stderr
    assert [line for line in run.stdout.splitlines() if line.startswith("wrote")] == [
        "wrote out.vtp",
        "wrote out.npz",
        "wrote out.png",
    ]
    assert (scene.parent / "out.png").read_bytes().startswith(b"\x89PNG")
    saved = pyrod.load(scene.parent / "out.npz")
    assert saved == pyrod.solve(pyrod.load(scene))


def test_the_command_line_has_precedence_over_the_file(scene: Path) -> None:
    scene.write_text(CANTILEVER + "[solve]\ntol = 1e-3\n")
    for arguments, tol in (((), 1e-3), (("--tol", "1e-7"), 1e-7)):
        run = pyrod_command("solve", scene, "--json", *arguments, cwd=scene.parent)
        assert json.loads(run.stdout)["tol"] == tol


def test_the_model_can_be_chosen(scene: Path) -> None:
    run = pyrod_command(
        *("solve", scene, "--tol", "1e-4", "--model", "auto", "--json"), cwd=scene.parent
    )
    assert "inextensible" in json.loads(run.stdout)["choice"]


def test_a_saddle_is_warned_of(scene: Path) -> None:
    """A column beyond Euler's load, straight."""
    scene.write_text(CANTILEVER.replace("[10.0, 0.0, 0.0]", "[0.0, 0.0, -5.0]"))
    stable = json.loads(pyrod_command("solve", scene, "--json", cwd=scene.parent).stdout)
    assert stable["index"] == 0
    assert stable["tips"][0][2] < 0.9
    straight = pyrod_command("solve", scene, "--json", "--any", cwd=scene.parent)
    told = json.loads(straight.stdout)
    assert told["index"] == 2  # it may fall to any side
    assert told["tips"][0] == pytest.approx([0, 0, 1])


def test_iterations_are_printed_on_demand(scene: Path) -> None:
    run = pyrod_command("solve", scene, "-v", cwd=scene.parent)
    assert sum(line.startswith("energy ") and "residual" in line for line in run.stdout.split("\n"))


def test_quiet_is_quiet(scene: Path) -> None:
    run = pyrod_command("solve", scene, "-q", "-o", "out.csv", cwd=scene.parent)
    assert (run.returncode, run.stdout, run.stderr) == (0, "", "")
    assert (scene.parent / "out.csv").exists()


# What goes wrong ----------------------------------------------------------------------------------


def test_a_wrong_scene_file_is_told_with_its_line(scene: Path) -> None:
    scene.write_text(CANTILEVER.replace("edges = 64", "edgs = 64"))
    run = pyrod_command("solve", scene, "-o", "out.vtp", cwd=scene.parent)
    assert run.returncode == WRONG
    assert run.stdout == ""
    assert run.stderr.startswith("pyrod: error: ")
    assert "edges" in run.stderr
    line = 1 + scene.read_text().split("\n").index("edgs = 64")
    assert f"line {line}" in run.stderr or f":{line}:" in run.stderr
    assert "Traceback" not in run.stderr
    assert not (scene.parent / "out.vtp").exists()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("solve", "none.toml"), "none.toml"),
        (("solve", "scene.toml", "-o", "out.xyz"), ".xyz"),
        (("solve", "scene.toml", "-o", "nowhere/out.vtp"), "nowhere"),
        (("solve", "scene.toml", "--tol", "2"), "tol"),
        (("solve", "scene.toml", "--tol", "much"), "much"),
        (("sweep", "scene.toml", "loads.0.force.0"), "ENTRY=VALUES"),
        (("sweep", "scene.toml", "loads.0.force.0=1:2"), "first:last:count"),
        (("sweep", "scene.toml", "loads.0.force.0=1:2:0"), "at least 1"),
        (("sweep", "scene.toml", "loads.0.frce.0=1"), "frce"),
        (("sweep", "scene.toml", "loads.0.force.0=1", "-j", "-1"), "jobs"),
        (("sweep", "scene.toml", "loads.0.force.0=1", "-o", "table.xls"), ".csv"),
        (("sweep", "scene.toml", "loads.0.force.0=1", "-o", "nowhere/table.csv"), "nowhere"),
        (("sweep", "scene.toml", "loads.0.force.0=1", "loads.0.force.0=2"), "twice"),
        (("demo", "nowhere/picture.png"), "nowhere"),
        (("check", "Q*"), "Q*"),
        (("info", "none.npz"), "none.npz"),
        (("frobnicate",), "frobnicate"),
    ],
)
def test_wrong_input_is_told_in_a_line(
    scene: Path, arguments: tuple[str, ...], message: str
) -> None:
    run = pyrod_command(*arguments, cwd=scene.parent)
    assert run.returncode == WRONG
    assert run.stderr.startswith("pyrod: error: ")
    assert message in run.stderr
    assert "Traceback" not in run.stderr
    assert "cases/s" not in run.stderr  # it is told before any work
    assert " 1024 " not in run.stdout


def test_no_equilibrium_has_an_exit_code_of_its_own(scene: Path) -> None:
    scene.write_text(CANTILEVER + "[solve]\nmax_iterations = 1\n")
    run = pyrod_command("solve", scene, "--json", "-o", "out.vtp", cwd=scene.parent)
    assert run.returncode == FAILED
    assert json.loads(run.stdout)["error"]["kind"] == "not_converged"
    assert run.stderr.startswith("pyrod: error: ")
    assert not (scene.parent / "out.vtp").exists()


def test_errors_are_objects_for_programs(tmp_path: Path) -> None:
    run = pyrod_command("solve", "none.toml", "--json", cwd=tmp_path)
    error = json.loads(run.stdout)["error"]
    assert run.returncode == WRONG
    assert error["kind"] == "wrong_input"
    assert "none.toml" in error["message"]


def test_warnings_of_what_fails_then_are_told(capsys: pytest.CaptureFixture[str]) -> None:
    output = Output(json=True)

    def doubtful() -> None:
        warnings.warn("odd", pyrod.StrainWarning, stacklevel=1)
        raise OSError

    with pytest.raises(OSError, match=r"^$"), output.heeding():
        doubtful()
    assert output.warnings == ["odd"]
    assert capsys.readouterr().err == "pyrod: warning: odd\n"


def test_ctrl_c_stops_a_long_solve(scene: Path) -> None:
    scene.write_text(CANTILEVER.replace("edges = 64", "edges = 1000000"))
    run = subprocess.Popen(
        [sys.executable, "-m", "pyrod", "solve", str(scene), "-v"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),  # also in the background
    )
    assert run.stdout is not None
    assert run.stdout.readline().startswith("energy")  # it is at work
    run.send_signal(signal.SIGINT)
    _, errors = run.communicate(timeout=60)
    assert run.returncode == STOPPED
    assert errors == "pyrod: error: stopped by Ctrl-C\n"


def test_a_long_solve_shows_a_progress_bar(scene: Path) -> None:
    scene.write_text(CANTILEVER.replace("edges = 64", "edges = 400000"))
    run = pyrod_command("solve", scene, cwd=scene.parent)
    assert run.returncode == 0
    assert "iterations" in run.stderr
    assert "residual=" in run.stderr


def test_a_reader_may_stop_reading(scene: Path) -> None:
    read, write = os.pipe()
    os.close(read)
    with os.fdopen(write, "w") as broken:
        run = subprocess.run(
            [sys.executable, "-m", "pyrod", "solve", str(scene)],
            stdout=broken,
            stderr=subprocess.PIPE,
            text=True,
            check=False,
        )
    assert run.returncode == 0
    assert "Traceback" not in run.stderr


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


# The whole ----------------------------------------------------------------------------------------


def test_help_names_the_commands(tmp_path: Path) -> None:
    shown = pyrod_command(cwd=tmp_path).stdout
    for command in ("solve", "sweep", "check", "info", "demo"):
        assert command in shown
        assert pyrod_command(command, "--help", cwd=tmp_path).returncode == 0


def test_the_script_is_installed(tmp_path: Path) -> None:
    script = Path(sys.executable).with_name("pyrod")
    shown = subprocess.run([script, "--version"], check=True, capture_output=True, text=True)
    assert shown.stdout.strip() == pyrod.__version__
