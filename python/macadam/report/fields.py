# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws pictures of field files (docs/fields.md) with PyVista, without a screen: particles as spheres, contacts as
tubes, cells as polygons."""

from __future__ import annotations

import importlib.util
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize

from macadam.report import look
from macadam.report.folders import Folder, ReportError
from macadam.report.page import Page

MOST = 4  # largest number of folders whose fields are drawn
STRONGEST = 0.06  # fraction of the contacts that is drawn, those with the largest forces
# For each kind of file: the names of arrays (the first one that the file has is drawn), a factor for the numbers of
# this array, and its label with the unit
_SHOWN = {
    "particles": (("displacement_amplitude", "displacement"), 1e6, "displacement (µm)"),
    "contacts": (("normal_force_amplitude", "normal_force"), 1.0, "normal force (N)"),
}


def add(page: Page, folders: list[Folder]) -> None:
    """Adds pictures of particles and contacts for each run that wrote fields, at its first frequency or its last
    time."""
    found = [(f, _files(f)) for f in folders if f.kind == "run"]
    found = [(f, files) for f, files in found if files]
    if not found:
        return
    why = cannot_draw()
    if why:
        for f, _ in found:
            page.leave_out(f.label, "pictures of the fields", why)
        return
    page.section("Fields")
    for f, files in found[:MOST]:
        if len(found) > 1:
            page.heading(f.label)
        for kind, file in files.items():
            names, factor, label = _SHOWN[kind]
            made, words = figure(
                file,
                names,
                factor=factor,
                label=label,
                half=kind == "particles",
                strongest=STRONGEST if kind == "contacts" else 1,
                size=(look.THIRD, 2.6),
            )
            page.figure(made, words, f"{kind} of {file.name}", third=True, raster=True)
    for f, _ in found[MOST:]:
        page.leave_out(f.label, "pictures of the fields", f"only the pictures of {MOST} folders are shown")


def cannot_draw() -> str:
    """Returns why pictures of fields cannot be drawn on this machine; empty if they can. A separate process tries to
    draw, because VTK ends its process if no OpenGL library can draw without a screen."""
    if importlib.util.find_spec("pyvista") is None:
        return "the Python package PyVista is not installed"
    line = "import pyvista as p; t = p.Plotter(off_screen=True); t.add_mesh(p.Cube()); t.screenshot(return_img=True)"
    try:
        done = subprocess.run([sys.executable, "-c", line], capture_output=True, stdin=subprocess.DEVNULL, timeout=120)
    except (OSError, subprocess.TimeoutExpired):
        return "PyVista cannot draw here"
    return "" if done.returncode == 0 else "PyVista cannot draw here: it needs a library of OpenGL without a screen (EGL)"


def _files(folder: Folder) -> dict[str, Path]:
    """Returns one file of particles and one file of contacts, by kind, for the lowest frequency. If a series of .vtp
    files was written, returns the last frame of the series."""
    chosen = {}
    for kind in _SHOWN:
        files = [p for end in ("vtkhdf", "vtp") for p in (folder.path / "fields").glob(f"{kind}*.{end}")]
        if files:
            first = min(files, key=_frequency)
            chosen[kind] = max((p for p in files if _frequency(p) == _frequency(first)), key=lambda p: p.name)
    return chosen


def _frequency(file: Path) -> float:
    """Returns the frequency in a file's name, such as particles_20Hz.vtkhdf; 0 if the name has no frequency."""
    try:
        return float(file.stem.split("_")[1].removesuffix("Hz"))
    except (IndexError, ValueError):
        return 0.0


def figure(
    file: str | Path,
    names: str | tuple[str, ...],
    *,
    factor: float = 1.0,
    label: str = "",
    frame: int = -1,
    half: bool = False,
    least: float | None = None,
    strongest: float = 1.0,
    limits: tuple[float, float] | None = None,
    size: tuple[float, float] = (look.WIDE / 2, 3.3),
) -> tuple[Any, str]:
    """Returns a matplotlib figure of a .vtkhdf or .vtp file, coloured by an array, and a sentence that says what it
    shows.

    names: name of the array; if several are given, the first that the file has. Vectors are shown by their length.
    factor: multiplies the numbers, 1e6 for micrometres. frame: number of the frame in a file with time, from 0, or
    negative from the end. half: leave out everything in front of the middle of the box. least: leave out everything
    with a smaller value. strongest: draw only this fraction of the points or cells, those with the largest values.
    limits: range of the colours. size: [inches]."""
    data = _read(Path(file), frame)
    name, of_points = _array(data, Path(file), (names,) if isinstance(names, str) else names)
    values = (data.point_data if of_points else data.cell_data)[name]
    values = factor * (np.linalg.norm(values, axis=1) if values.ndim > 1 else np.asarray(values, float))
    (data.point_data if of_points else data.cell_data)["shown"] = values
    # not the maximum: with a few very large values, all other values would have the same colour
    low, high = limits or (float(values.min()), float(np.quantile(values, 0.999)))
    words, box = [f"{label or name}, {Path(file).name}"], data.bounds
    if half:
        words.append("the front half is not drawn")
        data = _back_half(data)
    if least is None and strongest < 1:
        least = float(np.quantile(np.abs(values), 1 - strongest))
    if least is not None:
        words.append(f"only values of at least {look.number(least, 2)} are drawn")
        data = _selected_part(data, np.abs((data.point_data if of_points else data.cell_data)["shown"]) >= least, of_points)
        low = low if limits else max(low, least)
    made, axes = look.figure(*size)
    axes.imshow(_rendered(_shapes(data), box, (low, high), size))
    axes.axis("off")
    made.colorbar(ScalarMappable(Normalize(low, high), "viridis"), ax=axes, label=label or name, shrink=0.7, pad=0.02)
    text = "; ".join(words)
    return made, f"{text[:1].upper()}{text[1:]}."


