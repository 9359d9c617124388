"""The interactive picture: its data, and what a browser without network shows."""

from __future__ import annotations

import io
import json
import re
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from support import SOFT, uninstall

import pyrod
from pyrod import Clamp, Force, Joint, Material, Rod, Scene, Section
from pyrod.pictures.page import interactive
from pyrod.pictures.swept import swept

pytestmark = pytest.mark.outside

pytest.importorskip("plotly", reason="interactive pictures need plotly")

FLAT = Section.rectangle(0.02, 0.06, Material(E=1e6))


@pytest.fixture(scope="module")
def bent() -> pyrod.Equilibrium:
    return pyrod.solve(Scene(Rod.straight(1.0, 12, SOFT), Clamp(), Force((2.0, 1.0, 0.0))))


@pytest.fixture(scope="module")
def net() -> pyrod.Equilibrium:
    rods = [Rod.straight(1.0, 4, FLAT), Rod.straight(1.0, 6, FLAT).placed((0, 0, 1))]
    joint = Joint(((0, "end"), (1, "start")))
    return pyrod.solve(Scene(rods, Clamp(), Force((0.1, 0, 0), at=(1, "end")), joints=joint))


# The figure ---------------------------------------------------------------------------------------


def test_the_solid_is_the_swept_one(net: pyrod.Equilibrium) -> None:
    mesh, body = swept(net, 16), interactive(net, "moment", 16).data[0]
    np.testing.assert_allclose(np.column_stack([body.x, body.y, body.z]), mesh.points, atol=1e-7)
    np.testing.assert_array_equal(np.column_stack([body.i, body.j, body.k]), mesh.triangles)
    expected = [np.linalg.norm(rod.moment, axis=1) for rod in net.rods]
    np.testing.assert_allclose(body.intensity, mesh.at_points(expected), atol=1e-7)
    s = mesh.at_points([rod.s for rod in net.rods])
    np.testing.assert_allclose(np.array(body.customdata)[:, 0], s, rtol=1e-6)
    np.testing.assert_array_equal(np.array(body.customdata)[:, 1], body.intensity)
    assert "section moment |m| [N m]" in body.hovertemplate
    assert body.colorbar.title.text == "section moment |m| [N m]"


def test_every_rod_has_its_centreline(net: pyrod.Equilibrium, bent: pyrod.Equilibrium) -> None:
    _, *lines = interactive(net, "moment", 16).data
    assert [line.name for line in lines] == ["centreline 0", "centreline 1"]
    for line, rod in zip(lines, net.rods, strict=True):
        np.testing.assert_array_equal(np.column_stack([line.x, line.y, line.z]), rod.positions)
        np.testing.assert_array_equal(line.customdata, rod.s)
    assert interactive(bent, "moment", 16).data[1].name == "centreline"


def test_scales_are_equal_and_hold_the_rods(net: pyrod.Equilibrium) -> None:
    space = interactive(net, "moment", 16).layout.scene
    sides = [np.ptp(getattr(space, f"{name}axis").range) for name in "xyz"]
    ratios = [space.aspectratio[name] for name in "xyz"]
    np.testing.assert_allclose(ratios, sides / max(sides))
    positions = np.vstack([rod.positions for rod in net.rods])
    for axis, name in enumerate("xyz"):
        shown = getattr(space, f"{name}axis")
        assert shown.range[0] < positions[:, axis].min() <= positions[:, axis].max()
        assert positions[:, axis].max() < shown.range[1]
        assert shown.title.text == f"{name} [m]"


def test_the_list_has_all_quantities_but_those_that_are_seen(bent: pyrod.Equilibrium) -> None:
    (menu,) = interactive(bent, "K.2", 16).layout.updatemenus
    labels = [button.label for button in menu.buttons]
    assert labels[menu.active] == "K.2"
    assert {"s", "K", "K.1", "Gamma.3", "force.x", "moment", "load.z"} <= set(labels)
    assert not any(label.startswith(("positions", "frames", "a1")) for label in labels)


def test_a_quantity_that_is_not_in_the_list_is_added(bent: pyrod.Equilibrium) -> None:
    figure = interactive(bent, "a3.z", 16)
    (menu,) = figure.layout.updatemenus
    assert menu.buttons[menu.active].label == menu.buttons[-1].label == "a3.z"
    assert figure.data[0].colorbar.title.text == "director a3 a3_z [1]"


def test_values_of_edges_are_means_at_the_vertices(bent: pyrod.Equilibrium) -> None:
    body = interactive(bent, "Gamma.1", 16).data[0]
    mesh, values = swept(bent, 16), bent.Gamma[:, 0]
    middle = np.array(body.intensity)[mesh.vertex == 5]
    np.testing.assert_allclose(middle, (values[4] + values[5]) / 2, rtol=1e-6)


def test_unknown_quantities_are_refused_and_nothing_is_written(
    bent: pyrod.Equilibrium, tmp_path: Path
) -> None:
    with pytest.raises(ValueError, match="quantity: expected one of"):
        bent.to_html(tmp_path / "rod.html", "beauty")
    assert not list(tmp_path.iterdir())


