# SPDX-License-Identifier: GPL-3.0-or-later
"""The view in three dimensions: an HTML file beside the report, in which a specimen can be turned and cut.

The package K3D draws the view, because its pages contain the whole library (about 1 MB), load nothing, and store five
numbers per sphere. A page of PyVista would contain the triangles of every sphere."""

from __future__ import annotations

import importlib.util
import json
from html import escape
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np

from macadam.report import cracks, look, specimen
from macadam.report.folders import Folder, ReportError
from macadam.report.page import Page
from macadam.report.spheres import largest

MOST_SPHERES = 50_000  # largest number of spheres; the page then has about 2 MB
MOST_FACETS = 20_000  # largest number of facets of each kind
CORNERS = 8  # corners of a facet; facets are drawn as polygons of the same area
WALL = 0x3C8558  # colour of facets at walls
# The browser loads nothing from elsewhere. K3D evaluates its own source, which the page contains.
_POLICY = (
    "default-src 'none'; script-src 'unsafe-inline' 'unsafe-eval' blob:; style-src 'unsafe-inline'; "
    "img-src data: blob:; font-src data:; worker-src blob:; connect-src data: blob:"
)


def require_package() -> None:
    """Raises ReportError if the Python package K3D is missing."""
    if importlib.util.find_spec("k3d") is None:
        raise ReportError(
            "view: found no Python package k3d, expected it; install it with pip install 'macadam[view]', or leave out "
            "the view"
        )


def add(page: Page, folders: list[Folder], report: Path) -> None:
    """Adds a link to the view of each folder that has a specimen. The views are written together with the page, beside
    the file `report`, and are named after it."""
    shown = [f for f in folders if f.kind in ("run", "twin") and f.specimen is not None]
    page.section("The specimen in three dimensions")
    for number, folder in enumerate(shown, 1):
        name = f"{report.stem}-3d{'' if len(shown) == 1 else f'-{number}'}.html"
        page.companions[name], words = html(folder)
        page.link(name, f"{folder.label}: turn and cut the specimen", words)
    for folder in folders:
        if folder not in shown:
            page.leave_out(folder.label, "the view in three dimensions", "no specimen.csv in the folder")


def html(folder: Folder) -> tuple[str, str]:
    """Returns the page with the view of a folder that has a specimen, and the sentences that say what it shows."""
    import k3d

    box = 1e3 * specimen.box_of(folder)
    plot = k3d.plot(
        name=folder.label, grid_visible=False, camera_auto_fit=False, camera_mode="orbit", camera_up_axis="z", axes=["x", "y", "z"]
    )
    distance = 1.25 * float(np.linalg.norm(box))
    eye = box / 2 + distance * specimen.directions_of_view()[2]
    plot.camera = [*eye.tolist(), *(box / 2).tolist(), 0, 0, 1]
    cracked, crack_words = _cracks(plot, folder)
    shown, words = _spheres(plot, folder, mastic=cracked == 0)
    walls, wall_words = _walls(plot, folder)
    corners = np.array(list(product(*([0, edge] for edge in box))))
    edges = [(i, j) for i, j in product(range(8), repeat=2) if i < j and bin(i ^ j).count("1") == 1]
    plot += k3d.lines(corners.astype(np.float32), np.array(edges, np.uint32), "segment", color=0x8A8F98, shader="simple", name="box")
    facts = {
        "folder": folder.label,
        "particles": int((folder.specimen["phase"] != "void").sum()),
        "spheres": shown,
        "facets_at_walls": walls,
        "cracked_facets": cracked,
        "box_mm": box.tolist(),
    }
    said = " ".join(w for w in (*words, *wall_words, *crack_words) if w)
    return _page(plot, folder.label, said, facts), said


# Adds the spheres, one layer per phase. `mastic`: whether the layer of the mastic is visible at first. Returns the number
# of spheres, and sentences.
def _spheres(plot: Any, folder: Folder, mastic: bool) -> tuple[int, list[str]]:
    import k3d

    table, paint = folder.specimen, specimen.colours_of(folder)
    radius = table["radius"].to_numpy(float)
    rows = largest(radius, np.arange(len(table)), MOST_SPHERES)
    phase = table["phase"].to_numpy(str)[rows]
    centre = 1e3 * table[["x", "y", "z"]].to_numpy(float)
    for name in ("aggregate", "mastic", "void"):
        part = rows[phase == name]
        if len(part):
            plot += k3d.points(
                centre[part].astype(np.float32),
                point_sizes=(2e3 * radius[part]).astype(np.float32),  # K3D takes diameters
                colors=_packed(paint(part)),
                shader="3d",
                roughness=0.7,
                visible=name == "aggregate" or name == "mastic" and mastic,
                name=f"{name} ({look.number(len(part))} spheres)",
            )
    words = ["Spheres have the colours of the other pictures."]
    if len(rows) < len(table):
        words.append(f"Of {look.number(len(table))} spheres the {look.number(len(rows))} largest are shown.")
    if (phase == "void").any():
        words.append("Air voids are hidden at first.")
    if not mastic and (phase == "mastic").any():
        words.append("The mastic is hidden at first, so that the cracks can be seen.")
    return len(rows), words


