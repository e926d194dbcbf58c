# SPDX-License-Identifier: GPL-3.0-or-later
"""95 % quantiles of Fisher's F and Student's t. SciPy has them too, but studies without hypercubes do not need it."""

from __future__ import annotations

import functools

import numpy as np

# Number of steps of the integration. The quantiles are then correct to five digits up to 10,000 degrees of freedom.
_INTERVALS = 200_000


@functools.lru_cache
def fisher_95(numerator: int, denominator: int) -> float:
    """Returns the number that the ratio of two mean squares exceeds with a probability of 5 % if both are mean squares
    of the same random deviations. numerator, denominator: their degrees of freedom, at least 1.

    If tan² of an angle between 0 and 90° is denominator / (numerator F), its density is proportional to
    sin^(denominator-1) cos^(numerator-1). This function integrates the density numerically. A large F is a small
    angle."""
    step = 0.5 * np.pi / _INTERVALS
    angle = (np.arange(_INTERVALS) + 0.5) * step
    logarithm = (denominator - 1) * np.log(np.sin(angle)) + (numerator - 1) * np.log(np.cos(angle))
    below = np.cumsum(np.exp(logarithm - logarithm.max()))
    found = np.interp(0.05 * below[-1], below, angle + 0.5 * step)
    return float(denominator / numerator / np.tan(found) ** 2)


def student_95(freedom: int) -> float:
    """Returns Student's t for a two-sided 95 % interval: 95 % of random differences are within this number of standard
    errors."""
    return fisher_95(1, freedom) ** 0.5