def test_without_plotly_the_remedy_is_told(
    bent: pyrod.Equilibrium, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    uninstall(monkeypatch, "plotly")
    with pytest.raises(ImportError, match=r"pip install 'pyrod\[html\]'"):
        bent.to_html(tmp_path / "rod.html")


# In a browser -------------------------------------------------------------------------------------

FLAGS = [
    "--headless=new",
    "--no-sandbox",
    "--use-angle=swiftshader",  # WebGL without a graphics card
    "--enable-unsafe-swiftshader",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--no-first-run",
    "--window-size=800,700",
]
COLOURS_ARE_DRAWN = "return !!document.querySelector('.gl-container canvas')"


@pytest.fixture(scope="module")
def browser(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Any]:
    webdriver = pytest.importorskip("selenium.webdriver", reason="selenium drives the browser")
    chromium, driver = shutil.which("chromium"), shutil.which("chromedriver")
    if chromium is None or driver is None:
        pytest.skip("chromium and chromedriver are not there")
    options = webdriver.ChromeOptions()
    options.binary_location = chromium
    for flag in [*FLAGS, f"--user-data-dir={tmp_path_factory.mktemp('profile')}"]:
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    service = webdriver.ChromeService(driver)
    with webdriver.Chrome(options=options, service=service) as opened:
        yield opened


@pytest.fixture(scope="module")
def page(browser: Any, bent: pyrod.Equilibrium, tmp_path_factory: pytest.TempPathFactory) -> Any:
    """The browser with the picture of the bent rod."""
    path = tmp_path_factory.mktemp("html") / "rod.html"
    bent.to_html(path)
    browser.get_log("performance")  # what it asked for before
    browser.get(path.as_uri())
    until(browser, lambda: browser.execute_script(COLOURS_ARE_DRAWN))
    return browser


def until(browser: Any, condition: Callable[[], Any]) -> Any:
    """What the condition finds, once it finds something."""
    from selenium.webdriver.support.wait import WebDriverWait

    return WebDriverWait(browser, 30, poll_frequency=0.1).until(lambda _: condition())


def picture(browser: Any) -> np.ndarray:
    """(height, width, 3) the pixels of the page."""
    import matplotlib.image

    return matplotlib.image.imread(io.BytesIO(browser.get_screenshot_as_png()))[..., :3]


def on_the_rod(image: np.ndarray) -> np.ndarray:
    """(height, width) which pixels have a strong colour, besides title, legend and colour bar."""
    strong = np.ptp(image, axis=2) > 0.3
    height, width = strong.shape
    strong[: height // 3] = False
    strong[:, width * 3 // 4 :] = False
    return strong


def choose(browser: Any, name: str) -> None:
    """Picks a quantity with the mouse out of the part of the list that is seen at first."""
    from selenium.webdriver import ActionChains

    def texts() -> list[Any]:
        found = browser.find_elements("css selector", ".updatemenu-dropdown-button")
        return [button for button in found if button.text == name]

    header = browser.find_element("css selector", ".updatemenu-header")
    ActionChains(browser).click(header).perform()
    ActionChains(browser).click(until(browser, texts)[0]).perform()


def test_the_page_loads_without_errors_and_without_network(page: Any) -> None:
    assert [entry for entry in page.get_log("browser") if entry["level"] == "SEVERE"] == []
    events = [json.loads(entry["message"])["message"] for entry in page.get_log("performance")]
    asked = [
        event["params"]["request"]["url"]
        for event in events
        if event["method"] == "Network.requestWillBeSent"
    ]
    assert any(url.startswith("file://") for url in asked)
    assert not [url for url in asked if url.startswith(("http:", "https:", "ws:", "wss:"))]
    assert page.title.startswith("Rod(cosserat, straight, length=1, edges=12), converged")


def test_the_page_does_not_scroll(page: Any) -> None:
    inside = "return document.documentElement.scrollHeight <= window.innerHeight"
    assert page.execute_script(inside)


def test_the_rod_is_drawn_in_colours_that_the_list_changes(page: Any) -> None:
    def mean_colour() -> list[float] | None:
        image = picture(page)
        found = image[on_the_rod(image)]
        return found.mean(axis=0).tolist() if len(found) > 200 else None

    moment = until(page, mean_colour)
    choose(page, "load")
    body = "document.querySelector('.plotly-graph-div')._fullData[0]"
    bar = f"return {body}.colorbar.title.text"
    until(page, lambda: page.execute_script(bar) == "load |f| [N]")
    values = page.execute_script(f"return Array.from({body}.intensity)")
    assert max(values) == pytest.approx(5**0.5)
    assert "load |f| [N]" in page.execute_script(f"return {body}.hovertemplate")

    def other_colour() -> bool:
        found = mean_colour()
        return found is not None and np.abs(np.subtract(found, moment)).max() > 0.02

    assert until(page, other_colour)


def test_pointing_at_the_rod_tells_arc_length_and_value(page: Any) -> None:
    from selenium.webdriver.common.actions.action_builder import ActionBuilder

    told = "return document.querySelector('.hovertext')?.textContent"
    strong = on_the_rod(picture(page))
    rows, columns = np.nonzero(strong)
    row, column = rows[len(rows) // 2], columns[len(rows) // 2]

    def text() -> str | None:
        pointer = ActionBuilder(page, duration=0)
        for shift in (0, 1):  # it has to move
            pointer.pointer_action.move_to_location(int(column) + shift, int(row))
        pointer.perform()
        return page.execute_script(told)

    assert re.search(r"s = [\d.]+ m.*\[.*\]: [\d.]+", until(page, text))
