#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws figures from the files of fill_study: `draw_fill.py DIR OUT` writes OUT/fill-study.png and
OUT/fill-spheres.png."""
import csv
import sys
from collections import defaultdict
from itertools import cycle
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))
from specimen_colours import AGGREGATE  # noqa: E402

CIRCUMSCRIBED = 6.295  # half of D^I of every shape [mm]
LIGHT = np.array([-0.45, 0.55, 0.70])
# Published numbers of spheres ([1], Figs. 5 and 6). First dictionary of a shape: by the radius of equal spheres (mm).
# Second dictionary: by R_max / R_min, with R_min = 0.5 mm.
PUBLISHED = [("icosahedron", "*", {0.5: 1568, 2: 24}, {1: 1568}),
             ("aggregate #1", "X", {0.5: 634, 1: 79, 2: 9}, {1: 634, 3: 79})]
SHOWN = [(0.5, 0.5), (0.75, 0.75), (1.0, 1.0), (2.0, 2.0), (0.5, 1.5)]


def read(path):
    rows = list(csv.DictReader(open(path, encoding="utf-8")))
    return [{k: v if k == "shape" else float(v) for k, v in row.items()} for row in rows]


def seed_means(rows):
    """Returns the means over the seeds: {shape: {(radius_min, radius_max): row}}."""
    groups = defaultdict(list)
    for row in rows:
        groups[row["shape"], row["radius_min_mm"], row["radius_max_mm"]].append(row)
    means = defaultdict(dict)
    for (shape, low, high), same in groups.items():
        means[shape][low, high] = {k: np.mean([r[k] for r in same]) for k in same[0] if k != "shape"}
    return means


def draw_study(rows, out):
    means = seed_means(rows)
    figure, axes = plt.subplots(2, 2, figsize=(11, 8.5), constrained_layout=True)
    (by_radius, by_ratio), (by_shape, dimensions) = axes
    marks = dict(zip(means, cycle("osD^v<hPp>dH8")))
    for shape, table in means.items():
        equal = sorted((row for (low, high), row in table.items() if low == high), key=lambda r: r["radius_min_mm"])
        by_radius.plot([CIRCUMSCRIBED / r["radius_min_mm"] for r in equal], [r["spheres"] for r in equal],
                       marker=marks[shape], label=shape)
        mixed = sorted((row for (low, _), row in table.items() if low == 0.5), key=lambda r: r["radius_max_mm"])
        by_ratio.plot([r["radius_max_mm"] / 0.5 for r in mixed], [r["spheres"] for r in mixed], marker=marks[shape],
                      label=shape)
    for name, mark, of_radius, of_ratio in PUBLISHED:
        style = {"marker": mark, "mfc": "none", "mec": "black", "ls": "", "ms": 12, "zorder": 5,
                 "label": f"published, {name}"}
        by_radius.plot([CIRCUMSCRIBED / radius for radius in of_radius], of_radius.values(), **style)
        by_ratio.plot(of_ratio.keys(), of_ratio.values(), **style)
    by_radius.set(xlabel="$R_{circ}/R$", ylabel="spheres", yscale="log", title="(a) equal spheres")
    by_ratio.set(xlabel="$R_{max}/R_{min}$, with $R_{min}$ = 0.5 mm", ylabel="spheres", yscale="log")

    finest = {shape: table[0.5, 0.5] for shape, table in means.items()}
    for key, label, mark in [("flatness", "$F$", "o"), ("elongation", "$E$", "s"),
                             ("sphericity_true", r"$\psi^w$", "^"), ("sphericity_working", r"$\psi^A$", "v")]:
        by_shape.plot([r[key] for r in finest.values()], [r["spheres"] for r in finest.values()], mark, label=label)
    by_shape.set(xlabel="shape ratio", ylabel="spheres of 0.5 mm", ylim=(0, None),
                 title=f"(c) {len(finest)} shapes with the same $D^I$")

    for shape, line in zip(list(means)[:2], ["-", "--"]):
        equal = sorted((row for (low, high), row in means[shape].items() if low == high), key=lambda r: r["spheres"])
        for key, colour in [("long", "tab:blue"), ("intermediate", "tab:orange"), ("short", "tab:green")]:
            symbol = {"long": "L", "intermediate": "I", "short": "S"}[key]
            dimensions.plot([r["spheres"] for r in equal], [r[f"d_{key}_mm"] for r in equal], line, marker="o",
                            color=colour, label=f"$D^{symbol}$, {shape}")
            dimensions.axhline(equal[0][f"shape_d_{key}_mm"], color=colour, ls=":", lw=0.8)
    dimensions.set(xlabel="spheres", ylabel="dimension of the cluster (mm)", xscale="log",
                   title="(d) dimensions; dotted: dimensions of the shape")
    for ax in axes.flat:
        ax.grid(alpha=0.3)
    by_radius.legend(fontsize=7, loc="lower right")
    by_ratio.set_title("(b) ranges of radii (marks as in (a))")
    by_shape.legend(fontsize=8, loc="lower left")
    dimensions.legend(fontsize=7, loc="center", bbox_to_anchor=(0.5, 0.65), ncols=2)
    figure.savefig(out, dpi=110)


def view():
    """Returns a matrix whose rows are the directions right, up and towards the viewer."""
    towards = np.array([0.45, -0.80, 0.40])
    towards /= np.linalg.norm(towards)
    right = np.cross([0, 0, 1], towards)
    right /= np.linalg.norm(right)
    return np.array([right, np.cross(towards, right), towards])


def picture(spheres, half, pixels=260):
    """Draws spheres (x, y, z, R) in parallel projection with a depth buffer, lit from the upper left. The picture
    shows ±half [mm]."""
    image, depth = np.ones((pixels, pixels, 3)), np.full((pixels, pixels), -np.inf)
    size = 2 * half / pixels
    centres = (spheres[:, :3] - spheres[:, :3].mean(axis=0)) @ view().T
    light = LIGHT / np.linalg.norm(LIGHT)
    shades = np.random.default_rng(1).uniform(0.75, 1.0, len(spheres))
    for (cx, cy, cz), radius, shade in zip(centres, spheres[:, 3], shades):
        i0, i1 = np.clip([int((half - cy - radius) / size), int((half - cy + radius) / size) + 2], 0, pixels)
        j0, j1 = np.clip([int((half + cx - radius) / size), int((half + cx + radius) / size) + 2], 0, pixels)
        y = half - (np.arange(i0, i1) + 0.5) * size - cy
        x = (np.arange(j0, j1) + 0.5) * size - half - cx
        square = radius**2 - y[:, None] ** 2 - x[None, :] ** 2
        z = np.sqrt(np.maximum(square, 0))
        front = (square > 0) & (cz + z > depth[i0:i1, j0:j1])
        cosine = (x[None, :] * light[0] + y[:, None] * light[1] + z * light[2]) / radius
        colour = np.array(AGGREGATE) * shade * (0.35 + 0.65 * np.maximum(cosine, 0))[..., None]
        image[i0:i1, j0:j1][front] = colour[front]
        depth[i0:i1, j0:j1][front] = (cz + z)[front]
    return image


def draw_spheres(rows, out):
    clusters = defaultdict(list)
    for r in rows:
        clusters[r["shape"], r["radius_min_mm"], r["radius_max_mm"]].append((r["x"], r["y"], r["z"], r["radius"]))
    names = list(dict.fromkeys(shape for shape, _, _ in clusters))
    names = [names[0], names[-1]]
    figure, axes = plt.subplots(len(names), len(SHOWN), figsize=(13, 5.6), constrained_layout=True)
    half = max(np.linalg.norm(c[:3] - np.mean(cluster, axis=0)[:3]) + c[3]
               for key, cluster in clusters.items() if key[0] in names for c in np.array(cluster))
    for row, name in zip(axes, names):
        for ax, (low, high) in zip(row, SHOWN):
            spheres = np.array(clusters[name, low, high])
            ax.imshow(picture(spheres, half))
            radius = f"{low:g} mm" if low == high else f"{low:g}–{high:g} mm"
            ax.set_title(f"{name}, {radius}: {len(spheres)}", fontsize=9)
            ax.axis("off")
    figure.savefig(out, dpi=90)


if __name__ == "__main__":
    folder, target = Path(sys.argv[1]), Path(sys.argv[2])
    draw_study(read(folder / "fill-study.csv"), target / "fill-study.png")
    draw_spheres(read(folder / "fill-spheres.csv"), target / "fill-spheres.png")
