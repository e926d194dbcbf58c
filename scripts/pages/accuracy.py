# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/accuracy.md: from bench/accuracy's accuracy.csv, all rows of a study; what to use when, and each setting."""
import math

from pages import accuracy_asked, accuracy_elsewhere
from pages.accuracy_rows import (E, PHI, TRUE_E, TRUE_PHI, both, drift_differences, scene, scenes, signed, study,
                                 within)
from pages.data import head, largest, listed, minus, one, plain, power, rows, table, thousands, upto, where
from pages.marks import mark

DOCUMENT = "docs/accuracy.md"
PARTS = (accuracy_asked, accuracy_elsewhere)  # more functions of this document
ASKED_OF_MIXED = {E: 1e-5, PHI: 0.002}


@mark
def machine():
    about = dict(line.split(": ", 1) for line in head("accuracy.csv"))
    return f"{about['date']}, {about['machine']}"


@mark
def sizes():
    """Scenes and contacts of the standard studies."""
    contacts = {scene(r): int(r["contacts"]) for r in reversed(study("front", "tolerance"))}
    return ", ".join(f"{name} ({contacts[name]:,} contacts)" for name in scenes(study("front", "tolerance")))


# ---- what to use when

@mark
def harmonic_cost():
    runs = where(rows("paper-specimens.csv"), scene="ac14_ss_am1")
    return (f"{min(r['wall_s'] for r in runs):.0f} to {max(r['wall_s'] for r in runs):.0f} s and "
            f"{max(r['memory_gb'] for r in runs):.1f} GB with {runs[0]['threads']:.0f} threads")


def scaled():
    return study("front", form="condensed", precision="mixed", geometry="fixed", frequency_hz=20.0, mix="AM1",
                 backend="cpu")


@mark
def inertia(name):
    """Error of inertia at a scaling of 1e4 and 20 Hz."""
    row = one(scaled(), scene=name, density_scaling=1e4)
    return f"{signed(row[TRUE_E])} of \\|E\\*\\| and {row[TRUE_PHI]:+.2f}°"


@mark
def full_inertia():
    row = one(scaled(), scene="full", density_scaling=1e4)
    return f"{100 * abs(row[TRUE_E]):.0f} %"


def steady(precision="double", **wanted):
    return study("front", "drift", "step_share", start="steady", cycles=1.0, geometry="fixed", precision=precision,
                 step_share=lambda s: s < 1, **wanted)


@mark
def steady_error():
    return both(steady())


@mark
def steady_runs():
    return f"{len(steady())}"


@mark
def steady_scenes():
    return listed(scenes(steady()))


def rest(ramp, cycles):
    return study("rest", start="rest", ramp_cycles=float(ramp), cycles=cycles)


@mark
def ramp_error(cycles):
    return within(rest(1, float(cycles)), E)


@mark
def no_ramp_error(cycles):
    return both(rest(0, lambda n: n >= float(cycles)))


@mark
def forms():
    """Largest difference of the two forms in double precision."""
    def key(r):
        return tuple(r[k] for k in ("scene", "mix", "precision", "geometry", "density_scaling", "frequency_hz"))
    double = study("front", precision="double")
    condensed = {key(r): r for r in double if r["form"] == "condensed"}
    pairs = [(r, condensed[key(r)]) for r in double if r["form"] == "points"]
    e = max(abs(a["e_star_pa"] / b["e_star_pa"] - 1) for a, b in pairs)
    phi = max(abs(a["phase_deg"] - b["phase_deg"]) for a, b in pairs)
    return "the same digits" if e == phi == 0 else f"{minus(power(upto(e)))} and {minus(power(upto(phi)))}°"


def bent():
    """The longest runs of each scene: in one cycle the second harmonic still shows."""
    found = study("strain", geometry="updated")
    most = {scene(r): max(x["cycles"] for x in found if scene(x) == scene(r)) for r in found}
    return [r for r in found if r["cycles"] == most[scene(r)]]


@mark
def strain_scenes():
    return ", ".join(scenes(bent()))


@mark
def strain_factor():
    """|E*| over the square of the strain, where rounding is far below."""
    return plain(upto(max(abs(r[E]) / r["strain"] ** 2 for r in bent() if r["strain"] >= 1e-3)))


@mark
def strain_error(strain):
    return within([r for r in bent() if r["strain"] == float(strain)], E)


@mark
def rounding(precision):
    d = [d for _, d in drift_differences(precision)]
    return both(d)


@mark
def most_steps(precision):
    return thousands(max(r["steps"] for r, _ in drift_differences(precision)))


@mark
def rounding_up_to(precision, steps):
    return both([d for r, d in drift_differences(precision) if r["steps"] <= float(steps)])


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


# ---- damping

def shaken():
    return study("damping", scene="t8", mix="AM1", density_scaling=1e4)


def damped(kind, value):
    """What damping alone does, at 20 Hz and a scaling of 1e4: against the same start without it."""
    row = one(shaken(), damping_kind=kind, damping=float(value))
    base = one(shaken(), damping_kind="none") if row["start"] == "rest" else one(scaled(), scene="t8",
                                                                                 density_scaling=1e4)
    return row[TRUE_E] - base[TRUE_E], row[TRUE_PHI] - base[TRUE_PHI]


