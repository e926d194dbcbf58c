# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads and checks the file of `macadam mixture` (docs/mixture.md)."""

from __future__ import annotations

import math
import os
import re
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from macadam.mixture import units
from macadam.mixture.errors import MixtureError, refuse
from macadam.mixture.stiffening import MAXIMUM_PACKING, RULES
from macadam.mixture.units import Section, millimetres, positive
from macadam.mixture.volumes import Recipe, index_of, volumes

_SIZE_LAWS = ("log_uniform", "uniform", "volume_uniform")
_SPHERES = 15_000  # number of mastic spheres for which radii that the design does not give are chosen


@dataclass
class Binder:
    """Data of the binder: paths of the DSR and the BBR table, shear modulus of its glass [Pa] with relative standard
    deviation (0: held), Poisson's ratio, reference temperature [°C]."""

    file: Path
    bbr: Path | None
    glass_modulus: float
    glass_modulus_std: float
    poisson_ratio: float
    reference_temperature: float


@dataclass
class Scale:
    """One scale. `rule` is set for a stiffening rule of aggregate below `lower`; otherwise the scale is a specimen of the
    aggregate between the sieves `lower` and `upper` [m] in a box [m], with mastic spheres of these radii [m]."""

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


@dataclass
class Design:
    """Everything that the file says. decisions: sentences about values that it leaves open."""

    file: Path
    title: str
    binder: Binder
    temperatures: list[float]
    frequencies: list[float]
    recipe: Recipe
    rock_modulus: float
    rock_poisson: float
    scales: list[Scale]
    run: dict[str, Any]
    decisions: list[str] = field(default_factory=list)


def read(design: str | os.PathLike[str] | Mapping[str, Any]) -> Design:
    """Reads a design from a TOML file or a dictionary. Raises MixtureError that names file, key, value and expectation."""
    if isinstance(design, Mapping):
        return _design(design, Path("design"), Path.cwd())
    file = Path(design)
    try:
        tables = tomllib.loads(file.read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError) as error:
        raise MixtureError(f"{file}: {getattr(error, 'strerror', None) or error}") from None
    return _design(tables, file, file.parent)


def _design(tables: Mapping[str, Any], file: Path, folder: Path) -> Design:
    root = Section(tables, file, "", ("title", "binder", "test", "recipe", "aggregate", "scale", "run"))
    said: list[str] = []
    binder = _binder(Section(root.require("binder", "the section [binder]"), file, "[binder]", (
        "file", "bbr", "glass_modulus", "glass_modulus_std", "poisson_ratio", "reference_temperature")), folder, said)
    test = Section(root.require("test", "the section [test]"), file, "[test]", ("temperatures", "frequencies", "box"))
    temperatures = test.numbers("temperatures", units.TEMPERATURE, lambda v: -60 < v < 120, "temperatures from -60 to 120 °C")
    frequencies = test.numbers("frequencies", units.FREQUENCY, positive, "positive frequencies")
    recipe = _recipe(root.require("recipe", "the section [recipe]"), file)
    rock = Section(root.table.get("aggregate", {}), file, "[aggregate]", ("E", "poisson_ratio"))
    modulus = rock.number("E", units.MODULUS, 60e9, lambda v: v >= 1e9, "a modulus of at least 1 GPa")
    if "E" not in rock:
        said.append("Aggregate: E = 60 GPa, because [aggregate] E is not given.")
    poisson = rock.number("poisson_ratio", {}, 0.25, lambda v: -1 < v < 0.5, "a ratio above -1 and below 0.5")
    scales = _scales(root, file, folder, recipe, test, said)
    run = Section(root.table.get("run", {}), file, "[run]", ("workers", "backend"))
    if "workers" in run:
        run.number("workers", {}, None, lambda v: v >= 1 and v == int(v), "a whole number of at least 1")
    run.text("backend", ("auto", "cpu", "cuda"), "auto")
    return Design(file, str(root.table.get("title", "")), binder, temperatures, frequencies, recipe, modulus, poisson, scales,
                  run.table, said)


def _binder(section: Section, folder: Path, said: list[str]) -> Binder:
    paths: list[Path | None] = []
    for key in ("file", "bbr"):
        if key == "bbr" and key not in section:
            paths.append(None)
            continue
        path = folder / section.text(key)
        if not path.is_file():
            section.refuse(key, repr(str(section.table[key])), f"a table of measurements; there is no file {path}")
        paths.append(path)
    glass = section.number("glass_modulus", units.MODULUS, 1e9, lambda v: 1e8 <= v <= 1e10, "a shear modulus from 0.1 to 10 GPa")
    std = section.number("glass_modulus_std", units.FRACTION, 0.2, lambda v: 0 <= v <= 10, "a fraction of 0 or more; 0 holds the modulus")
    poisson = section.number("poisson_ratio", {}, 0.45, lambda v: 0 <= v < 0.5, "a ratio from 0 to below 0.5")
    reference = section.number("reference_temperature", units.TEMPERATURE, 20.0, lambda v: -60 < v < 120, "a temperature from -60 to 120 °C")
    if "glass_modulus" not in section:
        said.append(f"Binder: glass modulus |G*| = 1 GPa with a standard deviation of {100 * std:g} %, because [binder] "
                    "glass_modulus is not given.")
    if "poisson_ratio" not in section:
        said.append("Binder: Poisson's ratio 0.45, because [binder] poisson_ratio is not given.")
    return Binder(paths[0], paths[1], glass, std, poisson, reference)


