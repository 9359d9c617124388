"""A scene file for the commands."""

from __future__ import annotations

from pathlib import Path

import pytest
from command import CANTILEVER


@pytest.fixture
def scene(tmp_path: Path) -> Path:
    path = tmp_path / "scene.toml"
    path.write_text(CANTILEVER)
    return path
