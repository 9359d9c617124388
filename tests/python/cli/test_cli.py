"""``pyrod solve``, as a shell sees it, and what goes wrong in all commands."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import warnings
from pathlib import Path

import numpy as np
import pytest
from command import CANTILEVER, FAILED, STOPPED, TIP, WRONG, pyrod_command

import pyrod
from pyrod.cli.output import Output

pytestmark = pytest.mark.outside

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
