# SPDX-License-Identifier: GPL-3.0-or-later
"""Section of the report on tests of specimens that crack: energies and cracked area over strain or time, and the crack in a
section of the specimen."""

from __future__ import annotations

from itertools import product
from typing import Any

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import Normalize

from macadam.report import look, specimen
from macadam.report.folders import Folder
from macadam.report.page import Page
from macadam.report.spheres import frame, outline

# Energies from the bottom of the stack to its top: key of a point, name, colour.
ENERGIES = (
    ("crack_energy_j", "cracks", "#c4532f"),
    ("friction_energy_j", "friction", "#b98a1d"),
    ("viscous_energy_j", "dashpots", "#1f5a8a"),
    ("elastic_energy_j", "springs", "#3c8558"),
    ("kinetic_energy_j", "motion", "#80569b"),
    ("damping_energy_j", "damping", "#6b6f76"),
)
DAMAGE = "inferno_r"  # colour map of the damage
DRAWN = 0.5  # damage above which a facet is drawn in the picture of the whole specimen


def add(page: Page, folders: list[Folder]) -> None:
    """Adds the section for folders of tests whose points have crack energies."""
    found = [f for f in folders if f.in_time and (f.in_time.get("points") or [{}])[0].get("work_j") is not None]
    if not found:
        return
    page.section("Cracks and energies")
    for folder in found:
        if len(found) > 1:
            page.heading(folder.label)
        figure, words = _energies(folder)
        page.figure(figure, words, "energies and cracked area over strain")
        if folder.specimen is None or not folder.has("damage.csv"):
            page.leave_out(folder.label, "the crack in a section", "no specimen.csv or no damage.csv in the folder")
            continue
        figure, words = _section(folder)
        page.figure(figure, words, "the crack in a section of the specimen", raster=True)
        figure, words = _block(folder)
        page.figure(figure, words, "the crack in the specimen", raster=True)


def _energies(folder: Folder) -> tuple[Any, str]:
    """Draws the energies as a stack (left) and the cracked and broken area by pair (right). Returns figure and
    caption."""
    points = folder.in_time["points"]
    along, axis = _abscissa(points)
    thermal = _known(points, "thermal_work_j")
    work = [p["work_j"] + (p["thermal_work_j"] if thermal else 0) for p in points]
    supply = "work of the walls" + (" and against thermal expansion" if thermal else "")
    figure, (left, right) = look.figure(look.WIDE, 2.7, 1, 2)
    stack = [(name, colour, [1e3 * p[key] for p in points]) for key, name, colour in ENERGIES if _known(points, key)]
    left.stackplot(
        along, [np.clip(values, 0, None) for _, _, values in stack], colors=[c for _, c, _ in stack], alpha=0.75,
        labels=[name for name, _, _ in stack],
    )  # fmt: skip
    left.plot(along, 1e3 * np.array(work), color=look.INK, lw=1, ls="--", label="work")
    left.set(xlabel=axis, ylabel="energy (mJ)")
    handles, labels = left.get_legend_handles_labels()
    left.legend(handles[::-1], labels[::-1], loc="upper left")
    drawn = _area(folder, right, along)
    right.set(xlabel=axis, ylabel="area of contact points (mm²)")
    right.set_ylim(bottom=0)
    if drawn:
        right.legend()
    words = f"Left: the {supply} (dashed) and the energies into which it was converted, stacked. "
    words += (
        "Right: area of the points that have begun to crack (dashed) and that are broken, by pair of materials."
        if drawn
        else "Right: no contact point cracked."
    )
    error = folder.in_time.get("energy_error")
    if error is not None:
        words += f" The sum of the energies differs from the work by at most {look.percent(error, 2)} of the work."
    last = points[-1]
    if work[-1] > 0:
        parts = [f"{name} {look.percent(last[key] / work[-1])}" for key, name, _ in ENERGIES if _known(points, key)]
        words += f" At the end: work {look.number(1e3 * work[-1], 3)} mJ, of which {', '.join(parts)}."
    return figure, words


