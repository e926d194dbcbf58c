# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests bench/continuum against exact solutions: a homogeneous bar, and two layers in parallel and in series.

usage: continuum_test.py PROGRAM; exit code 1 if something is wrong."""
import cmath
import csv
import math
import subprocess
import sys

# The solver stops when the residual is 1e-8 of the first residual. The modulus follows from the energy, whose relative
# error is the square of this number, 1e-16. So the tolerance only has to cover the rounding to the ten printed digits.
TOLERANCE = 1e-9
MASTIC, PHASE, ROCK = 4e9, 30.0, 60e9


def computed(layers, mastic_poisson, rock, rock_phase, rock_poisson):
    """Returns the complex moduli and Poisson's ratios of both mixing rules. The surfaces between layers lie between
    voxels here."""
    out = subprocess.run([sys.argv[1], "--layers", layers, "--box", "0.004", "0.004", "0.008", "--voxel", "0.001", "--mastic",
                          str(MASTIC), str(PHASE), str(mastic_poisson), "--rock", str(rock), str(rock_phase), str(rock_poisson)],
                         capture_output=True, text=True, check=True).stdout
    return [(cmath.rect(float(row["e_star_pa"]), math.radians(float(row["phase_deg"]))), float(row["poisson_ratio"]))
            for row in csv.DictReader(out.splitlines())]


def main():
    soft = cmath.rect(MASTIC, math.radians(PHASE))
    cases = [  # name, arguments, exact modulus, exact Poisson's ratio
        ("homogeneous", ("z", 0.3, MASTIC, PHASE, 0.3), soft, 0.3),
        ("in parallel", ("x", 0.3, ROCK, 0, 0.3), (soft + ROCK) / 2, 0.3),  # equal lateral strains: no stress between layers
        ("in series", ("z", 0, ROCK, 0, 0), 2 / (1 / soft + 1 / ROCK), 0),
    ]
    wrong = 0
    for name, arguments, modulus, poisson in cases:
        results = computed(*arguments)
        if len(results) != 2:
            print(f"{name}: {len(results)} results, expected 2")
            wrong += 1
        for found, ratio in results:
            # phases are printed to 1e-6 degrees, which is 1.7e-8 rad
            if abs(abs(found) / abs(modulus) - 1) > TOLERANCE or abs(cmath.phase(found / modulus)) > 2e-8 or \
                    abs(ratio - poisson) > 1e-7:
                print(f"{name}: found {found} and {ratio}, expected {modulus} and {poisson}")
                wrong += 1
    return wrong > 0


if __name__ == "__main__":
    sys.exit(main())
