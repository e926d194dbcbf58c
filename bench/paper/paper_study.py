# SPDX-License-Identifier: GPL-3.0-or-later
"""The study of choices that the paper does not state about its specimens: sets of choices, their scenes, and how far
each set is from Table 5 and Fig. 11. Used by bench/paper/paper_variants, which runs them, and for docs/paper-specimens.md."""
import math
import re
from collections import namedtuple
from dataclasses import asdict, dataclass, replace

from paper_data import mean
from paper_tables import CLUSTERS, DEVIATION, PAIRS, PAPER

SHORT = [2, 20]  # Hz: the mean deviation at these two is within 0.3 points of the mean deviation at all four


@dataclass(frozen=True)
class Choice:
    """A set of choices: first those of making the specimen, then those of its contacts. The defaults are those of
    examples/."""
    voids: float = 0           # void in clusters, as a multiple of the void that the specimen's mastic volume implies
    test: str = "surfaces"     # which objects must not overlap when aggregates are placed: surfaces or spheres
    hold_out: float = 0        # stiffness with which the shapes' surfaces keep mastic out
    spacing_mm: float = 0      # smallest thickness of mastic between aggregates
    narrow: bool = False       # whether the coarse spheres have nearly the same radius
    library: str = ""          # library of shapes, in place of the scene's
    composition: str = ""      # name of the specimen whose composition is used in place of that of Poly
    inner_gap: float | None = None  # spheres of an aggregate with a larger gap, in mean radii, are not joined
    inner_modulus: float = 1   # factor on the moduli of contacts inside aggregates
    area_min: float = 0        # smallest area of all facets

    @property
    def making(self):
        """The choices that determine the specimen, without the choices of its contacts."""
        return replace(self, inner_gap=None, inner_modulus=1, area_min=0)

    @property
    def label(self):
        words = ["voids" if self.voids == 1 else f"voids × {self.voids:g}"] * (self.voids > 0)
        words += ["tested by spheres"] * (self.test == "spheres")
        words += [f"hold-out {self.hold_out:g}"] * (self.hold_out > 0)
        words += [f"spacing {self.spacing_mm:g} mm"] * (self.spacing_mm > 0) + ["narrow radii"] * self.narrow
        words += [f"library {self.library}"] * bool(self.library)
        words += [f"composition of {self.composition}"] * bool(self.composition)
        if self.inner_gap is not None:
            words.append(f"inner gap {self.inner_gap:g}")
        words += [f"inner moduli × {self.inner_modulus:g}"] * (self.inner_modulus != 1)
        words += [f"area_min {self.area_min:g}"] * (self.area_min > 0)
        return ", ".join(words) or "ours"


OURS = Choice()
# the most promising choices first, so that a study that is stopped has their results
MAKINGS = [OURS, Choice(voids=1), Choice(test="spheres"), Choice(voids=1, test="spheres"), Choice(hold_out=3),
           Choice(narrow=True), Choice(spacing_mm=0.2), Choice(voids=1.3, test="spheres"),
           Choice(voids=1, test="spheres", narrow=True), Choice(voids=1, test="spheres", hold_out=1),
           Choice(voids=1, hold_out=3), Choice(voids=1, test="spheres", spacing_mm=0.2),
           Choice(test="spheres", hold_out=3), Choice(voids=0.5, test="spheres")]
CONTACTS = [OURS, Choice(inner_gap=0.0), Choice(inner_gap=-0.05), Choice(inner_gap=-0.1), Choice(inner_gap=-0.15),
            Choice(inner_modulus=0.5), Choice(area_min=0.026), Choice(inner_gap=-0.1, area_min=0.026)]
# Radii of the coarse spheres for `narrow` [m]. The mean volume of these spheres is 0.82 times the mean volume of
# spheres with radii uniform in 1 to 2 mm; 0.82 is the smallest such ratio in Table 3.
NARROW = (1.35e-3, 1.55e-3)


