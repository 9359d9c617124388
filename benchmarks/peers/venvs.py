"""An environment for each solver, made once and kept."""

from __future__ import annotations

import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Peer:
    """`module` of peers.solvers, or None where there is none; packages to install from PyPI."""

    module: str | None
    packages: tuple[str, ...] = ()


PEERS = {
    "pyrod": Peer("ours"),
    "scipy-bvp": Peer("scipy_bvp", ("scipy", "numpy")),
    "scipy-shooting": Peer("scipy_shooting", ("scipy", "numpy")),
    "opensees": Peer("opensees_beam", ("openseespy==3.7.1.2", "numpy")),
    "kratos": Peer(
        "kratos_beam",
        (
            "KratosMultiphysics==10.4.4",
            "KratosStructuralMechanicsApplication==10.4.4",
            "KratosLinearSolversApplication==10.4.4",
            "numpy",
        ),
    ),
    "exudyn": Peer("exudyn_beam", ("exudyn==1.13.6", "numpy")),
    "mujoco": Peer("mujoco_cable", ("mujoco==3.17.0", "numpy")),
    "pyelastica": Peer("pyelastica_rod", ("pyelastica==1.0.0", "numpy")),
    "cardillo": Peer(None, ("cardillo",)),
}


def python(name: str, folder: Path) -> Path | str:
    """The interpreter that has the peer, or why there is none. pyrod itself is where we are."""
    packages = PEERS[name].packages
    if not packages:
        return Path(sys.executable)
    home = folder / packages[0].partition("==")[0].lower()
    done, interpreter = home / "installed", home / "bin" / "python"
    if done.exists() and done.read_text() == " ".join(packages):
        return interpreter
    steps = [
        [sys.executable, "-m", "venv", "--clear", str(home)],
        [str(interpreter), "-m", "pip", "install", "--quiet", *packages],
    ]
    for step in steps:
        run = subprocess.run(step, capture_output=True, text=True, check=False)
        if run.returncode:
            lines = [x for x in run.stderr.splitlines() if x.startswith("ERROR")] or ["failed"]
            return f"not installed: pip says {lines[-1].removeprefix('ERROR: ')}"
    done.write_text(" ".join(packages))
    return interpreter
