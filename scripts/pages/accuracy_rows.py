# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads the rows of accuracy.csv and accuracy-full.csv (the full specimen), which bench/accuracy writes, by study and
for all scenes, and writes their errors as text."""
from pages.data import largest, minus, power, rows, upto, where

FILES = ("accuracy.csv", "accuracy-full.csv")

E, PHI = "own_error_e_star", "own_error_phase_deg"  # errors relative to the harmonic solution with the same inertia
TRUE_E, TRUE_PHI = "error_e_star", "error_phase_deg"  # errors relative to that with true mass


# Returns all rows of both files.
def every():
    return [r for file in FILES for r in rows(file)]


def may_fail(row):
    """Whether a row may have failed: runs with steps beyond the stable one, runs whose gap_max may disconnect the
    specimen, and runs with `tolerance`. The tables of these rows show failures."""
    return row["study"] in ("step_share", "tolerance") or row["gap_max"] is not None


def study(*names, **wanted):
    """Returns the rows of these studies that succeeded. Raises LookupError for a failed row that must not fail."""
    found = [r for r in every() if r["study"] in names]
    for r in found:
        if r["status"] != "done" and not may_fail(r):
            raise LookupError(f"{r['study']} of {scene(r)}, {r['frequency_hz']:g} Hz, scaling "
                              f"{r['density_scaling']:g}: {r['status']}")
    return where(done(found), **wanted)


def tried(*names):
    """Returns all rows of these studies, also those that failed."""
    return [r for r in every() if r["study"] in names]


def done(found):
    return [r for r in found if r["status"] == "done"]


# Returns the name of a row's scene, with its mix if that is not AM1.
def scene(row):
    return row["scene"] + ("" if row["mix"] == "AM1" else f" with {row['mix']}")


def scenes(found):
    return list(dict.fromkeys(scene(r) for r in found))


def within(found, key):
    """Returns an upper bound of the column's magnitudes as text, rounded up."""
    bound = upto(largest(found, key))
    return minus(power(bound)) if bound < 0.001 else f"{bound:g}"


# Returns upper bounds of the errors of |E*| and phase as text.
def both(found, keys=(E, PHI)):
    return f"{within(found, keys[0])} and {within(found, keys[1])}°"


def signed(x, digits=2):
    return minus(power(x, digits, sign=True))


def drift_differences(precision=None):
    """Returns (row, difference) of the drift study: the difference from double precision with the same settings or, if
    that was not run, from the harmonic solution."""
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
