# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of docs/paper-specimens.md: our values beside those of the paper. A value that differs by more than a tenth is
bold and has the letter of its reason in paper_reasons.py; a bold value without a reason is an error."""
import textwrap
from fnmatch import fnmatchcase

import paper_data as data
from paper_data import half_range, line, mean, minus
from paper_runs import kolmogorov_smirnov
from paper_tables import (CLASSES, CLUSTERS, DESIGN, DEVIATION, FREQUENCIES, ICO_OVER_POLY, MASTIC, PAIRS, PAPER)


class Cells:
    """Makes cells with our value and the paper's, and collects the reasons that bold cells need."""

    def __init__(self, reasons):
        self.reasons, self.used, self.unexplained = reasons, [], []

    # Returns our value with the paper's in brackets. If they differ by more than 10 %, the cell is bold and has the
    # letter of its reason; key: name of the cell, which the patterns of the reasons match.
    def beside(self, key, ours, paper, digits, spread=None, percent=False):
        sign = "+" if percent else ""
        text = f"{ours:{sign},.{digits}f}" + ("" if spread is None else f" ± {spread:,.{digits}f}")
        text += f" ({paper:+g})" if percent and paper else f" ({paper:,.{digits}f})" if paper else " (≈ 0)"
        if abs(ours - paper) <= 0.1 * abs(paper):
            return minus(text)
        key += "/less" if ours < paper else "/more"
        for letter, patterns, _ in self.reasons:
            if any(fnmatchcase(key, pattern) for pattern in patterns):
                if letter not in self.used:
                    self.used.append(letter)
                return f"**{minus(text)}** {letter}"
        self.unexplained.append(key)
        return f"**{minus(text)}**"

    # Exits with a list of the bold cells that have no reason.
    def check(self):
        if self.unexplained:
            raise SystemExit("more than 10 % off the paper and no reason in bench/paper/paper_reasons.py:\n  "
                             + "\n  ".join(self.unexplained))


def wrapped(text, indent=""):
    """Returns a paragraph, or an entry of a list, in lines of at most 120 columns."""
    return textwrap.wrap(minus(" ".join(text.split())), 120, initial_indent=indent, subsequent_indent=" " * len(indent),
                         break_long_words=False, break_on_hyphens=False)


def table(head, rows):
    return [*data.table(head, rows, range(1, len(head))), ""]


def over(runs, name, base, value):
    """Returns the ratio of a value to the value of another specimen, for each seed."""
    return [value(a) / value(b) for a, b in zip(runs[name], runs[base])]


def deviations(runs, name, base, key):
    """Returns the deviations from another specimen in %, at each frequency and their mean (Eq. 26), for each seed."""
    result = []
    for a, b in zip(runs[name], runs[base]):
        d = [100 * (x / y - 1) for x, y in zip(getattr(a, key), getattr(b, key))]
        result.append([*d, mean(d)])
    return result


def composition(runs, cells):
    out = ["## Composition (Table 3)", ""]
    for name, paper in PAPER.items():
        def row(label, key, ours, theirs, digits=0, total=False):
            values = [mean(ours(run)[k] for run in runs[name]) for k in range(len(ours(runs[name][0])))]
            row = [label, *[cells.beside(f"composition/{name}/{key}/{CLASSES[k]}", v, theirs[k], digits)
                            for k, v in enumerate(values)]]
            where = f"composition/{name}/{key}/total"
            return row + [cells.beside(where, sum(values), sum(theirs), digits) if total else ""]

        single = [mean(run.single[k] for run in runs[name]) for k in range(4)]
        size = row("mean L^I (mm)", "size", lambda run: run.size, paper.size, 1)
        size.insert(5, f"{2e3 * MASTIC[0]:.1f}–{2e3 * MASTIC[1]:.1f} asked ({paper.size[4]:.1f})")
        out += [f"### {name}", "", *table(["", *CLASSES, "total"], [
            row("particles", "particles", lambda run: run.particles, paper.particles, total=True),
            *([["of these single spheres", *[f"{n:,.0f}" for n in single], "–", f"{sum(single):,.0f}"]]
              if paper.radius else []),
            row("spheres", "spheres", lambda run: run.spheres, paper.spheres, total=True),
            size, row("share of ΣV_s (%)", "share", lambda run: run.share, paper.share, 1)])]
        out += [*wrapped(f"""ΣV_s is {mean(run.to_box for run in runs[name]):.3f} of the box; the paper's is
            {paper.to_box:.3f} if its mastic has uniform radii."""), ""]
    return out + ["The paper's shares are rounded: here and in the scenes, mastic has what the aggregates leave.", ""]


