#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Figure from the CSV of gpu_step_bench: draw_gpu_steps.py FILE.csv writes FILE.png and FILE.svg."""
import csv
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

COLOUR = {"double": "tab:blue", "mixed": "tab:orange", "single": "tab:green"}
MARKER = {"tiles on the chip": "o", "tiles streamed": "^", "two kernels a step": "s"}


def main():
    path = Path(sys.argv[1])
    rows = []
    for row in csv.DictReader(line for line in open(path, encoding="utf-8") if not line.startswith("#")):
        scene, form, precision, geometry = row["step"].split("/")
        way = next(name for name in MARKER if name in row["path"])
        if scene.startswith("fcc") and geometry == "fixed":
            rows.append((form, precision, way, {k: float(row[k]) for k in ("contacts", "us", "contacts_per_s",
                                                                           "share_of_copy")}))
    device = row["path"].split(", ")[1]
    matplotlib.rcParams["svg.hashsalt"] = "macadam"
    figure, axes = plt.subplots(1, 3, figsize=(15, 5), layout="constrained")
    figure.suptitle(f"One step of fcc scenes of growing size, geometry fixed, AM1, {device}")
    for ax, key, label in zip(axes, ("us", "contacts_per_s", "share_of_copy"),
                              ("µs a step", "contacts a second", "counted bytes a second / copy bandwidth")):
        for form, precision in dict.fromkeys((r[0], r[1]) for r in rows):
            line = sorted((r[3]["contacts"], r[3][key], r[2]) for r in rows if r[:2] == (form, precision))
            ax.plot([x for x, _, _ in line], [y for _, y, _ in line], color=COLOUR[precision], lw=1,
                    ls="-" if form == "condensed" else "--", label=f"{form}, {precision}")
            for x, y, way in line:
                ax.plot(x, y, MARKER[way], color=COLOUR[precision], ms=6)
        ax.set_xscale("log")
        ax.set_yscale("log" if key != "share_of_copy" else "linear")
        ax.set_xlabel("contacts")
        ax.set_ylabel(label)
        ax.grid(True, which="major", alpha=0.3)
    handles, labels = axes[0].get_legend_handles_labels()
    handles += [matplotlib.lines.Line2D([], [], ls="", marker=m, color="0.3", label=way) for way, m in MARKER.items()]
    axes[0].legend(handles=handles, labels=labels + list(MARKER), fontsize=8)
    for suffix in (".png", ".svg"):
        figure.savefig(path.with_suffix(suffix), dpi=110, metadata={"Date": None} if suffix == ".svg" else None)


if __name__ == "__main__":
    main()
