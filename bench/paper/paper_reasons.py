# SPDX-License-Identifier: GPL-3.0-or-later
"""The reasons in docs/paper-details.md why our values differ from the paper's. Each reason is for the bold cells that
its patterns name. Every number comes from the results or from the paper's tables."""
import math
from collections import namedtuple

from paper_data import between, listed, mean, minus
from paper_document import deviations
from paper_study import OURS, Choice, choice_of, merits
from paper_tables import BOX, CLASSES, CLUSTERS, COARSE, DEVIATION, ICO_OVER_POLY, PAPER, mean_sphere

Void = namedtuple("Void", "ratio size chance number spheres")


def variant(name, choice):
    """Returns the name of a row of the study: `MS-Ico-fine, voids`."""
    return name if choice == OURS else f"{name}, {choice.label}"


class Facts:
    """The numbers from the results that the reasons use."""

    def __init__(self, runs, variants):
        self.runs = runs
        self.variants = {variant(v["specimen"], choice_of(v)): v for v in variants if v["seed"] == "1"}

    def of(self, name, key, k):
        return mean(getattr(run, key)[k] for run in self.runs[name])

    def weighted_size(self, name, k):
        """Returns the mean L^I in mm of a class, averaged over its spheres instead of its aggregates."""
        of = [(run.size_by_spheres[k], run.spheres[k]) for run in self.runs[name]]
        return sum(size * spheres for size, spheres in of) / sum(spheres for _, spheres in of)

    def void(self, name, classes):
        """Returns estimates of the void in the paper's clusters from its number of aggregates. The estimates assume
        that the paper's sizes and shapes are the same as ours."""
        paper, shapes, shapes_of_size, squares, spheres = PAPER[name], 0, 0, 0, 0
        for k in classes:
            found = sum(run.particles[k] for run in self.runs[name])  # aggregates of all seeds
            v, n = sum(run.volume[k] for run in self.runs[name]) * BOX / found, paper.particles[k]
            size = (paper.size[k] / self.of(name, "size", k)) ** 3
            shapes, shapes_of_size = shapes + n * v, shapes_of_size + n * v * size
            squares += n * (sum(run.square[k] for run in self.runs[name]) * 1e-18 / found - v * v)
            spheres += paper.spheres[k] * mean_sphere(paper.radius)
        own = sum(paper.volume(k) for k in classes) * BOX
        return Void(shapes / own, shapes / shapes_of_size, math.sqrt(squares) / shapes * own / shapes,
                    1 - own / shapes_of_size, 1 - spheres / shapes_of_size)

    def from_ss(self, variant, key):
        """Returns the deviations of a variant from SS in %, at 2 and 20 Hz."""
        v, ss = self.variants[variant], self.variants["SS"]
        return [100 * (float(v[f"{key}_{hz}_hz"]) / float(ss[f"{key}_{hz}_hz"]) - 1) for hz in (2, 20)]

    def counts(self, choice, key):
        """Returns the count `key` of each of the four specimens of clusters if made with a choice, as in CLUSTERS."""
        return [self.count(variant(n, choice), key) for n in CLUSTERS]

    def between(self, variant, base, key="e_star_pa"):
        """Returns the mean of a variant's deviations from another variant at 2 and 20 Hz, %."""
        v, b = self.variants[variant], self.variants[base]
        return mean(100 * (float(v[f"{key}_{hz}_hz"]) / float(b[f"{key}_{hz}_hz"]) - 1) for hz in (2, 20))

    def count(self, variant, key):
        return int(self.variants[variant][key])


def several(values, form="{:.2f}"):
    return minus(" and ".join(form.format(v) for v in values))


def number(f):
    def counts(of):
        return " / ".join(str(of(k)) for k in range(3))

    made = {v: counts(lambda k, v=v: f.count(v, f"aggregates_{k}"))
            for v in ("MS-Ico-coarse", "MS-Ico-fine", "MS-Ico-coarse, voids", "MS-Ico-fine, voids")}
    paper = {r: counts(lambda k, r=r: PAPER[f"MS-Ico-{r}"].particles[k]) for r in ("coarse", "fine")}
    voids = [(n, k, f.void(n, [k])) for n in CLUSTERS for k in range(3)]
    by_size = [f"{n[3:]} {CLASSES[k]} (number × {v.ratio:.2f}, of which sizes explain × {v.size:.2f})" for n, k, v in voids
               if v.ratio > 1.1 and v.size - 1 > 0.5 * (v.ratio - 1)]
    return f"""*Fewer aggregates in the three large classes.* Shares refer to the volumes of spheres. The same share
        therefore needs more clusters if the clusters have voids or are smaller. In the following cells the mean L^I
        of the paper is smaller than ours, which explains most or all of the larger number of aggregates:
        {', '.join(by_size)}. Why the size is smaller in the paper is *not explained*; in the largest class it may be
        chance. In the other cells the sizes are nearly equal, and voids may be
        the cause (*inferred*). With voids of 0.24 (coarse) and 0.12 (fine), Ico has {made['MS-Ico-coarse, voids']} and
        {made['MS-Ico-fine, voids']} aggregates; the paper has {paper['coarse']} and {paper['fine']}, and without voids
        Ico has {made['MS-Ico-coarse']} and {made['MS-Ico-fine']}."""


