# SPDX-License-Identifier: GPL-3.0-or-later
"""Colours of mastic, air, size classes and single spheres, for draw-section and draw-specimen."""
import colorsys
import csv

import numpy as np
from matplotlib.patches import Patch

MASTIC = (0.40, 0.53, 0.76)
AIR = (1.0, 1.0, 1.0)
CLASSES = [(0.33, 0.62, 0.36), (0.62, 0.62, 0.62), (0.90, 0.72, 0.33), (0.80, 0.40, 0.32), (0.60, 0.45, 0.70),
           (0.35, 0.68, 0.68), (0.85, 0.55, 0.65), (0.55, 0.45, 0.35)]


def size_classes(file):
    """Returns the size class of each body; empty if the file does not exist."""
    if not file.is_file():
        return {}
    rows = csv.DictReader(open(file, encoding="utf-8"))
    return {int(row["body"]): int(row["size_class"]) for row in rows}


def class_names(file):
    """Returns the name of each size class in the file, such as "4.75-9.5 mm"; empty if the file or the column does not
    exist."""
    if not file.is_file():
        return {}
    rows = csv.DictReader(open(file, encoding="utf-8"))
    return dict(sorted({int(row["size_class"]): row["class"] for row in rows if row.get("class")}.items()))


def legend(figure, names, mastic):
    """Adds a legend with the colours of classes and mastic below the drawing; does nothing if the classes have no
    names."""
    if not names:
        return
    entries = [(CLASSES[k % len(CLASSES)], name.replace("-", "–")) for k, name in names.items()]
    entries += [(MASTIC, "mastic")] * mastic
    handles = [Patch(facecolor=colour, edgecolor="0.3", linewidth=0.4, label=name) for colour, name in entries]
    # one line, or two lines in narrow drawings
    columns = len(handles) if figure.get_figwidth() > 0.9 * len(handles) else -(-len(handles) // 2)
    figure.legend(handles=handles, loc="lower center", ncols=columns, fontsize=7, frameon=False, handlelength=1,
                  handleheight=1, handletextpad=0.4, columnspacing=1)


def colour(classes, body, particle):
    """Returns the colour of one sphere of an aggregate: the hue of its class, or of its body if there are no classes,
    in a shade that differs between bodies and between spheres."""
    base = CLASSES[classes.get(body, 0) % len(CLASSES)] if classes else CLASSES[body % len(CLASSES)]
    hue, lightness, saturation = colorsys.rgb_to_hls(*base)
    of_body = (body * 0.6180339887) % 1 - 0.5  # golden ratio: consecutive numbers get very different shades
    of_particle = (particle * 0.7548776662) % 1 - 0.5
    lightness = min(0.92, max(0.12, lightness * (1 + 0.24 * of_body + 0.20 * of_particle)))
    return colorsys.hls_to_rgb(hue, lightness, saturation)


def of_phase(phase, classes, body, particle):
    if phase == "aggregate":
        return colour(classes, body, particle)
    return MASTIC if phase == "mastic" else AIR


def colours(classes, phase, body, particle):
    """Returns the colours of many spheres as an array of three columns."""
    return np.array([of_phase(p, classes, b, i) for p, b, i in zip(phase, body, particle)])
