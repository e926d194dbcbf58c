# SPDX-License-Identifier: GPL-3.0-or-later
"""Marks of docs/choose-settings.md, docs/verification.md and docs/frequency-solver.md, from all rows of the studies in accuracy.csv and
accuracy-full.csv, which bench/accuracy writes."""
from pages import (accuracy_asked, accuracy_device, accuracy_elsewhere, accuracy_iterations, accuracy_linear,
                   accuracy_rounding, verification)
from pages.accuracy_rows import (E, FILES, PHI, TRUE_E, TRUE_PHI, both, done, scene, scenes, signed, study, tried,
                                 within)
from pages.data import (between, downto, head, largest, listed, memory, minus, one, plain, power, rows, table, upto,
                        where)
from pages.marks import mark

DOCUMENT = "docs/choose-settings.md"
PARTS = (accuracy_asked, accuracy_device, accuracy_elsewhere, accuracy_iterations, accuracy_linear,
         accuracy_rounding)  # modules with more marks of this document


@mark
def machine(which):
    """Returns machine and date of the standard studies (0) or of the full specimen's studies (1)."""
    about = dict(line.split(": ", 1) for line in head(FILES[int(which)]))
    return f"{about['machine']}, {about['date']}"


@mark
def sizes():
    """Returns the scenes with their numbers of contacts."""
    found = done(tried("front", "tolerance"))
    contacts = {scene(r): int(r["contacts"]) for r in reversed(found)}
    return ", ".join(f"{name} ({contacts[name]:,} contacts)" for name in scenes(found))


# ---- what to use when

@mark
def harmonic_cost():
    runs = where(rows("paper-specimens.csv"), scene="ac14_ss_am1")
    return (f"{between(r['wall_s'] for r in runs)} s and {memory(r['memory_gb'] for r in runs)} with "
            f"{runs[0]['threads']:.0f} threads")


def scaled():
    return study("front", form="condensed", precision="mixed", geometry="fixed", frequency_hz=20.0, mix="AM1",
                 backend="cpu")


@mark
def inertia(name):
    """Returns the error by inertia at a density scaling of 1e4 and 20 Hz."""
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
    """Returns the rows of runs from rest whose time steps are below the computed critical step."""
    return study("rest", "step_share", start="rest", ramp_cycles=float(ramp), cycles=cycles,
                 step_share=lambda s: s < 1)


@mark
def ramp_error(cycles):
    return within(rest(1, float(cycles)), E)


@mark
def no_ramp_error(cycles):
    return both(rest(0, lambda n: n >= float(cycles)))


@mark
def forms():
    """Returns the largest difference between the two forms of contacts (condensed, points) in double precision."""
    def key(r):
        return tuple(r[k] for k in ("scene", "mix", "precision", "geometry", "density_scaling", "frequency_hz"))
    double = study("front", precision="double")
    condensed = {key(r): r for r in double if r["form"] == "condensed"}
    pairs = [(r, condensed[key(r)]) for r in double if r["form"] == "points"]
    e = max(abs(a["e_star_pa"] / b["e_star_pa"] - 1) for a, b in pairs)
    phi = max(abs(a["phase_deg"] - b["phase_deg"]) for a, b in pairs)
    return "the same digits" if e == phi == 0 else f"{minus(power(upto(e)))} and {minus(power(upto(phi)))}°"


def bent():
    """Returns the rows of the longest runs of each scene, because in a single cycle the second harmonic is still
    visible."""
    found = study("strain", geometry="updated")
    most = {scene(r): max(x["cycles"] for x in found if scene(x) == scene(r)) for r in found}
    return [r for r in found if r["cycles"] == most[scene(r)]]


@mark
def strain_scenes():
    return ", ".join(scenes(bent()))


@mark
def strain_factor():
    """Returns the largest error of |E*| divided by the square of the strain, for strains at which rounding is
    negligible."""
    return plain(upto(max(abs(r[E]) / r["strain"] ** 2 for r in bent() if r["strain"] >= 1e-3)))


@mark
def strain_error(strain):
    return within([r for r in bent() if r["strain"] == float(strain)], E)


# ---- damping

