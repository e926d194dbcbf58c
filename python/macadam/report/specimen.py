# SPDX-License-Identifier: GPL-3.0-or-later
"""Section of the report with pictures of the specimen: the block as if sawn, a cross section, and the aggregates. Cells
are Laguerre cells."""

from __future__ import annotations

from collections.abc import Callable
from itertools import product
from typing import Any

import numpy as np
from matplotlib.patches import Patch
from matplotlib.transforms import Affine2D

from macadam.report import look, phases
from macadam.report.folders import Folder
from macadam.report.page import Page
from macadam.report.spheres import frame, outline, spheres

MOST = 8  # largest number of folders whose specimens are drawn
HEIGHT = 3.0  # height of each of the three pictures [inches]
SAWN = 0.22  # fraction of each edge that is removed in the picture of the block
PIXELS = 420  # pixels along the longest edge of the box
FINE = 1200  # the same, if the figures are also written as files of their own
Paint = Callable[[np.ndarray], np.ndarray]  # returns the colours of rows of specimen.csv


# Adds pictures of the block, of a section and of the aggregates of each specimen to the page.
def add(page: Page, folders: list[Folder]) -> None:
    runs = [f for f in folders if f.kind in ("run", "twin")]
    drawn = []
    for folder in runs:
        if folder.specimen is None:
            page.leave_out(folder.label, "pictures of the specimen", "no specimen.csv in the folder")
        elif len(drawn) == MOST:
            page.leave_out(folder.label, "pictures of the specimen", f"only the pictures of {MOST} folders are shown")
        else:
            drawn.append(folder)
    if not drawn:
        return
    page.section("The specimen")
    for folder in drawn:
        if len(drawn) > 1:
            page.heading(folder.label)
        box, paint = box_of(folder), colours_of(folder)
        pixels = FINE if page.export else PIXELS
        page.figure(
            _block(folder, box, paint, pixels),
            f"The specimen, {look.percent(SAWN, 2)} sawn off the front, the right and the top. " + _legend_words(folder),
            "the specimen as a block",
            third=True,
            raster=True,
        )
        section, words = _section(folder, box, paint, pixels)
        page.figure(section, words, "a section of the specimen", third=True, raster=True)
        if (folder.specimen["phase"] == "aggregate").any():
            grains, words = spheres(folder.specimen, box, paint, directions_of_view(), HEIGHT)
            page.figure(grains, words, "the aggregates in the specimen", third=True, raster=True)


def picture(folder: Folder, what: str) -> Any:
    """Returns the figure "block", "section" or "aggregates" of a folder that has a specimen."""
    box, paint = box_of(folder), colours_of(folder)
    if what == "block":
        return _block(folder, box, paint)
    if what == "section":
        return _section(folder, box, paint)[0]
    return spheres(folder.specimen, box, paint, directions_of_view(), HEIGHT)[0]


# Returns the edges of the box [m]; without a summary, the edges of the volume that contains the spheres.
def box_of(folder: Folder) -> np.ndarray:
    edges = folder.summary.get("box_m")
    s = folder.specimen
    return np.array(edges, float) if edges else np.array([(s[a] + s["radius"]).max() for a in "xyz"])


def colours_of(folder: Folder) -> Paint:
    """Returns a function from rows of specimen.csv to colours: mastic blue, air white, aggregates by size class, each a
    little lighter or darker."""
    s = folder.specimen
    body = s["body"].to_numpy(int)
    colour = np.tile(phases.rgb(phases.MASTIC), (len(s), 1))
    colour[(s["phase"] == "void").to_numpy()] = phases.rgb(phases.VOID)
    grain = (s["phase"] == "aggregate").to_numpy()
    table = folder.aggregates
    names = dict(zip(table["body"], table["class"])) if table is not None else {}
    of_body = {b: phases.shaded(phases.of_class(names.get(b)), b) for b in np.unique(body[grain]).tolist()}
    if of_body:
        colour[grain] = [of_body[b] for b in body[grain]]
    return lambda rows: colour[rows]


# Returns the names of the size classes by their numbers.
def _names(folder: Folder) -> dict[int, str]:
    table = folder.aggregates
    if table is None:
        return {}
    return {int(k): str(n).replace("-", "–") for k, n in sorted(set(zip(table["size_class"], table["class"])))}


def _legend_words(folder: Folder) -> str:
    void = " Air voids are white." if (folder.specimen["phase"] == "void").any() else ""
    classes = "Each aggregate has the colour of its size class" if _names(folder) else "Aggregates are brown"
    return f"{classes}, the mastic is blue.{void}"


