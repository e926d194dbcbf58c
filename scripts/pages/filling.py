# SPDX-License-Identifier: GPL-3.0-or-later
"""Marks of docs/filling.md, from fill-study.csv (porosity 0.12) and fill-porosity-0.csv of bench/shapes/run."""
from paper_tables import PAPER
from pages.data import between, mean, percents, plain, rows, table, thousands, upto_percent, where
from pages.marks import mark

DOCUMENT = "docs/filling.md"
EQUAL = (0.5, 0.75, 1.0, 1.5, 2.0)
RANGES = [(r, r) for r in EQUAL] + [(0.75, 1.0), (1.0, 2.0)]
PUBLISHED = {0.5: 1568, 2.0: 24}  # number of spheres by radius [mm], from the paper's Fig. 5
RADII = {"fine": (0.75, 1.0), "coarse": (1.0, 2.0)}
DIAMETER = 12.59  # D^I of the shapes, mm
LENGTHS = ("long", "intermediate", "short")


def study(shape, low, high=None):
    return where(rows("fill-study.csv"), shape=shape, radius_min_mm=low, radius_max_mm=high or low)


def shapes():
    return [s for s in dict.fromkeys(r["shape"] for r in rows("fill-study.csv")) if s != "icosahedron"]


def kept(found, length):
    """Returns the mean ratio of a dimension of the clusters to that of their shapes."""
    return mean(r[f"d_{length}_mm"] / r[f"shape_d_{length}_mm"] for r in found)


@mark
def icosahedron():
    of = [study("icosahedron", r) for r in EQUAL]

    def row(label, value):
        return [label, *(value(r, f) for r, f in zip(EQUAL, of))]
    return table(["icosahedron, radius (mm)", *(f"{r:.2f}" for r in EQUAL)], [
        row("spheres", lambda r, f: f"{mean(x['spheres'] for x in f):.0f}"),
        row("published", lambda r, f: PUBLISHED.get(r, "")),
        row("covered", lambda r, f: f"{100 * mean(x['covered'] for x in f):.0f} %"),
        row("outside", lambda r, f: f"{plain(100 * mean(x['outside'] for x in f), 1)} %"),
        row("mean deviation / R", lambda r, f: f"{mean(x['deviation_mean_mm'] for x in f) / r:.2f}"),
        row("D^L, D^I, D^S / shape's", lambda r, f: ", ".join(f"{kept(f, x):.2f}" for x in LENGTHS))])


@mark
def count(low, high):
    return f"{mean(r['spheres'] for r in study('icosahedron', float(low), float(high))):.0f}"


@mark
def shorter():
    def between(names, r, length):
        of = [kept(study(name, r), length) for name in names]
        return f"{min(of):.3f}–{max(of):.3f}" if len(of) > 1 else f"{of[0]:.3f}"

    others = [s for s in shapes() if s != "aggregate_81"]
    return table(["R (mm)", "R / D^I", "D^L, six aggregates", "D^I, `aggregate_81`", "D^I, the other five",
                  "D^S, six aggregates", "icosahedron"],
                 [(f"{r:.2f}", f"1/{DIAMETER / r:.3g}", between(shapes(), r, "long"),
                   between(["aggregate_81"], r, "intermediate"), between(others, r, "intermediate"),
                   between(shapes(), r, "short"), ", ".join(f"{kept(study('icosahedron', r), x):.3f}" for x in LENGTHS))
                  for r in (0.5, 1.0, 2.0)])


@mark
def off_from(spheres):
    """Returns the largest deviation of a mean dimension, over all clusters with at least this number of spheres."""
    of = []
    for shape in [*shapes(), "icosahedron"]:
        for low, high in sorted({(r["radius_min_mm"], r["radius_max_mm"]) for r in rows("fill-study.csv")}):
            found = study(shape, low, high)
            if mean(r["spheres"] for r in found) >= float(spheres):
                of += [abs(kept(found, x) - 1) for x in LENGTHS]
    return upto_percent(of)


@mark
def papers_piece(filling):
    """Returns the paper's mean number of spheres per icosahedron of its largest class."""
    paper = PAPER[f"MS-Ico-{filling}"]
    return f"{paper.spheres[0] / paper.particles[0]:.0f}"


@mark
def papers_size(filling):
    return f"{PAPER[f'MS-Ico-{filling}'].size[0]:g}"


@mark
def a_piece(filling, porosity):
    """Returns our number of spheres in an icosahedron with the mean L^I of that class: the number at 12.59 mm without
    voids, times the ratio of the volumes, times the fraction 1 - porosity."""
    low, high = RADII[filling]
    found = where(rows("fill-porosity-0.csv"), shape="icosahedron", d_intermediate_mm=DIAMETER, radius_min_mm=low,
                  radius_max_mm=high)
    ratio = (PAPER[f"MS-Ico-{filling}"].size[0] / DIAMETER) ** 3 * (1 - float(porosity))
    return f"{ratio * mean(r['spheres'] for r in found):.0f}"


# ---- without voids

def library(spheres=lambda n: n > 1):
    """Returns the rows of all shapes with D^I = 9 mm that are filled as clusters."""
    return where(rows("fill-porosity-0.csv"), d_intermediate_mm=9.0, spheres=spheres)


@mark
def library_spheres():
    clusters, every = [r["spheres"] for r in library()], len(library(lambda n: True))
    return (f"{between(clusters)} spheres; {every - len(clusters)} of the {every} shapes becomes a single one and is "
            "left out")


def of_library(length):
    return [r[f"cluster_d_{length}_mm"] / r[f"shape_d_{length}_mm"] for r in library()]


@mark
def library_kept():
    return ", ".join(f"{mean(of_library(x)):.2f}" for x in LENGTHS)


@mark
def library_least():
    return f"{min(of_library('intermediate')):.2f}"


@mark
def library_covered(which):
    of = [r["covered"] for r in library()]
    return f"{100 * (min(of) if which == 'least' else mean(of)):.0f} %"


@mark
def covered():
    lines = []
    for shape in ("icosahedron", "aggregate_82", "aggregate_59", "aggregate_81"):
        of = [where(rows("fill-porosity-0.csv"), shape=shape, d_intermediate_mm=DIAMETER, radius_min_mm=low,
                    radius_max_mm=high) for low, high in RANGES]
        lines.append([shape if shape == "icosahedron" else f"`{shape}`",
                      *(f"{thousands(mean(r['spheres'] for r in f))}, {100 * mean(r['covered'] for r in f):.0f} %"
                        for f in of)])
    return table(["radius (mm)", *(f"{a:.2f}" if a == b else f"{a:.2f}–{b:.2f}" for a, b in RANGES)], lines)


@mark
def covered_range():
    """Returns the range of the covered fraction of a shape without voids."""
    return percents(r["covered"] for r in rows("fill-porosity-0.csv") if r["spheres"] > 1)