def shaken():
    return study("damping", scene="t8", mix="AM1", density_scaling=1e4)


def damped(kind, value):
    """Returns the effect of damping alone on |E*| and phase, at 20 Hz and a density scaling of 1e4: the difference from
    a run with the same start without damping."""
    row = one(shaken(), damping_kind=kind, damping=float(value))
    base = one(shaken(), damping_kind="none") if row["start"] == "rest" else one(scaled(), scene="t8",
                                                                                 density_scaling=1e4)
    return row[TRUE_E] - base[TRUE_E], row[TRUE_PHI] - base[TRUE_PHI]


@mark
def damping(kind, value):
    e, phi = damped(kind, value)
    return f"{signed(e)} and {minus(f'{phi:+.3f}')}°"


@mark
def damping_noise():
    """Returns the error that the waves of the start leave without damping."""
    row = one(shaken(), damping_kind="none")
    return f"{minus(power(abs(row[E])))} and {abs(row[PHI]):.4f}°"


# ---- the rest of the studies

@mark
def full_own():
    return both(study("front", scene="full", frequency_hz=20.0))


@mark
def full_scalings():
    of = sorted({r["density_scaling"] for r in study("front", scene="full", frequency_hz=20.0)})
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
    """Returns the errors of runs from rest without a ramp, over all shares of the critical step."""
    of = shares(start="rest", scene="t8", mix="AM1")
    e, phi = ([abs(r[key]) for r in of] for key in (E, PHI))
    steps = [r["step_share"] for r in of]
    return (f"over steps of {min(steps):.2f} to {max(steps):.2f} of the computed one, "
            f"{power(downto(min(e), 1), 1)} to {power(upto(max(e)))} and {downto(min(phi), 1):g}° to "
            f"{upto(max(phi)):g}°")


@mark
def step_to_inertia():
    """Returns the ratio of the error by the time step to that by inertia, for the steady start and the largest step
    below the computed one."""
    ratio = []
    for name in scenes(shares()):
        of = [r for r in shares(start="steady") if scene(r) == name and r["step_share"] < 1]
        r = max(of, key=lambda r: r["step_share"])
        ratio.append(abs(r[E] / r[TRUE_E]))
    return minus(power(upto(max(ratio))))


@mark
def stable_share():
    """Returns up to which share of the critical step the runs were stable, and at which they diverged."""
    found, words = tried("step_share"), []
    for name in scenes(found):
        of = [r for r in found if scene(r) == name]
        failed = [r["step_share"] for r in of if r["status"] != "done"]
        stable = max(r["step_share"] for r in done(of) if not failed or r["step_share"] < min(failed))
        words.append(f"{name} at {stable:.2f}" + (f" (not at {min(failed):.2f})" if failed else ""))
    return listed(words)


@mark
def share_scenes():
    return listed(scenes(tried("step_share")))


@mark
def true_limit():
    """Returns the range of the ratio of the true stability limit to the computed step."""
    low, high = verification.computed()
    return f"{1 / high:.2f} to {1 / low:.2f}"


@mark
def gap_zero():
    def change(r):
        return minus(f"{100 * r['model_e_star']:.0f} %") if r["status"] == "done" else "all, it falls apart,"
    return listed(f"{change(r)} ({scene(r)})" for r in where(tried("filter"), gap_max=0.0))


@mark
def area_saved():
    """Returns the fraction of contacts that area_min = 0.026 drops, the time that it saves, and the largest change of
    |E*|."""
    of = study("filter", area_min=0.026)
    base = {scene(r): r for r in study("filter") if r["gap_max"] is None and r["area_min"] is None}
    saved = [1 - r["seconds"] / r["steps"] / (base[scene(r)]["seconds"] / base[scene(r)]["steps"]) for r in of]
    dropped = [1 - r["contacts"] / base[scene(r)]["contacts"] for r in of]
    return (f"{100 * min(dropped):.1f} to {100 * max(dropped):.1f} % of the contacts, {100 * min(saved):.0f} to "
            f"{100 * max(saved):.0f} % of the time and up to {power(upto(largest(of, 'model_e_star')))} of |E\\*|")
