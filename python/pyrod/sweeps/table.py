"""What came of a sweep, as tables."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from pyrod.base.immutable import Immutable, sealed
from pyrod.base.optional import need
from pyrod.base.words import listed, shortly
from pyrod.files.atomic import check_place, replacing
from pyrod.notebook.chart import chart
from pyrod.notebook.table import MOST_ROWS, column_table, framed
from pyrod.result.equilibrium import Equilibrium
from pyrod.sweeps.cases import Cases
from pyrod.sweeps.work import Record

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr


class Failure(NamedTuple):
    """A case without an equilibrium."""

    case: int  #: its number
    parameters: dict[str, Any]  #: by name
    error: str  #: type and text of the exception


@dataclass(frozen=True, eq=False, repr=False)
class Sweep(Immutable):
    """What came of all cases of a sweep.

    ``sweep["energy"]`` is an array of the shape of the grid (or with a row per case), and so are
    all other quantities, the parameters, "time" [s], "warnings" and "error".
    """

    parameters: dict[str, tuple[Any, ...]]
    """Values by name, along the axes of the grid; or, of a list, of every case."""
    grid: bool  #: whether all combinations of them were solved
    columns: dict[str, np.ndarray]  #: by name, a row per case; the last parameter runs fastest
    results: tuple[Equilibrium | None, ...] | None  #: per case, if they were kept
    elapsed: float = field(compare=False)  #: time that it took, without what was stored before [s]

    @property
    def shape(self) -> tuple[int, ...]:
        """Of the grid; or (cases,)."""
        return tuple(map(len, self.parameters.values())) if self.grid else (len(self),)

    @property
    def quantities(self) -> tuple[str, ...]:
        """Names of what was measured, and "time", "warnings", "error"."""
        return tuple(name for name in self.columns if name not in self.parameters)

    @property
    def failures(self) -> list[Failure]:
        """The cases that have no equilibrium, or whose scene or measure raised an exception."""
        return [
            Failure(int(case), self.case(int(case)), str(self.columns["error"][case]))
            for case in np.flatnonzero(self.columns["error"] != "")
        ]

    def case(self, number: int) -> dict[str, Any]:
        """The parameters of a case by name."""
        if not self.grid:
            return {name: values[number] for name, values in self.parameters.items()}
        at = np.unravel_index(number, self.shape)
        return {n: v[i] for (n, v), i in zip(self.parameters.items(), at, strict=True)}

    def __len__(self) -> int:
        return len(self.columns["error"])

    def __getitem__(self, name: str) -> np.ndarray:
        if name not in self.columns:
            raise KeyError(f"{shortly(name)} is not in the sweep; it has {listed(self.columns)}")
        column = self.columns[name]
        return column.reshape(self.shape + column.shape[1:])

    def to_pandas(self) -> pd.DataFrame:
        """A row per case; arrays have a column per number: ``tip.0``, ``tip.1``, ``tip.2``."""
        flat = {
            ".".join((name, *map(str, at))): column[(slice(None), *at)]
            for name, column in self.columns.items()
            for at in np.ndindex(column.shape[1:])
        }
        frame = need("pandas", "sweep").DataFrame(flat)
        frame.index.name = "case"
        return frame

    def to_xarray(self) -> xr.Dataset:
        """A variable per quantity. Its dimensions are the parameters of the grid, or "case"; those
        of arrays come behind them: ``tip_0``."""
        dims = tuple(self.parameters) if self.grid else ("case",)
        variables = {
            name: (
                (*dims, *(f"{name}_{k}" for k in range(self.columns[name].ndim - 1))),
                self[name],
            )
            for name in (self.quantities if self.grid else self.columns)
        }
        axes = self.parameters if self.grid else {"case": range(len(self))}
        coords = {name: (name, _axis(values)) for name, values in axes.items()}
        tables = need("xarray", "sweep").Dataset(variables, coords)
        return tables if self.grid else tables.set_coords(list(self.parameters))

    def save(self, path: str | PathLike[str]) -> None:
        """Writes `to_pandas` to a file .csv, with all digits.

        Raises
        ------
        ValueError
            It has another suffix.
        """
        check_table(path)
        with replacing(Path(path)) as temporary:
            self.to_pandas().to_csv(temporary)

    def _ipython_key_completions_(self) -> list[str]:
        """What may stand in brackets."""
        return list(self.columns)

    def _repr_html_(self) -> str:
        """What notebooks show: the first cases, and a quantity over the last parameter."""
        names = [name for name, column in self.columns.items() if _is_small(column)]
        rows = [(case, *(self.columns[name][case] for name in names)) for case in range(len(self))]
        kept = rows[:MOST_ROWS]
        left = len(rows) - len(kept)
        note = f"{left} more cases; to_pandas() has them all" if left else ""
        return framed(repr(self), column_table(("case", *names), kept), self._picture(), note)

    def _picture(self) -> str:
        """The first quantity that is a number with digits, over the parameter that runs fastest."""
        over = list(self.parameters)[-1]
        x = self.columns[over]
        for name in self.quantities:
            y = self.columns[name]
            if x.dtype.kind in "iuf" and x.ndim == 1 and y.dtype.kind == "f" and y.ndim == 1:
                line = self.shape[-1]
                return chart(x.reshape(-1, line), y.reshape(-1, line), over, name)
        return ""

    def __repr__(self) -> str:
        parts = [f"{len(self)} cases"]
        if self.grid:
            sizes = zip(self.shape, self.parameters, strict=True)
            parts[0] += " of " + " x ".join(f"{size} {name}" for size, name in sizes)
        for name, word in (("error", "failed"), ("warnings", "with warnings")):
            count = np.count_nonzero(self.columns[name] != "")
            parts += [f"{count} {word}"] if count else []
        return f"Sweep({', '.join(parts)}, {self.elapsed:.2g} s)"


def sweep_of(cases: Cases, records: Mapping[int, Record], keep: bool, elapsed: float) -> Sweep:
    """The table of cases that were solved."""
    ordered = [records[case] for case in range(len(cases.rows))]
    listed = tuple(zip(*cases.rows, strict=True))
    columns = {n: _column(values) for n, values in zip(cases.names, listed, strict=True)}
    known = [record.values or {} for record in ordered]
    for name in dict.fromkeys(name for values in known for name in values):
        columns[name] = _column(_filled([values.get(name) for values in known]))
    for name in ("time", "warnings", "error"):
        columns[name] = _column([getattr(record, name) for record in ordered])
    results = tuple(record.result for record in ordered) if keep else None
    parameters = dict(zip(cases.names, cases.axes or listed, strict=True))
    return Sweep(parameters, cases.axes is not None, sealed(columns), results, elapsed)


def _is_small(column: np.ndarray) -> bool:
    """Whether a column says something in a small table: short rows, not all of them empty."""
    short = column.ndim == 1 or column[0].size <= 4
    return short and not (column.dtype.kind == "U" and not (column != "").any())


def check_table(path: str | PathLike[str]) -> None:
    """Refuses paths at which no table can be, before there is one."""
    if Path(path).suffix != ".csv":
        raise ValueError(f"path: a sweep is saved as .csv, got {shortly(str(path))}")
    check_place(Path(path))


def _filled(values: list[Any]) -> list[Any]:
    """NaN, or no text, where a case has no value."""
    first = next(value for value in values if value is not None)
    blank = "" if isinstance(first, str) else np.full(np.shape(first), np.nan)
    return [blank if value is None else value for value in values]


def _column(values: Sequence[Any]) -> np.ndarray:
    """An array with a row per value; of objects if they are neither numbers nor text, or differ in
    their shapes."""
    kinds = {(isinstance(value, str), np.shape(value)) for value in values}
    if len(kinds) == 1 and all(isinstance(v, (str, int, float, np.ndarray)) for v in values):
        return np.array(values)
    return _objects(values)


def _axis(values: Sequence[Any]) -> np.ndarray:
    column = _column(values)
    return column if column.ndim == 1 else _objects(values)


def _objects(values: Sequence[Any]) -> np.ndarray:
    column = np.empty(len(values), dtype=object)
    column[:] = values
    return column
