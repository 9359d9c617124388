"""Exact solutions, from the files that the tests use."""

from __future__ import annotations

from pathlib import Path

from pyrod.reference import Case, load

REFERENCE = Path(__file__).parents[2] / "tests" / "reference"


def case(name: str) -> Case:
    """The exact solution of that name."""
    return load(REFERENCE / f"{name}.json")[0]
