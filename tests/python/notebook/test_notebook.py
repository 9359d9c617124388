"""What notebooks show: well-formed, small, true, and of every object that there is."""

from __future__ import annotations

import re
import subprocess
import sys
import xml.etree.ElementTree as ET
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import Phase, given, settings
from scenes_of_all_kinds import scenes
from support import FLAT, ROUND, SOFT

import pyrod
from pyrod import Clamp, Force, Rod, Scene
from pyrod.notebook.chart import chart
from pyrod.notebook.sketch import Arrow, Mark, Sketch, svg
from pyrod.notebook.table import Row, column_table, page

LARGEST = 20_000
TAGS = {"div", "strong", "small", "table", "tr", "th", "td", "svg", "path", "g", "text", "title"}
SVG = "{http://www.w3.org/2000/svg}"


def read(html: str) -> ET.Element:
    """The parsed page; nothing but tables, words and pictures may be in it."""
    assert len(html.encode()) < LARGEST
    root = ET.fromstring(html)
    tags = {element.tag.removeprefix(SVG) for element in root.iter()}
    assert tags <= TAGS
    attributes = {name for element in root.iter() for name in element.attrib}
    assert not {name for name in attributes if name.startswith("on") or "href" in name}
    assert not re.search("nan|inf", "".join(p.get("d", "") for p in root.iter(SVG + "path")))
    return root


def table(html: str) -> dict[str, tuple[str, str]]:
    """Value and unit by what they are of."""
    rows = {}
    for row in read(html).iter("tr"):
        what, value, unit = ("".join(cell.itertext()) for cell in row)
        rows[what] = (value, unit)
    return rows


def pictures(html: str) -> list[ET.Element]:
    return list(read(html).iter(SVG + "svg"))


def titles(html: str) -> list[str]:
    return [title.text or "" for title in read(html).iter(SVG + "title")]


def told(*numbers: float) -> str:
    return ", ".join(f"{x + 0.0:.6g}" for x in numbers)


# What the tables say ------------------------------------------------------------------------------


def test_numbers_are_those_of_the_result(cantilever: pyrod.Equilibrium) -> None:
    rows = table(cantilever._repr_html_())
    assert rows["status"][0] == "converged"
    assert rows["stability"][0] == "stable"
    assert rows["energy"] == (told(cantilever.energy), "J")
    assert rows["end"] == (f"({told(*cantilever.tip)})", "m")
    assert rows["largest curvature"] == (told(cantilever.largest_K), "1/m")
    assert rows["largest section force"] == (told(cantilever.largest_force), "N")
    assert rows["largest section moment"] == (told(cantilever.largest_moment), "N m")
    assert rows["reaction 0, force"] == (f"({told(*cantilever.reaction.force)})", "N")
    assert rows["reaction 0, moment"] == (f"({told(*cantilever.reaction.moment)})", "N m")
    assert rows["lowest eigenvalue"] == (told(cantilever.lowest_eigenvalue or 0), "N m")
    assert rows["iterations"][0] == str(cantilever.iterations)


def test_what_is_no_equilibrium_says_so() -> None:
    scene = Scene(Rod.straight(1.0, 32, ROUND), Clamp(), Force((30, 0, 0)))
    with pytest.raises(pyrod.NotConverged) as raised:
        pyrod.solve(scene, options=pyrod.Options(max_iterations=1))
    result = raised.value.result
    rows = table(result._repr_html_())
    assert rows["status"][0] == result.status != "converged"
    assert rows["advice"][0] == result.advice


def test_a_scene_names_its_parts() -> None:
    rod = Rod.straight(2.0, 8, SOFT)
    loads = [Force((0, 1.5, -2), at=0.5, follower=True), pyrod.DistributedMoment((0, 0, 1))]
    html = Scene(rod, [Clamp(), pyrod.Hinge(at="end")], loads)._repr_html_()
    rows = table(html)
    assert rows["rod 0"] == ("2, 8 edges, cosserat, straight", "m")
    assert rows["support 0"][0] == "Clamp, start"
    assert rows["support 1"][0] == "Hinge, end"
    assert rows["load 0"] == ("Force (0, 1.5, -2), 0.5 m, follower", "N")
    assert rows["load 1"] == ("DistributedMoment (0, 0, 1), rod 0", "N")
    assert titles(html).count("DistributedMoment") == 7
    assert {"Clamp, start", "Hinge, end", "Force, 0.5 m"} <= set(titles(html))


