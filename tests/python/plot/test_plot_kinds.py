"""Pictures besides the plain shape: strains, forces, stability, colours, and the overview."""

from __future__ import annotations

from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.collections import LineCollection
from support import FLAT, SOFT, solved, uninstall

import pyrod
from pyrod import Force, Rod, plot

Equilibrium = pyrod.Equilibrium
pytestmark = pytest.mark.usefixtures("close_figures")


def lines(ax: Any) -> dict[str, Any]:
    return {line.get_label(): line for line in ax.lines if line.get_label()[0] != "_"}


def steps(ax: Any) -> dict[str, Any]:
    return {patch.get_label(): patch for patch in ax.patches}


# Along the rod ------------------------------------------------------------------------------------


def test_strains_are_those_beyond_rest(cantilever: Equilibrium) -> None:
    upper, lower = cantilever.plot(what="strains")
    for i, name in enumerate(("K1", "K2", "K3")):
        x, y = lines(upper)[name].get_data()
        np.testing.assert_array_equal(x, cantilever.s)
        np.testing.assert_allclose(y, (cantilever.K - [0.3, 1.0, 0.5])[:, i], atol=1e-14)
    for i, name in enumerate(("Γ1", "Γ2", "Γ3")):
        values, edges, baseline = steps(lower)[name].get_data()
        np.testing.assert_allclose(values, (cantilever.Gamma - [0, 0, 1])[:, i], atol=1e-15)
        np.testing.assert_array_equal(edges, cantilever.s)
        assert baseline is None
    assert "K - K0 [1/m]" in upper.get_ylabel()
    assert "Γ - e3 [1]" in lower.get_ylabel()
    assert (upper.get_xlabel(), lower.get_xlabel()) == ("", "arc length s [m]")


def test_forces_are_those_in_space(cantilever: Equilibrium) -> None:
    upper, lower = cantilever.plot(what="forces")
    for i, axis in enumerate("xyz"):
        np.testing.assert_array_equal(
            steps(upper)[f"n_{axis}"].get_data()[0], cantilever.force[:, i]
        )
        np.testing.assert_array_equal(
            lines(lower)[f"m_{axis}"].get_ydata(), cantilever.moment[:, i]
        )
    assert "n [N]" in upper.get_ylabel()
    assert "m [N m]" in lower.get_ylabel()
    assert {text.get_text() for text in lower.get_legend().texts} == {"m_x", "m_y", "m_z"}


@pytest.mark.parametrize(
    ("model", "drawn"),
    [("cosserat", {"Γ1", "Γ2", "Γ3"}), ("extensible", {"Γ3"}), ("inextensible", set())],
)
def test_strains_that_the_model_has_not_are_not_drawn(model: str, drawn: set[str]) -> None:
    result = solved(Rod.straight(1.0, 4, SOFT, model), Force((1, 0, 0)))  # type: ignore[arg-type]
    _, lower = result.plot(what="strains")
    assert set(steps(lower)) == drawn
    assert [text.get_text() for text in lower.texts] == ["the model has none"] * (not drawn)


def test_rods_have_a_colour_each_and_components_a_line_style(
    joined_rods: Equilibrium,
) -> None:
    _, lower = joined_rods.plot(what="forces")
    found = lines(lower)
    assert len(found) == 6
    for number, rod in enumerate(joined_rods.rods):
        of_rod = [found[f"rod {number}: m_{axis}"] for axis in "xyz"]
        assert {line.get_color() for line in of_rod} == {f"C{number}"}
        assert [line.get_linestyle() for line in of_rod] == ["-", "--", ":"]
        np.testing.assert_array_equal(of_rod[1].get_ydata(), rod.moment[:, 1])
    legend = [text.get_text() for text in lower.get_legend().texts]
    assert legend == ["rod 0", "rod 1", "m_x", "m_y", "m_z"]


def test_markers_show_the_vertices_where_there_are_few() -> None:
    for edges, marker in ((5, "."), (60, "None")):
        _, lower = solved(Rod.straight(1.0, edges, FLAT), Force((1, 0, 0))).plot(what="forces")
        assert lines(lower)["m_x"].get_marker() == marker


def test_given_axes_are_used(cantilever: Equilibrium) -> None:
    _, given = plt.subplots(2)
    figures = plt.get_fignums()
    found = cantilever.plot(given, what="strains", linewidth=3)
    assert list(found) == list(given)
    assert plt.get_fignums() == figures
    assert lines(given[0])["K1"].get_linewidth() == 3
    assert steps(given[1])["Γ1"].get_linewidth() == 3
    with pytest.raises(ValueError, match="ax: expected 2 axes for force, moment, got 1"):
        cantilever.plot(given[0], what="forces")


# Colours ------------------------------------------------------------------------------------------