def small_class(f):
    names = ["MS-Poly-fine", "MS-Ico-fine"]
    poly, ico = (PAPER[n] for n in names)
    volume = [1e9 * p.volume(3) * BOX / p.particles[3] for p in (poly, ico)]
    ball = [math.pi / 6 * p.size[3] ** 3 for p in (poly, ico)]
    mine = [1e9 * f.of(n, "volume", 3) * BOX / f.of(n, "particles", 3) for n in names]
    weighted = [f.weighted_size(n, 3) for n in names]
    larger = ", ".join(f"{f.weighted_size('MS-Ico-fine', k):.1f} ({ico.size[k]:.1f})" for k in range(3))
    return f"""*2.0–4.75 mm of the fine specimens.* The paper's mean L^I of {poly.size[3]} and {ico.size[3]} mm (Poly
        and Ico; 3.1 to 3.3 in its three other specimens) does not agree with the volumes in the paper. There the
        spheres of an aggregate have {several(volume, '{:.1f}')} mm³, and a ball with this L^I as diameter has
        {several(ball, '{:.0f}')} mm³. Our aggregates
        have a mean L^I of {f.of(names[0], 'size', 3):.1f} mm and {several(mine, '{:.1f}')} mm³. If each of our
        aggregates is weighted by its number of spheres, the mean L^I is {several(weighted)} mm, near the values of
        the paper. In the larger classes of Ico, however, this weighted mean is {larger} mm (paper in brackets), so
        the other values of the paper are not weighted in this way. *Not explained.* The numbers of aggregates follow
        from these volumes. Voids of 0.12 change the number of spheres of Ico from
        {f.count('MS-Ico-fine', 'spheres_3'):,} to {f.count('MS-Ico-fine, voids', 'spheres_3'):,} (paper
        {ico.spheres[3]:,}), because a cluster of eight spheres is then larger, and the number of spheres of Poly from
        {f.count('MS-Poly-fine', 'spheres_3'):,} to {f.count('MS-Poly-fine, voids', 'spheres_3'):,} (paper
        {poly.spheres[3]:,}). *Inferred:* voids are the main cause."""


def coarse_spheres(f):
    def ratios(radii, classes):
        of = [PAPER[n].sphere(k) / mean_sphere(PAPER[n].radius) for n in CLUSTERS if radii in n for k in classes]
        return f"{min(of):.2f} to {max(of):.2f}"

    least = 4 / 3 * math.pi * 1.45e-3**3 / mean_sphere(COARSE)
    return f"""*Fewer spheres in the large coarse classes.* Our radii are uniform in 1–2 mm. The mean volume of a
        sphere in the paper (share of ΣV_s divided by the number of spheres) is {ratios('coarse', (0, 1))} times the
        mean volume of our spheres (fine specimens:
        {ratios('fine', range(3))}), so the same volume needs more spheres. *Inferred:* the coarse radii of the paper
        have a narrower distribution than ours. The mean radius of 1.5 mm in the paper was at least 1.45 mm before
        rounding, and equal spheres of
        1.45 mm already have {least:.2f} of our mean volume. The paper does not state the distribution."""


def spheres_follow(f):
    name, k = "MS-Poly-coarse", 2
    paper, single = PAPER[name], 100 * f.of(name, "single_volume", k) / f.of(name, "volume", k)
    return f"""*Fewer spheres of 4.75–9.5 mm in Poly-coarse,* because the number of aggregates is smaller (ᵃ). An
        aggregate has {f.of(name, 'spheres', k) / f.of(name, 'particles', k):.1f} spheres, in the paper
        {paper.spheres[k] / paper.particles[k]:.1f}. {f.of(name, 'single', k):.0f} of our aggregates are single
        spheres, with {single:.0f} % of the volume of the class; the paper does not state how many of its aggregates
        are single spheres."""


def smaller_size(f):
    return f"""*Mean L^I of 4.75–9.5 mm in Poly-fine.* It is 6.5 to 7.1 mm in the paper's other specimens, 6.9 mm with a
        log-uniform distribution between the sieves, and {PAPER['MS-Poly-fine'].size[2]} mm in this cell of the paper.
        With this mean size, shapes like ours would have less volume than their spheres (void
        {f.void('MS-Poly-fine', [2]).number:.2f}). *Not explained.*"""


