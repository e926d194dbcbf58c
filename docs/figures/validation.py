#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws docs/figures/validation.png, the picture of docs/validation.md: computed loads of the IDEAL-CT over the approach of
the strips, and the measured discs.
usage: docs/figures/validation.py [FILE]. Needs Debian's python3-matplotlib."""
import csv
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

RESULTS = Path(__file__).parents[2] / "bench" / "results"
LANE = "3"
# set of parameters, colour, label
SETS = (("blind", "#0077bb", "computed, blind"), ("binder", "#009988", "computed, energy of the binder"),
        ("lane 3", "#ee7733", "computed, calibrated"))


def rows(name):
    with open(RESULTS / name, newline="", encoding="utf-8") as file:
        return [row for row in csv.DictReader(file) if row["lane"] == LANE]


def main():
    figure, axes = plt.subplots(figsize=(6.4, 4.2))
    curves = rows("validation-curves.csv")
    for parameters, colour, label in SETS:
        own = [r for r in curves if r["parameters"] == parameters]
        for k, seed in enumerate(sorted({r["seed"] for r in own})):
            line = [(1e3 * float(r["displacement_m"]), 1e-3 * float(r["load_n"])) for r in own if r["seed"] == seed]
            axes.plot(*zip(*line), color=colour, lw=1.2, label="_" if k else label)
    for k, disc in enumerate(rows("validation-measured.csv")):
        peak = 1e-3 * float(disc["peak_load_n"])
        at = [1e3 * float(disc[key]) for key in ("displacement_at_peak_m", "l85_m", "l75_m", "l65_m")]
        axes.plot(at, [part * peak for part in (1, 0.85, 0.75, 0.65)], "o-", color="#555555", ms=3.5, lw=0.8,
                  label="_" if k else "measured: peak, and 85, 75 and 65 % of it")
    axes.set(xlabel="approach of the strips (mm)", ylabel="load of a disc of 62 mm (kN)", xlim=(0, None), ylim=(0, None))
    axes.grid(alpha=0.3)
    axes.legend(fontsize=8)
    figure.tight_layout()
    figure.savefig(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).with_name("validation.png"), dpi=150)


if __name__ == "__main__":
    main()