def design(runs):
    scene, asked = DESIGN
    rows = []
    for k, label in enumerate(CLASSES):
        solid = [sum(run.asked) for run in runs]
        reached = [100 * run.reached[k] / s for run, s in zip(runs, solid)]
        rows.append([label, f"{asked[k]:.1f}", f"{mean(reached):.2f}",
                     f"{100 * max(abs(r / asked[k] - 1) for r in reached):.2f}",
                     f"{mean(run.particles[k] for run in runs):,.0f}",
                     f"{mean(run.single[k] for run in runs):,.0f}" if k < 4 else "–",
                     f"{mean(run.spheres[k] for run in runs):,.0f}"])
    contacts = [f"{mean(run.contacts[k] for run in runs):,.0f} {pair}" for k, pair in enumerate(PAIRS)]
    seconds = sorted(run.seconds for run in runs)
    return ["## Design formulation (Table 3, first column group)", "",
            *wrapped(f"""The paper's insertion stops short of the shares that the mixture was designed with, and the
                paper says no more of a specimen that has them. `examples/{scene}` (library shapes, coarse filling, all
                packed at once) asks for them, in % of the solid volume, {mean(solid):.2f} of the box. Means of
                {len(runs)} seeds, and the largest error of a seed:"""), "",
            *table(["", "asked (%)", "reached (%)", "error (% of the class)", "particles", "of these single spheres",
                    "spheres"], rows),
            *wrapped(f"""Contacts: {', '.join(contacts)}, {mean(run.coordination for run in runs):.2f} a particle, and
                {mean(run.inner for run in runs):,.0f} inner ones. Made in {seconds[0]:.0f} to {seconds[-1]:.0f} s by
                `macadam specimen` with {runs[0].threads} threads, other runs beside it."""), ""]


def contacts(runs, cells):
    heads, out = [*PAIRS, "total", "a particle"], ["## Contacts (Table 5)", ""]
    values = [lambda run, k=k: run.contacts[k] for k in range(4)] + [lambda run: run.coordination]
    rows, ratios = [], []
    for name, paper in PAPER.items():
        theirs = [*paper.contacts, paper.coordination]
        of = [[value(run) for run in runs[name]] for value in values]
        rows.append([name, *[cells.beside(f"contacts/{name}/{head}", mean(v), t, 2 * (head == heads[4]), half_range(v))
                             for head, v, t in zip(heads, of, theirs)],
                     f"{mean(run.inner for run in runs[name]):,.0f}"])
        if name != "SS":
            ss = [*PAPER["SS"].contacts, PAPER["SS"].coordination]
            of = [over(runs, name, "SS", value) for value in values]
            ratios.append([name, *[cells.beside(f"ratio/{name}/{heads[k]}", mean(v), theirs[k] / ss[k], 2,
                                                half_range(v)) for k, v in enumerate(of)]])
    return out + table(["", *heads, "inner"], rows) + ["Over SS, seed by seed:", ""] + table(["", *heads], ratios)


