# SPDX-License-Identifier: GPL-3.0-or-later
"""Moduli of a matrix with spherical inclusions: rules for filler in binder, and the bounds of Hashin and Shtrikman.

Moduli are in Pa, real or complex. By the correspondence principle the rules hold for complex moduli at one frequency;
the bounds hold for real moduli only. c is the volume fraction of the inclusions, 0 to below 1."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

RULES = ("nielsen", "hashin_shtrikman", "differential")
MAXIMUM_PACKING = 0.63  # packing fraction of randomly packed equal spheres; parameter of rule "nielsen"


def bulk_and_shear(young, poisson: float):
    """Returns bulk and shear modulus of a material with this Young's modulus and Poisson's ratio."""
    return young / (3 * (1 - 2 * poisson)), young / (2 * (1 + poisson))


def young_of(bulk, shear):
    """Returns Young's modulus of a material with this bulk and shear modulus."""
    return 9 * bulk * shear / (3 * bulk + shear)


def nielsen(matrix, inclusion, c: float, poisson: float, maximum_packing: float = MAXIMUM_PACKING):
    """Returns bulk and shear modulus by the equations of Lewis and Nielsen for spheres:
    G/G_m = (1 + A·B·c)/(1 − B·ψ·c), A = (7 − 5ν)/(8 − 10ν), B = (G_i/G_m − 1)/(G_i/G_m + A), ψ = 1 + c·(1 − φ_m)/φ_m².
    The bulk modulus is that of `hashin_shtrikman`. matrix, inclusion: (bulk, shear). poisson: of the matrix."""
    a = (7 - 5 * poisson) / (8 - 10 * poisson)
    ratio = inclusion[1] / matrix[1]
    b = (ratio - 1) / (ratio + a)
    psi = 1 + c * (1 - maximum_packing) / maximum_packing**2
    return hashin_shtrikman(matrix, inclusion, c)[0], matrix[1] * (1 + a * b * c) / (1 - b * psi * c)


def hashin_shtrikman(matrix, inclusion, c: float):
    """Returns bulk and shear modulus of Hashin's and Shtrikman's expressions for inclusions in a matrix. With real
    moduli and a matrix softer than the inclusions they are the lower bounds of an isotropic material, with a stiffer
    matrix the upper bounds. matrix, inclusion: (bulk, shear)."""
    (k, g), (ki, gi) = matrix, inclusion
    bulk = k + c * (ki - k) / (1 + 3 * (1 - c) * (ki - k) / (3 * k + 4 * g))
    shear = g + c * (gi - g) / (1 + 6 * (1 - c) * (gi - g) * (k + 2 * g) / (5 * g * (3 * k + 4 * g)))
    return bulk, shear


def differential(matrix, inclusion, c: float, steps: int = 200):
    """Returns bulk and shear modulus of the differential scheme: small parts of inclusions are added to the material
    that has been made so far. The differential equations are integrated over −ln(1 − c) by the Runge–Kutta method of
    fourth order. matrix, inclusion: (bulk, shear)."""
    ki, gi = inclusion

    def rate(state):
        k, g = state
        f = g * (9 * k + 8 * g) / (6 * (k + 2 * g))
        return np.array([(ki - k) * (3 * k + 4 * g) / (3 * ki + 4 * g), (gi - g) * (g + f) / (gi + f)])

    state = np.array([matrix[0], matrix[1]]) + 0 * (np.asarray(ki) + gi)
    step = -np.log1p(-c) / steps
    for _ in range(steps):
        one = rate(state)
        two = rate(state + step / 2 * one)
        three = rate(state + step / 2 * two)
        state = state + step / 6 * (one + 2 * two + 2 * three + rate(state + step * three))
    return state[0], state[1]


def stiffened(
    rule: str,
    young,
    poisson: float,
    inclusion_young: float,
    inclusion_poisson: float,
    c: float,
    maximum_packing: float = MAXIMUM_PACKING,
):
    """Returns Young's modulus of a matrix with inclusions by one of RULES. young, poisson: of the matrix, whose modulus
    may be an array of complex moduli, one per frequency. c: volume fraction of the inclusions."""
    matrix = bulk_and_shear(np.asarray(young), poisson)
    inclusion = bulk_and_shear(inclusion_young, inclusion_poisson)
    if rule == "nielsen":
        return young_of(*nielsen(matrix, inclusion, c, poisson, maximum_packing))
    made: Callable = {"hashin_shtrikman": hashin_shtrikman, "differential": differential}[rule]
    return young_of(*made(matrix, inclusion, c))


def bounds(phases: Sequence[tuple[float, float, float]]) -> tuple[float, float]:
    """Returns the lower and the upper bound of Young's modulus of an isotropic material, after Hashin and Shtrikman
    and, for more than two phases, Walpole. phases: (volume fraction, bulk, shear), real moduli; a void has the moduli
    0, with which the lower bound is 0."""
    total = sum(c for c, _, _ in phases)

    def mean(values: Sequence[float], comparison: float) -> float:
        if any(v + comparison == 0 for v in values):
            return 0.0
        return 1 / sum(c / total / (v + comparison) for (c, _, _), v in zip(phases, values)) - comparison

    found = []
    for choose in (min, max):
        k, g = choose(p[1] for p in phases), choose(p[2] for p in phases)
        zeta = g * (9 * k + 8 * g) / (6 * (k + 2 * g)) if g > 0 else 0.0
        bulk, shear = mean([p[1] for p in phases], 4 * g / 3), mean([p[2] for p in phases], zeta)
        found.append(young_of(bulk, shear) if bulk > 0 and shear > 0 else 0.0)
    return found[0], found[1]
