# SPDX-License-Identifier: GPL-3.0-or-later
"""Marks of docs/choose-settings.md and docs/verification.md on errors by rounding, by precision."""
import math

from pages.accuracy_rows import E, PHI, both, drift_differences, scene, scenes, signed, study
from pages.data import head, listed, minus, plain, power, rows, table, thousands, upto
from pages.marks import mark

ASKED_OF_MIXED = {E: 1e-5, PHI: 0.002}


@mark
def rounding(precision):
    d = [d for _, d in drift_differences(precision)]
    return both(d)


def single_steps():
    """Returns (row, difference) of all runs in single precision: the differences of the drift study and, for runs with
    `tolerance`, those from the harmonic solution with the same inertia."""
    asked = [(r, {E: r[E], PHI: r[PHI]}) for r in study("tolerance", precision="single", geometry="fixed")]
    return drift_differences("single") + asked


@mark
def single(steps):
    """Returns the largest difference in runs of at most this number of steps."""
    return both([d for r, d in single_steps() if r["steps"] <= float(steps)])


@mark
def single_scenes():
    return listed(scenes(r for r, _ in single_steps()))


@mark
def most_steps(precision):
    return thousands(max(r["steps"] for r, _ in drift_differences(precision)))


@mark
def mixed_margin():
    worst = {k: max(abs(d[k]) for _, d in drift_differences("mixed")) for k in (E, PHI)}
    e, phi = (math.floor(ASKED_OF_MIXED[k] / worst[k]) for k in (E, PHI))
    return f"{e} times over in |E\\*| and {phi} times in φ"


@mark
def many_cycles():
    of = [(r, d) for r, d in drift_differences("single") if r["cycles"] > 1]
    return (f"{max(r['cycles'] for r, _ in of):.0f} cycles, {thousands(max(r['steps'] for r, _ in of))} steps: at most "
            f"{both([d for _, d in of])}")


@mark
def drift():
    of = [(r, d) for r, d in drift_differences() if r["cycles"] == 1 and r["steps"] >= 3e5
          and (r["density_scaling"] == 1 or r["geometry"] == "updated")]
    of.sort(key=lambda p: (p[0]["steps"] if p[0]["density_scaling"] == 1 else 1e9 * p[0]["density_scaling"],
                           p[0]["geometry"], ["double", "mixed", "single"].index(p[0]["precision"])))
    return table(["scene", "f (Hz)", "scaling", "geometry", "steps", "precision", "\\|E\\*\\|", "φ (°)"],
                 [(scene(r), f"{r['frequency_hz']:g}", f"{r['density_scaling']:g}", r["geometry"],
                   thousands(r["steps"]), r["precision"], signed(d[E]), signed(d[PHI])) for r, d in of])


# ---- precision.csv: mixed and single against double at the same settings

def off(row):
    """Returns the larger of the errors of |E*| (relative) and φ (radians), which is the quantity that the program
    estimates."""
    return max(abs(row["e_star"]), abs(row["phase_rad"]))


def rounded_up(x):
    return minus(power(upto(x)))


def times(x):
    return plain(x) if x < 1000 else power(x)


def of(precision):
    return [r for r in rows("precision.csv") if r["precision"] == precision]


@mark
def precision_machines():
    return "; ".join(head("precision.csv"))


@mark
def precision_runs():
    return f"{len(of('single'))} comparisons"


@mark
def precision_largest(precision):
    return rounded_up(max(off(r) for r in of(precision)))


@mark
def precision_range():
    found = of("single")
    return (f"{thousands(max(r['steps'] for r in found))} steps, {max(r['layers'] for r in found):.0f} layers, "
            f"{thousands(max(r['particles'] for r in found))} particles, moduli "
            f"{times(max(r['contrast'] for r in found))} apart")
