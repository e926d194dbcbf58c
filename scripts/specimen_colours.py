# SPDX-License-Identifier: GPL-3.0-or-later
"""Colours of mastic, air, size classes and single spheres, for draw-section, draw-specimen and other scripts.

The colours are those of python/macadam/report/phases.py, which is loaded as a file: the scripts run without the
package."""
import csv
import importlib.util
from pathlib import Path

import numpy as np
from matplotlib.patches import Patch

_FILE = Path(__file__).resolve().parent.parent / "python" / "macadam" / "report" / "phases.py"
_SPEC = importlib.util.spec_from_file_location("macadam_phases", _FILE)
phases = importlib.util.module_from_spec(_SPEC)
_SPEC.loader.exec_module(phases)

MASTIC, AIR, AGGREGATE = (phases.rgb(colour) for colour in (phases.MASTIC, phases.VOID, phases.AGGREGATE))


def body_classes(file):
    """Returns the number and the name of the size class of each body, such as (0, "4.75-9.5 mm"); empty if the file
    does not exist."""
    if not file.is_file():
        return {}
    rows = csv.DictReader(open(file, encoding="utf-8"))
    return {int(row["body"]): (int(row["size_class"]), row.get("class") or "") for row in rows}


def class_names(classes):
    """Returns the name of each size class by its number; classes without a name are left out. classes: from
    body_classes."""
    return {number: name for number, name in sorted(set(classes.values())) if name}


def class_patches(names):
    """Returns the entries of a legend for size classes. names: such as "4.75-9.5 mm"."""
    return [_patch(phases.rgb(phases.of_class(name)), name.replace("-", "–")) for name in names]


def _patch(colour, label):
    return Patch(facecolor=colour, edgecolor="0.3", linewidth=0.4, label=label)


def legend(figure, names, mastic):
    """Adds a legend with the colours of classes and mastic below the drawing; does nothing if the classes have no
    names."""
    if not names:
        return
    handles = class_patches(names.values()) + [_patch(MASTIC, "mastic")] * mastic
    # one line, or two lines in narrow drawings
    columns = len(handles) if figure.get_figwidth() > 0.9 * len(handles) else -(-len(handles) // 2)
    figure.legend(handles=handles, loc="lower center", ncols=columns, fontsize=7, frameon=False, handlelength=1,
                  handleheight=1, handletextpad=0.4, columnspacing=1)


def colour(classes, body, particle):
    """Returns the colour of one sphere of an aggregate: the colour of its class, or AGGREGATE if its class is not
    known, in a shade that differs between bodies and between spheres."""
    _, name = classes.get(body, (0, ""))
    return phases.shaded(phases.of_class(name), body, particle)


def of_phase(phase, classes, body, particle):
    if phase == "aggregate":
        return colour(classes, body, particle)
    return MASTIC if phase == "mastic" else AIR


def colours(classes, phase, body, particle):
    """Returns the colours of many spheres as an array of three columns."""
    return np.array([of_phase(p, classes, b, i) for p, b, i in zip(phase, body, particle)])
