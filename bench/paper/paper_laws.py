# SPDX-License-Identifier: GPL-3.0-or-later
"""Section of docs/paper-details.md on Section 4.4 of the paper: the origin of the contacts' moduli and calibration
factors, compared with ours."""
import cmath
import math
import re
import tomllib

from paper_data import half_range, mean, minus, rows
from paper_document import table, wrapped
from paper_runs import ROOT
from paper_tables import DELTA_MM, FREQUENCIES, ROCK

MIXES = {"AM1": "ac14_ss_am1", "AM2": "ac14_ss_am2"}


def mastic_scene(mix):
    """Returns the scene of a specimen of mastic alone, with box, spheres, laws and walls of the mixture's scene and
    porosity 0.05."""
    text = (ROOT / "examples" / MIXES[mix] / "scene.toml").read_text(encoding="utf-8")
    text = re.sub(r" *#.*\n", "\n", text)
    text = re.sub(r"\[\[specimen\.aggregate\]\]\n(?:\w.*\n)+", "", text)
    text = re.sub(r"^(radius = .*\n)count = .*", r"\1porosity = 0.05", text, flags=re.M)
    return re.sub(r"^(radius = .*\n)porosity = .*", r"\1porosity = 0.05", text, flags=re.M)


def laws(mix):
    scene = tomllib.loads((ROOT / "examples" / MIXES[mix] / "scene.toml").read_text(encoding="utf-8"))
    return {c["pair"]: c for c in scene["contacts"]}


def with_mix(text, mix):
    """Returns a scene of examples/ with the contact laws of another mixture; it keeps its own law inside aggregates."""
    of_mix = (ROOT / "examples" / MIXES[mix] / "scene.toml").read_text(encoding="utf-8")
    inner = re.search(r'\[\[contacts\]\]\npair = "inner".*?\n\n', text, flags=re.S)[0]

    def contacts(scene):
        return re.search(r"\[\[contacts\]\].*(?=\[loading\])", scene, flags=re.S)[0]

    return text.replace(contacts(text), inner + contacts(of_mix))


def modulus(law, frequency):
    """Returns the complex modulus of a generalised Kelvin chain [Pa]."""
    s = 2j * math.pi * frequency
    return 1 / (1 / law["E_m"] + 1 / (s * law["C_m"]) + sum(1 / (e + s * c) for e, c in zip(law["E"], law["C"])))


def uniform_strain(alpha):
    """Returns the ratio of Young's modulus to the contacts' modulus if every sphere moves with the mean strain and the
    facets are distributed evenly over all directions: an upper bound for a large body."""
    return (2 + 3 * alpha) / (4 + alpha)


def factors(mix):
    """Returns two lists by frequency and seed. The first has the factors on the M-M law with which a specimen of mastic
    is as stiff as the mastic to which the law was fitted. The second has the phase of the specimen minus the phase of
    the law, in degrees."""
    law, of = laws(mix)["M-M"], [r for r in rows("paper-mastic.csv") if r["mix"] == mix]
    delta, phase = [], []
    for hz in FREQUENCIES:
        e = modulus(law, hz)
        delta.append([abs(e) / r[f"e_star_pa_{hz}"] for r in of])
        phase.append([r[f"phase_deg_{hz}"] - math.degrees(cmath.phase(e)) for r in of])
    return delta, phase


def mastic():
    lines, said = [], []
    for mix in MIXES:
        delta, phase = factors(mix)
        over_all = [mean(d) for d in zip(*delta)]
        lines.append([mix, *[f"{mean(d):.3f} ± {half_range(d):.3f}" for d in delta],
                      f"{mean(over_all):.2f} ({DELTA_MM[mix]:.2f})", minus(f"{mean(map(mean, phase)):+.2f}")])
        said.append(mean(over_all))
    alpha = laws("AM1")["M-M"]["alpha"]
    return ["### δ_MM", "",
            *wrapped(f"""A specimen of mastic spheres has a lower |E\\*| than the law of its contacts. δ_MM
        is |E\\*| of this law divided by |E\\*| of the specimen. Our specimens consist of mastic alone, in the
        mixture's box, with the law and walls of Table 4, radii uniform in 0.75–1 mm and porosity 0.05; the paper does
        not state the size of its specimen. If all spheres moved with the mean strain (uniform strain, an upper bound
        of the stiffness of a large body), δ_MM would be 1/{uniform_strain(alpha):.3f} =
        {1 / uniform_strain(alpha):.2f} at α = {alpha}. Motions that differ from the mean strain raise δ_MM, and stiff
        walls reduce it."""), "",
            *table(["δ_MM", *[f"{hz} Hz" for hz in FREQUENCIES], "mean (paper)", "φ minus φ of the law (°)"], lines),
            *wrapped(f"""
                The paper's factors differ from ours by {100 * (DELTA_MM['AM1'] / said[0] - 1):+.0f} % (AM1) and
                {100 * (DELTA_MM['AM2'] / said[1] - 1):+.0f} % (AM2). The paper found its factors by trial against a
                measured mastic, whose moduli it does not give, so these factors also correct the
                misfit of its law."""), ""]


def ratios():
    values = {mix: laws(mix)["M-A"]["E_m"] / laws(mix)["M-M"]["E_m"] for mix in MIXES}
    aa = laws("AM1")["A-A"]["E"]
    halves = {mix: 2 / (1 / aa + 1 / laws(mix)["M-M"]["E_m"]) / laws(mix)["M-M"]["E_m"] for mix in MIXES}
    return ["### δ_MA", "",
            *wrapped(f"""The row M-A of Table 4 is the row M-M, which includes δ_MM, times the stated δ_MA of
        {values['AM1']:.2f} (AM1) and {values['AM2']:.2f} (AM2). The paper assumes that an M-A contact is the elastic
        A-A contact and the viscoelastic M-M contact in series. Two half contacts in series, each with half of the
        distance and therefore twice the stiffness, would multiply E_m by {halves['AM1']:.2f} (AM1) and
        {halves['AM2']:.2f} (AM2), and the other constants by other numbers. The row M-A is therefore a fit of the
        paper's authors. Our scenes use it without a change."""), ""]


def springs():
    e, nu, aa = ROCK["E"], ROCK["nu"], laws("AM1")["A-A"]["E"] / 1e9
    confined = e * (1 - nu) / ((1 + nu) * (1 - 2 * nu))
    return ["### 115.1 GPa of A-A", "",
            *wrapped(f"""The paper estimates this modulus, {aa:.1f} GPa, with two springs in series, from a
        rock of {e:.0f} GPa and ν = {nu}, without a formula. The constrained modulus of the rock (no lateral strain),
        E·(1 − ν)/((1 + ν)(1 − 2ν)), is {confined:.1f} GPa. The paper's modulus is {aa / e:.3f} times the modulus of
        the rock and {aa / confined:.3f} times the constrained modulus. *Inferred* from these numbers alone: the paper
        multiplied the constrained modulus by 1.5, a factor that it does *not explain*."""), ""]


def inner():
    return ["### Inner moduli", "", "[The cube of aggregate](aggregate-cube.md) compares the moduli of the inner contacts.", ""]


def section():
    return ["## Origin of the contacts' moduli (section 4.4)", "", *mastic(), *ratios(), *springs(), *inner()]
