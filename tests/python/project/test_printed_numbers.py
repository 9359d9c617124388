"""Numbers that pages about critical loads tell in comments are those that are printed."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
NUMBER = re.compile(r"(?<![\w.^])-?\d+\.\d+(?:e-?\d+)?|(?<![\w.])\d+e-\d+")


def is_rounded(told: str, printed: str) -> bool:
    """Whether a number in a comment is a printed one with fewer digits."""
    mantissa, _, exponent = told.partition("e")
    digit = 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2]))
    return abs(float(told) - float(printed)) <= 0.501 * digit


@pytest.mark.parametrize("page", ["critical_loads.md", "howto/buckling.md", "measured_curves.md"])
def test_comments_tell_what_is_printed(
    page: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    names: dict[str, object] = {"__name__": "__main__"}
    blocks = re.findall(r"```python\n(.*?)```", (ROOT / "docs" / page).read_text(), re.DOTALL)
    compared = 0
    for block in blocks:
        exec(compile(block, page, "exec"), names)
        printed = re.findall(r"-?\d+\.?\d*(?:e-?\d+)?", capsys.readouterr().out)
        for comment in re.findall(r"^print\(.*\)  # (.*)$", block, re.MULTILINE):
            for told in NUMBER.findall(comment):
                assert any(is_rounded(told, number) for number in printed), (told, printed)
                compared += 1
    assert compared > 0
