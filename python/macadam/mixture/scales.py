# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads and checks the sections `[[scale]]` of a design."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from macadam.mixture import units
from macadam.mixture.errors import refuse
from macadam.mixture.stiffening import MAXIMUM_PACKING, RULES
from macadam.mixture.units import Section, millimetres, positive
from macadam.mixture.volumes import Recipe, index_of, part_of, volumes

_SIZE_LAWS = ("log_uniform", "uniform", "volume_uniform")
_NOMINAL = 0.98  # fraction of a scale's aggregate that passes the sieve from which a box is chosen
_SPHERES = 15_000  # number of mastic spheres for which radii that the design does not give are chosen


@dataclass
class Scale:
    """One scale. `rule` is set for a stiffening rule of aggregate below `lower`; otherwise the scale is a specimen of
    the aggregate between the sieves `lower` and `upper` [m] in a box [m], with mastic spheres of these radii [m]."""

    name: str
    lower: float
    upper: float = 0.0
    rule: str = ""
    maximum_packing: float = MAXIMUM_PACKING
    box: list[float] = field(default_factory=list)
    radius: list[float] = field(default_factory=list)
    void_radius: list[float] | None = None
    seeds: list[int] = field(default_factory=list)
    poisson_ratio: float | None = None
    points_per_decade: int = 3
    size_law: str = "log_uniform"
    shapes: dict[str, Any] | None = None

    @property
    def box_volume(self) -> float:
        """Volume of the box [m³]."""
        return self.box[0] * self.box[1] * self.box[2]


def read_scales(root: Section, file: Path, folder: Path, recipe: Recipe, test: Section, said: list[str]) -> list[Scale]:
    tables = root.require("scale", "one or more sections [[scale]]")
    if not isinstance(tables, list) or not tables:
        refuse(file, "scale", repr(tables), "one or more sections [[scale]]")
    sections = [
        Section(
            t,
            file,
            f"[[scale]] number {k + 1},",
            (
                "name",
                "below",
                "rule",
                "maximum_packing",
                "sieves",
                "box",
                "radius",
                "void_radius",
                "seeds",
                "poisson_ratio",
                "points_per_decade",
                "size_law",
                "shapes",
            ),
        )
        for k, t in enumerate(tables)
    ]
    scales: list[Scale] = []
    names: set[str] = set()
    for k, section in enumerate(sections):
        last = k == len(sections) - 1
        name = section.text("name", None, f"scale{k + 1}")
        if not re.fullmatch(r"[A-Za-z0-9_-]+", name) or name in names or name == "binder":
            section.refuse(
                "name", repr(name), 'another name of letters, digits, "-" and "_" for each scale, not "binder"'
            )
        names.add(name)
        below = scales[-1] if scales else None
        if "rule" in section:
            scales.append(_rule(section, name, recipe, k, last))
        else:
            scales.append(_specimen(section, name, recipe, below, last, test, folder, said))
    return scales


def _sieve(section: Section, key: str, value: float, recipe: Recipe) -> float:
    """Returns the sieve of the gradation that has this size. Raises MixtureError if the gradation has no such sieve."""
    try:
        return recipe.gradation[index_of(recipe, value)][0]
    except KeyError:
        sieves = ", ".join(f"{1e3 * s:g}" for s, _ in recipe.gradation)
        refuse(section.file, section.at(key), millimetres(value), f"a sieve of the gradation: {sieves} mm")


def _rule(section: Section, name: str, recipe: Recipe, k: int, last: bool) -> Scale:
    rule = section.text("rule", RULES)
    if k > 0 or last:
        section.refuse("rule", f'"{rule}" of scale {name}', "a rule only for the first scale, and a specimen after it")
    for key in ("sieves", "box", "radius", "void_radius", "seeds", "points_per_decade", "size_law", "shapes"):
        if key in section:
            section.refuse(key, "this key together with rule", "no such key, because a rule needs no specimen")
    below = _sieve(
        section,
        "below",
        section.number("below", units.LENGTH, None, positive, "the sieve below which the rule holds"),
        recipe,
    )
    packing = section.number(
        "maximum_packing", units.FRACTION, MAXIMUM_PACKING, lambda v: 0.3 <= v < 1, "a fraction from 0.3 to below 1"
    )
    return Scale(name, below, rule=rule, maximum_packing=packing, poisson_ratio=_ratio(section))


def _ratio(section: Section) -> float | None:
    if "poisson_ratio" not in section:
        return None
    return section.number("poisson_ratio", {}, None, lambda v: 0 <= v < 0.5, "a ratio from 0 to below 0.5")


