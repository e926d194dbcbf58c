#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws a figure of the lattices in a table of bench/steps/table: `bench/steps/draw.py TABLE.csv` writes TABLE.png."""
import csv
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

COLOUR = {"double": "tab:blue", "mixed": "tab:orange", "single": "tab:green"}
MARKER = {"tiles on the chip": "o", "tiles streamed": "^", "two kernels a step": "s"}


def lattices(path):
    """Yields (precision, kernels, contacts, µs per step) for each lattice."""
    for row in csv.DictReader(line for line in open(path, encoding="utf-8") if not line.startswith("#")):
        words = row["row"].split("/")
        if len(words) == 6 and words[1].startswith("lattice:"):
            way = next(name for name in MARKER if name in row["path"])
            yield words[4], way, float(row["contacts"]), float(row["us"])


def main():
    path = Path(sys.argv[1])
    rows = sorted(lattices(path), key=lambda r: r[2])
    machine = open(path, encoding="utf-8").readline()[1:].split(",")[0].strip()
    figure, axes = plt.subplots(1, 2, figsize=(11, 4.5), layout="constrained")
    figure.suptitle(f"A step of lattices of growing size: geometry fixed, condensed, laws AM1, {machine}")
    for ax, label in zip(axes, ("µs a step", "contacts a second")):
        for precision, colour in COLOUR.items():
            line = [(contacts, us if label == "µs a step" else contacts / us * 1e6, way)
                    for p, way, contacts, us in rows if p == precision]
            ax.plot([x for x, _, _ in line], [y for _, y, _ in line], color=colour, lw=1, label=precision)
            for x, y, way in line:
                ax.plot(x, y, MARKER[way], color=colour, ms=6)
        ax.set(xscale="log", yscale="log", xlabel="contacts", ylabel=label)
        ax.grid(True, which="major", alpha=0.3)
    handles, labels = axes[0].get_legend_handles_labels()
    handles += [matplotlib.lines.Line2D([], [], ls="", marker=m, color="0.3", label=way) for way, m in MARKER.items()]
    axes[0].legend(handles=handles, labels=labels + list(MARKER), fontsize=8)
    figure.savefig(path.with_suffix(".png"), dpi=110)


main()