def test_a_rod_tells_its_stiffnesses() -> None:
    rows = table(Rod.precurved(1.0, 4, SOFT, (0, 0, 1))._repr_html_())
    assert [rows[name][0] for name in ("EI1", "GJ", "EA")] == ["1", "0.8", "150"]
    tapered = replace(Rod.straight(1.0, 4, SOFT), mass_per_length=[1, 2, 3, 4])
    assert table(tapered._repr_html_())["mass per length"] == ("1 to 4", "kg/m")


def test_a_rod_among_others_is_shown(joined_rods: pyrod.Equilibrium) -> None:
    rows = table(joined_rods.rods[1]._repr_html_())
    assert rows["energy"] == (told(joined_rods.rods[1].energy), "J")
    assert "Joint, rigid" in titles(joined_rods._repr_html_())


def test_curves_are_shown() -> None:
    ring = [(np.cos(x), np.sin(x), 0) for x in np.linspace(0, 2 * np.pi, 12, endpoint=False)]
    polyline = pyrod.curve.Polyline(ring, closed=True)
    rows = table(polyline._repr_html_())
    assert rows["length"] == (told(polyline.length), "m")
    framed = polyline.bishop()
    assert table(framed._repr_html_())["twist"] == (told(framed.twist), "turns")
    assert len(pictures(framed._repr_html_())) == 1


def test_a_critical_load_is_shown_with_its_mode() -> None:
    pytest.importorskip("scipy")
    column = Scene(Rod.straight(1.0, 16, FLAT), Clamp(), Force((0, 0, -1)), "planar")
    found = pyrod.critical_load(column)
    rows = table(found._repr_html_())
    assert rows["factor"][0] == told(found.factor)
    assert rows["index above"][0] == str(found.index_after) == "1"
    assert "stroke-dasharray" in found._repr_html_()


def sweep_of(parameters: Any, **more: Any) -> pyrod.Sweep:
    def scene(load: float, side: float = 0.0) -> Scene:
        return Scene(Rod.straight(1.0, 4, FLAT), Clamp(), Force((load, side, 0)))

    return pyrod.sweep(scene, parameters, progress=False, **more)


def test_a_sweep_shows_its_first_cases_and_a_chart() -> None:
    swept = sweep_of({"side": [0, 1, 2], "load": [1.0, 2, 3, 4]})
    html = swept._repr_html_()
    head, *cases = [["".join(c.itertext()) for c in row] for row in read(html).iter("tr")]
    assert len(cases) == 8
    assert "4 more cases" in html
    energies = [case[head.index("energy")] for case in cases]
    assert energies == [told(x) for x in swept["energy"].ravel()[:8]]
    assert "error" not in head
    (picture,) = pictures(html)
    (line,) = [p.get("d", "") for p in picture.iter(SVG + "path") if p.get("stroke-width")]
    assert line.count("M") == 3
    assert line.count("L") == 9


def test_a_sweep_shows_what_failed() -> None:
    swept = sweep_of([{"load": 1}, {"load": np.inf}])
    assert "<b>" not in swept._repr_html_()
    head, *cases = [
        ["".join(c.itertext()) for c in row] for row in read(swept._repr_html_())[1][0][0]
    ]
    assert cases[1][head.index("error")] == swept.failures[0].error[:200]


# What the pictures show ---------------------------------------------------------------------------