def makings_of(name):
    """Returns the choices for making the specimen that are tried. For the specimen of single spheres only the spacing
    is varied, because it has no clusters."""
    if name == "SS":
        return [m for m in MAKINGS if m == Choice(spacing_mm=m.spacing_mm)]
    own = [m for m in MAKINGS if not m.narrow or "coarse" in name]
    if "Poly" in name:
        own[4:4] = [Choice(composition="Ico"), Choice(library="aggregates and icosahedron")]
    return own


def contacts_of(name, making):
    """Returns the choices for the contacts that are tried with a specimen."""
    of = [c for c in CONTACTS if name != "SS" or c in (OURS, Choice(area_min=c.area_min))]
    return [replace(making, inner_gap=c.inner_gap, inner_modulus=c.inner_modulus, area_min=c.area_min) for c in of]


def after(text, section, line):
    """Returns the scene with one more line in a section."""
    assert text.count(f"[{section}]\n") == 1
    return text.replace(f"[{section}]\n", f"[{section}]\n{line}\n")


def of_pair(text, pair, keys, factor):
    """Returns the scene with some moduli of one pair's law multiplied by a factor."""
    start = text.index(f'pair = "{pair}"')
    end = text.find("[[contacts]]", start)

    def times(line):
        return line[1] + re.sub(r"[0-9.]+(e[0-9]+)?", lambda m: f"{float(m[0]) * factor:.6e}", line[2])

    return text[:start] + re.sub(rf"^((?:{keys}) = )(.*)$", times, text[start:end], flags=re.M) + text[end:]


# Returns the scene with these volume fractions of its size classes.
def with_fractions(text, fractions):
    fraction = iter(fractions)
    return re.sub(r"^volume_fraction = .*", lambda _: f"volume_fraction = {next(fraction):.4f}", text, flags=re.M)


# Returns the void inside the clusters for a choice: `choice.voids` times the void that the specimen's volumes imply.
def porosity(name, choice):
    return round(choice.voids * PAPER[name].void_of_mastic, 2) if choice.voids else 0


def making_scene(text, name, choice):
    """Returns the text of a scene of examples/ with the choices of its making."""
    text = re.sub(r" *#.*\n", "\n", text)  # removes comments, so that a changed comment does not make another scene
    text = re.sub(r"^frequencies = .*", f"frequencies = {[float(f) for f in SHORT]}", text, flags=re.M)
    if choice.spacing_mm:
        text = after(text, "specimen", f'spacing = "{choice.spacing_mm:g} mm"')
    # the volumes of the spheres stay the same, so the shapes of clusters become larger
    if void := porosity(name, choice):
        clustered = PAPER[name].clustered
        volume = [s / 100 / (1 - void if k in clustered else 1) for k, s in enumerate(PAPER[name].share)]
        text = with_fractions(text, [v / sum(volume) for v in volume])
        text = re.sub(r"^porosity = 0\.0\b", f"porosity = {void}", text, flags=re.M)
    if choice.composition:
        of = PAPER[name.replace("Poly", choice.composition)]
        text = with_fractions(text, [s / 100 for s in of.share])
        text = re.sub(r"^count = \d+", f"count = {of.particles[4]}", text, flags=re.M)
    if choice.library:
        text = re.sub(r"^library = .*", f'library = "{choice.library}"', text, flags=re.M)
    if choice.narrow:
        start = text.index("[specimen.shapes]")
        text = text[:start] + re.sub(r"^radius = .*", f"radius = [{NARROW[0]}, {NARROW[1]}]", text[start:], count=1,
                                     flags=re.M)
    if choice.test != "surfaces":
        text = after(text, "specimen.shapes", f'test = "{choice.test}"')
    if choice.hold_out:
        text = after(text, "specimen.shapes", f"hold_out = {choice.hold_out}")
    return text


