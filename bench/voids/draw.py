#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws |E*|, and the change of the phase angle, against the air voids: `draw.py FILE.csv` writes FILE.png."""
import csv
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

COLOURS = ["tab:green", "tab:blue", "tab:red"]
STYLES = {2.0: ("o", "-"), 20.0: ("s", "--")}


def mean(values):
    return sum(values) / len(values)


def main():
    path = Path(sys.argv[1])
    with open(path, encoding="utf-8") as file:
        rows = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(file)]
    solid = {(r["seed"], r["frequency_hz"]): r["phase_deg"] for r in rows if r["fraction"] == 0}
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 4), layout="constrained")
    for axes, value in ((left, lambda r: 1e-9 * r["e_star_pa"]),
                        (right, lambda r: r["phase_deg"] - solid[r["seed"], r["frequency_hz"]])):
        for colour, radii in zip(COLOURS, sorted({(r["radius_min_mm"], r["radius_max_mm"]) for r in rows})):
            for frequency, (marker, style) in STYLES.items():
                chosen = [r for r in rows if (r["radius_min_mm"], r["radius_max_mm"], r["frequency_hz"]) ==
                          (*radii, frequency)]
                x = sorted({r["fraction"] for r in chosen})
                axes.plot([100 * r["fraction"] for r in chosen], [value(r) for r in chosen], marker, ms=3,
                          color=colour, alpha=0.5)
                axes.plot([100 * f for f in x], [mean([value(r) for r in chosen if r["fraction"] == f]) for f in x],
                          style, color=colour, label=f"radius {radii[0]:g}–{radii[1]:g} mm, {frequency:g} Hz")
        axes.set_xlabel("air voids (% of the box)")
        axes.grid(True, alpha=0.3)
    left.set_ylabel("|E*| (GPa)")
    left.set_ylim(bottom=0)
    left.legend(fontsize=7)
    right.set_ylabel("change of the phase angle (degrees)")
    figure.savefig(path.with_suffix(".png"), dpi=110)


if __name__ == "__main__":
    main()
