# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes bench/results/mastic-contact.csv: the complex modulus of one M-M contact of examples/mastic/scene.toml at the
scene's frequencies, from the formula of its law. scripts/documents writes and checks it."""
import cmath
import math
import tomllib
from pathlib import Path

SCENE = Path(__file__).resolve().parents[2] / "examples" / "mastic" / "scene.toml"


def modulus(law, frequency):
    """Returns the complex modulus (Pa) of a generalised Kelvin chain at a frequency (Hz)."""
    s = 2j * math.pi * frequency
    units = zip(law["E"], law["C"])
    return 1 / (1 / law["E_m"] + 1 / (law["C_m"] * s) + sum(1 / (e + c * s) for e, c in units))


def made():
    """Returns the text of the file."""
    scene = tomllib.loads(SCENE.read_text(encoding="utf-8"))
    law = next(contact for contact in scene["contacts"] if contact["pair"] == "M-M")
    lines = ["# Written by scripts/documents from examples/mastic/scene.toml", "frequency_hz,modulus_gpa,phase_deg"]
    for frequency in scene["loading"]["frequencies"]:
        k = modulus(law, frequency)
        lines.append(f"{frequency:g},{1e-9 * abs(k):.7g},{math.degrees(cmath.phase(k)):.7g}")
    return {"bench/results/mastic-contact.csv": "\n".join(lines) + "\n"}
