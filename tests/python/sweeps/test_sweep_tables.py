"""What a sweep shows: tables, files, a bar."""

from __future__ import annotations

import pickle
import re
from typing import Any

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from support import same_sweep
from sweeps import GRID, cantilever, sweep

import pyrod
from pyrod import Clamp, Force, Material, Rod, Scene, Section, solve

LIST = [{"load": 1.0, "angle": 0.3}, {"angle": 2.0, "load": 0.1}, {"load": 1.0, "angle": 0.3}]


@pytest.fixture(scope="module")
def grid() -> pyrod.Sweep:
    return sweep(cantilever, GRID)


def test_rows_of_a_frame(grid: pyrod.Sweep) -> None:
    frame = grid.to_pandas()
    assert frame.index.name == "case"
    assert list(frame["load"][::6]) == GRID["load"]
    np.testing.assert_array_equal(frame[["tip.0", "tip.1", "tip.2"]], grid.columns["tip"])
    assert "tip" not in frame


def test_dimensions_of_a_dataset(grid: pyrod.Sweep) -> None:
    tables = grid.to_xarray()
    assert dict(tables.sizes) == {"load": 5, "angle": 6, "tip_0": 3}
    one = tables.sel(load=2.0).isel(angle=3)
    alone = solve(cantilever(2.0, GRID["angle"][3]))
    np.testing.assert_array_equal(one["tip"], alone.tip)
    assert float(one["energy"]) == alone.energy
    frame = tables[["energy"]].to_dataframe().reset_index()
    np.testing.assert_array_equal(frame["energy"], grid.to_pandas()["energy"])


def test_a_dataset_of_a_list_has_cases() -> None:
    tables = sweep(cantilever, LIST).to_xarray()
    assert dict(tables.sizes) == {"case": 3, "tip_0": 3}
    assert list(tables["angle"].values) == [0.3, 2.0, 0.3]
    assert set(tables.coords) == {"case", "load", "angle"}


def made(section: Section, direction: Any, name: str | None = None) -> Scene:
    return Scene(Rod.straight(1.0, 8, section), Clamp(), Force(direction))


def test_parameters_may_be_anything() -> None:
    sections = [Section.circle(r, Material(1e9)) for r in (0.01, 0.02)]
    directions = [np.array([1.0, 0, 0]), np.array([0, 1.0, 0])]
    done = sweep(made, {"section": sections, "direction": directions, "name": [None, "b"]})
    tables = done.to_xarray()
    assert list(tables["section"].values) == sections
    assert [list(d) for d in tables["direction"].values] == [[1, 0, 0], [0, 1, 0]]
    assert [done.case(i)["name"] for i in (0, 7)] == [None, "b"]
    assert done.case(7)["section"] is sections[1]
    tips = tables["tip"].isel(section=0, name=0)
    assert float(tips[0, 0]) == pytest.approx(float(tips[1, 1]))
    assert list(done.to_pandas()["direction.1"]) == [0, 0, 1, 1, 0, 0, 1, 1]
    listed = sweep(made, [done.case(0), done.case(7)]).to_xarray()
    assert listed["direction"].dims == ("case", "direction_0")


def test_a_table_that_cannot_be_written_leaves_what_was_there(
    grid: pyrod.Sweep, tmp_path: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    def half(self: pd.DataFrame, path: Any) -> None:
        path.write_text("case,load")
        raise OSError("disk is full")

    (tmp_path / "grid.csv").write_text("before")
    monkeypatch.setattr(pd.DataFrame, "to_csv", half)
    with pytest.raises(OSError, match="disk is full"):
        grid.save(tmp_path / "grid.csv")
    assert [(p.name, p.read_text()) for p in tmp_path.iterdir()] == [("grid.csv", "before")]


def test_a_table_is_saved_with_all_digits(grid: pyrod.Sweep, tmp_path: Any) -> None:
    grid.save(tmp_path / "grid.csv")
    back = pd.read_csv(tmp_path / "grid.csv", index_col="case", keep_default_na=False)
    fine = back["error"] == ""
    for name in ("load", "angle", "energy", "tip.2"):
        numbers = back.loc[fine, name].astype(float)
        np.testing.assert_array_equal(numbers, grid.to_pandas().loc[fine, name])
    with pytest.raises(ValueError, match=r"path: a sweep is saved as .csv, got 'grid.xls'"):
        grid.save("grid.xls")


def test_a_sweep_can_be_pickled(grid: pyrod.Sweep) -> None:
    back = pickle.loads(pickle.dumps(grid))
    same_sweep(back, grid, but=())
    assert not back["energy"].flags.writeable
    assert isinstance(back.to_xarray(), xr.Dataset)


def test_unknown_quantities_are_refused(grid: pyrod.Sweep) -> None:
    with pytest.raises(KeyError, match="'mass' is not in the sweep; it has load, angle, status"):
        grid["mass"]


# Progress -----------------------------------------------------------------------------------------


def test_a_bar_is_shown_with_the_failures(capsys: pytest.CaptureFixture[str]) -> None:
    pyrod.sweep(cantilever, {"load": [1.0, 13.0], "angle": [1.0, 2.0]})
    shown = capsys.readouterr()
    assert re.search(r"100%\|█+\| 4/4 \[.* cases/s, failed=2\]\n$", shown.err)
    assert shown.out == ""
    sweep(cantilever, {"load": [1.0], "angle": [1.0]})
    assert capsys.readouterr() == ("", "")


def test_a_function_is_told_of_progress() -> None:
    told: list[tuple[int, int]] = []
    sweep(cantilever, {"load": [1.0], "angle": [1.0, 2.0, 3.0]}, progress=lambda *n: told.append(n))
    assert told == [(1, 3), (2, 3), (3, 3)]
