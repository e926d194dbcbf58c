# SPDX-License-Identifier: GPL-3.0-or-later
"""Marks of examples/shapes/README.md, from the tables that `macadam shapes measure examples/shapes` writes."""
import csv
import functools
from pathlib import Path

from pages.data import minus, one, rows, table
from pages.marks import mark

DOCUMENT = "examples/shapes/README.md"
PAPER = Path(__file__).with_name("paper-table-2.csv")
SIGNS = {"d_long_m": "D^L", "d_intermediate_m": "D^I", "d_short_m": "D^S", "volume_m3": "V", "area_m2": "A",
         "shape_index": "SI", "flatness": "F", "flakiness": "Fl", "elongation": "E", "sphericity_true": "ψ^w",
         "sphericity_working": "ψ^A"}
UNITS = {"d_long_m": (" (mm)", 1e3), "d_intermediate_m": (" (mm)", 1e3), "d_short_m": (" (mm)", 1e3),
         "volume_m3": (" (mm³)", 1e9), "area_m2": (" (mm²)", 1e6), "shape_index": (" (D^I ≥ 4 mm)", 1),
         "flakiness": (" (D^I ≥ 4 mm)", 1)}


@mark
def statistics():
    lines = []
    for row in rows("shapes-statistics.csv"):
        name = row["property"]
        unit, factor = UNITS.get(name, ("", 1))
        form = "{:.0f} ({:.0f})" if name in ("points", "facets") else "{:.2f} ({:.2f})"
        lines.append([SIGNS.get(name, name) + unit,
                      *(form.format(factor * row[k], factor * row[f"paper_{k}"]) for k in ("min", "average", "max"))])
    return table(["", "min", "average", "max"], lines, [1, 2, 3])


@functools.cache
def paper():
    with open(PAPER, encoding="utf-8") as f:
        return {(r["first"], r["second"]): float(r["coefficient"]) for r in csv.DictReader(x for x in f if x[0] != "#")}


def ours(first, second):
    return one(rows("shapes-correlation.csv"), property=first)[second]


@mark
def correlation():
    names, lines = list(SIGNS), []
    for i, a in enumerate(names):
        lines.append([SIGNS[a], *("" if i == j else minus(f"{ours(a, b) if j < i else paper()[a, b]:.2f}")
                                  for j, b in enumerate(names))])
    return table(["", *SIGNS.values()], lines, range(1, 12))


def differences():
    return {pair: abs(ours(*pair) - value) for pair, value in paper().items()}


@mark
def largest_difference():
    """Returns the second largest difference of a correlation. The largest is that of SI and F, which the sentence names
    itself."""
    found = differences()
    assert max(found, key=found.get) == ("shape_index", "flatness")
    return f"{sorted(found.values())[-2]:.2f}"
