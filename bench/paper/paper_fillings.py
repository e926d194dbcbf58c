# SPDX-License-Identifier: GPL-3.0-or-later
"""The sections after the tables of docs/paper-specimens.md: why our values differ, the effect of the fillings, and the
run times."""
from paper_data import mean, memory, minus
from paper_document import deviations, table, wrapped
from paper_reasons import REASONS, Facts, several
from paper_tables import CLASSES, CLUSTERS, FREQUENCIES, PAPER

FILLINGS = ("coarse", "fine")


def two(value):
    return minus(f"{round(value, 2) + 0:.2f}")  # adding 0 turns −0.00 into 0.00


def reasons(facts, letters):
    out = ["## What differs, and why", "",
           *wrapped("""As in the paper, clusters are stiffer and less viscous than single spheres, fine ones more than
               coarse ones, and shape matters less than the size of the spheres. The bold cells:"""), ""]
    for letter, _, reason in REASONS:
        out += wrapped(f"{letter} {reason(facts)}", "- ") if letter in letters else []
    at = {key: [mean(d[k] for d in deviations(facts.runs, "MS-Ico-fine", "SS", key)) for k in (0, -2)]
          for key in ("e_star", "phase")}
    return out + ["", *wrapped(
        f"""With the frequency, the deviation in |E\\*| falls here (Ico-fine {at['e_star'][0]:+.0f} % at
            {FREQUENCIES[0]} Hz, {at['e_star'][1]:+.0f} % at {FREQUENCIES[-1]} Hz), and the one in φ grows in size
            ({at['phase'][0]:+.0f} to {at['phase'][1]:+.0f} %). The paper says of |E\\*| both that its deviation grows
            with the frequency and that it is largest at the lowest. Only the second can be with φ lower everywhere: φ
            is roughly 90° times the slope of ln |E\\*| over ln f, so that a lower φ is a flatter curve."""), ""]


def implied_voids(facts):
    rows = []
    for name in CLUSTERS:
        for classes in ([0], [1], [2], [0, 1, 2]):
            v, together = facts.void(name, classes), len(classes) == 3
            # if a class has many single spheres, the mean radius of its spheres differs from the mean radius in clusters
            by_spheres = all(facts.of(name, "single", k) < 0.1 * facts.of(name, "particles", k) for k in classes)
            rows.append([f"{name[3:]}, {'together' if together else CLASSES[classes[0]]}", two(v.ratio), two(v.size),
                         two(1 - 1 / v.ratio), two(v.chance), two(v.number),
                         two(v.spheres) if by_spheres else "–", two(PAPER[name].void_of_mastic) if together else ""])
    return table(["", "paper's number over ours", "its sizes give", "void, from the number", "chance",
                  "… its sizes considered", "… from the spheres", "… from the mastic"], rows)


def hints(facts):
    """Returns the list of hints at the void in the paper's clusters that follow from its numbers, each with its
    basis."""
    ss, rest = PAPER["SS"], "This rests on"
    budget = {r: [PAPER[f"MS-{s}-{r}"].void_of_mastic for s in ("Poly", "Ico")] for r in FILLINGS}
    ico, poly = ([facts.void(f"MS-{s}-{r}", [0, 1, 2]) for r in FILLINGS] for s in ("Ico", "Poly"))
    spheres = [facts.void("MS-Ico-coarse", [0, 1]).spheres, ico[1].spheres]
    apart = max(abs(v.number - budget[r][1]) for v, r in zip(ico, FILLINGS))
    entries = [
        f"""*From the mastic.* In SS mastic has {ss.volume(4):.3f} of the box and aggregates
            {ss.to_box - ss.volume(4):.3f}, {ss.to_box:.3f} in all. If a specimen of clusters was given mastic for the
            rest of the same sum, the shapes have room for voids of {several(budget['coarse'])} (Poly and Ico, coarse)
            and {several(budget['fine'])} (fine). {rest} that sum, and on mastic radii uniform in 0.75–1 mm.""",
        f"""*From the number of aggregates* at the same share: {several(v.number for v in ico)} in Ico (coarse and
            fine), sizes considered, {several(1 - 1 / v.ratio for v in ico)} if not; chance, the standard deviation of
            so few sizes, is given. {rest} shapes like ours, so that Ico, whose shape is known, tells, and Poly
            ({several(v.number for v in poly)}) does not: a negative void would mean that the paper's shapes have more
            volume than ours at one D^I.""",
        f"""*From the spheres of an aggregate*: {several(spheres)} in Ico (coarse without the class of many single
            spheres), near zero ([filling.md](filling.md#spheres-against-radius)). {rest} radii uniform in their range,
            and the coarse ones are not (ᶜ)."""]
    return [row for e in entries for row in wrapped(e, "- ")] + ["", *wrapped(
        f"""So they disagree. Mastic and number of aggregates, which have only ΣV_s in common, both find voids in Ico,
            more of them in the coarse one, and differ by {apart:.2f} at most; the spheres find none. Our scenes have
            none: a cluster has the volume of its shape."""), ""]


def fillings(facts):
    return ["## What the fillings decide", "",
            *wrapped("""Porosity of a cluster is 1 − the sum of its spheres' volumes over the volume of its shape. Ours
                is 0, which is not full cover: overlaps count twice in the sum ([how much is
                covered](filling.md#porosity-0)). The paper gives no number, but three hints:"""), "",
            *hints(facts), *implied_voids(facts)]


def making(runs, times):
    wall, used = [r.wall for r in runs if r.wall], [r.memory for r in runs if r.memory]
    return ["## Making them", "", *wrapped("""`macadam specimen SCENE`, seed 1
        ([paper-specimens-time.csv](../bench/results/paper-specimens-time.csv)):"""), "",
            *table(["", "seconds", "cores", "measured"], [list(t.values()) for t in times]),
            *wrapped(f"""Most of the longest is insertion of the last shapes. Making and solving one of the specimens
                above at four frequencies took {min(wall):.0f} to {max(wall):.0f} s and up to
                {memory(used)} with {runs[0].threads} threads, other runs beside it."""), ""]


def prose(runs, table_of_variants, times):
    facts = Facts(runs, table_of_variants)
    every = [run for of in runs.values() for run in of]
    return lambda letters: reasons(facts, letters) + fillings(facts) + making(every, times)
