# SPDX-License-Identifier: GPL-3.0-or-later
"""Marks of examples/mastic/README.md: the output of its command compared with a single contact of its law."""
import cmath
import functools
import math
import re
import tomllib

from pages.common import source
from pages.data import between, table, text
from pages.marks import mark

DOCUMENT = "examples/mastic/README.md"


@functools.cache
def law():
    return next(c for c in tomllib.loads(source("examples/mastic/scene.toml"))["contacts"] if c["pair"] == "M-M")


def contact(frequency):
    """Returns the complex modulus of one contact [Pa]."""
    s = 2j * math.pi * frequency
    return 1 / (1 / law()["E_m"] + 1 / (law()["C_m"] * s) + sum(1 / (e + c * s) for e, c in zip(law()["E"], law()["C"])))


def found():
    """Returns rows of frequency, |E*| in GPa, phase in degrees, and the differences of both from the harmonic
    solution."""
    rows = [m for m in (re.match(r" +([\d.]+) +([\d.]+) +([\d.]+) +(\S+) +(\S+) +\S+ +\d+", row) for row in text("mastic-output.txt")) if m]
    return [[float(m[k]) for k in range(1, 6)] for m in rows]


@mark
def moduli():
    return table(["f (Hz)", "\\|E\\*\\| (GPa)", "φ (degrees)", "against the harmonic solution"],
                 [[f"{f:g}", f"{e:.3f}", f"{phi:.2f}", f"{de:.1e}, {math.degrees(dphi):.3f}°".replace("-", "−", 1)]
                  for f, e, phi, de, dphi in found()], range(4))


@mark
def contact_modulus():
    return ", ".join(f"{1e-9 * abs(contact(f)):.3f}" for f, *_ in found()) + " GPa"


@mark
def contact_phase():
    return ", ".join(f"{math.degrees(cmath.phase(contact(f))):.2f}" for f, *_ in found()) + "°"


@mark
def fraction():
    """Returns the range of the ratio of the specimen's |E*| to that of one contact."""
    return between([1e9 * e / abs(contact(f)) for f, e, *_ in found()], "{:.2f}")


@mark
def phase_below():
    return between([math.degrees(cmath.phase(contact(f))) - phi for f, _, phi, *_ in found()], "{:.2f}") + "°"
