# SPDX-License-Identifier: GPL-3.0-or-later
"""The reasons in docs/paper-details.md why our values differ from the paper's. Each reason is for the bold cells that
its patterns name. Every number comes from the results or from the paper's tables."""
import math
from collections import namedtuple

from paper_data import between, listed, mean, minus

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
    return f"""*Fewer aggregates in the three large classes.* A share is a fraction of the volume of spheres. The
        same share therefore needs more clusters if the clusters have voids or are smaller. In the following cells the
        paper's smaller mean L^I explains most or all of its larger number of aggregates: {', '.join(by_size)}. Why
        the size is smaller in the paper is *not explained*; in the largest class it may be chance. In the other cells
        the sizes are nearly equal, and voids may be the cause (*inferred*): the three large classes of Ico-coarse
        have {made['MS-Ico-coarse']} aggregates without voids, {made['MS-Ico-coarse, voids']} with voids of 0.24, and
        {paper['coarse']} in the paper; the classes of Ico-fine have {made['MS-Ico-fine']} without voids,
        {made['MS-Ico-fine, voids']} with voids of 0.12, and {paper['fine']} in the paper."""


def small_class(f):
    names = ["MS-Poly-fine", "MS-Ico-fine"]
    poly, ico = (PAPER[n] for n in names)
    volume = [1e9 * p.volume(3) * BOX / p.particles[3] for p in (poly, ico)]
    ball = [math.pi / 6 * p.size[3] ** 3 for p in (poly, ico)]
    mine = [1e9 * f.of(n, "volume", 3) * BOX / f.of(n, "particles", 3) for n in names]
    weighted = [f.weighted_size(n, 3) for n in names]
    
    return f"""*2.0–4.75 mm of the fine specimens.* The paper's mean L^I of {poly.size[3]} and {ico.size[3]} mm (Poly
        and Ico; 3.1 to 3.3 in its three other specimens) does not agree with its volumes: the spheres of an aggregate
        have {several(volume, '{:.1f}')} mm³, but a ball with this L^I as diameter has {several(ball, '{:.0f}')} mm³.
        Our aggregates have a mean L^I of {f.of(names[0], 'size', 3):.1f} mm and {several(mine, '{:.1f}')} mm³.
        Weighted by the number of spheres, our mean L^I is {several(weighted)} mm, near the paper's; but the paper's
        values of the larger classes are not weighted in this way. *Not explained.* The numbers of aggregates follow
        from these volumes. Voids of 0.12 change the number of spheres of Ico from
        {f.count('MS-Ico-fine', 'spheres_3'):,} to {f.count('MS-Ico-fine, voids', 'spheres_3'):,} (paper
        {ico.spheres[3]:,}) and of Poly from {f.count('MS-Poly-fine', 'spheres_3'):,} to
        {f.count('MS-Poly-fine, voids', 'spheres_3'):,} (paper {poly.spheres[3]:,}). *Inferred:* voids are the main
        cause."""


def coarse_spheres(f):
    def ratios(radii, classes):
        of = [PAPER[n].sphere(k) / mean_sphere(PAPER[n].radius) for n in CLUSTERS if radii in n for k in classes]
        return f"{min(of):.2f} to {max(of):.2f}"

    least = 4 / 3 * math.pi * 1.45e-3**3 / mean_sphere(COARSE)
    return f"""*Fewer spheres in the large coarse classes.* The mean volume of a sphere in the paper (share of ΣV_s
        divided by the number of spheres) is {ratios('coarse', (0, 1))} times ours (fine specimens:
        {ratios('fine', range(3))}), so the same volume needs more spheres. The paper does not state the distribution
        of radii; ours is uniform in 1–2 mm. *Inferred:* the paper's distribution is narrower. Its mean radius of
        1.5 mm was at least 1.45 mm before rounding, and equal spheres of 1.45 mm have {least:.2f} of our mean
        volume."""


def spheres_follow(f):
    name, k = "MS-Poly-coarse", 2
    paper = PAPER[name]
    return f"""*Fewer spheres of 4.75–9.5 mm in Poly-coarse,* because the number of aggregates is smaller (ᵃ). The
        mean number of spheres of an aggregate is {f.of(name, 'spheres', k) / f.of(name, 'particles', k):.1f}, in the
        paper {paper.spheres[k] / paper.particles[k]:.1f}."""


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
        clusters they differ. An exact test of their surfaces keeps our clusters apart, and mastic lies between most of
        them. The paper does not state how it tests that aggregates do not overlap. If only the spheres are tested,
        clusters interlock. In the order of the table, our numbers of A-A contacts are {ours}; {voids} with voids;
        {spheres} if only the spheres are tested; and {together} with voids and this test. The
        last four numbers differ from the paper's by {between(off, '{:+.0f}')} %. *Inferred:* voids, this test, and
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
    
    _, best, of = merits(f.variants.values())[0]
    e, phi = (max(abs(of[n].deviations[k] - DEVIATION[n][k]) for n in CLUSTERS) for k in (0, 1))
    return f"""*|E\\*| and φ against SS.* [Other choices](#choices-that-the-paper-does-not-state) reproduce the paper
        more closely. With the best set ({best.label}) |E\\*| differs from the paper's by at most {e:.0f} percentage
        points, and φ
        by at most {phi:.0f} percentage points."""


def shape(f):
    e, same, phi = ([f.between(f"MS-Ico-{r}", f"MS-Poly-{r}{given}", key) for r in ("coarse", "fine")] for given, key in
                    (("", "e_star_pa"), (", composition of Ico", "e_star_pa"), (", composition of Ico", "phase_deg")))
    
    return f"""*Ico against Poly.* Table 3, and therefore our scenes, give Ico more aggregate and less mastic than
        Poly. If Poly has the composition of Ico (seed 1, mean of 2 and 20 Hz), |E\\*| of Ico differs from Poly's by
        {several(same, '{:+.1f}')} % (coarse and fine) instead of {several(e, '{:+.1f}')} %, and φ by
        {several(phi, '{:+.1f}')} % (paper {ICO_OVER_POLY['fine'][1]:+} % for fine). The different
        compositions therefore explain why |E\\*| of our Ico is higher than |E\\*| of our Poly. It is *not explained* why
        |E\\*| and φ of the paper's Ico and Poly differ as if the two had the same composition."""


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
