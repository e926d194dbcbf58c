# SPDX-License-Identifier: GPL-3.0-or-later
"""Rows of bench/accuracy's accuracy.csv and accuracy-full.csv (the full specimen) by study, whatever scenes they have,
and how their errors are written."""
from pages.data import largest, minus, power, rows, upto, where

FILES = ("accuracy.csv", "accuracy-full.csv")

E, PHI = "own_error_e_star", "own_error_phase_deg"  # against the same inertia
TRUE_E, TRUE_PHI = "error_e_star", "error_phase_deg"  # against true mass


def every():
    return [r for file in FILES for r in rows(file)]


def may_fail(row):
    """Steps beyond the stable one, gaps without which a network falls apart, and what `tolerance` chose: their tables
    show what became of them."""
    return row["study"] in ("step_share", "tolerance") or row["gap_max"] is not None


def study(*names, **wanted):
    """Rows that were measured. A failed one is an error where nothing but a fault can make it fail."""
    found = [r for r in every() if r["study"] in names]
    for r in found:
        if r["status"] != "done" and not may_fail(r):
            raise LookupError(f"{r['study']} of {scene(r)}, {r['frequency_hz']:g} Hz, scaling "
                              f"{r['density_scaling']:g}: {r['status']}")
    return where(done(found), **wanted)


def tried(*names):
    """All rows, those that failed too."""
    return [r for r in every() if r["study"] in names]


def done(found):
    return [r for r in found if r["status"] == "done"]


def scene(row):
    return row["scene"] + ("" if row["mix"] == "AM1" else f" with {row['mix']}")


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