@pytest.mark.parametrize("of", ["moment", "material_moment.2", "s"])
def test_vertices_colour_their_half_edges(cantilever: Equilibrium, of: str) -> None:
    ax = cantilever.plot(colour_by=of, directors=False)
    (found,) = ax.collections
    expected = {
        "moment": np.linalg.norm(cantilever.moment, axis=1),
        "material_moment.2": cantilever.material_moment[:, 1],
        "s": cantilever.s,
    }
    np.testing.assert_allclose(found.get_array(), expected[of], rtol=1e-14)
    pieces = np.array(found._segments3d)
    np.testing.assert_allclose(pieces[:, 1], cantilever.positions, atol=1e-15)
    np.testing.assert_allclose(pieces[1:, 0], pieces[:-1, 2], atol=1e-15)
    middle = (cantilever.positions[1:] + cantilever.positions[:-1]) / 2
    np.testing.assert_allclose(pieces[1:, 0], middle, atol=1e-15)
    limits = np.array([ax.get_xlim(), ax.get_ylim(), ax.get_zlim()])
    plain = cantilever.plot(directors=False)
    expected_limits = np.array([plain.get_xlim(), plain.get_ylim(), plain.get_zlim()])
    np.testing.assert_allclose(limits, expected_limits, atol=0.05)


def test_edges_are_coloured_whole(planar_cantilever: Equilibrium) -> None:
    ax = planar_cantilever.plot(colour_by="force.x")
    (found,) = (c for c in ax.collections if isinstance(c, LineCollection))
    np.testing.assert_array_equal(found.get_array(), planar_cantilever.force[:, 0])
    pieces = np.array(found.get_segments())
    local = planar_cantilever.positions[:, [2, 0]]
    np.testing.assert_allclose(pieces, np.stack([local[:-1], local[1:]], axis=1), atol=1e-15)
    assert ax.get_aspect() == 1
    low, high = np.transpose([ax.get_xlim(), ax.get_ylim()])
    assert (low <= local.min(axis=0)).all()
    assert (high >= local.max(axis=0)).all()


def test_the_bar_tells_quantity_and_unit(joined_rods: Equilibrium) -> None:
    ax = joined_rods.plot(colour_by="moment.y")
    (bar,) = (other for other in ax.figure.axes if other is not ax)
    assert bar.get_ylabel() == "section moment m_y [N m]"
    values = np.concatenate([rod.moment[:, 1] for rod in joined_rods.rods])
    assert bar.get_ylim() == pytest.approx((values.min(), values.max()))


# Overview -----------------------------------------------------------------------------------------


def titles(figure: Any) -> list[str]:
    return [ax.get_title() for ax in figure.axes if ax.get_title()]


def test_the_overview_has_all_that_is_known(cantilever: Equilibrium) -> None:
    figure = cantilever.overview()
    labels = [ax.get_ylabel() for ax in figure.axes]
    for symbol in ("K - K0 [1/m]", "Γ - e3 [1]", "n [N]", "m [N m]", "residual [N m]"):
        assert sum(label.endswith(symbol) for label in labels) == 1, symbol
    assert any("lowest mode" in title for title in titles(figure))
    head = figure.get_suptitle()
    for fact in ("converged", "index 0", f"energy {cantilever.energy:.6g} J", "ms", "cosserat"):
        assert fact in head
    record = next(ax for ax in figure.axes if ax.get_xlabel() == "iteration")
    np.testing.assert_array_equal(record.lines[0].get_ydata(), cantilever.record["residual"])


def test_the_overview_leaves_out_what_there_is_not(joined_rods: Equilibrium) -> None:
    result = solved(Rod.straight(1.0, None, FLAT), Force((1, 0, 0)), space="planar", tol=1e-4)
    figure = result.overview()
    assert not any("Γ" in ax.get_ylabel() for ax in figure.axes)
    assert not any("mode" in title for title in titles(figure))
    assert str(result.accuracy) in figure.get_suptitle()
    assert "2 rods" in joined_rods.overview().get_suptitle()


def test_a_rod_that_is_at_rest_has_an_overview() -> None:
    figure = solved(Rod.straight(1.0, 4, FLAT)).overview()
    figure.canvas.draw()
    assert "converged" in figure.get_suptitle()


# What is refused ----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"what": "beauty"}, "what: expected one of shape, strains, forces, stability"),
        ({"colour_by": "beauty"}, "quantity: expected one of s, positions"),
        ({"colour_by": "moment.1"}, "quantity: moment has moment.x, moment.y, moment.z"),
        ({"colour_by": "s.x"}, "quantity: s has no components; got 's.x'"),
        ({"colour_by": "moment", "what": "forces"}, "only the shape can be coloured"),
        ({"colour_by": "moment", "color": "red"}, "color: give either it or colour_by"),
    ],
)
def test_bad_arguments(cantilever: Equilibrium, arguments: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        cantilever.plot(**arguments)
    assert not plt.get_fignums()


@pytest.mark.parametrize("draw", [plot.draw, plot.overview])
def test_without_matplotlib_the_remedy_is_told(
    cantilever: Equilibrium, draw: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    uninstall(monkeypatch, "matplotlib")
    with pytest.raises(ImportError, match=r"pip install 'pyrod\[plot\]'"):
        draw(cantilever)
