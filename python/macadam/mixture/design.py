# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads and checks the file of `macadam mixture` (docs/mixture.md)."""

from __future__ import annotations

import os
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from macadam.mixture import units
from macadam.mixture.errors import MixtureError
from macadam.mixture.scales import Scale, read_scales
from macadam.mixture.units import Section, millimetres, positive
from macadam.mixture.volumes import Recipe, volumes


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
    """Reads a design from a TOML file or a dictionary. Raises MixtureError that names file, key, value and
    expectation."""
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
    binder = _binder(
        Section(
            root.require("binder", "the section [binder]"),
            file,
            "[binder]",
            ("file", "bbr", "glass_modulus", "glass_modulus_std", "poisson_ratio", "reference_temperature"),
        ),
        folder,
        said,
    )
    test = Section(root.require("test", "the section [test]"), file, "[test]", ("temperatures", "frequencies", "box"))
    temperatures = test.numbers(
        "temperatures", units.TEMPERATURE, lambda v: -60 < v < 120, "temperatures from -60 to 120 °C"
    )
    frequencies = test.numbers("frequencies", units.FREQUENCY, positive, "positive frequencies")
    recipe = _recipe(root.require("recipe", "the section [recipe]"), file)
    rock = Section(root.table.get("aggregate", {}), file, "[aggregate]", ("E", "poisson_ratio"))
    modulus = rock.number("E", units.MODULUS, 60e9, lambda v: v >= 1e9, "a modulus of at least 1 GPa")
    if "E" not in rock:
        said.append("Aggregate: E = 60 GPa, because [aggregate] E is not given.")
    poisson = rock.number("poisson_ratio", {}, 0.25, lambda v: -1 < v < 0.5, "a ratio above -1 and below 0.5")
    scales = read_scales(root, file, folder, recipe, test, said)
    run = Section(root.table.get("run", {}), file, "[run]", ("workers", "backend"))
    if "workers" in run:
        run.number("workers", {}, None, lambda v: v >= 1 and v == int(v), "a whole number of at least 1")
    run.text("backend", ("auto", "cpu", "cuda"), "auto")
    return Design(
        file,
        str(root.table.get("title", "")),
        binder,
        temperatures,
        frequencies,
        recipe,
        modulus,
        poisson,
        scales,
        run.table,
        said,
    )


def _binder(section: Section, folder: Path, said: list[str]) -> Binder:
    def path(key: str) -> Path:
        file = folder / section.text(key)
        if not file.is_file():
            section.refuse(
                key, repr(str(section.table[key])), f"a table of measurements; the file {file} does not exist"
            )
        return file

    dsr, bbr = path("file"), path("bbr") if "bbr" in section else None
    glass = section.number(
        "glass_modulus", units.MODULUS, 1e9, lambda v: 1e8 <= v <= 1e10, "a shear modulus from 0.1 to 10 GPa"
    )
    std = section.number(
        "glass_modulus_std", units.FRACTION, 0.2, lambda v: 0 <= v <= 10, "a fraction of 0 or more; 0 holds the modulus"
    )
    poisson = section.number("poisson_ratio", {}, 0.45, lambda v: 0 <= v < 0.5, "a ratio from 0 to below 0.5")
    reference = section.number(
        "reference_temperature", units.TEMPERATURE, 20.0, lambda v: -60 < v < 120, "a temperature from -60 to 120 °C"
    )
    if "glass_modulus" not in section:
        said.append(
            f"Binder: glass modulus |G*| = 1 GPa with a standard deviation of {100 * std:g} %, because [binder] "
            "glass_modulus is not given."
        )
    if "poisson_ratio" not in section:
        said.append("Binder: Poisson's ratio 0.45, because [binder] poisson_ratio is not given.")
    return Binder(dsr, bbr, glass, std, poisson, reference)


def _recipe(table: Any, file: Path) -> Recipe:
    name = "[recipe]"
    section = Section(
        table,
        file,
        name,
        (
            "gradation",
            "binder",
            "binder_of",
            "aggregate_density",
            "filler_density",
            "binder_density",
            "absorbed_binder",
            "maximum_density",
            "air_voids",
            "bulk_density",
        ),
    )
    given = section.require("gradation", "a list of [sieve, passing]")
    if not isinstance(given, list) or len(given) < 2 or not all(isinstance(e, list) and len(e) == 2 for e in given):
        section.refuse("gradation", repr(given), "a list of two or more [sieve, passing]")
    curve = [
        (
            section.value("gradation", s, units.LENGTH, positive, "a positive size"),
            section.value("gradation", p, units.FRACTION, lambda v: 0 <= v <= 1, "a passing from 0 % to 100 %"),
        )
        for s, p in given
    ]
    if curve[0][1] != 1:
        section.refuse("gradation", f"{100 * curve[0][1]:g} % passing the coarsest sieve", "100 %")
    for (a, pa), (b, pb) in zip(curve, curve[1:]):
        if b >= a:
            section.refuse("gradation", f"{millimetres(b)} after {millimetres(a)}", "sieves from coarse to fine")
        if pb > pa:
            section.refuse(
                "gradation",
                f"{100 * pb:g} % passing {millimetres(b)} after {100 * pa:g} % passing {millimetres(a)}",
                "a passing that does not rise towards finer sieves",
            )
    of = section.text("binder_of", ("mix", "aggregate"))
    binder = section.number(
        "binder", units.FRACTION, None, lambda v: 0 < v < (1 if of == "mix" else 3), "a binder content above 0"
    )
    density: dict[str, Any] = {"expected": "a density from 200 to 10000 kg/m3", "rule": lambda v: 200 <= v <= 10_000}
    aggregate = section.require("aggregate_density", "a density, or a list with one per interval between two sieves")
    if isinstance(aggregate, list):
        aggregate = section.numbers(
            "aggregate_density", units.DENSITY, density["rule"], density["expected"], len(curve) - 1
        )
    else:
        aggregate = [section.number("aggregate_density", units.DENSITY, None, **density)]
    optional = {
        k: section.number(k, units.DENSITY, None, **density)
        for k in ("filler_density", "maximum_density", "bulk_density")
        if k in section
    }
    for key in ("absorbed_binder", "air_voids"):
        if key in section:
            optional[key] = section.number(
                key, units.FRACTION, None, lambda v: 0 <= v < 1, "a fraction from 0 % to below 100 %"
            )
    if ("air_voids" in optional) == ("bulk_density" in optional):
        section.refuse(
            "air_voids",
            "both air_voids and bulk_density" if "air_voids" in optional else "neither air_voids nor bulk_density",
            "exactly one of the two",
        )
    if "absorbed_binder" in optional and "maximum_density" in optional:
        section.refuse("absorbed_binder", "both absorbed_binder and maximum_density", "at most one of the two")
    recipe = Recipe(
        curve, binder, of, aggregate, section.number("binder_density", units.DENSITY, None, **density), **optional
    )
    v = volumes(recipe)
    if not 0 < v.effective_binder_mass:
        section.refuse(
            "binder",
            f"an effective binder of {100 * v.effective_binder_mass:.3g} % of the mix",
            "more binder than is absorbed",
        )
    return recipe