def aggregate_contacts(f):
    ss = 100 * abs(mean(run.contacts[0] for run in f.runs["SS"]) / PAPER["SS"].contacts[0] - 1)
    both = Choice(voids=1, test="spheres")
    ours, voids, spheres, together = (listed([f"{n:,}" for n in f.counts(c, "A-A")])
                                      for c in (OURS, Choice(voids=1), Choice(test="spheres"), both))
    off = [100 * (n / PAPER[name].contacts[0] - 1) for n, name in zip(f.counts(both, "A-A"), CLUSTERS)]
    return f"""*Fewer A-A contacts.* In SS the numbers of A-A contacts agree within {ss:.0f} %; in the specimens of
        clusters they differ. Our clusters are kept
        apart by an exact test of their surfaces, and mastic lies between most of them. The paper fills an aggregate before it
        places it, and does not state how it tests that aggregates do not overlap. If only the spheres are tested,
        clusters interlock. In the order of the table, our numbers are {ours}; {voids} with voids; {spheres} if only
        the spheres are tested; and {together} with voids and this test, which differs from the paper by
        {between(off, '{:+.0f}')} %. *Inferred:* voids, this test, and
        [further choices](#choices-that-the-paper-does-not-state)."""


def other_contacts(f):
    ratio = [f.count(v, "M-A") / f.count("SS", "M-A") for v in ("MS-Ico-coarse", "MS-Ico-coarse, voids")]
    paper = PAPER["MS-Ico-coarse"].contacts
    return f"""*M-M and M-A of Ico-coarse.* Without voids the shapes take less space, so more space is left for the
        mastic. With voids of 0.24, M-M falls from {f.count('MS-Ico-coarse', 'M-M'):,} to
        {f.count('MS-Ico-coarse, voids', 'M-M'):,} (paper
        {paper[2]:,}), and M-A divided by SS rises from {ratio[0]:.2f} to {ratio[1]:.2f} (paper
        {paper[1] / PAPER['SS'].contacts[1]:.2f}). *Inferred:* voids."""


def deviation(f):
    coarse, fine = ([mean(d[-1] for d in deviations(f.runs, f"MS-{s}-{r}", "SS", "e_star")) for s in ("Poly", "Ico")]
                    for r in ("coarse", "fine"))
    _, best, of = merits(f.variants.values())[0]
    e, phi = (listed([f"{of[n].deviations[k]:+.0f} ({DEVIATION[n][k]:+d})" for n in CLUSTERS]) for k in (0, 1))
    return f"""*|E\\*| and φ against SS.* The coarse clusters are stiffer by {several(coarse, '{:.0f}')} % (Poly and
        Ico), the fine clusters by {several(fine, '{:.0f}')} %. φ falls by less than in the paper in all four specimens.
        Among the [choices that were varied](#choices-that-the-paper-does-not-state) the best set ({best.label}) changes
        |E\\*| by {e} % and φ by {phi} %, in the order of the table, with the paper's values in brackets."""


def shape(f):
    e, same, phi = ([f.between(f"MS-Ico-{r}", f"MS-Poly-{r}{given}", key) for r in ("coarse", "fine")] for given, key in
                    (("", "e_star_pa"), (", composition of Ico", "e_star_pa"), (", composition of Ico", "phase_deg")))
    poly, ico = (PAPER[f"MS-{s}-coarse"] for s in ("Poly", "Ico"))
    box = [f"{sum(p.volume(k) for k in range(4)):.3f} and {p.volume(4):.3f}" for p in (ico, poly)]
    return f"""*Ico against Poly.* Table 3, and therefore our scenes, give Ico more aggregate and less mastic than
        Poly: in the coarse specimens {box[0]} of the box for Ico, and {box[1]} for Poly. If Poly has the composition
        of Ico (seed 1, mean of 2 and 20 Hz),
        |E\\*| of Ico differs from Poly's by {several(same, '{:+.1f}')} % (coarse and fine) instead of
        {several(e, '{:+.1f}')} %, and φ by {several(phi, '{:+.1f}')} %. The difference in composition therefore
        explains our difference in |E\\*| between Ico and Poly; for fine filling its effect is even larger than this
        difference. At equal composition φ of Ico-fine is higher by the
        same amount as in the paper ({ICO_OVER_POLY['fine'][1]:+} %). The compositions in the paper are not equal. Why
        its specimens differ as if they had equal compositions is *not explained*."""


REASONS = [
    ("ᵃ", [f"composition/MS-*/particles/{c}/less" for c in CLASSES[:3]], number),
    ("ᵇ", ["composition/MS-*-fine/size/2.0–4.75/less", "composition/MS-*-fine/particles/2.0–4.75/less",
           "composition/MS-*-fine/spheres/2.0–4.75/more"], small_class),
    ("ᶜ", [f"composition/MS-*-coarse/spheres/{c}/less" for c in CLASSES[:2]], coarse_spheres),
    ("ᵈ", ["composition/MS-Poly-coarse/spheres/4.75–9.5/less"], spheres_follow),
    ("ᵉ", ["composition/MS-Poly-fine/size/4.75–9.5/more"], smaller_size),
    ("ᶠ", ["contacts/MS-*/A-A/less", "ratio/MS-*/A-A/less"], aggregate_contacts),
    ("ᵍ", ["contacts/MS-Ico-coarse/M-M/more", "ratio/MS-Ico-coarse/M-A/less"], other_contacts),
    ("ʰ", ["deviation/MS-*-coarse/e_star/less", "deviation/MS-*-fine/e_star/more", "deviation/MS-*/phase/more"],
     deviation),
    ("ⁱ", ["shape/*/e_star/more", "shape/*/phase/less"], shape),
]
