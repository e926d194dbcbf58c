#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws docs/figures/four-gpus.png, the picture of docs/several-gpus.md: speed on one to four GPUs relative to one GPU.
usage: docs/figures/four_gpus.py [FILE]. Needs Debian's python3-matplotlib."""
import csv
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

ROOT = Path(__file__).parents[2]
# kind of GPU, row of the file, label, style and colour of the line
LINES = (
    ("H100", "step/lattice:1e7/single", "step, lattice of 10⁷", "o-", "#0077bb"),
    ("H200", "step/lattice:1e6/single", "step, lattice of 10⁶", "s-", "#33bbee"),
    ("H200", "many/40", "forty full specimens", "D-", "#ee7733"),
    ("H100", "harmonic/lattice:1e7/loads:1", "one frequency, lattice of 10⁷", "^--", "#009988"),
    ("H200", "harmonic/lattice:1e6/loads:4", "four frequencies, lattice of 10⁶", "v--", "#ee3377"),
)


def main():
    lines = (ROOT / "bench/results/four-gpus-2026-11-27.csv").read_text().split("\n")
    rows = list(csv.DictReader(line for line in lines if line and not line.startswith("#")))
    figure, axes = plt.subplots(figsize=(6.4, 4.2))
    axes.plot([1, 4], [1, 4], ":", color="#888888", label="proportional")
    for gpu, name, label, style, colour in LINES:
        us = {int(r["devices"]): float(r["us"]) for r in rows if r["gpu"] == gpu and r["row"] == name}
        axes.plot(list(us), [us[1] / t for t in us.values()], style, color=colour, label=f"{label} ({gpu})")
    axes.set(xlabel="GPUs", ylabel="speed relative to one GPU", xticks=[1, 2, 3, 4], ylim=(0.8, 4.2))
    axes.grid(alpha=0.3)
    axes.legend(fontsize=8)
    figure.tight_layout()
    figure.savefig(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).with_name("four-gpus.png"), dpi=150)


if __name__ == "__main__":
    main()
