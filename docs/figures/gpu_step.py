#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws docs/figures/gpu-step.png, the picture of docs/gpu-step.md: tiles of a specimen, and two multiprocessors that
each step one tile. usage: docs/figures/gpu_step.py [FILE]. Needs Debian's python3-matplotlib."""
import random
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.patches import FancyBboxPatch, Rectangle  # noqa: E402

COLOURS = ("#4477aa", "#ccbb44", "#66ccee", "#bbbbbb")  # tiles A to D; distinct for all kinds of colour vision
NAMES = "ABCD"
INK = "#222222"


def particles():
    """Returns (x, y, tile) of the particles of a small packing in the unit square, cut in half twice."""
    draw = random.Random(3)
    out = []
    for row in range(8):
        for column in range(8):
            x = (column + 0.5 + 0.25 * (row % 2 - 0.5) + draw.uniform(-0.1, 0.1)) / 8
            y = (row + 0.5 + draw.uniform(-0.1, 0.1)) / 8
            out.append((x, y, 2 * (y < 0.5) + (x > 0.5)))
    return out


def draw_specimen(axes):
    bodies = particles()
    contacts = [(i, j) for i in range(len(bodies)) for j in range(i)
                if (bodies[i][0] - bodies[j][0]) ** 2 + (bodies[i][1] - bodies[j][1]) ** 2 < 0.155 ** 2]
    halo = set()
    for i, j in contacts:
        tiles = bodies[i][2], bodies[j][2]
        crosses = tiles[0] != tiles[1]
        axes.plot([bodies[i][0], bodies[j][0]], [bodies[i][1], bodies[j][1]], color="#cc3311" if crosses else "#888888",
                  linewidth=1.8 if crosses else 0.8, zorder=1)
        if crosses and 0 in tiles:
            halo.add(i if tiles[1] == 0 else j)
    for k, (x, y, tile) in enumerate(bodies):
        axes.plot(x, y, "o", markersize=11, color=COLOURS[tile], zorder=2, markeredgewidth=2.2 if k in halo else 0.5,
                  markeredgecolor="#aa3377" if k in halo else INK)
    for tile, (x, y) in enumerate(((0.02, 1.04), (0.98, 1.04), (0.02, -0.055), (0.98, -0.055))):
        axes.text(x, y, f"tile {NAMES[tile]}", ha="left" if x < 0.5 else "right", va="center", fontsize=10, color=INK)
    lines = [("#cc3311", "contact between tiles: stepped by both"), ("#aa3377", "halo of tile A")]
    for k, (colour, text) in enumerate(lines):
        y = -0.17 - 0.075 * k
        if k == 0:
            axes.plot([0.0, 0.09], [y, y], color=colour, linewidth=1.8, clip_on=False)
        else:
            axes.plot(0.045, y, "o", markersize=10, color="white", markeredgecolor=colour, markeredgewidth=2.2,
                      clip_on=False)
        axes.text(0.13, y, text, va="center", fontsize=9, color=INK)
    axes.set_title("The particles of a specimen in four tiles", fontsize=11, pad=16)
    axes.set_xlim(-0.03, 1.03)
    axes.set_ylim(-0.3, 1.08)
    axes.set_aspect("equal")
    axes.axis("off")


def box(axes, x, y, width, height, text, face="white"):
    axes.add_patch(Rectangle((x, y), width, height, facecolor=face, edgecolor=INK, linewidth=0.8))
    axes.text(x + width / 2, y + height / 2, text, ha="center", va="center", fontsize=8.5,
              color="white" if face == COLOURS[0] else INK)


def draw_multiprocessor(axes, x, tile, other):
    """One multiprocessor, 4 wide and 7.6 high, with its lower edge at 3.2. `other`: a neighbouring tile."""
    axes.add_patch(FancyBboxPatch((x, 3.2), 4, 7.6, boxstyle="round,pad=0.1", facecolor="#f4f4f4", edgecolor=INK))
    axes.text(x + 2, 10.5, f"multiprocessor of tile {NAMES[tile]}", ha="center", va="center", fontsize=10, color=INK)
    box(axes, x + 0.2, 8.55, 3.6, 1.55, "registers of 16 warps\nstate δf, Σ of each contact\n(up to 4 contacts per thread)", "#ffffff")
    axes.text(x + 2, 8.2, "shared memory", ha="center", va="center", fontsize=9, color=INK)
    parts = [(1.7, f"velocities\nof tile {NAMES[tile]}", COLOURS[tile]), (0.75, "walls", "white"),
             (1.15, f"halo\n(of {NAMES[other]}, …)", COLOURS[other])]
    at = x + 0.2
    for width, text, face in parts if tile == 0 else reversed(parts):  # the halos lie next to the gap
        box(axes, at, 6.95, width, 1.0, text, face)
        at += width
    box(axes, x + 0.2, 5.75, 3.6, 1.0, "load cells: one for each couple\nand for each end B", "#ffffff")
    box(axes, x + 0.2, 4.55, 3.6, 1.0, "particles: velocity, u, base load,\nΔt/m, Δt/I", "#ffffff")
    box(axes, x + 0.2, 3.4, 3.6, 0.95, "cache: constants of contacts", "#ffffff")


def arrow(axes, start, end, colour):
    axes.annotate("", xy=end, xytext=start, arrowprops={"arrowstyle": "-|>", "color": colour, "linewidth": 1.8})


def draw_chip(axes):
    draw_multiprocessor(axes, 0.2, 0, 1)
    draw_multiprocessor(axes, 6.2, 1, 0)
    box(axes, 0.2, 1.35, 4.0, 0.75, "tile A: v, ω, tag of the step", COLOURS[0])
    box(axes, 6.2, 1.35, 4.0, 0.75, "tile B: v, ω, tag of the step", COLOURS[1])
    axes.text(5.2, 1.72, "exchange,\nin the L2 cache", ha="center", va="center", fontsize=8.5, color=INK)
    box(axes, 0.2, 0.1, 10.0, 0.85, "global memory: contacts that do not fit, chains (viscoelastic states), load records, plan")
    for x, colour in ((1.0, "#225588"), (9.4, "#887711")):
        arrow(axes, (x, 3.1), (x, 2.15), colour)
    axes.text(1.15, 2.68, "publish", fontsize=9, va="center", color=INK)
    axes.text(9.25, 2.68, "publish", fontsize=9, va="center", ha="right", color=INK)
    arrow(axes, (3.95, 2.1), (6.4, 7.45), "#aa3377")
    arrow(axes, (6.45, 2.1), (4.0, 7.45), "#aa3377")
    axes.text(5.2, 9.0, "receive:\nread until\nthe word\nhas the tag\nof the step", ha="center", va="center", fontsize=8.5, color=INK)
    axes.set_title("One thread block per tile, one tile per multiprocessor", fontsize=11, pad=6)
    axes.set_xlim(0, 10.4)
    axes.set_ylim(0, 11.1)
    axes.axis("off")


def main():
    out = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent / "gpu-step.png"
    figure, (left, right) = plt.subplots(1, 2, figsize=(11.5, 5.75), width_ratios=(1, 1.75))
    draw_specimen(left)
    draw_chip(right)
    figure.tight_layout()
    figure.savefig(out, dpi=96, metadata={"Software": None}, pil_kwargs={"optimize": True})
    print(f"wrote {out}")


if __name__ == "__main__":
    main()
