# SPDX-License-Identifier: GPL-3.0-or-later
"""Marks of docs/voids.md, from voids.csv of bench/voids/run, which has one row per specimen and frequency."""
from pages.data import between, mean, minus, rows, table, where
from pages.marks import mark

DOCUMENT = "docs/voids.md"
FREQUENCIES = (2.0, 20.0)


def radii():
    return list(dict.fromkeys((r["radius_min_mm"], r["radius_max_mm"]) for r in rows("voids.csv")))


def fractions():
    return sorted({r["fraction"] for r in rows("voids.csv")})


def found(size, fraction, frequency):
    return where(rows("voids.csv"), radius_min_mm=size[0], radius_max_mm=size[1], fraction=fraction,
                 frequency_hz=frequency)


def over_none(size, fraction, frequency):
    """Returns the mean deviation of |E*| from that of the same seeds without voids, %."""
    none = {r["seed"]: r["e_star_pa"] for r in found(size, 0, frequency)}
    return mean(100 * (r["e_star_pa"] / none[r["seed"]] - 1) for r in found(size, fraction, frequency))


def turned(size, fraction, frequency):
    none = {r["seed"]: r["phase_deg"] for r in found(size, 0, frequency)}
    return mean(r["phase_deg"] - none[r["seed"]] for r in found(size, fraction, frequency))


@mark
def moduli():
    lines = []
    for size in radii():
        for f in fractions():
            of = [found(size, f, hz) for hz in FREQUENCIES]
            lines.append([f"{size[0]:g}–{size[1]:g}", f"{100 * f:.0f}", f"{mean(r['voids'] for r in of[0]):.0f}",
                          f"{100 * mean(r['void_cells'] for r in of[0]):.1f}"] +
                         [x for r, hz in zip(of, FREQUENCIES)
                          for x in (f"{1e-9 * mean(q['e_star_pa'] for q in r):.2f}",
                                    minus(f"{over_none(size, f, hz):+.1f}") if f else "",
                                    f"{mean(q['phase_deg'] for q in r):.2f}")])
    return table(["radius (mm)", "voids (%)", "number", "their cells (%)",
                  *(x for hz in FREQUENCIES for x in (f"\\|E\\*\\| at {hz:g} Hz (GPa)", "to none (%)", "φ (°)"))],
                 lines, range(1, 10))


@mark
def a_point():
    """Returns the loss of |E*| per percentage point of voids, up to the largest fraction, %."""
    most = fractions()[-1]
    return between([-over_none(s, most, hz) / (100 * most) for s in radii() for hz in FREQUENCIES], "{:.1f}") + " %"


@mark
def of_phase():
    most = fractions()[-1]
    return minus(between([turned(s, most, hz) for s in radii() for hz in FREQUENCIES], "{:+.2f}")) + "°"


@mark
def up_to():
    return f"voids of up to {100 * fractions()[-1]:g} % of the box"


@mark
def smallest_fraction():
    return f"{100 * fractions()[1]:g} %"


@mark
def first_points():
    """Returns the loss of |E*| per percentage point of voids, up to the smallest fraction, %."""
    least = fractions()[1]
    return between([-over_none(s, least, hz) / (100 * least) for s in radii() for hz in FREQUENCIES], "{:.1f}") + " %"


def risen():
    """Returns changes of the phase angle, each with the fraction of voids."""
    return [(turned(s, f, hz), f) for s in radii() for hz in FREQUENCIES for f in fractions()[1:]]


@mark
def most_phase():
    return f"{max(risen())[0]:.2f}°"


@mark
def most_phase_at():
    return f"{100 * max(risen())[1]:g} %"
