# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of results and specimens, in the look of the report. They need matplotlib (the extra `report`)."""
from __future__ import annotations

import importlib
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _core

if TYPE_CHECKING:
    from ._result import Result

#: What plot_result() draws, by the kind of the test, and what plot_specimen() draws.
OF_FREQUENCY = ("modulus", "cole_cole", "black", "master_curve")
OF_TIME = ("history",)
OF_SPECIMEN = ("block", "section", "aggregates", "3d")


def _chosen(what: str | None, choices: tuple[str, ...]) -> str:
    if what is None:
        return choices[0]
    if what not in choices:
        raise _core.InputError(f"what: found {what!r}, expected one of {', '.join(choices)}")
    return what


def plot_result(result: Result, what: str | None = None) -> Any:
    """Returns a figure of a result; `Result.plot` describes the arguments."""
    from .report import histories, look, loops, modulus
    from .report.folders import read_all
    folder = read_all([result.folder])[0]
    with look.style():
        if folder.by_frequency:
            chosen, curves = _chosen(what, OF_FREQUENCY), modulus.curves([folder])
            if chosen == "master_curve":
                if any(r.get("reduced_frequency_hz") is None for r in folder.by_frequency):
                    raise _core.InputError("what: found 'master_curve' for results without a reduced frequency, expected laws "
                                           "that all have the same shift, and several temperatures")
                return loops.master_curve(folder)[0]
            if chosen == "modulus":
                return modulus.over_frequency(curves)
            figure = (modulus.cole_cole if chosen == "cole_cole" else modulus.black)(curves)
            figure.set_size_inches(look.WIDE / 2, look.WIDE / 2)
            if len(curves) > 1:
                figure.axes[0].legend()
            return figure
        if not (folder.in_time or {}).get("points"):
            raise _core.InputError(f"{result.folder}: found no results to draw, expected a modulus or points over time")
        _chosen(what, OF_TIME)
        return histories.drawing([folder])[0]


def plot_specimen(specimen: _core.Specimen, what: str | None = None) -> Any:
    """Returns a figure of a specimen; `Specimen.plot` describes the arguments."""
    if _chosen(what, OF_SPECIMEN) == "3d":
        return _view(specimen)
    from .report import look
    from .report import specimen as pictures
    folder = _folder_of(specimen)
    if what == "aggregates" and not (folder.specimen["phase"] == "aggregate").any():
        raise _core.InputError("what: found 'aggregates' for a specimen without aggregates, expected block or section")
    with look.style():
        figure = pictures.picture(folder, what or "block")
        figure.set_size_inches(1.5 * look.THIRD, 1.5 * pictures.HEIGHT)
        return figure


def _folder_of(specimen: _core.Specimen) -> Any:
    """Returns the specimen as a folder of results, which the report's pictures take. Nothing is written."""
    import pandas as pd

    from .report.folders import Folder
    names, voids = np.array(["aggregate", "mastic"]), specimen.void_radius
    centre = np.concatenate([specimen.centre, np.reshape(specimen.void_centre, (-1, 3))])
    table = pd.DataFrame(centre, columns=list("xyz"))
    table["radius"] = np.concatenate([specimen.radius, voids])
    table["phase"] = [*names[specimen.phase], *["void"] * len(voids)]
    table["body"] = np.concatenate([specimen.body, np.full(len(voids), -1)])
    aggregates = pd.DataFrame(specimen.aggregates)
    if len(aggregates):
        classes = [name for name in specimen.composition if name in set(aggregates["class"])]
        aggregates["size_class"] = [classes.index(name) if name in classes else -1 for name in aggregates["class"]]
    folder = Folder(Path("specimen"), "run", summary={"box_m": list(specimen.box), "domain": {"shape": specimen.domain}})
    folder.__dict__.update(specimen=table, aggregates=aggregates if len(aggregates) else None)
    return folder


def _view(specimen: _core.Specimen) -> Any:
    """Shows the particles with PyVista, coloured by phase, in a window or in the notebook. Raises InputError if PyVista is
    not installed."""
    try:
        pyvista = importlib.import_module("pyvista")
    except ImportError:
        raise _core.InputError("what: found '3d' without the Python package PyVista, expected that it is installed: "
                               "pip install 'macadam[fields]'") from None
    from .report import fields, phases
    with tempfile.TemporaryDirectory(prefix="macadam-") as folder:
        file = Path(folder) / "particles.vtp"
        specimen.write(file, arrays={"mastic": specimen.phase.astype(np.int32)})
        particles = fields._read(file, -1)
    plotter = pyvista.Plotter()
    for phase, colour in ((0, phases.AGGREGATE), (1, phases.MASTIC)):
        part = fields._selected_part(particles, np.asarray(particles.point_data["mastic"]) == phase, True)
        if part.n_points:
            plotter.add_mesh(fields._shapes(part), color=colour, smooth_shading=True)
    plotter.add_mesh(pyvista.Box(particles.bounds).extract_feature_edges(), color="#8a8f98")
    return plotter.show()
