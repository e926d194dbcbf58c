# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the pictures of docs/paper-specimens.md: sections, views, orientation and stiffness."""
import subprocess
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.patches import Patch  # noqa: E402

from paper_data import mean  # noqa: E402
from paper_document import deviations  # noqa: E402
from paper_runs import ROOT, committed, rows  # noqa: E402
from paper_tables import DEVIATION, FREQUENCIES, PAPER  # noqa: E402

sys.path.insert(0, str(ROOT / "scripts"))
from specimen_colours import class_patches, phases  # noqa: E402

PICTURES = ROOT / "docs" / "pictures"
STYLE = {"SS": ("black", "-", "o"), "MS-Poly-coarse": ("tab:blue", "--", "s"), "MS-Ico-coarse": ("tab:cyan", "-", "D"),
         "MS-Poly-fine": ("tab:red", "--", "^"), "MS-Ico-fine": ("tab:orange", "-", "v")}


def specimens(results):
    for paper in PAPER.values():
        folder = results / f"{paper.scene}_sections"
        for cut in ("x_0.025", "y_0.025"):
            subprocess.run([sys.executable, ROOT / "scripts" / "draw-section", folder / f"section_{cut}.csv", "--dpi",
                            "90"], check=True)
            (folder / f"section_{cut}.png").replace(PICTURES / f"{paper.scene}_{cut}.png")
        subprocess.run([sys.executable, ROOT / "scripts" / "draw-specimen", folder / "specimen.csv", "--without-mastic",
                        "--pixels", "560", "--out", PICTURES / f"{paper.scene}_view.png"], check=True)


def gradations(results):
    for mix in ("ac14", "ac20"):
        subprocess.run([sys.executable, ROOT / "scripts" / "draw-gradation", results / f"{mix}_recipe", "--out",
                        PICTURES / f"gradation_{mix}.png", "--dpi", "90"], check=True)


def axes(results):
    """Draws Figs. 9a and b: a line along D^L at the position of each cluster above 4.75 mm."""
    for name in ("MS-Poly-fine", "MS-Poly-coarse"):
        scene = PAPER[name].scene
        figure = plt.figure(figsize=(4.4, 6), layout="constrained")
        ax = figure.add_subplot(projection="3d", box_aspect=(50, 50, 80))
        drawn = {}
        for a in rows(results / f"{scene}_sections" / "aggregates.csv"):
            if a["shape"] != "sphere" and int(a["size_class"]) < 3:
                half = float(a["d_long"]) / 2
                ends = [[1e3 * (float(a[x]) + s * half * float(a[f"axis_{x}"])) for s in (-1, 1)] for x in "xyz"]
                ax.plot(*ends, color=phases.of_class(a["class"]), lw=1)
                drawn[a["class"]] = None  # the keys are the classes in the order of the file
        ax.set(xlabel="x (mm)", ylabel="y (mm)", zlabel="z (mm)", xlim=(0, 50), ylim=(0, 50), zlim=(0, 80), title=name)
        figure.legend(handles=class_patches(drawn), fontsize=7, loc="lower center", ncols=3, frameon=False)
        figure.savefig(PICTURES / f"{scene}_axes.png", dpi=90)


def orientation(runs):
    figure, grid = plt.subplots(2, 2, figsize=(8, 6.6), sharex=True, sharey=True, layout="constrained")
    for ax, name in zip(grid.flat, ("MS-Poly-fine", "MS-Poly-coarse", "MS-Ico-fine", "MS-Ico-coarse")):
        cosines = [a for run in runs[name] for a in run.axes]
        for k, axis in enumerate("xyz"):
            values = sorted(c[k] for c in cosines)
            ax.plot(values, [(i + 1) / len(values) for i in range(len(values))], label=axis)
        ax.plot([0, 1], [0, 1], "k:", lw=1, label="isotropic")
        ax.set_title(f"{name}, {len(cosines):,} clusters of {len(runs[name])} seeds", fontsize=10)
        ax.grid(alpha=0.3)
    for ax in grid[1]:
        ax.set_xlabel("|component| of the $D^L$ direction")
    for ax in grid[:, 0]:
        ax.set_ylabel("cumulative frequency")
    grid[0, 0].legend()
    figure.savefig(PICTURES / "orientation.png", dpi=100)


def stiffness(runs):
    """Draws Fig. 11: |E*| and phase over frequency, and below them their mean deviations from SS beside the paper's."""
    figure, grid = plt.subplots(2, 2, figsize=(10, 8), height_ratios=(3, 2), layout="constrained")
    for (upper, lower), key, label, title in zip(grid.T, ("e_star", "phase"), ("|E*| (GPa)", "φ (degrees)"),
                                                 ("$d_m$ of |E*| (%)", "$d_m$ of φ (%)")):
        for name, (colour, dashes, marker) in STYLE.items():
            series = [[getattr(run, key)[k] for run in runs[name]] for k in range(len(FREQUENCIES))]
            range_of = [[mean(s) - min(s) for s in series], [max(s) - mean(s) for s in series]]
            # Poly and Ico nearly coincide in phi, so one marker is open and the other is small, inside it
            size, fill = (9, "none") if "Poly" in name else (5, colour)
            upper.errorbar(FREQUENCIES, [mean(s) for s in series], range_of, color=colour, ls=dashes, marker=marker,
                           ms=size, mfc=fill, capsize=3, label=name)
        upper.set(xlabel="f (Hz)", ylabel=label, xscale="log")
        upper.set_xticks(FREQUENCIES, [str(f) for f in FREQUENCIES])
        upper.minorticks_off()
        upper.grid(alpha=0.3)
        clusters = [name for name in STYLE if name != "SS"]
        for i, name in enumerate(clusters):
            d = [seed[-1] for seed in deviations(runs, name, "SS", key)]
            ours, paper = mean(d), DEVIATION[name][0 if key == "e_star" else 1]
            bars = [lower.bar(i - 0.2, ours, 0.36, yerr=[[ours - min(d)], [max(d) - ours]], color=STYLE[name][0],
                              capsize=3),
                    lower.bar(i + 0.2, paper, 0.36, fill=False, hatch="///", edgecolor="0.4")]
            for bar, value in zip(bars, (ours, paper)):
                lower.bar_label(bar, [f"{value:+.0f}".replace("-", "−")], padding=4, fontsize=8)
        lower.set_xticks(range(len(clusters)), clusters, fontsize=8)
        lower.axhline(0, color="black", lw=0.8)
        lower.margins(y=0.18)
        lower.set_ylabel(title)
    grid[0, 0].legend(fontsize=8)
    grid[1, 0].legend(handles=[Patch(facecolor="0.5", label="ours, with the range over the seeds"),
                               Patch(facecolor="white", edgecolor="0.4", hatch="///", label="paper")], fontsize=8,
                      loc="upper left")
    figure.savefig(PICTURES / "specimens_e_star.png", dpi=100)


def draw(results):
    PICTURES.mkdir(exist_ok=True)
    runs = {name: committed(p.scene) for name, p in PAPER.items()}
    orientation(runs)
    stiffness(runs)
    gradations(results)
    axes(results)
    specimens(results)