def _recipe(table: Any, file: Path) -> Recipe:
    name = "[recipe]"
    section = Section(table, file, name, ("gradation", "binder", "binder_of", "aggregate_density", "filler_density", "binder_density",
                                          "absorbed_binder", "maximum_density", "air_voids", "bulk_density"))
    given = section.require("gradation", "a list of [sieve, passing]")
    if not isinstance(given, list) or len(given) < 2 or not all(isinstance(e, list) and len(e) == 2 for e in given):
        section.refuse("gradation", repr(given), "a list of two or more [sieve, passing]")
    curve = [(section.value("gradation", s, units.LENGTH, positive, "a positive size"),
              section.value("gradation", p, units.FRACTION, lambda v: 0 <= v <= 1, "a passing from 0 % to 100 %")) for s, p in given]
    if curve[0][1] != 1:
        section.refuse("gradation", f"{100 * curve[0][1]:g} % passing the coarsest sieve", "100 %")
    for (a, pa), (b, pb) in zip(curve, curve[1:]):
        if b >= a:
            section.refuse("gradation", f"{millimetres(b)} after {millimetres(a)}", "sieves from coarse to fine")
        if pb > pa:
            section.refuse("gradation", f"{100 * pb:g} % passing {millimetres(b)} after {100 * pa:g} % passing {millimetres(a)}",
                           "a passing that does not rise towards finer sieves")
    of = section.text("binder_of", ("mix", "aggregate"))
    binder = section.number("binder", units.FRACTION, None, lambda v: 0 < v < (1 if of == "mix" else 3), "a binder content above 0")
    density = {"expected": "a density from 200 to 10000 kg/m3", "rule": lambda v: 200 <= v <= 10_000}
    aggregate = section.require("aggregate_density", "a density, or a list with one per interval between two sieves")
    if isinstance(aggregate, list):
        aggregate = section.numbers("aggregate_density", units.DENSITY, density["rule"], density["expected"], len(curve) - 1)
    else:
        aggregate = [section.number("aggregate_density", units.DENSITY, None, **density)]
    optional = {k: section.number(k, units.DENSITY, None, **density) for k in ("filler_density", "maximum_density", "bulk_density")
                if k in section}
    for key in ("absorbed_binder", "air_voids"):
        if key in section:
            optional[key] = section.number(key, units.FRACTION, None, lambda v: 0 <= v < 1, "a fraction from 0 % to below 100 %")
    if ("air_voids" in optional) == ("bulk_density" in optional):
        section.refuse("air_voids", "both air_voids and bulk_density" if "air_voids" in optional else "neither air_voids nor bulk_density",
                       "exactly one of the two")
    if "absorbed_binder" in optional and "maximum_density" in optional:
        section.refuse("absorbed_binder", "both absorbed_binder and maximum_density", "at most one of the two")
    recipe = Recipe(curve, binder, of, aggregate, section.number("binder_density", units.DENSITY, None, **density), **optional)
    v = volumes(recipe)
    if not 0 < v.effective_binder_mass:
        section.refuse("binder", f"an effective binder of {100 * v.effective_binder_mass:.3g} % of the mix", "more binder than is absorbed")
    return recipe


def _scales(root: Section, file: Path, folder: Path, recipe: Recipe, test: Section, said: list[str]) -> list[Scale]:
    tables = root.require("scale", "one or more sections [[scale]]")
    if not isinstance(tables, list) or not tables:
        refuse(file, "scale", repr(tables), "one or more sections [[scale]]")
    sections = [Section(t, file, f"[[scale]] number {k + 1},", (
        "name", "below", "rule", "maximum_packing", "sieves", "box", "radius", "void_radius", "seeds", "poisson_ratio",
        "points_per_decade", "size_law", "shapes")) for k, t in enumerate(tables)]
    scales: list[Scale] = []
    names: set[str] = set()
    for k, section in enumerate(sections):
        last = k == len(sections) - 1
        name = section.text("name", None, f"scale{k + 1}")
        if not re.fullmatch(r"[A-Za-z0-9_-]+", name) or name in names or name == "binder":
            section.refuse("name", repr(name), 'another name of letters, digits, "-" and "_" for each scale, not "binder"')
        names.add(name)
        below = scales[-1] if scales else None
        if "rule" in section:
            scales.append(_rule(section, name, recipe, k, last))
        else:
            scales.append(_specimen(section, name, recipe, below, last, test, folder, said))
    return scales


def _sieve(section: Section, key: str, value: float, recipe: Recipe) -> float:
    """Returns a sieve of the gradation that has this size. Raises MixtureError if there is none."""
    k = index_of(recipe, value)
    if k is None:
        section.refuse(key, millimetres(value), "a sieve of the gradation: " + ", ".join(f"{1e3 * s:g}" for s, _ in recipe.gradation) + " mm")
    return recipe.gradation[k][0]


