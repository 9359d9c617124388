"""Equations of docs/theory.md have numbers, and what the code cites is there."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
THEORY = ROOT / "docs" / "theory.md"
NUMBER = re.compile(r"^    .*\S +\((\d+)\)$", re.MULTILINE)
CITED = re.compile(r"theory\s+(?:///?\s+|#\s+)?(\(\d+\)(?:(?:, | and |,?\s+(?:///?\s+)?)\(\d+\))*)")
SOURCES = [
    path
    for folder in ("cpp", "python", "tests", "examples")
    for path in sorted((ROOT / folder).rglob("*.[chp][py]*"))
    if path.suffix in (".hpp", ".cpp", ".py") and path.name != Path(__file__).name
]


def displayed(text: str) -> list[list[str]]:
    """Indented blocks that are not programs or items of lists: a paragraph before, one behind."""
    blocks = re.findall(r"(?<=\n\n)((?: {4}\S.*\n)(?: {4}.*\n)*)(?=\n)", text)
    return [block.splitlines() for block in blocks]


def cited(text: str) -> set[int]:
    """Numbers of equations that a source names."""
    return {int(n) for group in CITED.findall(text) for n in re.findall(r"\d+", group)}


@pytest.fixture(scope="module")
def numbers() -> list[int]:
    return [int(n) for n in NUMBER.findall(THEORY.read_text(encoding="utf-8"))]


def test_numbers_count_up(numbers: list[int]) -> None:
    assert len(numbers) > 20
    assert numbers == list(range(1, len(numbers) + 1))


def test_everything_displayed_has_a_number() -> None:
    blocks = displayed(THEORY.read_text(encoding="utf-8"))
    assert len(blocks) > 20
    for block in blocks:
        assert re.search(r" \(\d+\)$", block[-1]), block


def test_what_is_cited_is_there(numbers: list[int]) -> None:
    assert len(SOURCES) > 300
    wrong = {}
    for path in SOURCES:
        unknown = cited(path.read_text(encoding="utf-8")) - set(numbers)
        if unknown:
            wrong[str(path.relative_to(ROOT))] = unknown
    assert wrong == {}


def test_every_equation_is_cited_by_the_code(numbers: list[int]) -> None:
    found: set[int] = set()
    for path in SOURCES:
        if path.is_relative_to(ROOT / "cpp"):
            found |= cited(path.read_text(encoding="utf-8"))
    assert set(numbers) - found == set()


def test_the_page_refers_to_its_own_numbers(numbers: list[int]) -> None:
    """A number in a sentence is one of this page unless it stands with a name, as Linn's do."""
    pages = "\n".join(p.read_text(encoding="utf-8") for p in (ROOT / "docs").glob("*.md"))
    assert cited(pages) <= set(numbers)


def test_citations_are_seen() -> None:
    assert cited("docs, theory (3), theory (12) and (14)\n/// theory\n/// (7)") == {3, 12, 14, 7}
    assert cited("Linn (48); theory of beams (3)") == set()
