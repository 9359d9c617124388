"""The driver's side of a worker: asks, waits at most so long, and starts another if one dies."""

from __future__ import annotations

import json
import os
import selectors
import subprocess
from pathlib import Path
from typing import Any

FOLDER = Path(__file__).parents[1]
ALONE = {f"{name}_NUM_THREADS": "1" for name in ("OMP", "OPENBLAS", "MKL", "NUMBA")}


class Worker:
    """A process of `worker.py` in the environment of one solver."""

    def __init__(self, python: Path, module: str, folder: Path) -> None:
        self._command = [str(python), "-m", "peers.worker", module]
        self._folder, self._log = folder, folder / "worker.log"
        self._process: subprocess.Popen[str] | None = None

    def __enter__(self) -> Worker:
        return self

    def __exit__(self, *error: object) -> None:
        self._stop()

    def ask(self, limit: float, /, **request: Any) -> dict[str, Any]:
        """The answer, or `failed` with the reason."""
        process = self._started()
        assert process.stdin is not None
        assert process.stdout is not None
        try:
            process.stdin.write(json.dumps(request) + "\n")
            process.stdin.flush()
        except BrokenPipeError:
            return self._crashed()
        with selectors.DefaultSelector() as selector:
            selector.register(process.stdout, selectors.EVENT_READ)
            if not selector.select(limit):
                self._stop()
                return {"failed": f"no answer in {limit:g} s"}
        line = process.stdout.readline()
        return json.loads(line) if line else self._crashed()

    def _started(self) -> subprocess.Popen[str]:
        if self._process is None:
            with self._log.open("a") as log:
                self._process = subprocess.Popen(
                    self._command,
                    cwd=self._folder,
                    text=True,
                    stdin=subprocess.PIPE,
                    stdout=subprocess.PIPE,
                    stderr=log,
                    env=os.environ | ALONE | {"PYTHONPATH": str(FOLDER)},
                )
        return self._process

    def _crashed(self) -> dict[str, Any]:
        code = self._process.wait() if self._process else None
        self._stop()
        return {"failed": f"the process ended with code {code}"}

    def _stop(self) -> None:
        if self._process is not None:
            self._process.kill()
            self._process.wait()
            self._process = None