def _rule(section: Section, name: str, recipe: Recipe, k: int, last: bool) -> Scale:
    rule = section.text("rule", RULES)
    if k > 0 or last:
        section.refuse("rule", f'"{rule}" of scale {name}', "a rule only for the first scale, and a specimen after it")
    for key in ("sieves", "box", "radius", "void_radius", "seeds", "points_per_decade", "size_law", "shapes"):
        if key in section:
            section.refuse(key, "this key together with rule", "no such key, because a rule needs no specimen")
    below = _sieve(section, "below", section.number("below", units.LENGTH, None, positive, "the sieve below which the rule holds"), recipe)
    packing = section.number("maximum_packing", units.FRACTION, MAXIMUM_PACKING, lambda v: 0.3 <= v < 1, "a fraction from 0.3 to below 1")
    return Scale(name, below, rule=rule, maximum_packing=packing, poisson_ratio=_ratio(section))


def _ratio(section: Section) -> float | None:
    if "poisson_ratio" not in section:
        return None
    return section.number("poisson_ratio", {}, None, lambda v: 0 <= v < 0.5, "a ratio from 0 to below 0.5")


def _specimen(section: Section, name: str, recipe: Recipe, below: Scale | None, last: bool, test: Section, folder: Path,
              said: list[str]) -> Scale:
    for key in ("below", "maximum_packing"):
        if key in section:
            section.refuse(key, "this key without rule", "no such key; a specimen has sieves")
    sieves = section.numbers("sieves", units.LENGTH, positive, "the finest and the coarsest sieve of the specimen's aggregate", 2)
    lower, upper = (_sieve(section, "sieves", s, recipe) for s in sieves)
    if lower >= upper:
        section.refuse("sieves", f"{millimetres(lower)} and {millimetres(upper)}", "the finer sieve first")
    if below and lower != (below.upper or below.lower):
        section.refuse("sieves", millimetres(lower), f"{millimetres(below.upper or below.lower)}, where scale {below.name} ends")
    coarsest = next(s for (s, _), (_, p) in zip(recipe.gradation, recipe.gradation[1:]) if p < 1)
    if last and upper < coarsest:
        section.refuse("sieves", millimetres(upper), f"{millimetres(coarsest)}, because the last scale holds the coarsest aggregate")
    scale = Scale(name, lower, upper, poisson_ratio=_ratio(section))
    largest = min(upper, coarsest)
    edges = {"expected": "three edges above 0", "rule": positive, "size": 3}
    if "box" in section:
        scale.box = section.numbers("box", units.LENGTH, **edges)
    elif last and "box" in test:
        scale.box = test.numbers("box", units.LENGTH, **edges)
    else:
        scale.box = [4 * largest, 4 * largest, 6 * largest]
        said.append(f"Scale {name}: box of {' x '.join(f'{1e3 * e:g}' for e in scale.box)} mm, four times the largest grain and half as "
                    "high again, because no box is given.")
    if min(scale.box) < largest:
        section.refuse("box", f"an edge of {millimetres(min(scale.box))}", f"at least the largest grain, {millimetres(largest)}")
    scale.seeds = _seeds(section)
    scale.size_law = section.text("size_law", _SIZE_LAWS, "log_uniform")
    scale.points_per_decade = int(section.number("points_per_decade", {}, 3, lambda v: v in range(1, 21), "a whole number from 1 to 20"))
    if "radius" in section:
        scale.radius = section.numbers("radius", units.LENGTH, positive, "the smallest and the largest radius", 2)
        if scale.radius[0] > scale.radius[1]:
            section.refuse("radius", repr(section.table["radius"]), "the smaller radius first")
    else:
        scale.radius = _radii(scale, recipe)
        said.append(f"Scale {name}: mastic spheres of {1e3 * scale.radius[0]:.3g} to {1e3 * scale.radius[1]:.3g} mm, because no radius is "
                    f"given: 0.37 of the finest sieve in the mean, or more if the box would hold more than {_SPHERES:,} spheres.")
    if "void_radius" in section:
        if not last:
            section.refuse("void_radius", "this key", "no such key, because only the last scale has air voids")
        scale.void_radius = section.numbers("void_radius", units.LENGTH, positive, "the smallest and the largest radius", 2)
    if "shapes" in section:
        scale.shapes = dict(Section(section.table["shapes"], section.file, section.at("shapes"), (
            "library", "radius", "porosity", "least", "single", "placement", "allow_short", "test", "hold_out", "gap")).table)
        library = scale.shapes.get("library")
        if isinstance(library, str) and (folder / library).is_dir():
            scale.shapes["library"] = str((folder / library).resolve())
    return scale


def _seeds(section: Section) -> list[int]:
    given = section.table.get("seeds", 3)
    seeds = list(range(1, given + 1)) if isinstance(given, int) and not isinstance(given, bool) and 0 < given <= 1000 else given
    whole = isinstance(seeds, list) and seeds and all(isinstance(s, int) and not isinstance(s, bool) and s >= 0 for s in seeds)
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