def _abscissa(points: list[dict[str, Any]]) -> tuple[np.ndarray, str]:
    """Returns the strain of the points and its name for an axis; the time [h] if the specimen is held while its
    temperature changes."""
    if _known(points, "temperature_c") and all(p["strain"] == 0 for p in points):
        return np.array([p["time_s"] / 3600 for p in points]), "time (h)"
    return np.array([1e6 * p["strain"] for p in points]), "strain (µm/m)"


def _known(points: list[dict[str, Any]], key: str) -> bool:
    return all(p.get(key) is not None for p in points)


def _area(folder: Folder, axes: Any, along: np.ndarray) -> bool:
    """Draws the area of the points that have begun to crack (dashed) and of those that are broken (solid), by pair.
    Returns whether any point has begun to crack."""
    points = folder.in_time["points"]
    pairs = [pair for pair, area in points[-1].get("cracked_area_m2", {}).items() if area > 0]
    broken = folder.table("cracks.csv", ["pair", "area_m2", "time_s"]) if _breaks(folder) else None
    times = np.array([p["time_s"] for p in points])
    for pair in pairs:
        colour = look.PAIRS.get(pair, look.INK)
        axes.plot(along, [1e6 * p["cracked_area_m2"][pair] for p in points], color=colour, ls="--", lw=1)
        rows = broken[broken["pair"] == pair] if broken is not None else None
        by_time = np.zeros(len(times)) if rows is None else [
            1e6 * rows.loc[rows["time_s"] <= t * (1 + 1e-9), "area_m2"].sum() for t in times
        ]  # fmt: skip
        axes.plot(along, by_time, color=colour, label=pair)
    return bool(pairs)


def _breaks(folder: Folder) -> bool:
    return folder.has("cracks.csv") and any(c["points"] for c in (folder.summary.get("cracks") or {}).values())


def chords(
    centre: np.ndarray, normal: np.ndarray, area: np.ndarray, axis: int, value: float
) -> tuple[np.ndarray, np.ndarray]:
    """Cuts discs by the plane axis = value. Each disc has the centre, normal and area of a facet. Returns the indices of
    the discs that the plane cuts, and both ends of the line in which it cuts each of them: (n, 2, 3) [m]."""
    across = np.zeros(3)
    across[axis] = 1
    along = np.cross(normal, across)
    length = np.linalg.norm(along, axis=1)
    steep = length > 1e-6  # other discs are parallel to the plane
    along[steep] /= length[steep, None]
    inside = np.cross(normal, along)  # direction in the disc, perpendicular to the line
    slope = inside[:, axis]
    distance = np.divide(value - centre[:, axis], slope, out=np.full(len(slope), np.inf), where=steep)
    square = area / np.pi - distance**2
    cuts = np.flatnonzero(square > 0)
    middle = centre[cuts] + distance[cuts, None] * inside[cuts]
    half = np.sqrt(square[cuts])[:, None] * along[cuts]
    return cuts, np.stack([middle - half, middle + half], axis=1)


