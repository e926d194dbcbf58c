# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks a design without computing specimens."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from typing import Any

from macadam.mixture import design as designs
from macadam.mixture import volumes
from macadam.mixture.binder import fit_binder, needed_range


def check(design: str | os.PathLike[str] | Mapping[str, Any], say: Callable[[str], object]) -> None:
    """Reads a design, fits its binder, and passes sentences on volumes, grains and ranges to `say`. Raises MixtureError
    for wrong input."""
    read = designs.read(design)
    for words in read.decisions:
        say(words)
    mix = volumes.volumes(read.recipe)
    say(
        f"Mix: maximum density {mix.maximum_density:.1f} kg/m3, air voids {100 * mix.air_voids:.2f} %, VMA "
        f"{100 * mix.vma:.2f} %, filled with binder {100 * mix.vfa:.1f} %."
    )
    found = fit_binder(read.binder, read.temperatures, read.frequencies)
    low, high = needed_range(found.model, read.temperatures, read.frequencies)
    say(
        f"Binder: rms errors {100 * found.errors[0]:.2g} % of |G*|, {found.errors[1]:.2g} degrees; measured from "
        f"{found.range[0]:.2g} to {found.range[1]:.2g} Hz at {read.binder.reference_temperature:g} °C; the test needs "
        f"{low:.2g} to {high:.2g} Hz."
    )
    for k, scale in enumerate(read.scales):
        if scale.rule:
            c = volumes.filler_fraction(read.recipe, scale.lower)
            say(f"Scale {scale.name}: rule {scale.rule}, {100 * c:.3g} % of its volume is aggregate.")
            continue
        part = volumes.part_of(
            read.recipe, scale.lower, scale.upper, scale.box_volume, k == len(read.scales) - 1, scale.size_law
        )
        for words in part.merged:
            say(f"Scale {scale.name}: {words}")
        say(
            f"Scale {scale.name}: {100 * part.c:.3g} % of the solid volume is aggregate, about "
            f"{sum(part.grains.values()):.0f} grains."
        )
