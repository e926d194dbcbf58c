#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws docs/figures/softening.png, the picture of docs/cracks.md: the softening curves, and one crack that opens, closes
and opens again. usage: docs/figures/softening.py [FILE]. Needs Debian's python3-matplotlib."""
import math
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

INK = "#222222"
UNLOADED = 0.7  # opening at which the crack of the right picture closes, in units of G_f/f_t


def linear(y):
    return max(0.0, 1 - y / 2)


def bilinear(y, rho=0.8, r=1 / 3):
    end = (2 - rho) / r
    if y < rho:
        return 1 - (1 - r) * y / rho
    return max(0.0, r * (end - y) / (end - rho))


def exponential(y):
    return math.exp(-y)


# name, curve, colour, line style
CURVES = (("linear", linear, "#4477aa", "-"),
          ("bilinear", bilinear, "#cc3311", "--"),
          ("exponential", exponential, "#228833", "-."))


def area(curve, end=40.0, steps=400_000):
    """Returns the area below a curve, which must be 1 in units of G_f."""
    h = end / steps
    return h * (sum(curve(k * h) for k in range(1, steps)) + (curve(0) + curve(end)) / 2)


def draw_curves(axes):
    ys = [4.2 * k / 840 for k in range(841)]
    for name, curve, colour, line in CURVES:
        axes.plot(ys, [curve(y) for y in ys], line, color=colour, linewidth=1.8, label=name)
    axes.plot([0, 0, 4.2], [1, 0, 0], color="#aa3377", linewidth=2.6, linestyle=":", clip_on=False, zorder=3,
              label="brittle")
    axes.legend(frameon=False, fontsize=9)
    axes.set_title("Softening curves with the same strength\nand, except for brittle, the same energy", fontsize=10)


def draw_cycle(axes):
    ys = [2 * k / 200 for k in range(201)]
    axes.plot(ys, [linear(y) for y in ys], color="#bbbbbb", linewidth=1.2)
    t = linear(UNLOADED)
    axes.fill([0, 0, UNLOADED], [0, 1, t], color="#f3d9d2", linewidth=0)
    axes.fill([0, UNLOADED, UNLOADED], [0, t, 0], color="#dce8f2", linewidth=0)
    axes.annotate("", (UNLOADED, t), (0, 1), arrowprops={"arrowstyle": "-|>", "color": "#cc3311", "linewidth": 1.8})
    axes.annotate("", (0.02, 0.02), (UNLOADED, t),
                  arrowprops={"arrowstyle": "<|-|>", "color": "#4477aa", "linewidth": 1.8})
    axes.annotate("", (2, 0), (UNLOADED, t), arrowprops={"arrowstyle": "-|>", "color": "#cc3311", "linewidth": 1.8})
    axes.plot([0, 0], [-0.35, 0], color="#4477aa", linewidth=1.8)
    axes.text(0.07, 0.62, "dissipated", fontsize=9, color=INK)
    axes.text(0.38, 0.12, "stored", fontsize=9, color=INK)
    axes.text(0.75, 0.70, "the crack grows", fontsize=9, color="#cc3311")
    axes.text(0.74, 0.03, "closing and opening again:\nalong the secant of slope K", fontsize=9, color="#4477aa")
    axes.text(0.06, -0.30, "shut: pressure of the law", fontsize=9, color="#4477aa")
    axes.axhline(0, color=INK, linewidth=0.6)
    axes.set_ylim(-0.38, 1.08)
    axes.set_title("A crack that grows, closes and opens again\n", fontsize=10)


def main():
    for name, curve, *_ in CURVES:
        # the trapezoidal rule errs by 1e-9; the exponential curve has exp(-40) of its area behind the end
        assert abs(area(curve) - 1) < 1e-6, name
    out = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent / "softening.png"
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained")
    draw_curves(left)
    draw_cycle(right)
    for axes, letter in ((left, "y"), (right, "w_n")):
        axes.set_xlabel(f"opening ${letter}$, in units of $G_f/f_t$")
        axes.set_ylabel(r"stress, in units of $f_t$")
        axes.spines[["top", "right"]].set_visible(False)
    figure.savefig(out, dpi=150)


if __name__ == "__main__":
    main()