def test_a_picture_keeps_proportions() -> None:
    """A square of 1 m, seen along z, is one of as many pixels."""
    square = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0.0)])
    root = ET.fromstring(svg(Sketch([square], view=np.eye(3)[:2])))
    (line,) = [p.get("d", "") for p in root.iter(SVG + "path") if p.get("stroke-linejoin")]
    xy = np.array([pair.split() for pair in line[1:].split("L")], dtype=float)
    steps = np.diff(xy, axis=0)
    assert steps == pytest.approx(np.array([(192, 0), (0, -192), (-192, 0)]), abs=0.2)


def test_what_points_at_the_eye_has_no_head() -> None:
    line = np.array([(0, 0, 0), (1, 0, 0.0)])
    seen, hidden = (
        svg(Sketch([line], arrows=[Arrow(line[1], along, "f")], view=np.eye(3)[:2]))
        for along in (np.array([0, 1.0, 0]), np.array([0, 0, 1.0]))
    )
    assert len(seen) > len(hidden)
    assert ET.fromstring(hidden) is not None


def test_what_is_too_much_is_left_out_and_told() -> None:
    rods = [Rod.straight(1.0, 2, ROUND).placed((i, 0, 0)) for i in range(400)]
    scene = Scene(
        rods,
        [Clamp(at=(i, "start")) for i in range(400)],
        [Force((1, 0, 0), at=(i, "end")) for i in range(400)],
    )
    html = scene._repr_html_()
    assert "200 of 400 lines drawn, 30 of 400 supports and joints drawn" in html
    assert table(html)["…"][0] == "392 more loads"
    assert "…" in table(pyrod.solve(scene)._repr_html_())
    fine = Scene(Rod.straight(1.0, 100_000, ROUND), Clamp(), Force((1, 0, 0)))
    assert len(pictures(fine._repr_html_())) == 1


@pytest.mark.parametrize("size", [0.0, 5e-324, 1e-300, 1e300, np.nan, np.inf])
def test_no_size_is_too_much_for_a_picture(size: float) -> None:
    line = np.array([(0, 0, 0), (size, 0, size), (0, size, 0)])
    sketch = Sketch([line], [line], [Mark(line[1], "circle", "m")], [Arrow(line[0], line[1], "a")])
    drawn = svg(sketch)
    assert not drawn or not re.search("nan|inf", drawn)
    chart(np.array([[0.0, 1, 2]]), np.array([[size, 0, 1]]), "x", "y")


def test_special_characters_are_escaped() -> None:
    bad = "<script>alert('&')</script>\""
    for html in (
        page(bad, [Row(bad, bad, bad)], note=bad),
        column_table([bad], [[bad]]),
        chart(np.array([[0, 1.0]]), np.array([[0, 1.0]]), bad, bad),
        svg(Sketch([np.eye(3)], marks=[Mark(np.zeros(3), "square", bad)])),
    ):
        assert "<script" not in html
        assert bad in "".join(ET.fromstring(html).itertext())


def test_parameters_of_a_sweep_are_escaped() -> None:
    def scene(**loads: float) -> Scene:
        return Scene(Rod.straight(1.0, 4, FLAT), Clamp(), Force((loads["<b>&"], 0, 0)))

    swept = pyrod.sweep(scene, {"<b>&": [1.0, 2.0]}, progress=False)
    assert "<b>" not in swept._repr_html_()
    assert "&lt;b&gt;&amp;" in swept._repr_html_()


@settings(max_examples=100, phases=[Phase.explicit, Phase.generate])
@given(scenes())
def test_every_scene_is_shown(scene: Scene) -> None:
    html = scene._repr_html_()
    assert len(pictures(html)) == 1
    assert table(html)["space"][0] == scene.space
    for rod in scene.rods:
        assert len(pictures(rod._repr_html_())) == 1


def test_matplotlib_is_not_imported() -> None:
    code = (
        "import sys, pyrod; rod = pyrod.Rod.straight(1, 4, pyrod.Section(1, 1, 1));"
        "pyrod.solve(pyrod.Scene(rod, pyrod.Clamp(), pyrod.Force((1, 0, 0))))._repr_html_();"
        "print('matplotlib' in sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "False"
