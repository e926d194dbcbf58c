# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the chart of bench/command/run: the fraction of the wall time that each phase takes, for each case."""
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from paper_runs import rows  # noqa: E402
from phases import PHASES, WALL  # noqa: E402

CASE = ("scene", "method", "specimen", "backend", "threads")


def draw(files, out):
    """Writes a PNG from several CSV files, each of one machine."""
    bars = {}  # machine and case → phase → seconds
    for file in files:
        for row in rows(file):
            where = (file.stem, *(row[key] for key in CASE))
            bars.setdefault(where, {"on": row["device"] or row["machine"]})[row["phase"]] = float(row["seconds"])
    figure, ax = plt.subplots(figsize=(11, 1.6 + 0.5 * len(bars)), layout="constrained")
    left = [0.0] * len(bars)
    colours = matplotlib.colormaps["tab20"].colors
    for phase, colour in zip(PHASES, colours):
        # fractions refer to the sum of the medians, because medians of phases need not add up to the median wall time
        share = [100 * bar[phase] / sum(bar[p] for p in PHASES) for bar in bars.values()]
        ax.barh(range(len(bars)), share, left=left, color=colour, label=phase)
        left = [a + b for a, b in zip(left, share)]
    for at, bar in enumerate(bars.values()):
        ax.text(101, at, f"{bar[WALL]:.2f} s", va="center")
    names = [f"{scene}, {method}{', specimen read' * (specimen == 'read')}\n{bar['on']}, {backend}, {threads} threads"
             for (_, scene, method, specimen, backend, threads), bar in bars.items()]
    ax.set_yticks(range(len(bars)), names, fontsize=8)
    ax.invert_yaxis()
    ax.set_xlim(0, 110)
    ax.set_xticks(range(0, 101, 20))
    ax.set_xlabel("share of the wall time of macadam run (%)")
    ax.legend(loc="lower center", bbox_to_anchor=(0.5, 1), ncol=6, fontsize=8)
    figure.savefig(out.with_suffix(".png"), dpi=110)