def _specimen(
    section: Section,
    name: str,
    recipe: Recipe,
    below: Scale | None,
    last: bool,
    test: Section,
    folder: Path,
    said: list[str],
) -> Scale:
    for key in ("below", "maximum_packing"):
        if key in section:
            section.refuse(key, "this key without rule", "no such key; a specimen has sieves")
    sieves = section.numbers(
        "sieves", units.LENGTH, positive, "the finest and the coarsest sieve of the specimen's aggregate", 2
    )
    lower, upper = (_sieve(section, "sieves", s, recipe) for s in sieves)
    if lower >= upper:
        section.refuse("sieves", f"{millimetres(lower)} and {millimetres(upper)}", "the finer sieve first")
    if below and lower != (below.upper or below.lower):
        section.refuse(
            "sieves", millimetres(lower), f"{millimetres(below.upper or below.lower)}, where scale {below.name} ends"
        )
    held = recipe.passing(upper) - recipe.passing(lower)
    if held <= 0:
        section.refuse(
            "sieves", f"no aggregate between {millimetres(lower)} and {millimetres(upper)}", "some aggregate"
        )
    if last and recipe.passing(upper) < 1:
        above = f"{millimetres(upper)}, with {100 * (1 - recipe.passing(upper)):.3g} % of the aggregate above it"
        section.refuse("sieves", above, "a sieve that all aggregate passes, because this is the last scale")
    if below is None and recipe.passing(lower) > 0:
        section.refuse(
            "sieves",
            f"{millimetres(lower)}, with {100 * recipe.passing(lower):.3g} % of the aggregate below it",
            "a first [[scale]] with a rule for this aggregate",
        )
    scale = Scale(name, lower, upper, poisson_ratio=_ratio(section))
    scale.seeds = _seeds(section)
    scale.size_law = section.text("size_law", _SIZE_LAWS, "log_uniform")
    scale.points_per_decade = int(
        section.number("points_per_decade", {}, 3, lambda v: v in range(1, 21), "a whole number from 1 to 20")
    )
    _set_box(section, scale, recipe, test if last else None, said)
    if "radius" in section:
        scale.radius = section.numbers("radius", units.LENGTH, positive, "the smallest and the largest radius", 2)
        if scale.radius[0] > scale.radius[1]:
            section.refuse("radius", repr(section.table["radius"]), "the smaller radius first")
    else:
        scale.radius = _radii(scale, recipe)
        said.append(
            f"Scale {name}: mastic spheres of {1e3 * scale.radius[0]:.3g} to {1e3 * scale.radius[1]:.3g} mm, because "
            "no radius is given: 0.37 of the finest sieve in the mean, or more if the box would hold more than "
            f"{_SPHERES:,} spheres."
        )
    if "void_radius" in section:
        if not last:
            section.refuse("void_radius", "this key", "no such key, because only the last scale has air voids")
        scale.void_radius = section.numbers(
            "void_radius", units.LENGTH, positive, "the smallest and the largest radius", 2
        )
    if "shapes" in section:
        scale.shapes = dict(
            Section(
                section.table["shapes"],
                section.file,
                section.at("shapes"),
                (
                    "library",
                    "radius",
                    "porosity",
                    "least",
                    "single",
                    "placement",
                    "allow_short",
                    "test",
                    "hold_out",
                    "gap",
                ),
            ).table
        )
        library = scale.shapes.get("library")
        if isinstance(library, str) and (folder / library).is_dir():
            scale.shapes["library"] = str((folder / library).resolve())
    return scale


def _set_box(section: Section, scale: Scale, recipe: Recipe, test: Section | None, said: list[str]) -> None:
    """Sets the box of a scale, and checks that its largest grain fits. test: the section [test] for the last scale."""
    edges: dict[str, Any] = {"expected": "three edges above 0", "rule": positive, "size": 3}
    if "box" in section:
        scale.box = section.numbers("box", units.LENGTH, **edges)
    elif test is not None and "box" in test:
        scale.box = test.numbers("box", units.LENGTH, **edges)
    else:
        most = recipe.passing(scale.lower) + _NOMINAL * (recipe.passing(scale.upper) - recipe.passing(scale.lower))
        largest = min(s for s, p in recipe.gradation if scale.lower < s <= scale.upper and p >= most)
        scale.box = [4 * largest, 4 * largest, 6 * largest]
        said.append(
            f"Scale {scale.name}: box of {' x '.join(f'{1e3 * e:g}' for e in scale.box)} mm, because no box is given: "
            f"4 x 4 x 6 times the sieve that {100 * _NOMINAL:g} % of its aggregate pass."
        )
    part = part_of(recipe, scale.lower, scale.upper, scale.box_volume, test is not None, scale.size_law)
    largest = max(coarse for _, coarse in part.grains)
    if min(scale.box) < largest:
        expected = f"at least the largest grain, {millimetres(largest)}"
        section.refuse("box", f"an edge of {millimetres(min(scale.box))}", expected)


def _seeds(section: Section) -> list[int]:
    given = section.table.get("seeds", 3)
    seeds = (
        list(range(1, given + 1))
        if isinstance(given, int) and not isinstance(given, bool) and 0 < given <= 1000
        else given
    )
    whole = (
        isinstance(seeds, list)
        and seeds
        and all(isinstance(s, int) and not isinstance(s, bool) and s >= 0 for s in seeds)
    )
    if not whole or len(set(seeds)) < len(seeds):
        section.refuse("seeds", repr(given), "a number of seeds, or a list of different whole numbers")
    return seeds


def _radii(scale: Scale, recipe: Recipe) -> list[float]:
    """Returns the radii of mastic spheres for a scale whose design gives none."""
    v = volumes(recipe)
    first, last = index_of(recipe, scale.upper), index_of(recipe, scale.lower)
    mastic = 1 - sum(v.classes[first:last]) / (v.finer(first) + v.effective_binder)
    volume = mastic * scale.box_volume
    mean = max(0.37 * scale.lower, (3 * volume / (4 * math.pi * _SPHERES)) ** (1 / 3))
    return [0.87 * mean, 1.13 * mean]