def orientation(runs):
    rows, least = [], 1
    for name in CLUSTERS:
        cosines = [a for run in runs[name] for a in run.axes]
        tests = [kolmogorov_smirnov([c[k] for c in cosines]) for k in range(3)]
        least = min(least, *[p for _, p in tests])
        rows.append([name, f"{len(cosines):,}", *[f"{d:.3f}, p = {p:.2f}" for d, p in tests]])
    n = 3 * len(CLUSTERS)
    return ["## Orientation (Fig. 9)", "",
            "Direction of D^L of the clusters: distance of each component's distribution from the isotropic one, which",
            "is uniform, and the probability of a larger one by chance (Kolmogorov–Smirnov, all seeds together).", "",
            *table(["", "clusters", "x", "y", "z"], rows),
            *wrapped(f"""The smallest of these {n} probabilities is {least:.3f}; the smallest of {n} independent ones is
                as small by chance in {100 * (1 - (1 - least) ** n):.0f} % of cases."""), "",
            "![Cumulative orientation](pictures/orientation.png)", ""]


def stiffness(runs, cells):
    hz, keys = [f"{f} Hz" for f in FREQUENCIES], (("e_star", "\\|E*\\|", "GPa"), ("phase", "φ", "°"))
    rows = []
    for key, label, unit in keys:
        for name, of in runs.items():
            series = [[getattr(run, key)[k] for run in of] for k in range(len(hz))]
            rows.append([f"{name}, {label} ({unit})", *[f"{mean(s):.3f} ± {half_range(s):.3f}" for s in series]])
    out = ["## Stiffness (Fig. 11)", "",
           "Frequency domain, without inertia, AM1 with the same δ everywhere.", "", *table(["", *hz], rows),
           "Deviation from SS, seed by seed, and its mean over the frequencies (d_m, Eq. 26), beside the paper's:", ""]

    def compared(pairs, where):
        rows = []
        for i, (key, label, _) in enumerate(keys):
            for name, base, title, paper in pairs:
                d = list(zip(*deviations(runs, name, base, key)))
                rows.append([f"{title}, {label} (%)", *[minus(f"{mean(v):+.1f} ± {half_range(v):.1f}") for v in d[:-1]],
                             cells.beside(f"{where}/{title}/{key}", mean(d[-1]), paper[i], 1,
                                          half_range(d[-1]), True)])
        return table(["", *hz, "d_m"], rows)

    out += compared([(name, "SS", name, DEVIATION[name]) for name in CLUSTERS], "deviation")
    out += ["![Stiffness modulus and phase angle](pictures/specimens_e_star.png)", "", "### Poly against Ico", "",
            "Deviation of Ico from Poly; the paper calls the coarse ones identical:", ""]
    return out + compared([(f"MS-Ico-{size}", f"MS-Poly-{size}", size, paper) for size, paper in ICO_OVER_POLY.items()],
                          "shape")


def pictures():
    out = ["## Sections and views (Figs. 7, 8, 10)", "",
           *wrapped(f"""Laguerre cells cut exactly at x = 25 mm and y = 25 mm, and the aggregates without the mastic;
               seed 1. Mastic is blue; aggregates have the colour of their sieve class, and the spheres of a cluster
               shades of it."""), ""]
    for name, paper in PAPER.items():
        files = [f"![](pictures/{paper.scene}_{view}.png)" for view in ("x_0.025", "y_0.025", "view")]
        out += [line([f"{name}, x = 25 mm", "y = 25 mm", "aggregates"]), "|---|---|---|", line(files), ""]
    return out


def head(runs):
    return ["# The paper, and ours beside it", "",
            *wrapped(f"""Every table and figure of [the paper](model.md#source) that has specimens in it. Made by
                `scripts/documents` of what `bench/paper/paper` leaves in [bench/results](../bench/results); do not edit. Ours, and the paper's in
                brackets; where the two differ by more than 10 % the cell is bold, and its letter stands for the reason
                [below](#what-differs-and-why). Means of {len(runs['SS'])} seeds; ± is half the range over the seeds,
                everywhere. Scenes: `examples/ac14_ss_am1` and `examples/ac14_ms_*`. Figures without numbers in the
                paper's text are drawn for ours alone. Tables 1 and 2 and Figs. 5 and 6a, b, d are in
                [shapes.md](shapes.md) and [filling.md](filling.md)."""), ""]
