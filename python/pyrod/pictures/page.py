"""An interactive picture in one HTML file, made with plotly when it is written."""

from __future__ import annotations

import json
from base64 import b64encode
from pathlib import Path
from typing import Any

import numpy as np

from pyrod.base.calls import spelled
from pyrod.base.immutable import Array
from pyrod.base.optional import need
from pyrod.pictures.box import box
from pyrod.pictures.measure import measure, measures
from pyrod.pictures.swept import Swept, swept
from pyrod.result.equilibrium import Equilibrium

LEFT_OUT = ("vertex_frames", "frames", "positions", "a1", "a2", "a3")
"""Quantities that the picture shows as it is."""


@spelled
def write_html(
    result: Equilibrium, path: str | Path, colour_by: str | None = None, *, sides: int = 16
) -> None:
    """Writes an interactive picture as one HTML file that needs no network.

    The solid can be turned and coloured by any quantity out of a list; pointing at it tells arc
    length and value. Values of edges are shown as means at the vertices.

    Parameters
    ----------
    result : `Equilibrium`
        What to show.
    path : str or Path
        Of the file.
    colour_by : str
        The quantity shown at first, as for `Equilibrium.plot`; default: "moment".
    sides : int
        Into how many chords circles are cut; default 16.

    Raises
    ------
    ValueError
        An unknown quantity.
    ImportError
        plotly is not installed: ``pip install 'pyrod[html]'``.
    """
    figure = interactive(result, "moment" if colour_by is None else colour_by, sides)
    title = json.dumps(_title(result))
    figure.write_html(
        path,
        include_plotlyjs=True,
        config={"displaylogo": False, "responsive": True},
        post_script=f"document.title = {title}; document.body.style.margin = 0;",
    )


def interactive(result: Equilibrium, colour_by: str, sides: int) -> Any:
    """The plotly figure: the solid, the centrelines, and a list of quantities to colour by."""
    left_out = LEFT_OUT if result.tendons else {*LEFT_OUT, "backbone_force"}
    names = [name for name in measures() if name.partition(".")[0] not in left_out]
    if colour_by not in names:
        names = [*names, colour_by]
    mesh, objects = swept(result, sides), need("plotly.graph_objects", "html")
    looks = [_look(result, mesh, name) for name in names]
    start = looks[names.index(colour_by)]
    body = objects.Mesh3d(
        **dict(zip("xyz", mesh.points.T.astype(np.float32), strict=True)),
        **dict(zip("ijk", mesh.triangles.T, strict=True)),
        name="solid",
        showlegend=True,
        colorscale="Viridis",
        flatshading=True,  # outlines may have edges
        lighting={"ambient": 0.65, "diffuse": 0.5, "specular": 0.2},
        **start,
    )
    figure = objects.Figure([body, *_centrelines(result, objects)])
    figure.update_layout(
        title={"text": _title(result), "font": {"size": 15}},
        legend={"x": 0, "y": 1},
        margin={"l": 0, "r": 0, "b": 0, "t": 70},
        scene=_space(result),
        updatemenus=[_menu(names, looks, names.index(colour_by))],
    )
    return figure


def _look(result: Equilibrium, mesh: Swept, name: str) -> dict[str, Any]:
    """What changes with the quantity: colours, what is told of a point, and the colour bar."""
    by = measure(result, name)
    values = mesh.at_points(by.at_vertices).astype(np.float32)
    s = mesh.at_points([rod.s for rod in result.rods])
    told = f"s = %{{customdata[0]:.4g}} m<br>{by.label}: %{{customdata[1]:.4g}}"
    return {
        "intensity": values,
        "customdata": np.column_stack([s, values]).astype(np.float32),
        "hovertemplate": f"{told}<extra></extra>",
        "colorbar": {"title": {"text": by.label, "side": "right"}, "len": 0.8},
    }


def _centrelines(result: Equilibrium, objects: Any) -> list[Any]:
    """A line for each rod, which is switched on in the legend."""
    return [
        objects.Scatter3d(
            **dict(zip("xyz", rod.positions.T, strict=True)),
            mode="lines+markers",
            visible="legendonly",
            line={"width": 4},
            marker={"size": 2},
            name="centreline" if len(result.rods) == 1 else f"centreline {number}",
            customdata=rod.s,
            hovertemplate="s = %{customdata:.4g} m<br>(%{x:.4g}, %{y:.4g}, %{z:.4g}) m",
        )
        for number, rod in enumerate(result.rods)
    ]


def _space(result: Equilibrium) -> dict[str, Any]:
    """Axes of one scale, in a box whose longest side fills the view."""
    low, high = box(np.vstack([rod.positions for rod in result.rods]))
    margin = 0.05 * (high - low).max()
    axes = {
        f"{axis}axis": {"title": {"text": f"{axis} [m]"}, "range": [a - margin, b + margin]}
        for axis, a, b in zip("xyz", low.tolist(), high.tolist(), strict=True)
    }
    sides = high - low + 2 * margin
    ratio = dict(zip("xyz", (sides / sides.max()).tolist(), strict=True))
    camera = {"eye": {"x": 1.15, "y": 1.15, "z": 0.9}}
    return {"aspectmode": "manual", "aspectratio": ratio, "camera": camera, **axes}


def _menu(names: list[str], looks: list[dict[str, Any]], active: int) -> dict[str, Any]:
    """The list of quantities; a choice changes the first trace, the solid."""
    buttons = [
        {"label": name, "method": "restyle", "args": [_restyled(look), [0]]}
        for name, look in zip(names, looks, strict=True)
    ]
    return {
        "buttons": buttons,
        "active": active,
        "x": 1.0,
        "xanchor": "right",
        "y": 1.0,
        "yanchor": "bottom",
    }


def _restyled(look: dict[str, Any]) -> dict[str, Any]:
    """The look as an update of one trace: arrays are wrapped, as each is for one trace."""
    bar = look["colorbar"]["title"]["text"]
    arrays = {name: [_encoded(look[name])] for name in ("intensity", "customdata")}
    return {**arrays, "hovertemplate": look["hovertemplate"], "colorbar.title.text": bar}


def _encoded(array: Array) -> dict[str, str]:
    """An array as plotly writes those of traces; in menus it would write the digits."""
    data = b64encode(array.tobytes()).decode()
    return {"dtype": "f4", "bdata": data, "shape": ", ".join(map(str, array.shape))}


def _title(result: Equilibrium) -> str:
    rods = f"{len(result.rods)} rods" if len(result.rods) > 1 else repr(result.scene.rod)
    return f"{rods}, {result.status}, energy {result.energy:.6g} J"
