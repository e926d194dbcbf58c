# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the figures of bench/fracture/run from its tables: docs/figures/fracture-NAME.png."""
import math

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from bars import line  # noqa: E402
from paper_runs import rows  # noqa: E402

BLUE, RED = "#4477aa", "#cc3311"


def numbers(table, key):
    return [float(row[key]) for row in table]


def over_theory(axes, x, table, name, equation, bar):
    """Draws a column of the table over its theoretical value, and the band of the bar [%]."""
    stem, _, unit = name.rpartition("_")
    axes.plot(x, [float(row[name]) / float(row[f"{stem}_theory_{unit}"]) for row in table], "o", color=BLUE,
              label=f"computed over theory ({equation})")
    axes.axhline(1, color=RED)
    axes.axhspan(1 - bar / 100, 1 + bar / 100, color=RED, alpha=0.1, label=f"bar of {bar} %")
    axes.legend()


def strip(table, axes):
    over_theory(axes, numbers(table, "fracture_energy_j_m2"), table, "stress_pa", "V.1", 3)
    axes.set_xlabel("fracture energy (J/m²), or characteristic length (mm)")
    axes.set_ylabel("critical stress over theory")


def griffith(table, axes):
    axes.loglog(numbers(table, "notch_mm"), [x / 1e6 for x in numbers(table, "strength_pa")], "o", color=BLUE,
                label="computed")
    axes.loglog(numbers(table, "notch_mm"), [x / 1e6 for x in numbers(table, "strength_theory_pa")], color=RED,
                label="theory (V.2)")
    axes.set_xlabel("half length of the notch (mm)")
    axes.set_ylabel("strength (MPa)")
    axes.legend()


def size(table, axes):
    width, strength = numbers(table, "width_mm"), [x / 1e6 for x in numbers(table, "strength_pa")]
    intercept, slope = line([(w, s**-2) for w, s in zip(width, strength)])
    course = [width[0] / 2 * 1.05**k for k in range(70)]
    axes.loglog(width, strength, "o", color=BLUE, label="computed")
    axes.loglog(course, [(intercept + slope * w)**-0.5 for w in course], color=BLUE,
                label="size effect law (V.3), fitted")
    theory = float(table[-1]["strength_theory_pa"]) / 1e6
    axes.loglog(course, [theory * math.sqrt(width[-1] / w) for w in course], "--", color=RED,
                label="linear elastic fracture mechanics (V.2)")
    axes.set_xlabel("half width of the plate (mm)")
    axes.set_ylabel("strength (MPa)")
    axes.legend()


def disc(table, axes):
    course = [0.002 * k for k in range(131)]
    axes.plot(numbers(table, "strip_width"), [x / 1e6 for x in numbers(table, "strength_pa")], "o", color=BLUE,
              label="computed")
    axes.plot(course, [(1 - b * b)**-1.5 for b in course], color=RED, label="theory (V.4)")
    axes.set_xlabel("width of the strips over the diameter")
    axes.set_ylabel("indirect over direct strength")
    axes.set_ylim(0.7, 1.2)
    axes.legend()


def half_disc(table, axes):
    over_theory(axes, [2 * float(row["notch_mm"]) / float(row["diameter_mm"]) for row in table], table, "load_n", "V.5", 5)
    axes.set_xlabel("notch over radius")
    axes.set_ylabel("largest load over theory")
    axes.set_ylim(0.9, 1.1)


PICTURES = {"strip": strip, "griffith": griffith, "size": size, "disc": disc, "half-disc": half_disc}


def draw(name, table_file, folder):
    """Draws the figure of a check from its table into the folder."""
    figure, axes = plt.subplots(figsize=(7, 3.2), layout="constrained")
    PICTURES[name](rows(table_file), axes)
    axes.grid(alpha=0.3)
    figure.savefig(folder / f"fracture-{name}.png", dpi=110)
    plt.close(figure)