def cells_at(u: np.ndarray, v: np.ndarray, centre: np.ndarray, radius: np.ndarray) -> np.ndarray:
    """Returns the particle whose Laguerre cell contains each point (u, v) of a grid in a plane, one row per v: the
    particle with the least power distance |x − c|² − r². centre: (n, 3), u, v and the distance from the plane; metres.

    The power distance of a sphere is below a bound only at points within √(bound + r²) of the centre. So each sphere is
    compared only with the points within that distance. If at some point no sphere has a power distance below the bound,
    everything is repeated with a bound four times as large."""
    own = radius**2 - centre[:, 2] ** 2
    bound = 0.25 * float(np.median(radius)) ** 2
    while True:
        least = np.full((len(v), len(u)), np.inf)
        cell = np.zeros(least.shape, int)
        near = np.flatnonzero(own + bound > 0)
        reach = np.sqrt(own[near] + bound)
        first_u, last_u = (np.searchsorted(u, centre[near, 0] + side * reach) for side in (-1, 1))
        first_v, last_v = (np.searchsorted(v, centre[near, 1] + side * reach) for side in (-1, 1))
        for k, a, b, c, d in zip(near, first_v, last_v, first_u, last_u, strict=True):
            power = (v[a:b, None] - centre[k, 1]) ** 2 + ((u[c:d] - centre[k, 0]) ** 2 - own[k])
            closer = power < least[a:b, c:d]
            least[a:b, c:d][closer] = power[closer]
            cell[a:b, c:d][closer] = k
        if (least <= bound).all():
            return cell
        bound *= 4


def plane_of(
    folder: Folder, box: np.ndarray, axis: int, value: float, paint: Paint, pixels: int = PIXELS
) -> np.ndarray:
    """Returns the picture of the cells in the plane axis = value. Columns and rows are the two other axes in their
    order, from low to high."""
    u, v = [k for k in range(3) if k != axis]
    step = box.max() / pixels
    nu, nv = max(1, round(box[u] / step)), max(1, round(box[v] / step))
    centre = folder.specimen[["x", "y", "z"]].to_numpy(float)[:, [u, v, axis]] - [0, 0, value]
    along = [(np.arange(n) + 0.5) * box[k] / n for n, k in ((nu, u), (nv, v))]
    cell = cells_at(*along, centre, folder.specimen["radius"].to_numpy(float))
    body = folder.specimen["body"].to_numpy(int)[cell]
    picture = paint(cell)
    rim = np.zeros(body.shape, bool)  # pixels where two aggregates meet, which become a dark line
    for a, b in (((slice(1, None),), (slice(-1),)), ((slice(None), slice(1, None)), (slice(None), slice(-1)))):
        rim[a] |= (body[a] != body[b]) & (body[a] >= 0) & (body[b] >= 0)
    picture[rim] *= 0.45
    at = {u: along[0][None, :], v: along[1][:, None], axis: np.array([[value]])}
    picture[np.broadcast_to(_outside(folder.summary.get("domain") or {}, at, box), body.shape)] = 1  # white
    return picture


def _outside(domain: dict[str, Any], at: dict[int, np.ndarray], box: np.ndarray) -> np.ndarray:
    """Returns which points of the bounding box, given by their coordinates x, y, z [m], lie outside the domain."""
    x, y, z = (at[k] for k in range(3))
    if domain.get("shape") == "cylinder":
        return np.hypot(x - box[0] / 2, y - box[0] / 2) > box[0] / 2
    if domain.get("shape") in ("disc", "half_disc"):
        return np.hypot(x - box[0] / 2, z - (box[0] / 2 if domain["shape"] == "disc" else 0)) > box[0] / 2
    if domain.get("shape") == "trapezoid" and "dimensions_m" in domain:
        half = (box[0] + (domain["dimensions_m"]["top_width"] - box[0]) * z / box[2]) / 2
        return np.abs(x - box[0] / 2) > half
    return np.zeros(np.broadcast_shapes(x.shape, y.shape, z.shape), bool)