def contact_scene(text, choice, specimen):
    """Returns a scene that reads its specimen from a file. Its contact laws follow the choices of contacts."""
    box = re.search(r"^box = .*", text, flags=re.M)[0]
    text = f'[specimen]\n{box}\nfile = "{specimen}"\n\n' + text[text.index("[materials."):]
    if choice is None:
        return text
    if choice.inner_gap is not None:
        text = text.replace('pair = "inner"\n', f'pair = "inner"\ngap_max = {choice.inner_gap}\n')
    if choice.inner_modulus != 1:
        text = of_pair(text, "inner", "E", choice.inner_modulus)
    return text + (f"\n[network]\narea_min = {choice.area_min}\n" if choice.area_min else "")


# ---- figure of merit

QUANTITIES = [*PAIRS, "total", "|E*|", "φ"]
# Scales by which differences are divided: 5 % for a number of contacts relative to SS, 2 points for a deviation from
# SS. The paper gives deviations to the nearest 0.5 percentage points. The seeds of one scene differ by up to 4 % in
# the number of A-A contacts, by less in the other numbers, and by about 1 percentage point in the deviations.
CONTACT_SCALE, DEVIATION_SCALE = 0.05, 2.0
Judged = namedtuple("Judged", "ratios deviations misfits")


def judged(row, ss):
    """Compares a row of the study with the row of SS that has the same choices of contacts. Returns ratios of numbers
    of contacts, deviations of |E*| and phi in %, and each misfit divided by its scale."""
    paper, base = PAPER[row["specimen"]], PAPER["SS"]
    own, theirs = ([float(r[p]) for p in PAIRS] for r in (row, ss))
    ratios = [a / b for a, b in zip([*own, sum(own)], [*theirs, sum(theirs)])]
    deviations = [mean(100 * (float(row[f"{key}_{hz}_hz"]) / float(ss[f"{key}_{hz}_hz"]) - 1) for hz in SHORT)
                  for key in ("e_star_pa", "phase_deg")]
    misfits = [math.log(r / (a / b)) / CONTACT_SCALE for r, a, b in zip(ratios, paper.contacts, base.contacts)]
    misfits += [(d - p) / DEVIATION_SCALE for d, p in zip(deviations, DEVIATION[row["specimen"]])]
    return Judged(ratios, deviations, misfits)


def choice_of(row):
    """Returns the choice of a row of bench/results/paper-study.csv."""
    kinds = {"narrow": lambda v: v == "True", "test": str, "library": str,
             "composition": str, "inner_gap": lambda v: float(v) if v else None}
    return Choice(**{key: kinds.get(key, float)(row[key]) for key in asdict(OURS)})


def reference(rows, choice, seed):
    """Returns the row of the single spheres with which a choice is compared: with the same spacing and the same
    area_min."""
    wanted = Choice(spacing_mm=choice.spacing_mm, area_min=choice.area_min)
    return next((r for r in rows if r["specimen"] == "SS" and r["seed"] == seed and choice_of(r) == wanted), None)


def merits(rows):
    """Returns, for each choice that all four specimens have, its judged rows by specimen, averaged over seeds, and the
    root mean square of their misfits; the best choice first."""
    by_choice = {}
    for row in rows:
        ss = reference(rows, choice_of(row), row["seed"])
        if row["specimen"] != "SS" and ss:
            by_choice.setdefault(choice_of(row), {}).setdefault(row["specimen"], []).append(judged(row, ss))
    result = []
    for choice, own in by_choice.items():
        # a choice that does not apply to a specimen leaves it unchanged, so its row without that choice is used
        of = {**by_choice.get(replace(choice, narrow=False, library="", composition=""), {}), **own}
        if set(of) >= set(CLUSTERS):
            averaged = {n: Judged(*([mean(v) for v in zip(*part)] for part in zip(*of[n]))) for n in CLUSTERS}
            square = mean(m * m for j in averaged.values() for m in j.misfits)
            result.append((math.sqrt(square), choice, averaged))
    return sorted(result, key=lambda r: r[0])