@mark
def damping(kind, value):
    e, phi = damped(kind, value)
    return f"{signed(e, 1)} and {minus(f'{phi:+.3f}')}°"


@mark
def damping_noise():
    """What the waves of the start leave without any damping: differences below it say nothing."""
    row = one(shaken(), damping_kind="none")
    return f"{minus(power(abs(row[E]), 1))} and {abs(row[PHI]):.3f}°"


# ---- the rest of the studies

@mark
def full_own():
    of = study("front", scene="full")
    return both(of)


@mark
def full_scalings():
    of = sorted({r["density_scaling"] for r in study("front", scene="full")})
    return f"{minus(power(of[0], 1))} to {minus(power(of[-1], 1))}"


@mark
def cycles_from_rest():
    lines = []
    for name in scenes(study("rest")):
        for f in (20.0, 2.0):
            of = [r for r in study("rest") if scene(r) == name and r["frequency_hz"] == f and r["start"] == "rest"]
            if not of:
                continue
            needed = {ramp: [] for ramp in (1.0, 0.0)}
            for ramp in needed:
                for s in sorted({r["density_scaling"] for r in of if r["ramp_cycles"] == ramp}):
                    run = [r for r in of if r["ramp_cycles"] == ramp and r["density_scaling"] == s]
                    last = max((r["cycles"] for r in run if abs(r[E]) > 1e-5 or abs(r[PHI]) > 0.002), default=0)
                    after = [r["cycles"] for r in run if r["cycles"] > last]
                    needed[ramp].append(f"{min(after):.0f}" if after else f"> {max(r['cycles'] for r in run):.0f}")
            scalings = sorted({r["density_scaling"] for r in of})
            lines.append((name, f"{f:g}", ", ".join(minus(power(s, 1)) for s in scalings),
                          ", ".join(needed[1.0]), ", ".join(needed[0.0])))
    return table(["scene", "f (Hz)", "scalings", "with a ramp of one cycle", "without"], lines)


def shares(**wanted):
    return study("step_share", **wanted)


@mark
def rest_share():
    """From rest without ramp, by the share of the critical step."""
    of = {r["step_share"]: r for r in shares(start="rest", scene="t8", mix="AM1")}
    return "; ".join(f"{minus(power(abs(of[s][E]), 1))} and {plain(abs(of[s][PHI]), 1)}° at {s:.2f}"
                     for s in (min(of), max(x for x in of if x < 1), max(of)))


@mark
def step_to_inertia():
    """Error of the step over that of inertia, steady start, at the largest step below the computed one."""
    ratio = []
    for name in scenes(shares()):
        of = [r for r in shares(start="steady") if scene(r) == name and r["step_share"] < 1]
        r = max(of, key=lambda r: r["step_share"])
        ratio.append(abs(r[E] / r[TRUE_E]))
    return minus(power(upto(max(ratio), 1), 1))


@mark
def stable_share():
    return ", ".join(f"{name} at {max(r['step_share'] for r in shares() if scene(r) == name):.2f}"
                     for name in scenes(shares()))


@mark
def filters():
    changed = where(study("quadrature", "filter"), frequency_hz=20.0)
    base = {scene(r): r["contacts"] for r in changed if r["gap_max"] is None and r["area_min"] is None}
    lines, seen = [], set()
    for r in sorted(changed, key=lambda r: scenes(changed).index(scene(r))):
        what = ("`quadrature = \"exact\"`" if r["quadrature"] != "lumped" else
                f"`gap_max = {r['gap_max']:g}`" if r["gap_max"] is not None else
                f"`area_min = {r['area_min']:g}`" if r["area_min"] is not None else None)
        if what is None or (scene(r), what) in seen:
            continue
        seen.add((scene(r), what))
        dropped = base[scene(r)] - r["contacts"]
        lines.append((scene(r), what, f"{dropped:.0f}", f"{100 * dropped / base[scene(r)]:.1f}",
                      f"{100 * r['model_e_star']:+.3f}".replace("-", "−"), minus(f"{r['model_phase_deg']:+.4f}")))
    return table(["scene", "choice", "contacts dropped", "of all (%)", "\\|E\\*\\| (%)", "φ (°)"], lines)


@mark
def gap_zero():
    of = where(study("filter"), gap_max=0.0)
    return listed(f"{minus(f'{change:.0f}')} % ({name})"
                  for name, change in ((scene(r), 100 * r["model_e_star"]) for r in of))


@mark
def area_saved():
    """What area_min = 0.026 drops and saves, and the largest change of |E*| by it."""
    of = [r for r in study("filter") if r["area_min"] == 0.026]
    base = {scene(r): r for r in study("filter") if r["gap_max"] is None and r["area_min"] is None}
    saved = [1 - r["seconds"] / r["steps"] / (base[scene(r)]["seconds"] / base[scene(r)]["steps"]) for r in of]
    dropped = [1 - r["contacts"] / base[scene(r)]["contacts"] for r in of]
    return (f"{100 * min(dropped):.1f} to {100 * max(dropped):.1f} % of the contacts, {100 * min(saved):.0f} to "
            f"{100 * max(saved):.0f} % of the time and {power(upto(largest(of, 'model_e_star'), 1), 1)} of |E\\*|")
