# SPDX-License-Identifier: GPL-3.0-or-later
"""The section of docs/paper-details.md on the choices that the paper does not state, from
bench/results/paper-study.csv."""
import math

from paper_data import RESULTS, listed, mean, minus
from paper_document import table, wrapped
from paper_runs import rows
from paper_study import (CONTACT_SCALE, DEVIATION_SCALE, NARROW, OURS, QUANTITIES, SHORT, Choice, merits,
                         porosity)
from paper_tables import CLUSTERS, DEVIATION, PAPER

SHOWN = 4  # number of best sets in the table


def studied():
    """Returns the sets of the study, the best first; empty if the study was not run yet."""
    file = RESULTS / "paper-study.csv"
    return merits(rows(file)) if file.is_file() else []


def single(choice):
    """Whether a set differs from ours in at most one choice."""
    return sum(getattr(choice, key) != value for key, value in vars(OURS).items()) <= 1


def off(of):
    """Returns the misfit of each quantity, as the root mean square over the specimens. The misfit of a number of
    contacts is in per cent, the misfit of a deviation in percentage points."""
    scales = [100 * CONTACT_SCALE] * 4 + [DEVIATION_SCALE] * 2
    return [s * math.sqrt(mean(of[n].misfits[k] ** 2 for n in CLUSTERS)) for k, s in enumerate(scales)]


def ranking(found):
    lines = [[f"{merit:.1f}", choice.label, *[f"{v:.1f}" for v in off(of)]] for merit, choice, of in found]
    return table(["merit", "", *[q.replace("|", "\\|") + (" (points)" if q in QUANTITIES[4:] else " (%)")
                                 for q in QUANTITIES]], lines)


def detail(title, of):
    lines = []
    for name in CLUSTERS:
        paper, ss, j = PAPER[name], PAPER["SS"], of[name]
        ratios = [f"{r:.2f} ({a / b:.2f})" for r, a, b in zip(j.ratios, paper.contacts, ss.contacts)]
        lines.append([name, *ratios, *[minus(f"{d:+.0f} ({p:+d})") for d, p in zip(j.deviations, DEVIATION[name])]])
    return [*wrapped(f"{title}; the values of the paper are in brackets:"), "",
            *table(["divided by SS", *QUANTITIES[:4], "\\|E*\\| (%)", "φ (%)"], lines)]


def choices():
    voids = listed([f"{porosity(n, Choice(voids=1)):.2f} ({n[3:]})" for n in CLUSTERS])
    entries = [
        f"""*voids*: porosity of the clusters, [estimated from the mastic](#porosity-of-the-clusters): {voids}; *voids
            × 1.3* is 1.3 times this porosity.""",
        """*tested by spheres*: insertion keeps the spheres of two clusters apart (`test = "spheres"`), not their
            surfaces.""",
        """*inner gap g*: spheres of one cluster are joined only if the gap between them is at most g times their mean
            radius (`gap_max` of the pair `inner`); a negative gap is an overlap.""",
        """*hold-out k*: while the mastic relaxes, the surfaces of the aggregates push it out, with k times the
            stiffness of a sphere (`hold_out`).""",
        f"""*narrow radii*: coarse spheres of {1e3 * NARROW[0]:.2f}–{1e3 * NARROW[1]:.2f} mm, which have the mean volume
            of the paper's spheres (ᶜ).""",
        "*spacing*: least distance between two aggregates when they are placed, also in SS.",
        "*area_min*: facets with an area below this fraction of the mean area are not contacts, also in SS.",
        """*library aggregates and icosahedron*: the icosahedron as the 83rd shape of Poly, as in the paper;
            *composition of Ico*: the shares of Ico in Table 3, used for Poly.""",
        "*inner moduli × 0.5*: the paper states these moduli; the factor shows the effect of softer clusters."]
    return [line for entry in entries for line in wrapped(entry, "- ")]


def section():
    found = studied()
    if not found:
        return []
    
    merit, best, of = found[0]
    return ["## Choices that the paper does not state", "",
            *wrapped(f"""`bench/paper/paper_variants` varies the following choices, alone and together, in all four
                specimens of clusters ([paper-study.csv](../bench/results/paper-study.csv); seed 1, {SHORT[0]} and
                {SHORT[1]} Hz):"""), "", *choices(), "",
            *wrapped(f"""The merit of a set is the root mean square, over the four specimens, of six differences
                (misfits) from the paper: the numbers of contacts A-A, M-A, M-M and total, divided by the numbers of
                SS, each in units of {100 * CONTACT_SCALE:.0f} %, and d_m of |E\\*| and φ in units of
                {DEVIATION_SCALE:.0f} percentage points. A lower merit is better. With another seed d_m changes by about 1
                percentage point and the number of A-A contacts by up to 4 %, so two sets with merits below 1 cannot be distinguished.
                The other columns are the root mean squares of the single misfits. In the first table one choice at a
                time is changed:"""), "",
            *ranking([f for f in found if single(f[1])]), f"The best {SHOWN} of {len(found)} sets:", "",
            *ranking(found[:SHOWN]), *detail(f"The best set is {best.label} (merit {merit:.1f})", of)]
