# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the page bench/results/accuracy-tables.md, which shows accuracy.csv and accuracy-full.csv by study."""
import math

from pages.accuracy_rows import E, FILES, PHI, TRUE_E, TRUE_PHI, drift_differences, scene, study, tried
from pages.data import head, table

DOCUMENT = "bench/results/accuracy-tables.md"


def true(r):
    return f"{r[TRUE_E]:+.1e}", f"{r[TRUE_PHI]:+.1e}"


def own(r):
    return f"{r[E]:+.1e}", f"{r[PHI]:+.1e}"


def cost(r):
    return int(r["steps"]), f"{r['seconds']:.3g}", f"{1e6 * r['seconds'] / r['steps']:.3g}", f"{r['bytes'] / 1024:.0f}"


def name(r, *keys):
    """Returns scene, frequency and the columns `keys` of a row as short texts."""
    return (scene(r), f"{r['frequency_hz']:g}", *(r[k] if isinstance(r[k], str) else f"{r[k]:g}" for k in keys))


def cycles_needed():
    lines = []
    groups = dict.fromkeys((scene(r), r["frequency_hz"], r["density_scaling"], r["ramp_cycles"])
                           for r in study("rest") if r["start"] == "rest")
    for group in sorted(groups, key=lambda g: ([scene(r) for r in tried("rest")].index(g[0]), -g[1], g[2], g[3])):
        found = [r for r in study("rest") if r["start"] == "rest" and
                 (scene(r), r["frequency_hz"], r["density_scaling"], r["ramp_cycles"]) == group]

        def needed(e_star, phase, found=found):
            last = max((r["cycles"] for r in found if abs(r[E]) > e_star or abs(r[PHI]) > phase), default=0)
            after = [r["cycles"] for r in found if r["cycles"] > last]
            return f"{min(after):g}" if after else f"> {max(r['cycles'] for r in found):g}"
        lines.append((group[0], *(f"{x:g}" for x in group[1:]),
                      *(needed(t, math.degrees(t)) for t in (1e-2, 1e-3, 1e-4)), needed(1e-5, 0.002)))
    return lines


def filters():
    base = {scene(r): r["contacts"] for r in tried("filter") if r["gap_max"] is None and r["area_min"] is None}
    for r in tried("quadrature", "filter"):
        what = (*name(r, "quadrature"), *("" if r[k] is None else f"{r[k]:g}" for k in ("gap_max", "area_min")))
        yield ((*what, int(base[scene(r)] - r["contacts"]), f"{r['model_e_star']:+.2e}", f"{r['model_phase_deg']:+.2e}",
                *own(r), cost(r)[2]) if r["status"] == "done" else (*what, r["status"][:60], "", "", "", "", ""))


def asked(r):
    if r["status"] != "done":
        return (*name(r, "tolerance"), *[""] * 3, r["status"][:60].replace("|", "\\|"), *[""] * 6)
    hand = r["seconds_by_hand"]
    return (*name(r, "tolerance", "density_scaling", "precision", "geometry"),
            f"{(1 + r[TRUE_E]) / (1 + r[E]) - 1:+.3e}", f"{r[TRUE_E]:+.3e}", f"{math.radians(r[TRUE_PHI]):+.2e}",
            int(r["steps"]), f"{r['seconds']:.3g}", f"{r['seconds_harmonic']:.2g}",
            f"{r['seconds'] / hand:.2f}" if hand and math.isfinite(hand) else "none found")


def page():
    e, phi = "\\|E\\*\\|", "φ (°)"
    parts = [
        ("Error against run time, steady start, one cycle",
         ["scene", "f", "scaling", "form", "precision", "geometry", e, phi, "steps", "s", "µs per step", "KiB"],
         [(*name(r, "density_scaling", "form", "precision", "geometry"), *true(r), *cost(r)) for r in study("front")]),
        ("Drift: difference from double",
         ["scene", "f", "scaling", "cycles", "steps", "precision", "geometry", e, phi],
         [(*name(r, "density_scaling", "cycles"), int(r["steps"]), r["precision"], r["geometry"], f"{d[E]:+.1e}",
           f"{d[PHI]:+.1e}") for r, d in drift_differences() if r["precision"] != "double"]),
        ("Cycles from rest until the error stays below",
         ["scene", "f", "scaling", "ramp", "1e-2", "1e-3", "1e-4", "1e-5 and 0.002°"], cycles_needed()),
        ("Strain, updated geometry, against the linear solution", ["scene", "f", "strain", "cycles", e, phi],
         [(*name(r, "strain", "cycles"), *own(r)) for r in study("strain") if r["geometry"] == "updated"]),
        ("Step as a share of the computed critical one, against the same inertia",
         ["scene", "f", "start", "share", e, phi],
         [(*name(r, "start"), f"{r['step_share']:.2f}", *(own(r) if r["status"] == "done" else (r["status"], "")))
          for r in tried("step_share")]),
        ("Damping, against true mass undamped", ["scene", "f", "scaling", "damping", "value", "start", e, phi],
         [(*name(r, "density_scaling", "damping_kind", "damping", "start"), *true(r)) for r in study("damping")]),
        ("Quadrature and filters: change of the model, and error against its own solution",
         ["scene", "f", "quadrature", "gap_max", "area_min", "contacts dropped", f"{e} model", "φ model (°)",
          f"{e} own", "φ own (°)", "µs per step"], list(filters())),
        ("Backends", ["scene", "f", "backend", "scaling", "precision", "form", f"{e} own", "φ own (°)", "steps", "s",
                      "µs per step", "KiB"],
         [(*name(r, "backend", "density_scaling", "precision", "form"), *own(r), *cost(r)) for r in study("backend")]),
        ("`[solver] tolerance`", ["scene", "f", "asked", "scaling", "precision", "geometry", f"{e} predicted",
                                  f"{e} achieved", "φ achieved (rad)", "steps", "s", "planning s", "s / fastest by trial"],
         [asked(r) for r in tried("tolerance")])]
    out = ["# Tables of accuracy.csv and accuracy-full.csv", "",
           *(f"- {file}: {'; '.join(head(file))}" for file in FILES), ""]
    for title, heads, lines in parts:
        out += [f"## {title}", "", *table(heads, lines), ""]
    return "\n".join(out).rstrip() + "\n"
