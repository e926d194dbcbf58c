# SPDX-License-Identifier: GPL-3.0-or-later
"""Sections of docs/paper-specimens.md and docs/paper-details.md except the five specimens at the same delta: the
shapes' figures, the calibrated specimens (Figs. 12 and 13), and specimens stepped in time."""
import math

from paper_data import RESULTS, between, half_range, mean, minus, rows, span, thousands, upto, where
from paper_document import table, wrapped
from paper_runs import committed
from paper_tables import CALIBRATED, DELTA_MA, DEVIATION, FREQUENCIES, PAPER

INDEXES = {"flatness": "F", "elongation": "E", "sphericity_true": "ψ^w", "sphericity_working": "ψ^A"}


def correlation(x, y):
    """Returns Pearson's correlation coefficient."""
    dx, dy = ([v - mean(of) for v in of] for of in (x, y))
    return sum(a * b for a, b in zip(dx, dy)) / math.sqrt(sum(a * a for a in dx) * sum(b * b for b in dy))


def numbers_of_spheres():
    """Returns the table for Fig. 6c: correlation of the shapes' indices with the number of spheres of 0.5 mm in shapes
    with the same D^I."""
    found = where(rows("fill-study.csv"), radius_min_mm=0.5, radius_max_mm=0.5, seed=1.0)
    
    n = [r["spheres"] for r in found]
    r = {label: correlation(n, [row[key] for row in found]) for key, label in INDEXES.items()}
    stones = [row for row in found if row["shape"] != "icosahedron"]
    alone = {label: correlation([s["spheres"] for s in stones], [s[key] for s in stones])
             for key, label in INDEXES.items()}
    lines = [[f"all {len(found)} shapes", *[minus(f"{v:+.2f}") for v in r.values()]],
             ["without the icosahedron", *[minus(f"{v:+.2f}") for v in alone.values()]]]
    return ["## Spheres against shape (Fig. 6c)", "",
            *wrapped(f"""The table has the correlation of the shape indices (Eqs. 18–23)
        with the number of spheres of 0.5 mm radius that fill a shape with D^I = 12.59 mm, for {len(found)} shapes with
        {span((r["spheres"] for r in found), thousands, " to ")} spheres. The paper states that no index is strongly correlated with the number, but gives no coefficients. A
        coefficient is significant (5 %, two-sided) if its size is at least 0.75 for {len(found)} shapes, or 0.81 for
        {len(found) - 1} ([fill-study.csv](../bench/results/fill-study.csv); [filling.md](filling.md)):"""), "",
            *table(["correlation", *INDEXES.values()], lines)]


def gradation():
    return ["## Gradation (Fig. 4)", "",
            *wrapped("""Fig. 4 of the paper shows, without numbers, the gradation of the AC 20 whose aggregates were
                scanned. The picture shows our AC 20, `examples/ac20_recipe`, on a Fuller curve. The mix design of the
                AC 14, which the paper gives by mass, is used in [mix-design.md](mix-design.md)."""), "",
            "![Passing mass over sieve size of AC 20, required and reached](pictures/gradation_ac20.png)", ""]


# ---- Figs. 12 and 13

def am2_single_spheres():
    runs = committed("ac14_ss_am2")
    lines = [[label, *[f"{mean(s):.3f} ± {half_range(s):.3f}" for s in zip(*[getattr(run, key) for run in runs])]]
             for key, label in (("e_star", "\\|E*\\| (GPa)"), ("phase", "φ (°)"))]
    return ["Single spheres of AM2, with the paper's δ_MA of 6.75:", "",
            *table(["", *[f"{hz} Hz" for hz in FREQUENCIES]], lines)]


def of_mix(found, mix, figure):
    lines = []
    for name in (n for n in DELTA_MA[mix] if n != "SS"):
        of = where(found, mix=mix, specimen=name)
        delta = [r["delta_ma"] for r in of]
        cells = [name, f"{mean(delta):.2f} ± {half_range(delta):.2f} ({DELTA_MA[mix][name]:.2f})"]
        for key in ("e_star_pa", "phase_deg"):
            d = [[100 * (r[f"{key}_{hz}"] / r[f"ss_{key}_{hz}"] - 1) for hz in FREQUENCIES] for r in of]
            each = [mean(v) for v in zip(*d)]
            if key == "phase_deg":  # the mean deviation of |E*| is zero, because |E*| is fitted
                cells.append(minus(f"{mean(map(mean, d)):+.1f} ± {half_range(map(mean, d)):.1f}"))
            cells.append(minus(f"{each[0]:+.0f} … {each[-1]:+.0f}"))
        lines.append(cells)
    e, phi = CALIBRATED[mix]
    return [f"### {mix} (Fig. {figure})", "",
            *table(["", "δ_MA (paper)", "\\|E*\\| (%), 2 … 20 Hz", "d_m of φ (%)", "φ (%), 2 … 20 Hz"], lines),
            *wrapped(f"""Because |E\\*| is fitted, its mean deviation d_m is 0. In the paper d_m of |E\\*| is {e} %, and
                d_m of φ is between {minus(f'{phi[0]:+d}')} and {phi[1]:+d} %, depending on the specimen."""), ""]