# Reads one frame of a field file as a PyVista mesh. Raises ReportError if that is impossible.
def _read(file: Path, frame: int) -> Any:
    import pyvista
    from vtkmodules.vtkCommonCore import vtkLogger

    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)  # errors are reported below
    try:
        reader = pyvista.get_reader(file)
        frames = _frames(reader)
        if not -frames <= frame < frames:
            raise ReportError(
                f"frame: found {frame}, expected a number from 0 to {frames - 1}, or from -{frames} to -1"
            )
        if frames > 1:
            reader.reader.SetStep(frame % frames)
        data = reader.read()
    except Exception as error:  # errors of VTK and PyVista have no common class
        raise ReportError(f"{file}: {' '.join(str(error).split())}") from None
    if not data.n_points:
        raise ReportError(f"{file}: found no points, expected a file of particles, contacts or cells")
    return data


def _frames(reader: Any) -> int:
    """Returns the number of frames. PyVista's reader of .vtkhdf cannot read times, but the VTK reader within it can."""
    vtk = reader.reader
    if not hasattr(vtk, "GetNumberOfSteps"):
        return 1
    vtk.UpdateInformation()
    return max(1, vtk.GetNumberOfSteps())


# Returns the name of the first array that the mesh has, and whether it belongs to points (otherwise to cells).
def _array(data: Any, file: Path, names: tuple[str, ...]) -> tuple[str, bool]:
    for name in names:
        if name in data.point_data or name in data.cell_data:
            return name, name in data.point_data
    there = ", ".join([*data.point_data.keys(), *data.cell_data.keys()])
    raise ReportError(f"{file}: found the arrays {there}; expected {' or '.join(names)}")


def _selected_part(data: Any, chosen: np.ndarray, of_points: bool) -> Any:
    """Returns the chosen points (of_points) or cells of a mesh, with their arrays."""
    import pyvista

    if of_points:
        left = pyvista.PolyData(np.asarray(data.points)[chosen])
        for name in data.point_data:
            left.point_data[name] = data.point_data[name][chosen]
        return left
    return data.extract_cells(np.flatnonzero(chosen)).extract_surface(algorithm=None)


# Returns the half of a mesh that is farther from the eye: larger y than the middle of the box.
def _back_half(data: Any) -> Any:
    low, high = data.bounds[2:4]
    middle = 0.5 * (low + high)
    if data.n_verts:
        return _selected_part(data, np.asarray(data.points)[:, 1] >= middle, True)
    return _selected_part(data, data.cell_centers().points[:, 1] >= middle, False)


def _shapes(data: Any) -> Any:
    """Returns the surfaces to draw: spheres with the particles' radii, tubes for lines, or the polygons themselves."""
    import pyvista

    if "radius" in data.point_data:
        ball = pyvista.Sphere(radius=1.0, theta_resolution=24, phi_resolution=16)
        return data.glyph(scale="radius", geom=ball, orient=False)
    return data.tube(radius=data.length / 400, n_sides=8) if data.n_lines else data


def _rendered(shapes: Any, box: Any, limits: tuple[float, float], size: tuple[float, float]) -> np.ndarray:
    import pyvista

    pixels = [round(200 * 0.78 * size[0]), round(200 * size[1])]
    plotter = pyvista.Plotter(off_screen=True, window_size=pixels)
    try:
        plotter.background_color = "white"
        plotter.enable_anti_aliasing("ssaa")
        plotter.add_mesh(shapes, scalars="shown", clim=limits, cmap="viridis", show_scalar_bar=False, ambient=0.25)
        plotter.add_mesh(pyvista.Box(box).extract_feature_edges(), color="#8a8f98", line_width=1)
        plotter.view_vector((-0.45, -1.0, 0.35), (0, 0, 1))
        plotter.camera.zoom(1.15)
        return np.asarray(plotter.screenshot(return_img=True))
    finally:
        plotter.close()