def _section(folder: Folder, box: np.ndarray, paint: Paint, pixels: int = PIXELS) -> tuple[Any, str]:
    """Draws the first cross section that the program wrote or, if it wrote none, one through the middle. Returns figure
    and caption."""
    written = sorted(folder.path.glob("section_*.csv"))
    figure, axes = look.figure(look.THIRD, HEIGHT)
    axes.grid(False)
    axes.set_aspect("equal")
    if written:
        from matplotlib.collections import PolyCollection

        table = folder.table(written[0].name, ["particle", *"xyz"])
        cells = [(int(k), 1e3 * g[list("xyz")].to_numpy(float)) for k, g in table.groupby("particle", sort=False)]
        corners = np.concatenate([c for _, c in cells])
        axis = int(np.argmin(np.ptp(corners, axis=0)))
        u, v = [k for k in range(3) if k != axis]
        void = np.array(phases.rgb(phases.VOID))
        face = [paint(np.array([k]))[0] if k < len(folder.specimen) else void for k, _ in cells]
        axes.add_collection(
            PolyCollection([c[:, [u, v]] for _, c in cells], facecolors=face, edgecolors=(0, 0, 0, 0.5), linewidths=0.2)
        )
        where, source = corners[0, axis], f"Cells as the program cut them ({written[0].name})."
    else:
        axis, (u, v) = 1, (0, 2)
        picture = plane_of(folder, box, axis, box[axis] / 2, paint, pixels)
        axes.imshow(picture, origin="lower", extent=(0, 1e3 * box[u], 0, 1e3 * box[v]), interpolation="antialiased")
        where, source = 1e3 * box[axis] / 2, "The cells of the particles fill the section."
    axes.set(xlim=(0, 1e3 * box[u]), ylim=(0, 1e3 * box[v]), xlabel=f"{'xyz'[u]} (mm)", ylabel=f"{'xyz'[v]} (mm)")
    names = _names(folder)
    if names:
        handles = [Patch(fc=phases.of_class(n), ec="#5a5f68", lw=0.4, label=n) for n in names.values()]
        handles.append(Patch(fc=phases.MASTIC, label="mastic"))
        figure.legend(
            handles=handles,
            loc="outside lower center",
            ncols=3,
            handlelength=1,
            handleheight=1,
            columnspacing=1,
            handletextpad=0.4,
            fontsize=6.5,
        )
    return figure, f"Section at {'xyz'[axis]} = {look.number(float(where), 3)} mm. {source}"


def directions_of_view() -> np.ndarray:
    """Returns the directions of view as rows of a matrix: right, up, towards the eye."""
    a, e = np.radians([-60, 24])
    towards = np.array([np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)])
    right = np.array([-np.sin(a), np.cos(a), 0])
    return np.array([right, np.cross(towards, right), towards])


def _block(folder: Folder, box: np.ndarray, paint: Paint, pixels: int = PIXELS) -> Any:
    """Draws the block that is left after the fraction SAWN is removed from the three visible sides. The drawing
    consists of three pictures of cells, each sheared to the direction of view, in the outline of the box."""
    turn = directions_of_view()
    corners = np.array(list(product(*([0, e] for e in box)))) @ turn.T
    low, high = corners.min(axis=0), corners.max(axis=0)
    figure, axes = look.figure(look.THIRD, HEIGHT)
    outline(axes, corners, "#c3c7cc")
    first = np.array([0.0, SAWN * box[1], 0.0])
    last = np.array([(1 - SAWN) * box[0], box[1], (1 - SAWN) * box[2]])
    for axis, value, light in ((1, first[1], 0.95), (0, last[0], 0.74), (2, last[2], 1.12)):
        u, v = [k for k in range(3) if k != axis]
        picture = plane_of(folder, box, axis, value, paint, pixels)
        rows, columns = picture.shape[:2]
        at = [
            round(x * n / e)
            for x, n, e in (
                (first[u], columns, box[u]),
                (last[u], columns, box[u]),
                (first[v], rows, box[v]),
                (last[v], rows, box[v]),
            )
        ]
        corner = first.copy()
        corner[axis] = value
        origin, a, b = turn[:2] @ corner, turn[:2, u] * (last - first)[u], turn[:2, v] * (last - first)[v]
        shear = Affine2D(np.array([[a[0], b[0], origin[0]], [a[1], b[1], origin[1]], [0, 0, 1]]))
        shown = axes.imshow(
            np.clip(picture[at[2] : at[3], at[0] : at[1]] * light, 0, 1),
            origin="lower",
            extent=(0, 1, 0, 1),
            aspect="auto",
            interpolation="antialiased",
            zorder=2,
        )
        shown.set_transform(shear + axes.transData)
        axes.plot(*np.array([origin, origin + a, origin + a + b, origin + b, origin]).T, color=look.INK, lw=0.5)
    frame(axes, low, high)
    return figure
