# SPDX-License-Identifier: GPL-3.0-or-later
"""Volumes of a mix design, and its division into scales: the recipe of each scale's specimen, the grains in its box,
and the size classes that are merged because they have less than one grain.

The volumes follow EN 12697-5 and EN 12697-8, as `[specimen.recipe]` of a scene does (docs/mix-design.md)."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

from macadam.mixture.units import millimetres


@dataclass
class Recipe:
    """A mix design by mass in SI units, fractions 0 to 1. gradation: (sieve, passing), coarsest first.
    aggregate_density: one value, or one per interval between two sieves."""

    gradation: list[tuple[float, float]]
    binder: float
    binder_of: str
    aggregate_density: list[float]
    binder_density: float
    filler_density: float | None = None
    absorbed_binder: float | None = None
    maximum_density: float | None = None
    air_voids: float | None = None
    bulk_density: float | None = None

    def density(self, interval: int) -> float:
        """Returns the density of the aggregate between the sieves `interval` and `interval` + 1, or of the filler for
        the last sieve."""
        if interval == len(self.gradation) - 1:
            return self.filler_density or self.aggregate_density[-1]
        return self.aggregate_density[interval if len(self.aggregate_density) > 1 else 0]

    def passing(self, sieve: float) -> float:
        """Returns the fraction of the aggregate's mass that passes a sieve of the gradation."""
        return self.gradation[index_of(self, sieve)][1]

    def masses(self) -> list[float]:
        """Returns the mass fractions of the aggregate: in each interval between two sieves, then of the filler."""
        passing = [p for _, p in self.gradation] + [0.0]
        return [a - b for a, b in zip(passing, passing[1:])]


@dataclass
class Volumes:
    """Volumes per 1 kg of mix [m³], and fractions of the bulk volume. classes: volume of each interval between two
    sieves, then of the filler."""

    classes: list[float]
    binder: float  # mass fraction of the mix
    effective_binder_mass: float
    absorbed: float  # fraction of the aggregate's mass
    effective_binder: float
    bulk: float
    air_voids: float
    maximum_density: float
    bulk_density: float

    @property
    def vma(self) -> float:
        """Voids in the mineral aggregate, fraction of the bulk volume."""
        return 1 - sum(self.classes) / self.bulk

    @property
    def vfa(self) -> float:
        """Fraction of the voids in the mineral aggregate that effective binder fills."""
        return (self.vma - self.air_voids) / self.vma

    @property
    def aggregate(self) -> float:
        """Aggregate, fraction of the bulk volume."""
        return sum(self.classes) / self.bulk

    def finer(self, first: int) -> float:
        """Returns the volume of all aggregate in the intervals from `first` on, the filler included."""
        return sum(self.classes[first:])


def volumes(recipe: Recipe) -> Volumes:
    """Returns the volumes of a mix design."""
    binder = recipe.binder if recipe.binder_of == "mix" else recipe.binder / (1 + recipe.binder)
    aggregate = 1 - binder
    classes = [aggregate * m / recipe.density(k) for k, m in enumerate(recipe.masses())]
    absorbed = aggregate * (recipe.absorbed_binder or 0)
    if recipe.maximum_density:
        absorbed = max(0.0, binder - recipe.binder_density * (1 / recipe.maximum_density - sum(classes)))
    effective = (binder - absorbed) / recipe.binder_density
    solid = sum(classes) + effective
    air = recipe.air_voids if recipe.air_voids is not None else max(0.0, 1 - (recipe.bulk_density or 0.0) * solid)
    return Volumes(
        classes,
        binder,
        binder - absorbed,
        absorbed / aggregate,
        effective,
        solid / (1 - air),
        air,
        1 / solid,
        (1 - air) / solid,
    )


def mean_grain(fine: float, coarse: float, size_law: str = "log_uniform") -> float:
    """Returns the mean volume [m³] of spheres with diameters between two sieves [m]."""
    a, b = fine, coarse
    cube = {
        "log_uniform": (b**3 - a**3) / (3 * math.log(b / a)),
        "uniform": (a + b) * (a * a + b * b) / 4,
        "volume_uniform": 2 * (b - a) / (a**-2 - b**-2),
    }[size_law]
    return math.pi / 6 * cube


