# SPDX-License-Identifier: GPL-3.0-or-later
"""Rows of bench/accuracy's accuracy.csv by study, whatever scenes it has, and how their errors are written."""
from pages.data import largest, minus, power, rows, upto, where

E, PHI = "own_error_e_star", "own_error_phase_deg"  # against the same inertia
TRUE_E, TRUE_PHI = "error_e_star", "error_phase_deg"  # against true mass


def study(*names, **wanted):
    return where(rows("accuracy.csv"), study=names, status="done", **wanted)


def scene(row):
    return row["scene"] + ("" if row["mix"] == "AM1" else f", {row['mix']}")


def scenes(found):
    return list(dict.fromkeys(scene(r) for r in found))


def within(found, key):
    """A bound of the magnitudes, rounded up."""
    bound = upto(largest(found, key))
    return minus(power(bound)) if bound < 0.001 else f"{bound:g}"


def both(found, keys=(E, PHI)):
    return f"{within(found, keys[0])} and {within(found, keys[1])}°"


def signed(x, digits=2):
    return minus(power(x, digits, sign=True))


def drift_differences(precision=None):
    """(row, difference from double at the same settings; from the harmonic solution where double was not run)."""
    found = study("drift")
    def key(r):
        return (r["scene"], r["mix"], r["frequency_hz"], r["density_scaling"], r["cycles"], r["geometry"])
    double = {key(r): r for r in found if r["precision"] == "double"}
    pairs = []
    for r in found:
        d = double.get(key(r))
        pairs.append((r, {E: r["e_star_pa"] / d["e_star_pa"] - 1, PHI: r["phase_deg"] - d["phase_deg"]}
                      if d and r["precision"] != "double" else {E: r[E], PHI: r[PHI]}))
    return [p for p in pairs if precision in (None, p[0]["precision"])]
