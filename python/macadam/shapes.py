# SPDX-License-Identifier: GPL-3.0-or-later
"""Shapes of aggregates: closed triangulated surfaces (docs/shapes.md, docs/filling.md). `macadam shapes …`

    >>> from macadam import shapes
    >>> ball = shapes.icosahedron(0.01)
    >>> bool(shapes.check(ball)), shapes.measure(ball).volume < 4.19e-6
    (True, True)
"""
from __future__ import annotations

from collections.abc import Iterable
from os import PathLike, fspath
from typing import TYPE_CHECKING

from . import _core
from ._core import FillReport, ShapeMeasure, Spheres, Surface, Verdict, measure_fill
from ._core import shape_library as library
from ._core import subdivided_icosahedron as icosahedron

if TYPE_CHECKING:
    import pandas

__all__ = ["FillReport", "ShapeMeasure", "Spheres", "Surface", "Verdict", "check", "files_in", "fill", "generate", "icosahedron",
           "library", "measure", "measure_fill", "read", "repair", "table", "write"]

SurfaceLike = Surface | str | PathLike[str]
_COLUMNS = ("d_long", "d_intermediate", "d_short", "volume", "area", "shape_index", "flatness", "elongation", "flakiness",
            "sphericity_true", "sphericity_working")


def read(file: str | PathLike[str], scale: float = 1) -> Surface:
    """Reads STL, OFF, PLY or OBJ; the surface's `reading` says what was changed. scale: metres per unit of the file, 1e-3 for
    millimetres."""
    return _core.read_surface(fspath(file), scale)


def write(file: str | PathLike[str], surface: Surface, scale: float = 1) -> None:
    """Writes .off, .stl (binary), .ply or .obj, coordinates divided by `scale`."""
    _core.write_surface(fspath(file), surface, scale)


def _surface(of: SurfaceLike) -> Surface:
    return of if isinstance(of, Surface) else read(of)


def check(surface: SurfaceLike) -> Verdict:
    """Finds the faults of a surface and where they are. str() of the Verdict describes them; bool() is true if the
    surface is good."""
    return _core.check_surface(_surface(surface))


def repair(surface: SurfaceLike, *, wrap: bool = False) -> tuple[Surface, str]:
    """Returns a repaired surface that can be measured and filled, and a text that says what was done, with volume and
    area before and after.

    wrap: accept a new skin around a faulty surface even if it changes volume or area by more than 1 %. Raises RunError
    if no repair succeeds, or if a change of more than 1 % is not accepted.
    """
    return _core.repair_surface(_surface(surface), wrap)


def measure(surface: SurfaceLike) -> ShapeMeasure:
    """Measures a closed surface: dimensions [m], volume, area and shape indices."""
    return _core.measure_shape(_surface(surface))


def table(surfaces: Iterable[SurfaceLike], *, repair: bool = False, wrap: bool = False,
          out: str | PathLike[str] | None = None) -> pandas.DataFrame:
    """Measures several surfaces, one row each [SI units]: `macadam shapes measure`.

    repair: repair faulty surfaces before they are measured. wrap: as for repair(). out: a folder for shapes.csv,
    statistics.csv and correlation.csv.
    """
    import pandas
    shapes = [_surface(one) for one in surfaces]
    if repair:
        shapes = [shape if check(shape) else _core.repair_surface(shape, wrap)[0] for shape in shapes]
    measures = [measure(shape) for shape in shapes]
    if out is not None:
        _core.write_shape_tables(fspath(out), [shape.name for shape in shapes], measures)
    return pandas.DataFrame([{"name": shape.name, **{c: getattr(of, c) for c in _COLUMNS}}
                             for shape, of in zip(shapes, measures, strict=True)])


def files_in(folder: str | PathLike[str], scale: float = 1) -> list[Surface]:
    """Reads all surfaces of a folder, in the order of their names. scale: as for read()."""
    return [read(file, scale) for file in _core.surface_files_in(fspath(folder))]


def fill(surface: SurfaceLike, radius: float | tuple[float, float], *, porosity: float = 0.12, least: int = 8,
         single: str = "intermediate", seed: int = 1, circumscribed: float | None = None,
         out: str | PathLike[str] | None = None) -> Spheres:
    """Fills a shape with spheres.

    radius: radius of the spheres [m], or the smallest and the largest.
    porosity: 1 - sum of the spheres' volumes / volume of the shape.
    least: if fewer spheres than this would fill the shape, it becomes a single sphere, whose radius `single` chooses:
    "intermediate" (D^I/2), "circumscribed" or "volume".
    circumscribed: scale the shape first, so that D^I/2 has this value [m].
    out: a folder for spheres.csv, spheres.obj and shape.obj, as the command writes them.
    """
    low, high = (radius, radius) if isinstance(radius, (int, float)) else radius
    shape = _surface(surface)
    if circumscribed is not None:
        shape = _core.scale_shape(shape, circumscribed)
    spheres = _core.fill_shape(shape, low, high, porosity, least, single, seed)
    if out is not None:
        _core.write_filling(fspath(out), shape, spheres)
    return spheres


def generate(out: str | PathLike[str] | None = None, *, seed: int = 1, count: int = 82,
             icosahedron: float | None = None) -> list[Surface]:
    """Generates crushed aggregates with the statistics of the library that ships or, if `icosahedron` is given, the
    subdivided icosahedron of this radius [m]. out: a folder for OFF files, which must not contain other shapes."""
    shapes = _core.generate_shape_library(seed, count) if icosahedron is None else [_core.subdivided_icosahedron(icosahedron)]
    if out is not None:
        _core.write_shape_library(fspath(out), shapes)
    return shapes
