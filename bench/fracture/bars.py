# SPDX-License-Identifier: GPL-3.0-or-later
"""The bars of bench/fracture/run: largest relative difference between a computed value and theory.

The bars of the strip and of the size effect were set before the first run. The others were set after first runs, so
that a change of the results is found; they do not follow from rounding. They allow for the lattice: a crack needs up
to a few per cent more load to pass from facet to facet if its cohesive zone has only a few facets, and less if the
zone is not small beside the notch."""

# check: value, theory, bar
BARS = {
    "strip": ("stress_pa", "stress_theory_pa", 0.03),
    "griffith": ("strength_pa", "strength_theory_pa", 0.06),
    "half-disc": ("load_n", "load_theory_n", 0.05),
    "disc": ("strength_pa", "strength_theory_pa", 0.05),
}
SIZE_EFFECT = 0.1  # fracture energy of the regression beside the dissipated energy


def line(points):
    """Returns intercept and slope of the straight line through points (x, y), by least squares."""
    n, sx, sy = len(points), sum(x for x, _ in points), sum(y for _, y in points)
    slope = (n * sum(x * y for x, y in points) - sx * sy) / (n * sum(x * x for x, _ in points) - sx * sx)
    return (sy - slope * sx) / n, slope


def size_effect(table):
    """Returns a row with the fracture energy of the regression of 1/strength^2 over the width and the energy that the
    cracks of the largest plate dissipate, in J/m2. Large plates have the slope 1/(strength_theory^2 width), which is
    proportional to 1/G_f."""
    _, slope = line([(float(row["width_mm"]), float(row["strength_pa"])**-2) for row in table])
    last = table[-1]
    theory = float(last["strength_theory_pa"])**-2 / float(last["width_mm"])
    return {"energy_j_m2": round(float(last["fracture_energy_j_m2"]) * theory / slope, 6),
            "dissipated_j_m2": float(last["dissipated_j_m2"]),
            **{key: last[key] for key in ("date", "commit", "machine")}}


def missed(check, table):
    """Returns a message for each value of a table that misses its bar."""
    out = []
    if check == "size":
        effect = size_effect(table)
        found, dissipated = effect["energy_j_m2"], effect["dissipated_j_m2"]
        if abs(found / dissipated - 1) > SIZE_EFFECT:
            out.append(f"size: G_f of the size effect is {found:.4g} J/m2, expected {dissipated:.4g} within "
                       f"{SIZE_EFFECT:.0%}")
    if check in BARS:
        value, theory, bar = BARS[check]
        for n, row in enumerate(table, 1):
            found, expected = float(row[value]), float(row[theory])
            if abs(found / expected - 1) > bar:
                out.append(f"{check}, row {n}: {value} is {found:.5g}, expected {expected:.5g} within {bar:.0%}")
    return out
