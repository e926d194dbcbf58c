# SPDX-License-Identifier: GPL-3.0-or-later
"""Predictions of |E*| by two published regressions, to be shown beside the computed modulus. They are fitted to tests
of other mixtures; neither is a measurement.

Hirsch: D. W. Christensen, T. Pellinen, R. F. Bonaquist, Journal of the Association of Asphalt Paving Technologists 72
(2003). Witczak 1-37A: the dynamic modulus equation of the NCHRP Project 1-37A guide (2004)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

PSI = 6894.757293168  # Pa
_ROCK = 4.2e6  # psi, modulus of the aggregate in the Hirsch model


def hirsch(shear_modulus, vma: float, vfa: float):
    """Returns |E*| [Pa] and phase [degrees] of the Hirsch model.

    shear_modulus: |G*| of the binder [Pa], a number or an array. vma: voids in the mineral aggregate, fraction of the
    mixture's volume. vfa: fraction of these voids that binder fills."""
    g, vma, vfa = 3 * np.asarray(shear_modulus, float) / PSI, 100 * vma, 100 * vfa
    of_binder = g * vfa / vma
    contact = (20 + of_binder) ** 0.58 / (650 + of_binder**0.58)
    parallel = _ROCK * (1 - vma / 100) + g * vfa * vma / 1e4
    series = 1 / ((1 - vma / 100) / _ROCK + vma / (g * vfa))
    log = np.log10(contact)
    return PSI * (contact * parallel + (1 - contact) * series), -21 * log**2 - 55 * log


@dataclass
class Retained:
    """Gradation in the terms of the Witczak equation, in % of the aggregate's mass: retained on the sieves of 19 mm
    (3/4 in), 9.5 mm (3/8 in) and 4.75 mm (No. 4), and passing 0.075 mm (No. 200)."""

    on_19: float
    on_9_5: float
    on_4_75: float
    filler: float


def retained(gradation: list[tuple[float, float]]) -> Retained:
    """Returns the gradation at the sieves of the Witczak equation. gradation: (sieve [m], passing fraction), coarsest
    first; between two sieves the passing is interpolated over the logarithm of the size, below the finest sieve it
    falls to 0 in proportion to the size."""
    sizes = np.log([s for s, _ in gradation][::-1])
    passing = np.array([p for _, p in gradation][::-1])

    def at(size: float) -> float:
        finest, least = gradation[-1]
        if size < finest:
            return 100 * least * size / finest
        return 100 * float(np.interp(np.log(size), sizes, passing))

    return Retained(100 - at(0.019), 100 - at(0.0095), 100 - at(0.00475), at(75e-6))


def viscosity(shear_modulus, phase):
    """Returns the viscosity of a binder [Pa s] from |G*| [Pa] and phase [degrees] at 10 rad/s, by the Cox–Merz relation
    with the exponent of the NCHRP 1-37A guide: η = |G*|/10 · (1/sin δ)^4.8628."""
    return np.asarray(shear_modulus, float) / 10 * (1 / np.sin(np.radians(phase))) ** 4.8628


def witczak(frequency, eta, mix: Retained, air_voids: float, effective_binder: float):
    """Returns |E*| [Pa] of the Witczak 1-37A equation.

    frequency: [Hz]. eta: viscosity of the binder at the temperature of the test [Pa s]. air_voids, effective_binder:
    fractions of the mixture's volume."""
    air, binder = 100 * air_voids, 100 * effective_binder
    poise6 = np.asarray(eta, float) * 10 / 1e6  # 10^6 poise
    low = (
        3.750063
        + 0.02932 * mix.filler
        - 0.001767 * mix.filler**2
        - 0.002841 * mix.on_4_75
        - 0.058097 * air
        - 0.802208 * binder / (binder + air)
    )
    rise = 3.871977 - 0.0021 * mix.on_4_75 + 0.003958 * mix.on_9_5 - 0.000017 * mix.on_9_5**2 + 0.00547 * mix.on_19
    return PSI * 10 ** (
        low + rise / (1 + np.exp(-0.603313 - 0.313351 * np.log10(frequency) - 0.393532 * np.log10(poise6)))
    )