# Adds the facets at walls, through which the specimen is loaded. A free side has no such facets.
def _walls(plot: Any, folder: Folder) -> tuple[int, list[str]]:
    if not folder.has("contacts.csv"):
        return 0, ["The loaded facets are not shown, because the folder has no contacts.csv (contacts = true in [output])."]
    names = ["a", "b", "area", "distance", "nx", "ny", "nz"]
    table = folder.table("contacts.csv", names)
    table = table[table["b"] < 0]
    if not len(table):
        return 0, ["No contact joins the specimen to a wall."]
    first = table["a"].to_numpy(int)
    if first.min() < 0 or first.max() >= len(folder.specimen):
        raise ReportError(
            f"{folder.path / 'contacts.csv'}: found the particle {first.max() if first.min() >= 0 else first.min()}, expected "
            f"numbers from 0 to {len(folder.specimen) - 1} as in specimen.csv"
        )
    normal = table[["nx", "ny", "nz"]].to_numpy(float)
    centre = folder.specimen[["x", "y", "z"]].to_numpy(float)[first] + table["distance"].to_numpy(float)[:, None] * normal
    area = table["area"].to_numpy(float)
    chosen = largest(area, np.arange(len(area)), MOST_FACETS)
    _facets(plot, f"facets at walls ({look.number(len(chosen))})", centre[chosen], normal[chosen], area[chosen], color=WALL)
    words = "The facets at the loaded walls are green discs of the same area."
    if len(chosen) < len(area):
        words += f" Of {look.number(len(area))} the {look.number(len(chosen))} largest are shown."
    return len(chosen), [words]


# Adds the facets that have begun to crack, coloured by their mean opening. Those with little damage are a layer of their
# own, which is hidden at first.
def _cracks(plot: Any, folder: Folder) -> tuple[int, list[str]]:
    import k3d

    table = cracks.damaged(folder) if folder.has("damage.csv") else None
    if table is None:
        return 0, []
    opening, damage = 1e6 * table["opening_m"].to_numpy(float), table["damage"].to_numpy(float)
    # not the maximum: with a few very wide openings, all other facets would have the same colour
    high = max(float(np.quantile(opening, 0.99)), 1e-6)
    drawn = 0
    for wide in (False, True):
        rows = largest(opening, np.flatnonzero((damage > cracks.DRAWN) == wide), MOST_FACETS)
        if not len(rows):
            continue
        drawn += len(rows)
        _facets(
            plot,
            f"opening (µm), damage {'above' if wide else 'up to'} {cracks.DRAWN} ({look.number(len(rows))} facets)",
            table[list("xyz")].to_numpy(float)[rows],
            table[["nx", "ny", "nz"]].to_numpy(float)[rows],
            table["area_m2"].to_numpy(float)[rows],
            attribute=np.repeat(opening[rows], CORNERS).astype(np.float32),
            color_map=k3d.matplotlib_color_maps.Plasma,
            color_range=[0.0, high],
            visible=wide,
        )
        plot.colorbar_object_id = plot.objects[-1].id
    words = "Facets that have begun to crack are discs of the same area, coloured by their opening. The colours end at "
    words += f"{look.number(high, 3)} µm. Facets with a mean damage up to {cracks.DRAWN} are hidden at first."
    if drawn < len(opening):
        words += f" Of {look.number(len(opening))} facets the {look.number(drawn)} with the widest openings are shown."
    return drawn, [words]


# Adds facets as polygons of the same area. Lengths in metres, area in square metres.
def _facets(plot: Any, name: str, centre: np.ndarray, normal: np.ndarray, area: np.ndarray, **colours: Any) -> None:
    import k3d

    corners = 1e3 * cracks.discs(centre, normal, area, CORNERS)
    fan = np.array([[0, k, k + 1] for k in range(1, CORNERS - 1)])
    triangles = (CORNERS * np.arange(len(centre))[:, None, None] + fan).reshape(-1, 3)
    plot += k3d.mesh(
        corners.reshape(-1, 3).astype(np.float32), triangles.astype(np.uint32), side="double", flat_shading=True, name=name, **colours
    )


# Returns colours (n, 3), each from 0 to 1, as numbers 0xrrggbb.
def _packed(colours: np.ndarray) -> np.ndarray:
    parts = np.rint(255 * np.clip(colours, 0, 1)).astype(np.uint32)
    return parts[:, 0] << 16 | parts[:, 1] << 8 | parts[:, 2]


# Returns K3D's page with our title, sentences, policy and script. Raises ReportError if K3D's page has another form.
def _page(plot: Any, title: str, words: str, facts: dict[str, Any]) -> str:
    import k3d

    here = Path(__file__).parent
    made = plot.get_snapshot(9, additional_js_code=(here / "view.js").read_text(encoding="utf-8"))
    style = (here / "view.css").read_text(encoding="utf-8")
    data = json.dumps(facts).replace("<", "\\u003c")
    head = (
        f'<head><meta http-equiv="Content-Security-Policy" content="{_POLICY}"><link rel="icon" href="data:,">'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
    )
    body = (
        f"<style>{style}</style><aside><details open><summary>{escape(title)}</summary><p>{escape(words)}</p>"
        "<p>Turn: drag. Move: drag with the right button. Zoom: wheel. Layers: Objects, in the panel.</p></details>"
        '<label>Cut along <select id="axis"><option>x<option selected>y<option>z</select>'
        '<input id="cut" type="range" min="0" max="1" step="0.005" value="0"></label></aside>'
        f'<script type="application/json" id="facts">{data}</script>'
        '<p id="none" hidden>This browser has no WebGL 2, so it cannot draw the view.</p><script>'
        'document.getElementById("none").hidden = document.createElement("canvas").getContext("webgl2") !== null</script>'
    )
    for mark, text in (("<head>", head), ("<body>", f"<body>{body}")):
        if made.count(mark) != 1:
            raise ReportError(f"view: found a page of K3D {k3d.__version__} with {made.count(mark)} marks {mark}, expected one")
        made = made.replace(mark, text)
    start, end = made.index("<title>"), made.index("</title>")
    return f"{made[:start]}<title>{escape(title)}{made[end:]}"
