# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the scene of one specimen of one scale."""

from __future__ import annotations

import math
from typing import Any

from macadam.mixture.design import Design
from macadam.mixture.laws import Law
from macadam.mixture.scales import Scale
from macadam.mixture.volumes import Part


def scene_of(
    design: Design,
    scale: Scale,
    part: Part,
    law: Law,
    poisson: float,
    seed: int,
    frequencies: list[float],
    rule: str = "series",
) -> dict[str, Any]:
    """Returns the scene of a specimen: a sweep over reduced frequencies [Hz] at the reference temperature, solved
    without time steps.

    part: the aggregate of the specimen. law, poisson: of its mastic. rule: `rule` of `[network]`; "centres" is for
    tests of the chain of commands only, because its moduli depend on the discretisation."""
    air = part.recipe["air_voids"]
    specimen: dict[str, Any] = {
        "box": scale.box,
        "seed": seed,
        "size_law": scale.size_law,
        "recipe": {k: v for k, v in part.recipe.items() if v is not None},
        "mastic": {"radius": scale.radius},
    }
    if air > 0:
        specimen["voids"] = {"radius": scale.void_radius or scale.radius}
    if scale.shapes:
        specimen["shapes"] = scale.shapes
    mastic, rock = law.keys(), {"law": "elastic", "E": design.rock_modulus}
    if mastic["C_m"] == math.inf:
        del mastic["C_m"]
    scene: dict[str, Any] = {
        "specimen": specimen,
        "materials": {
            "aggregate": {**rock, "poisson_ratio": design.rock_poisson},
            "mastic": {**mastic, "poisson_ratio": poisson},
        },
        "network": {"rule": rule},
        "loading": {"kind": "sweep", "frequencies": frequencies},
        "solver": {"method": "harmonic"},
    }
    if "backend" in design.run:
        scene["solver"]["backend"] = design.run["backend"]
    if rule == "centres":
        laws = {"M-M": mastic, "M-A": mastic, "M-W": mastic, "A-A": rock, "inner": rock, "A-W": rock}
        scene["contacts"] = [{"pair": pair, **keys, "alpha": 1.0} for pair, keys in laws.items()]
        scene["network"], scene["materials"] = {}, {}
    return scene


def sweep_of(low: float, high: float, points_per_decade: int) -> list[float]:
    """Returns frequencies [Hz] from `low` to `high`, evenly spaced in the logarithm, both ends included."""
    number = max(2, math.ceil(math.log10(high / low) * points_per_decade - 1e-9) + 1)
    return [float(f"{low * (high / low) ** (k / (number - 1)):.9g}") for k in range(number)]
