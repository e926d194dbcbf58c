# SPDX-License-Identifier: GPL-3.0-or-later
"""Marks of docs/ct-twin.md, from ct-twin.csv of bench/ct/twin.py, which has one row per specimen and frequency."""
from pages.data import mean, minus, one, rows, table, where
from pages.marks import mark

DOCUMENT = "docs/ct-twin.md"
KINDS = {"truth": "twin of the truth", "segmented": "twin of the segmentation", "repacked": "another of the mixture"}
REPACKED = 1000  # offset of the seeds of repacked specimens, the same as in bench/ct/twin.py
CASES = ("whole", "sawn")


def sources(case, frequency):
    return where(rows("ct-twin.csv"), case=case, kind="source", frequency_hz=frequency)


def frequencies():
    return sorted({r["frequency_hz"] for r in rows("ct-twin.csv")})


def differences(case, kind, frequency, key):
    """Returns the differences of twins from their sources: of |E*| in %, of the phase angle in degrees."""
    out = []
    for source in sources(case, frequency):
        seed = source["seed"] + (REPACKED if kind == "repacked" else 0)
        r = one(rows("ct-twin.csv"), case=case, kind=kind, frequency_hz=frequency, seed=seed)
        out.append(100 * (r[key] / source[key] - 1) if key == "e_star_pa" else r[key] - source[key])
    return out


def rms(values):
    return mean(v * v for v in values) ** 0.5


def signed(values, digits):
    return minus(f"{mean(values):+.{digits}f}"), f"{rms(values):.{digits}f}", minus(
        f"{max(values, key=abs):+.{digits}f}")


def kinds():
    present = {r["kind"] for r in rows("ct-twin.csv")}
    return [k for k in KINDS if k in present]


@mark
def differences_table():
    lines = []
    for case in CASES:
        for hz in frequencies():
            for kind in kinds():
                lines.append([case, KINDS[kind], f"{hz:g}",
                              *signed(differences(case, kind, hz, "e_star_pa"), 2),
                              *signed(differences(case, kind, hz, "phase_deg"), 2)])
    return table(["specimen", "", "Hz", "\\|E\\*\\| (%): mean", "rms", "worst", "φ (°): mean", "rms", "worst"], lines,
                 range(2, 9))


@mark
def seeds(case):
    n = len(sources(case, frequencies()[0]))
    return f"{n} seed{'s' if n > 1 else ''}"


@mark
def worst(kind, key):
    """Returns the largest difference over all cases, seeds and frequencies."""
    values = [abs(d) for case in CASES for hz in frequencies() for d in differences(case, kind, hz, key)]
    return f"{max(values):.1f} %" if key == "e_star_pa" else f"{max(values):.2f}°"


@mark
def lower_frequency():
    return f"{frequencies()[0]:g} Hz"


@mark
def phase_difference(case):
    """Returns the mean difference over the seeds of the twins of the segmentation, and its standard error."""
    of = differences(case, "segmented", frequencies()[0], "phase_deg")
    error = (sum((d - mean(of)) ** 2 for d in of) / (len(of) - 1) / len(of)) ** 0.5
    if abs(mean(of)) > 2 * error:
        raise LookupError("the sentence says that the difference is not significant, and it is")
    return minus(f"{mean(of):+.2f} ± {error:.2f}°")


@mark
def stiffer(kind):
    """Returns the mean deviation of |E*| of twins of sawn specimens from that of their sources."""
    of = [d for hz in frequencies() for d in differences("sawn", kind, hz, "e_star_pa")]
    return minus(f"{mean(of):+.1f} %")