def calibrated():
    out = ["## Calibrated to the single spheres (Figs. 12 and 13)", "",
           *wrapped("""For each specimen of clusters, δ_MA is fitted to |E\\*| of the single spheres, by least squares
               over the four frequencies; φ is not fitted (`bench/paper/paper-deltas`)."""), "", *am2_single_spheres()]
    if not (RESULTS / "paper-deltas.csv").is_file():
        return out + ["Run `bench/paper/paper-deltas` to make Figs. 12 and 13.", ""]
    found = rows("paper-deltas.csv")
    return out + of_mix(found, "AM1", 12) + of_mix(found, "AM2", 13) + why_less(found)


def stiffer(name):
    """Returns the ratio of |E*| to that of the single spheres at the same delta, averaged over seeds and
    frequencies."""
    return mean(a / b for run, ss in zip(committed(PAPER[name].scene), committed(PAPER["SS"].scene))
                for a, b in zip(run.e_star, ss.e_star))


def why_less(found):
    """Returns the sentences on what our delta and the paper's imply for the contribution of M-A contacts to |E*|."""
    own, papers = [], []
    for name, (percent, _) in DEVIATION.items():
        delta = mean(r["delta_ma"] for r in where(found, mix="AM1", specimen=name))
        own.append(math.log(stiffer(name)) / math.log(DELTA_MA["AM1"]["SS"] / delta))
        papers.append(math.log(1 + percent / 100) / math.log(DELTA_MA["AM1"]["SS"] / DELTA_MA["AM1"][name]))
    return wrapped(f"""Our calibrated δ_MA are larger than the paper's, although our fine clusters are stiffer, so that
        their calibration must reduce |E\\*| by more. To explain this, assume that |E\\*| is proportional to δ_MA^n.
        The stiffness with δ_MA = 3.15 (Fig. 11) and the calibrated δ_MA then give n: {between(own, "{:.2f}")} here and
        {between(papers, "{:.2f}")} in the paper (AM1). n is the fraction of the stiffness that M-A contacts carry.
        In the paper's specimens, therefore, less force passes through M-A contacts and more through A-A contacts, in
        agreement with the larger number of A-A contacts in the paper (ᶠ). This explanation is *inferred*.""") + [""]


# ---- stepped in time

PAPERS_DAYS = (5, 40)  # days that MS-Poly-fine took in the paper at 20 and at 2 Hz, on one core of an i9-10900KF


def stepped():
    if not (RESULTS / "paper-stepped.csv").is_file():
        return []
    found = rows("paper-stepped.csv")
    lines = [[r["specimen"], f"{r['frequency_hz']:g}", f"{r['steps'] / 1e6:.2f}", f"{r['us_per_step']:.1f}", f"{r['stepping_s']:.0f}", f"{r['e_star_pa'] / 1e9:.4f}",
              minus(f"{1e9 * r['off_e_star']:+.0f}"), f"{r['phase_deg']:.3f}",
              minus(f"{1e9 * r['off_phase_rad']:+.0f}")] for r in found]
    off = upto(max(abs(r[k]) for r in found for k in ("off_e_star", "off_phase_rad")), 2)
    
    poly = {r["frequency_hz"]: r["stepping_s"] for r in found if r["specimen"] == "MS-Poly-fine"}
    faster = [86400 * days / poly[hz] for hz, days in zip((20.0, 2.0), PAPERS_DAYS) if hz in poly]
    out = ["## Stepped in time, at true mass", "",
           *wrapped(f"""One cycle was stepped from the steady start, in mixed precision and without density scaling. The
               results differ from the frequency domain without inertia, which all other tables use, by at most
               {off:.1e} ([results](../bench/results/paper-stepped.csv) of `bench/paper/paper-stepped`):"""), "",
           *table(["", "f (Hz)", "10⁶ steps", "µs per step", "seconds", "\\|E*\\| (GPa)", "difference (10⁻⁹)",
                   "φ (°)", "difference (10⁻⁹ rad)"], lines)]
    text = f"""In the paper the stepped runs of MS-Poly-fine took {PAPERS_DAYS[0]} days (20 Hz) to {PAPERS_DAYS[1]} days
        (2 Hz) on one core of an i9-10900KF; the paper does not state the number of cycles. The file of the results
        names Macadam's version and the GPU; a time step has become faster since then
        ([benchmarks](../bench/README.md))."""
    if faster:
        text += f""" Of MS-Poly-fine it is {span(faster, lambda x: thousands(round(x, -2)), ' to ')} times faster, if the
            paper's were one cycle too, by the machine, the precision and the condensed contacts together."""
    return out + [*wrapped(text), ""]
