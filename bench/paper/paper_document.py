# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of docs/paper-specimens.md and docs/paper-details.md: our values with the paper's. A value that differs by
more than a tenth is bold and has the letter of its reason in paper_reasons.py; a bold value without a reason is an error."""
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
    out = ["## Composition (Table 3)", "", *wrapped("""The tables give the numbers of particles
        and spheres by sieve class (mm), the mean size, and the share (in %) of the volume of all spheres, ΣV_s. The
        last row is ΣV_s divided by the volume of the box; the paper's value assumes uniform radii of the mastic.
        The shares in the paper are rounded, so here and in the scenes the share of the mastic is 100 % minus
        the shares of the aggregate classes."""), ""]
    for name, paper in PAPER.items():
        def row(label, key, ours, theirs, digits=0, total=False):
            values = [mean(ours(run)[k] for run in runs[name]) for k in range(len(ours(runs[name][0])))]
            row = [label, *[cells.beside(f"composition/{name}/{key}/{CLASSES[k]}", v, theirs[k], digits)
                            for k, v in enumerate(values)]]
            where = f"composition/{name}/{key}/total"
            return row + [cells.beside(where, sum(values), sum(theirs), digits) if total else ""]

        single = [mean(run.single[k] for run in runs[name]) for k in range(4)]
        size = row("mean L^I (mm)", "size", lambda run: run.size, paper.size, 1)
        size.insert(5, f"{2e3 * MASTIC[0]:.1f}–{2e3 * MASTIC[1]:.1f} required ({paper.size[4]:.1f})")
        out += [f"### {name}", "", *table(["", *CLASSES, "total"], [
            row("particles", "particles", lambda run: run.particles, paper.particles, total=True),
            *([["of these single spheres", *[f"{n:,.0f}" for n in single], "–", f"{sum(single):,.0f}"]]
              if paper.radius else []),
            row("spheres", "spheres", lambda run: run.spheres, paper.spheres, total=True),
            size, row("share of ΣV_s (%)", "share", lambda run: run.share, paper.share, 1),
            ["ΣV_s / box", *[""] * len(CLASSES),
             f"{mean(run.to_box for run in runs[name]):.3f} ({paper.to_box:.3f})"]])]
    return out


def design(runs):
    scene, asked = DESIGN
    rows, largest = [], 0
    for k, label in enumerate(CLASSES):
        solid = [sum(run.asked) for run in runs]
        reached = [100 * run.reached[k] / s for run, s in zip(runs, solid)]
        largest = max([largest, *[100 * abs(r / asked[k] - 1) for r in reached]])
        rows.append([label, f"{mean(reached):.2f}", f"{mean(run.particles[k] for run in runs):,.0f}",
                     f"{mean(run.single[k] for run in runs):,.0f}" if k < 4 else "–",
                     f"{mean(run.spheres[k] for run in runs):,.0f}"])
    contacts = [f"{mean(run.contacts[k] for run in runs):,.0f} {pair}" for k, pair in enumerate(PAIRS)]
    
    return ["## Design formulation (Table 3, first column group)", "",
            *wrapped(f"""In the paper the insertion of aggregates does not reach the volume fractions (shares) of
                the mix design. `examples/{scene}` (library shapes, coarse filling, all aggregates packed at once)
                reaches these shares, which are in % of the solid volume, {mean(solid):.2f} of the box. The error of a
                share is at most {largest:.2f} % of the share in {len(runs)} seeds; all other values are means over the
                seeds:"""), "",
            *table(["", "share (%)", "particles", "of these single spheres", "spheres"], rows),
            *wrapped(f"""The numbers of contacts are {', '.join(contacts)} ({mean(run.coordination for run in runs):.2f}
                per particle), and {mean(run.inner for run in runs):,.0f} inner."""), ""]


def contacts(runs, cells):
    heads, out = [*PAIRS, "total", "per particle"], ["## Contacts (Table 5)", ""]
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
            of = [over(runs, name, "SS", value) for value in values[:3]]
            ratios.append([name, *[cells.beside(f"ratio/{name}/{heads[k]}", mean(v), theirs[k] / ss[k], 2,
                                                half_range(v)) for k, v in enumerate(of)]])
    return [*out, *table(["", *heads, "inner"], rows), "Divided by the values of SS with the same seed:", "",
            *table(["", *PAIRS], ratios)]


def orientation(runs):
    least, clusters = 1, []
    for name in CLUSTERS:
        cosines = [a for run in runs[name] for a in run.axes]
        tests = [kolmogorov_smirnov([c[k] for c in cosines]) for k in range(3)]
        least = min(least, *[p for _, p in tests])
        clusters.append(f"{len(cosines):,}")
    n = 3 * len(CLUSTERS)
    return ["## Orientation (Fig. 9)", "",
            *wrapped(f"""In an isotropic distribution every component of the direction of D^L (the longest dimension) is
            uniformly distributed. We compared the three components in the four specimens of clusters
            ({data.listed(clusters)} clusters of all seeds) with this distribution by Kolmogorov–Smirnov tests. Each
            test gives the probability that an isotropic distribution has a larger distance by chance. The smallest of
            these {n} probabilities is {least:.3f}. Among {n} independent
            probabilities, at least one is this small in {100 * (1 - (1 - least) ** n):.0f} % of all cases. The
            directions therefore do not contradict an isotropic distribution."""), "",
            "![Cumulative distribution of the components of the direction of D^L, four specimens; all lie on the diagonal"
            " of the isotropic distribution](pictures/orientation.png)", "",
            *wrapped("""In Figs. 9a and b of the paper a line shows the direction of D^L of each cluster above 4.75 mm,
            without numbers. Our pictures of seed 1 show the same for
            [MS-Poly-fine](pictures/ac14_ms_poly_fine_axes.png) and
            [MS-Poly-coarse](pictures/ac14_ms_poly_coarse_axes.png); each line has the colour of its sieve
            class."""), ""]


def stiffness(runs, cells):
    hz, keys = [f"{f} Hz" for f in FREQUENCIES], (("e_star", "\\|E*\\|", "GPa"), ("phase", "φ", "°"))
    rows = []
    for key, label, unit in keys:
        for name, of in runs.items():
            series = [[getattr(run, key)[k] for run in of] for k in range(len(hz))]
            rows.append([f"{name}, {label} ({unit})", *[f"{mean(s):.3f} ± {half_range(s):.3f}" for s in series]])
    out = ["## Stiffness (Fig. 11)", "",
           "The values are solved in the frequency domain, without inertia, for AM1. All specimens have the same "
           "factors δ.", "", *table(["", *hz], rows),
           "Deviation from SS of the same seed, and its mean over the frequencies (d_m, Eq. 26), with d_m of the paper in "
           "brackets:", ""]

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
    out += ["![Above: stiffness modulus and phase angle over frequency, five specimens. Below: mean deviations from single "
            "spheres, ours and the paper's](pictures/specimens_e_star.png)", "", "### Real shapes and icosahedra", "",
            "Deviation of Ico from Poly. In the paper the results of the two coarse specimens are identical:", ""]
    return out + compared([(f"MS-Ico-{size}", f"MS-Poly-{size}", size, paper) for size, paper in ICO_OVER_POLY.items()],
                          "shape")


def pictures():
    """Returns the section with the cut and the view of one specimen, and links to the other pictures."""
    name, paper = next((n, p) for n, p in PAPER.items() if n == "MS-Poly-fine")
    out = ["## Sections and views (Figs. 7, 8, 10)", "",
           *wrapped(f"""{name}, seed 1: Laguerre cells cut at x = 25 mm, and the aggregates without the mastic. Mastic is
               blue. Aggregates have the colour of their sieve class, and the spheres of one cluster have different
           shades of this colour."""),
           "", line(["x = 25 mm", "aggregates"]), "|---|---|",
           line([f"![Cut through {name}: cells of mastic blue, aggregates by sieve class]"
                 f"(pictures/{paper.scene}_x_0.025.png)",
                 f"![Aggregates of {name} without mastic, coloured by sieve class](pictures/{paper.scene}_view.png)"]), ""]
    others = [f"{n} ([x](pictures/{p.scene}_x_0.025.png), [y](pictures/{p.scene}_y_0.025.png), "
              f"[view](pictures/{p.scene}_view.png))" for n, p in PAPER.items()]
    return out + wrapped("All pictures: " + ", ".join(others) + ".")


def verdict(runs):
    """Returns the opening of the page: its purpose, and how well the paper's results are reproduced."""
    def beside(names, key, index):
        ours = [mean(d[-1] for d in deviations(runs, name, "SS", key)) for name in names]
        theirs = [DEVIATION[name][index] for name in names]
        return minus(f"{data.between(ours, '{:+.0f}')} % (paper {data.between(theirs, '{:+.0f}')} %)")

    coarse, fine = ([n for n in CLUSTERS if n.endswith(size)] for size in ("coarse", "fine"))
    fewer = [100 * (1 - mean(run.contacts[0] for run in runs[n]) / PAPER[n].contacts[0]) for n in CLUSTERS]
    entries = ["""**Reproduced:** the compositions of the single spheres (SS) and of most classes of the clusters; the
            sign and the order of the deviations from single spheres. Clusters are stiffer than single spheres and
            have a smaller φ; both deviations are larger for fine clusters than for coarse ones; and the shape matters
            less than the size of the spheres.""",
               f"""**|E\\*| against SS, not reproduced in size:** coarse clusters {beside(coarse, 'e_star', 0)}, fine
            clusters {beside(fine, 'e_star', 0)}.""",
               f"""**φ against SS, not reproduced in size:** coarse clusters {beside(coarse, 'phase', 1)}, fine clusters
            {beside(fine, 'phase', 1)}.""",
               f"""**Contacts between aggregates:** the clusters have {data.between(fewer, '{:.0f}')} % fewer of these
               contacts than the clusters in the paper.""",
               """**Most probable cause of the differences:** choices that the paper does not state, above all
               the porosity of the clusters and the test that keeps clusters apart when they are placed
               ([details](paper-details.md#choices-that-the-paper-does-not-state)).""",
               """**Not compared:** measured moduli, because they are not in the paper."""]
    return ["# The paper's specimens", "",
            *wrapped(f"""We generated and solved the specimens of the published study ("the paper",
            [[1]](model.md#source)) with Macadam. This page compares the results with Table 5 and Figs. 7 to 13 of the
            paper. [Details](paper-details.md) compares them with Tables 3 and 4 and Figs. 4, 6c and 9, and gives the
            reasons of the differences. [Shapes of aggregates](shapes.md) and [Filling shapes](filling.md) are about
            Tables 1 and 2 and Figs. 5 and 6a, b, d."""),
            "",
            *[row for e in entries for row in wrapped(e, "- ")], "",
            *wrapped(f"""SS is the specimen of single spheres. MS are specimens of clusters ("multi-spheres") of real
                shapes (Poly) or icosahedra (Ico), filled with coarse or fine spheres. In the tables the value of
                Macadam ("ours") is first, and the value of the paper is in brackets. Our values are means of
                {len(runs['SS'])} seeds; ± is half the range over the seeds. If the two values differ by more than
                10 %, the cell is bold, and a letter names [the reason](paper-details.md#reasons-of-the-differences).
                The scenes are `examples/ac14_ss_am1` and `examples/ac14_ms_*`. `bench/paper/paper` computes the
                results."""), ""]


def details_head():
    return ["# The paper's specimens: details", "",
            *wrapped("""This page is for reviewers of the [comparison with the paper](paper-specimens.md), which
                explains the notation and the values in brackets. It has the tables of composition, the other figures,
                the origin of the contacts' moduli, the reasons of the differences, and a study of the choices that
                the paper does not state."""), ""]
