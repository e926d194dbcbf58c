# SPDX-License-Identifier: GPL-3.0-or-later
"""Computes the scatter between specimens of one mix: mean and standard deviation over runs of one scene with several
seeds."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from macadam.report.modulus import Curve


@dataclass
class Seeds:
    """Means over seeds: frequencies [Hz], |E*| [Pa], phase [degrees], and their standard deviations."""

    label: str
    frequency: np.ndarray
    e_star: np.ndarray
    e_scatter: np.ndarray
    phase: np.ndarray
    phase_scatter: np.ndarray


def scatter(curves: list[Curve]) -> list[Seeds]:
    """Returns one entry for each scene, method and temperature that was run with two seeds or more at the same
    frequencies."""
    groups: dict[tuple, list[Curve]] = {}
    for c in curves:
        s = c.folder.summary
        if s.get("scene") and s.get("specimen", {}).get("seed") is not None:
            method = (s.get("solver") or {}).get("method")
            groups.setdefault((s["scene"], method, c.temperature, tuple(c.frequency)), []).append(c)
    found = []
    for (_, _, temperature, frequency), of in groups.items():
        if len({c.folder.summary["specimen"]["seed"] for c in of}) < max(2, len(of)):
            # there is a single seed, or one seed occurs twice, so not all of the runs are of different specimens
            continue
        e_star, phase = np.array([c.e_star for c in of]), np.array([c.phase for c in of])
        at = "" if temperature is None else f", {temperature:g} °C"
        found.append(
            Seeds(
                f"mean of {len(of)} seeds{at}",
                np.array(frequency),
                e_star.mean(0),
                e_star.std(0, ddof=1),
                phase.mean(0),
                phase.std(0, ddof=1),
            )
        )
    return found