def _section(folder: Folder) -> tuple[Any, str]:
    """Draws a section through the middle with the facets that have begun to crack, coloured by their damage. Returns
    figure and caption."""
    box = specimen.box_of(folder)
    axis, (u, v) = 1, (0, 2)
    paint = specimen.colours_of(folder)
    picture = specimen.plane_of(folder, box, axis, box[axis] / 2, paint)
    height = specimen.HEIGHT * 1.2
    figure, axes = look.figure(min(look.WIDE, height * box[u] / box[v] + 1.6), height)
    axes.grid(False)
    axes.set_aspect("equal")
    extent = (0, 1e3 * box[u], 0, 1e3 * box[v])
    axes.imshow(0.5 + 0.5 * picture, origin="lower", extent=extent, interpolation="antialiased")
    scale = ScalarMappable(Normalize(0, 1), DAMAGE)
    drawn = 0
    table = damaged(folder)
    if table is not None:
        table = table.sort_values("damage", kind="stable")  # the most damaged facets are drawn last
        cuts, lines = chords(
            table[list("xyz")].to_numpy(float), table[["nx", "ny", "nz"]].to_numpy(float),
            table["area_m2"].to_numpy(float), axis, box[axis] / 2,
        )  # fmt: skip
        damage = table["damage"].to_numpy(float)[cuts]
        axes.add_collection(
            LineCollection(1e3 * lines[:, :, [u, v]], colors=scale.to_rgba(damage), linewidths=0.6 + 1.6 * damage)
        )
        drawn = len(cuts)
    figure.colorbar(scale, ax=axes, label="damage", shrink=0.8)
    axes.set(xlim=extent[:2], ylim=extent[2:], xlabel=f"{'xyz'[u]} (mm)", ylabel=f"{'xyz'[v]} (mm)")
    return figure, (
        f"Section at {'xyz'[axis]} = {look.length(box[axis] / 2)} mm at the end of the test, with the {drawn} facets in "
        "it that have begun to crack. Each facet is drawn as a disc of its area; its colour is its mean damage, 0 intact "
        "and 1 separated."
    )


def damaged(folder: Folder) -> Any:
    """Returns the table of the contacts that have begun to crack, or None without such contacts. The folder must have a
    damage.csv if a contact has begun to crack."""
    cracked = any(c.get("cracked_points") for c in (folder.summary.get("cracks") or {}).values())
    return folder.table("damage.csv", ["x", "y", "z", "nx", "ny", "nz", "area_m2", "opening_m", "damage"]) if cracked else None


def discs(centre: np.ndarray, normal: np.ndarray, area: np.ndarray, corners: int = 16) -> np.ndarray:
    """Returns regular polygons with the centres, normals and areas of facets: (n, corners, 3) [m]."""
    least = np.eye(3)[np.abs(normal).argmin(axis=1)]  # an axis that is far from the normal
    first = np.cross(normal, least)
    first /= np.linalg.norm(first, axis=1)[:, None]
    second = np.cross(normal, first)
    radius = np.sqrt(area / (0.5 * corners * np.sin(2 * np.pi / corners)))
    angle = 2 * np.pi * np.arange(corners) / corners
    ring = np.cos(angle)[:, None] * first[:, None] + np.sin(angle)[:, None] * second[:, None]
    return centre[:, None] + radius[:, None, None] * ring


def _block(folder: Folder) -> tuple[Any, str]:
    """Draws the facets with a mean damage above DRAWN in the outline of the box, from the back to the front. Returns
    figure and caption."""
    box, turn = specimen.box_of(folder), specimen.directions_of_view()
    corners = np.array(list(product(*([0, e] for e in box)))) @ turn.T
    figure, axes = look.figure(look.THIRD + 1, specimen.HEIGHT * 1.2)
    outline(axes, corners, "#c3c7cc")
    scale = ScalarMappable(Normalize(DRAWN, 1), DAMAGE)
    table = damaged(folder)
    table = None if table is None else table[table["damage"] > DRAWN]
    drawn = 0 if table is None else len(table)
    if drawn:
        centre = table[list("xyz")].to_numpy(float)
        shapes = discs(centre, table[["nx", "ny", "nz"]].to_numpy(float), table["area_m2"].to_numpy(float)) @ turn.T
        order = np.argsort(centre @ turn[2], kind="stable")  # draws the facets nearest to the eye last
        colours = scale.to_rgba(table["damage"].to_numpy(float)[order])
        axes.add_collection(
            PolyCollection(shapes[order][:, :, :2], facecolors=colours, edgecolors=(0, 0, 0, 0.4), linewidths=0.2, zorder=2)
        )
    figure.colorbar(scale, ax=axes, label="damage", shrink=0.8)
    frame(axes, corners.min(axis=0), corners.max(axis=0))
    return figure, (
        f"The {drawn} facets whose mean damage is above {DRAWN} at the end of the test, as discs of the same "
        "area in the box of the specimen."
    )
