"""Pictures of results in files."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from pyrod.base.optional import need
from pyrod.result.equilibrium import Equilibrium


def save_picture(result: Equilibrium, path: Path, **style: Any) -> None:
    """What `Equilibrium.plot` draws."""
    pyplot = need("matplotlib.pyplot", "plot")
    axes: Any = result.plot(**style)  # of one picture, or of several
    figure = np.ravel(axes)[0].figure
    try:
        figure.savefig(path)
    finally:
        pyplot.close(figure)


def save_html(result: Equilibrium, path: Path, **options: Any) -> None:
    """What `Equilibrium.to_html` writes."""
    result.to_html(path, **options)
