# SPDX-License-Identifier: GPL-3.0-or-later
"""Computes one scale: by a stiffening rule, or by specimens with one seed each."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from macadam.mixture import volumes
from macadam.mixture.design import Design
from macadam.mixture.laws import Curve, Fitter, Law
from macadam.mixture.runs import Run, Runner
from macadam.mixture.scales import Scale
from macadam.mixture.scenes import scene_of
from macadam.mixture.stiffening import RULES, stiffened
from macadam.mixture.units import millimetres

_SMALL = 3.0  # ratio of the smallest edge of a box to the largest grain below which a warning is added


class Sentences(list):
    """A list of sentences that calls a function with each one that is added."""

    def __init__(self, say: Callable[[str], object], before: str = "") -> None:
        super().__init__()
        self._say, self._before = say, before

    def add(self, words: str) -> None:
        """Adds a sentence that is not yet in the list, and prints it."""
        if words not in self:
            self.append(words)
            self._say(self._before + words)


@dataclass
class Step:
    """The results of one scale. curves, laws: one per seed (one for binder and rule). poisson: Poisson's ratio of the
    material, which the next scale uses. facts: values for summary.json."""

    name: str
    kind: str
    curves: list[Curve]
    laws: list[Law]
    poisson: float
    facts: dict[str, Any] = field(default_factory=dict)

    @property
    def frequency(self) -> np.ndarray:
        """Reduced frequencies [Hz]."""
        return self.curves[0].frequency

    @property
    def e_star(self) -> np.ndarray:
        """Geometric mean of |E*| [Pa] over the seeds."""
        return np.exp(np.mean([np.log(c.e_star) for c in self.curves], axis=0))

    @property
    def phase(self) -> np.ndarray:
        """Mean phase [degrees] over the seeds."""
        return np.mean([c.phase for c in self.curves], axis=0)

    @property
    def e_scatter(self) -> np.ndarray:
        """Standard deviation of ln|E*| over the seeds; NaN for a single seed."""
        return _deviation([np.log(c.e_star) for c in self.curves])

    @property
    def phase_scatter(self) -> np.ndarray:
        """Standard deviation of the phase [degrees] over the seeds; NaN for a single seed."""
        return _deviation([c.phase for c in self.curves])


def _deviation(values: list[np.ndarray]) -> np.ndarray:
    if len(values) < 2:
        return np.full(len(values[0]), np.nan)
    return np.std(values, axis=0, ddof=1)


@dataclass
class Workshop:
    """Holds the data that every scale needs: the design, the functions that run and fit, the binder's shift as keys of
    a scene, the sentences so far, and the rule of `[network]`."""

    design: Design
    runner: Runner
    fitter: Fitter
    shift: dict[str, Any]
    decisions: Sentences
    warnings: Sentences
    progress: Callable[[str], object]
    rule: str


def by_rule(shop: Workshop, scale: Scale, before: Step) -> Step:
    """Computes the finest scale by its stiffening rule, and by the other rules for comparison. before: the binder."""
    design, binder = shop.design, before.curves[0]
    c = volumes.filler_fraction(design.recipe, scale.lower)
    every = {
        rule: stiffened(
            rule, binder.complex, before.poisson, design.rock_modulus, design.rock_poisson, c, scale.maximum_packing
        )
        for rule in RULES
    }
    curve = Curve.of(binder.frequency, every[scale.rule])
    ratio = {rule: abs(e) / binder.e_star for rule, e in every.items()}
    factors = np.concatenate([abs(e) / curve.e_star for rule, e in every.items() if rule != scale.rule])
    low, high, middle = float(factors.min()), float(factors.max()), len(binder.frequency) // 2
    others = ", ".join(f"{rule} {ratio[rule][middle]:.3g}" for rule in RULES if rule != scale.rule)
    shop.decisions.add(
        f"Scale {scale.name}: aggregate below {millimetres(scale.lower)} is {100 * c:.3g} % of its volume. The rule "
        f"{scale.rule} makes it {ratio[scale.rule][middle]:.3g} times as stiff as the binder at "
        f"{binder.frequency[middle]:.2g} Hz ({others}). The other rules would multiply |E*| of the {scale.name} by "
        f"{low:.2f} to {high:.2f}, and |E*| of the mixture by a factor nearer to 1."
    )
    facts = {
        "below_m": scale.lower,
        "rule": scale.rule,
        "filler_volume_fraction": c,
        "other_rules_factor": [low, high],
        "stiffening": [
            {"reduced_frequency_hz": float(binder.frequency[k]), **{rule: float(ratio[rule][k]) for rule in RULES}}
            for k in (0, middle, len(binder.frequency) - 1)
        ],
    }
    law = shop.fitter.fit(scale.name, curve, shop.shift)
    return Step(scale.name, "rule", [curve], [law], _poisson(scale, before), facts)


def by_specimens(shop: Workshop, scale: Scale, before: Step, frequencies: list[float], last: bool) -> Step:
    """Computes a scale by specimens, one per seed, at reduced frequencies [Hz]. The specimens use the laws of the seeds
    of the scale below in turn, so that the scatter over the seeds includes the scatter of the scale below. last:
    whether it is the mixture, which has the air voids and whose law nobody needs."""
    design = shop.design
    part = volumes.part_of(design.recipe, scale.lower, scale.upper, scale.box_volume, last, scale.size_law)
    _describe(shop, scale, part, last)
    laws = [before.laws[k % len(before.laws)] for k in range(len(scale.seeds))]
    made = [
        (seed, scene_of(design, scale, part, law, before.poisson, seed, frequencies, shop.rule))
        for seed, law in zip(scale.seeds, laws)
    ]
    runs = shop.runner.run(scale.name, made, shop.progress)
    for words in sorted({w for r in runs for w in r.summary.get("warnings") or []}):
        shop.warnings.add(f"Scale {scale.name}: {words}")
    step = Step(scale.name, "specimen", [r.curve for r in runs], [], _poisson(scale, before), _facts(scale, part, runs))
    if not last:
        names = [f"{scale.name}, seed {seed}" for seed in scale.seeds]
        with ThreadPoolExecutor(shop.runner.workers) as pool:
            step.laws = list(pool.map(lambda name, curve: shop.fitter.fit(name, curve, shop.shift), names, step.curves))
    return step


def _poisson(scale: Scale, before: Step) -> float:
    return before.poisson if scale.poisson_ratio is None else scale.poisson_ratio


def _describe(shop: Workshop, scale: Scale, part: volumes.Part, last: bool) -> None:
    """Adds sentences on the specimens of a scale."""
    for words in part.merged:
        shop.decisions.add(f"Scale {scale.name}: {words}")
    grains = ", ".join(f"{n:.0f} of {1e3 * a:g}-{1e3 * b:g} mm" for (a, b), n in part.grains.items())
    shop.decisions.add(
        f"Scale {scale.name}: {100 * part.c:.3g} % of the solid volume is aggregate, about "
        f"{sum(part.grains.values()):.0f} grains ({grains}) in a box of "
        f"{' x '.join(f'{1e3 * e:g}' for e in scale.box)} mm; {len(scale.seeds)} seed{'s' * (len(scale.seeds) > 1)}."
    )
    largest = max((b for _, b in part.grains), default=0.0)
    if min(scale.box) < _SMALL * largest:
        shop.warnings.add(
            f"Scale {scale.name}: the shortest edge of the box is {min(scale.box) / largest:.3g} times the largest "
            f"grain. Below {_SMALL:g} times, specimens differ much and their mean may be wrong."
        )
    if last and part.recipe["air_voids"] > 0:
        radius = scale.void_radius or scale.radius
        shop.decisions.add(
            f"Scale {scale.name}: the air voids, {100 * part.recipe['air_voids']:.3g} % of the volume, are voids with "
            f"radii of {1e3 * radius[0]:.3g} to {1e3 * radius[1]:.3g} mm, which carry no load."
        )


def _facts(scale: Scale, part: volumes.Part, runs: list[Run]) -> dict[str, Any]:
    """Returns the values of a scale of specimens for summary.json."""
    return {
        "sieves_m": [scale.lower, scale.upper],
        "box_m": scale.box,
        "radius_m": scale.radius,
        "seeds": scale.seeds,
        "aggregate_volume_fraction": part.c,
        "merged": part.merged,
        "grains": [{"sieve_m": [a, b], "number": n} for (a, b), n in part.grains.items()],
        "particles": [r.summary.get("particles") for r in runs],
        "volume_fractions": [r.summary.get("volume_fractions") or {} for r in runs],
        "solve_s": [(r.summary.get("timing_s") or {}).get("solve") for r in runs],
        "folders": [f"cache/results/{r.folder.name}" for r in runs],
    }
