# SPDX-License-Identifier: GPL-3.0-or-later
"""Young's modulus of networks with rule "series" is within the bounds of Hashin and Shtrikman, which hold for every
isotropic material of two phases, whatever its geometry."""

import numpy as np
import pytest
from macadam.mixture.stiffening import bounds, bulk_and_shear

import macadam as mc

ROCK = 60e9
# The bounds hold for an isotropic material, and a small specimen is not exactly isotropic. The bounds are closest at a
# ratio of moduli of 2. There the moduli of the seeds in bench/results/bounds.csv differ by up to 0.16 %, in boxes with 2.7
# times the volume of the boxes here.
TOLERANCE = 0.005


def scene(content, ratio, poisson, seed):
    """Returns the scene of a small specimen with this fraction of rock. poisson: Poisson's ratios of mastic and rock."""
    return mc.Scene(
        {
            "specimen": {
                "box": [0.009, 0.009, 0.012],
                "seed": seed,
                "aggregate": [
                    {"sieve": [0.002, 0.004], "volume_fraction": 0.7 * content},
                    {"sieve": [0.001, 0.002], "volume_fraction": 0.3 * content},
                ],
                "mastic": {"radius": [0.00045, 0.0006], "porosity": 0.0},
            },
            "network": {"rule": "series"},
            "materials": {
                "aggregate": {"density": 2630, "law": "elastic", "E": ROCK, "poisson_ratio": poisson[1]},
                "mastic": {"density": 2110, "law": "elastic", "E": ROCK / ratio, "poisson_ratio": poisson[0]},
            },
            "loading": {"kind": "cyclic", "frequencies": [1.0]},
            "solver": {"method": "harmonic", "backend": "cpu"},
        }
    )


@pytest.mark.parametrize("seed", range(1, 9))
def test_young_s_modulus_is_within_the_bounds(seed):
    random = np.random.default_rng(seed)
    content, poisson = random.uniform(0.1, 0.55), (random.uniform(0, 0.45), random.uniform(0, 0.3))
    for ratio in (2.0, 10 ** random.uniform(0.3, 4), 1e4):
        found = mc.harmonic(scene(content, ratio, poisson, seed)).summary
        rock = found["volume_fractions"]["aggregate_cells"]
        modulus = found["results"][0]["e_star_pa"] / (ROCK / ratio)
        # a network with rule "series" has Poisson's ratio 0 in each phase; only films use the ratios of the scene
        for nu, nu_rock in ((0.0, 0.0), poisson):
            mastic, aggregate = bulk_and_shear(1.0, nu), bulk_and_shear(ratio, nu_rock)
            if mastic[0] > aggregate[0]:
                continue  # the expressions are bounds only if the rock has the larger bulk and shear modulus
            low, high = bounds([(1 - rock, *mastic), (rock, *aggregate)])
            assert (1 - TOLERANCE) * low < modulus < (1 + TOLERANCE) * high, (seed, rock, ratio, nu)
