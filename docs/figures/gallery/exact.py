"""Exact solutions, from the files that the tests use."""

from __future__ import annotations

from pyrod.reference import Case, folder, load

REFERENCE = folder()


def case(name: str) -> Case:
    """The exact solution of that name."""
    return load(REFERENCE / f"{name}.json")[0]
