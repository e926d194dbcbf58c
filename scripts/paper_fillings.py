# SPDX-License-Identifier: GPL-3.0-or-later
"""The sections after the tables of docs/paper-specimens.md: why ours differ, what the fillings decide, how long it
takes."""
from pages.data import mean, memory, minus
from paper_document import deviations, table, wrapped
from paper_reasons import REASONS, Facts, several
from paper_tables import CLASSES, CLUSTERS, DEVIATION, FREQUENCIES, PAIRS, PAPER

# the variants that have the void of the mastic budget, by filling
VOIDS = {"coarse": "coarse, porosity 0.24", "fine": "fine, porosity 0.12"}


def two(value):
    return minus(f"{round(value, 2) + 0:.2f}")  # no −0.00


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
            # a class with many single spheres has no radius of its clusters' spheres
            by_spheres = all(facts.of(name, "single", k) < 0.1 * facts.of(name, "particles", k) for k in classes)
            rows.append([f"{name[3:]}, {'together' if together else CLASSES[classes[0]]}", two(v.ratio), two(v.size),
                         two(1 - 1 / v.ratio), two(v.chance), two(v.number),
                         two(v.spheres) if by_spheres else "–", two(PAPER[name].void_of_mastic) if together else ""])
    return table(["", "paper's number over ours", "its sizes give", "void, from the number", "chance",
                  "… its sizes considered", "… from the spheres", "… from the mastic"], rows)


def contact_changes(facts):
    rows, text = [], {"nearer": [], "farther": []}
    for label, variant in VOIDS.items():
        paper = PAPER[f"MS-Ico-{label}"].contacts
        for k, pair in enumerate(PAIRS):
            off = [100 * (facts.count(v, pair) / paper[k] - 1) for v in (label, variant)]
            rows.append([f"{label}, {pair}", *[minus(f"{d:+.1f}") for d in off]])
            text["nearer" if abs(off[1]) < abs(off[0]) else "farther"].append(f"{label} {pair}")
    return table(["Ico's contacts, off the paper (%)", "no voids", "with voids"], rows), text


def variants(facts):
    rows = []
    for v in facts.variants.values():
        if v["specimen"] == "SS":
            continue
        paper, label = PAPER[v["specimen"]], v["specimen"][3:]
        what = [f"porosity {v['porosity']}"] * (v["porosity"] != "0")
        what += ["inner moduli halved"] * (v["inner_modulus"] == "0.5")
        what += [f"δ_MA {float(v['delta_ma']):.2f} (paper: within 3 % of SS)"] * (v["delta_ma"] != "3.15")
        what += [f"composition of {v['composition'][3:]}"] * bool(v["composition"])
        if not what:
            rows.append([f"{label}, paper", f"{sum(paper.particles[:4]):,}", f"{sum(paper.spheres[:4]):,}",
                         *[f"{n:,}" for n in paper.contacts[:3]],
                         *[cell for d in DEVIATION[v["specimen"]] for cell in ("", minus(f"{d:+d}"))]])
        both = [facts.from_ss(v["variant"], key) for key in ("e_star_pa", "phase_deg")]
        rows.append([f"{label}, {', '.join(what) or 'ours'}", f"{int(v['aggregates']):,}",
                     f"{sum(int(v[f'spheres_{k}']) for k in range(4)):,}", *[f"{int(v[p]):,}" for p in PAIRS],
                     *[minus(cell) for d in both for cell in (f"{d[0]:+.0f} … {d[1]:+.0f}", f"{mean(d):+.0f}")]])
    return table(["", "aggregates", "their spheres", *PAIRS, "\\|E*\\| (%)", "mean", "φ (%)", "mean"], rows)


def hints(facts):
    """What the paper's numbers say of the void in its clusters, and on what each hint rests."""
    ss, rest = PAPER["SS"], "This rests on"
    budget = {r: [PAPER[f"MS-{s}-{r}"].void_of_mastic for s in ("Poly", "Ico")] for r in VOIDS}
    ico, poly = ([facts.void(f"MS-{s}-{r}", [0, 1, 2]) for r in VOIDS] for s in ("Ico", "Poly"))
    spheres = [facts.void("MS-Ico-coarse", [0, 1]).spheres, ico[1].spheres]
    apart = max(abs(v.number - budget[r][1]) for v, r in zip(ico, VOIDS))
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
    changes, moved = contact_changes(facts)
    e, phi = ({v: mean(facts.from_ss(v, key)) for v in facts.variants} for key in ("e_star_pa", "phase_deg"))
    paper = {r: DEVIATION[f"MS-Ico-{r}"] for r in VOIDS}
    off = [abs(d[VOIDS[r] + ", inner halved"] - paper[r][k]) for r in VOIDS for k, d in enumerate((e, phi))]

    def change(d, k):
        return " and ".join(f"from {d[r]:+.0f} to {d[v]:+.0f} % ({r}; paper {paper[r][k]:+d})"
                            for r, v in VOIDS.items())

    return ["## What the fillings decide", "",
            *wrapped("""Porosity of a cluster is 1 − the sum of its spheres' volumes over the volume of its shape. Ours
                is 0, which is not full cover: overlaps count twice in the sum ([how much is
                covered](filling.md#porosity-0)). The paper gives no number, but three hints:"""), "",
            *hints(facts), *implied_voids(facts),
            *wrapped("""What voids and other laws would do, varied in Ico alone (in Poly only the composition, ⁱ), with
                seed 1, at 2 and 20 Hz only; deviations are from SS of the same seed, at 2 … 20 Hz, and the means of
                these two, the paper's of four frequencies. An earlier `bench/paper_variants` made [the
                data](../bench/results/paper-variants.csv)."""), "",
            *variants(facts), *changes,
            *wrapped(f"""So voids bring {', '.join(moved['nearer'])} nearer to the paper, and
                {', '.join(moved['farther'])} farther. φ goes {change(phi, 1)}, and |E\\*| {change(e, 0)}. What is
                missing is a compliance that is elastic, so that it lowers both, and inside the clusters: with inner
                contacts of half the paper's modulus as well, all four means are within {max(off):.1f} points of the
                paper's. Such a cluster is a body of 30 GPa, not of the rock's 60. Why it should be is a guess: the
                paper found its inner moduli on cubes, and if those were packed full while its clusters have voids, some
                spheres of a cluster do not touch and may not be joined. Here every facet within a cluster is a contact,
                whether its spheres touch or not. The scenes keep the moduli of Table 4 and of the text."""), ""]


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
