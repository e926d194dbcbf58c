# SPDX-License-Identifier: GPL-3.0-or-later
"""Sections of docs/paper-details.md: why our values differ, and the effect of the fillings."""
from paper_data import mean, minus
from paper_document import deviations, table, wrapped
from paper_reasons import REASONS, Facts, several
from paper_tables import CLUSTERS, FREQUENCIES, PAPER

FILLINGS = ("coarse", "fine")


def two(value):
    return minus(f"{round(value, 2) + 0:.2f}")  # adding 0 turns −0.00 into 0.00


def reasons(facts, letters):
    out = ["## Reasons of the differences", "",
           *wrapped("""Each letter belongs to bold cells on this page or in [the comparison](paper-specimens.md).
           *Inferred* means that numbers support the reason but do not prove it."""), ""]
    for letter, _, reason in REASONS:
        out += wrapped(f"{letter} {reason(facts)}", "- ") if letter in letters else []
    at = {key: [mean(d[k] for d in deviations(facts.runs, "MS-Ico-fine", "SS", key)) for k in (0, -2)]
          for key in ("e_star", "phase")}
    return out + ["", *wrapped(
        f"""With rising frequency, our deviation in |E\\*| falls (Ico-fine {at['e_star'][0]:+.0f} % at
            {FREQUENCIES[0]} Hz, {at['e_star'][1]:+.0f} % at {FREQUENCIES[-1]} Hz), and the deviation in φ grows in size
            ({at['phase'][0]:+.0f} to {at['phase'][1]:+.0f} %). The paper states both that the deviation in |E\\*|
            grows with the frequency and that it is largest at the lowest frequency."""), ""]


def implied_voids(facts):
    rows = []
    for name in CLUSTERS:
        v = facts.void(name, [0, 1, 2])
        # if a class has many single spheres, the mean radius of its spheres differs from the mean radius in clusters
        by_spheres = all(facts.of(name, "single", k) < 0.1 * facts.of(name, "particles", k) for k in range(3))
        rows.append([name[3:], two(v.ratio), two(v.size), two(1 - 1 / v.ratio), two(v.chance), two(v.number),
                     two(v.spheres) if by_spheres else "–", two(PAPER[name].void_of_mastic)])
    return table(["", "number, paper / ours", "explained by sizes", "void, from the number", "standard deviation",
                  "void, sizes considered", "void, from the spheres", "void, from the mastic"], rows)


def hints(facts):
    """Returns the list of three estimates of the voids in the paper's clusters. Each says from which numbers of the
    paper it follows, and on what assumptions it rests."""
    ss, rest = PAPER["SS"], "This estimate rests on"
    budget = {r: [PAPER[f"MS-{s}-{r}"].void_of_mastic for s in ("Poly", "Ico")] for r in FILLINGS}
    ico, poly = ([facts.void(f"MS-{s}-{r}", [0, 1, 2]) for r in FILLINGS] for s in ("Ico", "Poly"))
    spheres = [facts.void("MS-Ico-coarse", [0, 1]).spheres, ico[1].spheres]
    apart = max(abs(v.number - budget[r][1]) for v, r in zip(ico, FILLINGS))
    entries = [
        f"""*From the mastic.* In SS mastic and aggregates together take {ss.to_box:.3f} of the volume of the box. If
            the paper filled its cluster specimens with mastic to the same sum, the shapes have voids of
            {several(budget['coarse'])} (Poly and Ico, coarse) and {several(budget['fine'])} (fine). {rest} the equal
            sum, and on mastic radii uniform in 0.75–1 mm.""",
        f"""*Estimate from the number of aggregates*, at the same share of aggregates: the fraction of voids in the
            clusters of Ico is {several(v.number for v in ico)} (coarse and fine) if the size of each aggregate is used.
            With one mean size it is {several(1 - 1 / v.ratio for v in ico)}. The standard deviation in the table follows from the small number
            of sizes. {rest} shapes like ours. It is therefore useful for Ico, whose shape is known, but not for Poly,
            for which it gives voids of {several(v.number for v in poly)}. A negative void means that the paper's
            shapes have more volume than our shapes at the same D^I.""",
        f"""*From the spheres of an aggregate*: the clusters of Ico have voids of {several(spheres)} (coarse and fine;
            coarse without the class with many single spheres), which is near zero
            ([filling.md](filling.md#spheres-against-radius)). {rest} uniform radii, and the
            coarse radii are not uniform (ᶜ)."""]
    return [row for e in entries for row in wrapped(e, "- ")] + ["", *wrapped(
        f"""The estimates from the mastic and from the number of aggregates are nearly independent, because they have
        only ΣV_s in common. For Ico these two estimates differ by {apart:.2f} at most. The
        estimate from the spheres disagrees with both of them."""), ""]


def fillings(facts):
    return ["## Porosity of the clusters", "",
            *wrapped("""The porosity (void) of a cluster is 1 − (sum of the volumes of its spheres) / (volume of its
                shape). Our clusters have [porosity 0](filling.md#porosity-0). The paper does not state the porosity
                of its clusters, but it can be estimated in three ways:"""), "",
            *hints(facts), *implied_voids(facts)]


def prose(runs, table_of_variants):
    facts = Facts(runs, table_of_variants)
    
    return lambda letters: reasons(facts, letters) + fillings(facts)