@dataclass
class Part:
    """The part of a mix design that the specimen of one scale holds. recipe: its keys of `[specimen.recipe]`. c: volume
    fraction of the particles in the solid. grains: number of particles per class, by its two sieves [m]. merged:
    sentences about classes that were merged."""

    recipe: dict[str, Any]
    c: float
    grains: dict[tuple[float, float], float] = field(default_factory=dict)
    merged: list[str] = field(default_factory=list)


def index_of(recipe: Recipe, sieve: float) -> int:
    """Returns the index of a sieve of the gradation. Raises KeyError if the gradation has no such sieve."""
    for k, (size, _) in enumerate(recipe.gradation):
        if math.isclose(size, sieve, rel_tol=1e-9):
            return k
    raise KeyError(sieve)


def filler_fraction(recipe: Recipe, below: float) -> float:
    """Returns the volume fraction of the aggregate finer than a sieve in the mastic: this aggregate and the effective
    binder."""
    v = volumes(recipe)
    fine = v.finer(index_of(recipe, below))
    return fine / (fine + v.effective_binder)


def part_of(
    recipe: Recipe, lower: float, upper: float, box_volume: float, with_air: bool, size_law: str = "log_uniform"
) -> Part:
    """Returns the part of a mix design between two sieves of its gradation, in all effective binder and all finer
    aggregate. with_air: whether it has the air voids of the design; the scales below the mixture have none. Classes
    with less volume than their smallest grain are merged with the next."""
    v = volumes(recipe)
    first, last = index_of(recipe, upper), index_of(recipe, lower)
    air = v.air_voids if with_air else 0.0
    solid = v.finer(first) + v.effective_binder
    kept = recipe.masses()[first:]
    share = sum(kept)
    passing = [sum(kept[k:]) / share for k in range(len(kept))]
    sieves = [s for s, _ in recipe.gradation[first:]]
    densities = [recipe.density(k) for k in range(first, len(recipe.gradation) - 1)]
    part = Part({}, sum(v.classes[first:last]) / solid)
    of_box = [c / solid * (1 - air) * box_volume for c in v.classes[first:last]]
    _merge(sieves, passing, of_box, part.merged)
    for k, volume in enumerate(of_box):
        if volume > 0:
            part.grains[sieves[k + 1], sieves[k]] = volume / mean_grain(sieves[k + 1], sieves[k], size_law)
    # the coarsest sieve of a recipe passes everything; sieves above it hold nothing
    drop = max(k for k in range(len(passing)) if passing[k] >= 1 - 1e-12)
    sieves, passing, densities = sieves[drop:], passing[drop:], densities[drop:]
    mass = (1 - v.binder) * share
    part.recipe = {
        "gradation": [[s, 1.0 if k == 0 else p] for k, (s, p) in enumerate(zip(sieves, passing))],
        "cut": lower,
        "binder": (v.effective_binder_mass + v.absorbed * mass) / mass,
        "binder_of": "aggregate",
        "aggregate_density": densities if len(recipe.aggregate_density) > 1 else recipe.aggregate_density[0],
        "filler_density": recipe.filler_density,
        "binder_density": recipe.binder_density,
        "absorbed_binder": v.absorbed or None,
        "air_voids": air,
    }
    return part


def _merge(sieves: list[float], passing: list[float], of_box: list[float], said: list[str]) -> None:
    """Moves the material of every class that has less volume than its smallest grain to the next finer class, or to the
    next coarser class if there is no finer one. Changes `passing` and `of_box` [m³]; appends a sentence per class."""
    number = len(of_box)
    for k in range(number):
        smallest = math.pi / 6 * sieves[k + 1] ** 3
        if not 0 < of_box[k] < smallest or number == 1:
            continue
        finer = [j for j in range(k + 1, number)] or [j for j in range(k - 1, -1, -1) if of_box[j] > 0]
        if not finer:
            continue
        to = finer[0]
        said.append(
            f"The class {millimetres(sieves[k + 1])[:-3]}-{millimetres(sieves[k])} has {of_box[k] / smallest:.2g} of "
            "the volume of its smallest grain in this box; its material is merged with the class "
            f"{millimetres(sieves[to + 1])[:-3]}-{millimetres(sieves[to])}."
        )
        of_box[to] += of_box[k]
        of_box[k] = 0.0
        if to > k:
            passing[k + 1] = passing[k]
        else:
            for j in range(to + 1, k + 1):
                passing[j] = passing[k + 1]
