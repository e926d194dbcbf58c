#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws a figure from the CSV of iterations_bench: `draw.py FILE.csv` writes FILE.png."""
import csv
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import matplotlib.ticker  # noqa: E402

MANY = 640
LINES = [  # which rows, label, colour
    (lambda boxes: boxes == 0, "each particle by itself", "tab:red"),
    (lambda boxes: 0 < boxes < MANY, "and up to 160 boxes (the solver's)", "tab:blue"),
    (lambda boxes: boxes == MANY, "and 640 boxes", "tab:green"),
]


def main():
    path = Path(sys.argv[1])
    with open(path, encoding="utf-8") as f:
        rows = list(csv.DictReader(line for line in f if not line.startswith("#")))
    figure, ax = plt.subplots(figsize=(6.5, 4.5), layout="constrained")
    for chosen, label, colour in LINES:
        line = [(int(r["particles"]), int(r["iterations"])) for r in rows
                if chosen(int(r["boxes"])) and r["converged"] == "yes"]
        ax.plot(*zip(*sorted(line)), "o-", color=colour, label=label)
    sizes = sorted({int(r["particles"]) for r in rows})
    first = next(int(r["iterations"]) for r in rows if r["boxes"] == "0" and int(r["particles"]) == sizes[0])
    ax.plot(sizes, [first * (n / sizes[0]) ** (1 / 3) for n in sizes], ls=":", color="0.5",
            label="as the cube root of the number")
    ax.set_xscale("log")
    ax.set_yscale("log")
    ax.yaxis.set_major_locator(matplotlib.ticker.LogLocator(subs=(1, 2, 5)))
    ax.yaxis.set_major_formatter("{x:g}")
    ax.yaxis.set_minor_formatter("")
    ax.set_xlabel("particles")
    ax.set_ylabel("iterations to a residual of 1e-8")
    ax.set_title("AM1, 20 Hz")
    ax.grid(True, which="both", alpha=0.3)
    ax.legend()
    figure.savefig(path.with_suffix(".png"), dpi=110)


if __name__ == "__main__":
    main()
