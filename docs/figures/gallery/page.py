"""The code of a page, so that a picture shows the rods that its text is about."""

from __future__ import annotations

import re
from contextlib import redirect_stdout
from io import StringIO
from pathlib import Path
from types import SimpleNamespace

PAGES = Path(__file__).parents[2]


def run(page: str) -> SimpleNamespace:
    """Runs all blocks of a page, such as "howto/spring", and returns the names they define."""
    text = (PAGES / f"{page}.md").read_text()
    names: dict[str, object] = {"__name__": page}
    with redirect_stdout(StringIO()):
        for block in re.findall(r"^```python\n(.*?)^```", text, re.DOTALL | re.MULTILINE):
            exec(compile(block, page, "exec"), names)
    return SimpleNamespace(**names)
