#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws a contact sheet of a folder of OFF surfaces: `draw_shapes.py DIR FILE.png`. Each surface is scaled to its
cell and has its D^L below it."""
import io
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.collections import PolyCollection  # noqa: E402
from PIL import Image  # noqa: E402

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "scripts"))
from specimen_colours import AGGREGATE  # noqa: E402

COLUMNS = 12
VIEW = np.array([[0.80, -0.60, 0.0], [0.21, 0.28, 0.936], [-0.562, -0.749, 0.351]])  # rows: directions right, up,
                                                                                     # towards the viewer
LIGHT = np.array([-0.45, 0.65, 0.61])  # direction of the light in the frame of VIEW


def read_off(path):
    numbers = path.read_text(encoding="ascii").split()
    points, facets = int(numbers[1]), int(numbers[2])
    x = np.array(numbers[4:4 + 3 * points], dtype=float).reshape(-1, 3)
    return x, np.array(numbers[4 + 3 * points:4 + 3 * points + 4 * facets], dtype=int).reshape(-1, 4)[:, 1:]


def draw(ax, path):
    x, facets = read_off(path)
    x = (x - (x.max(axis=0) + x.min(axis=0)) / 2) @ VIEW.T
    corners = x[facets]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    seen = np.flatnonzero(normals[:, 2] > 0)
    seen = seen[np.argsort(corners[seen, :, 2].mean(axis=1))]  # the nearest facets are drawn last
    bright = 0.35 + 0.95 * np.clip(normals[seen] @ LIGHT, 0, 1)
    colours = np.clip(bright[:, None] * np.array(AGGREGATE), 0, 1)
    ax.add_collection(PolyCollection(corners[seen, :, :2], facecolors=colours, edgecolors=colours, linewidths=0.3))
    reach = np.linalg.norm(x, axis=1).max()
    ax.set(xlim=(-reach, reach), ylim=(-reach, reach), aspect="equal")
    ax.axis("off")
    longest = np.linalg.norm(x[:, None] - x[None], axis=2).max()
    ax.set_title(f"{path.stem.split('_')[-1]}  {1e3 * longest:.1f} mm", fontsize=6, y=-0.08)


def main():
    files = sorted(Path(sys.argv[1]).glob("*.off"))
    rows = -(-len(files) // COLUMNS)
    figure, axes = plt.subplots(rows, COLUMNS, figsize=(COLUMNS, 1.08 * rows))
    for ax in axes.flat:
        ax.axis("off")
    for ax, path in zip(axes.flat, files):
        draw(ax, path)
    figure.subplots_adjust(0.005, 0.015, 0.995, 0.995, 0.02, 0.12)
    whole = io.BytesIO()
    figure.savefig(whole, dpi=110)
    Image.open(whole).convert("RGB").quantize(48).save(sys.argv[2], optimize=True)


main()
