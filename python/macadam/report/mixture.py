# SPDX-License-Identifier: GPL-3.0-or-later
"""Section of the report on the mix: its composition by volume and by mass, and its gradation."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import Any

import numpy as np

from macadam.report import look, phases
from macadam.report.folders import Folder
from macadam.report.page import Page, facts

ABREAST = 4  # largest number of folders that one table shows as columns
SIZES = re.compile(r"([\d.]+)-([\d.]+) mm$")  # name of a size class to which the scene gives no name


# Adds the section on the mix of all runs.
def add(page: Page, folders: list[Folder]) -> None:
    runs = [f for f in folders if f.kind == "run"]
    if not runs:
        return
    page.section("The mix")
    page.columns([(f.label, f.colour, facts(_facts_of_mix(f))) for f in runs])
    _composition(page, runs)
    mixes = [f for f in runs if f.summary.get("recipe", {}).get("gradation")]
    for folder in mixes:
        page.figure(_gradation(folder), _gradation_caption(folder), "gradation curve of the mix")
    for folder in (f for f in runs if f not in mixes):
        if folder.aggregates is None:
            page.leave_out(
                folder.label, "gradation", "no aggregates.csv: the specimen was read from a file, or has no aggregates"
            )
    plain = [f for f in runs if f not in mixes and f.aggregates is not None]
    if plain:
        page.figure(_sizes(plain), _sizes_caption(plain), "sizes of the aggregates by volume")


def _facts_of_mix(folder: Folder) -> list[tuple[str, Any]]:
    s, recipe = folder.summary, folder.summary.get("recipe")
    rows: list[tuple[str, Any]] = []
    if s.get("box_m"):
        shape = (s.get("domain") or {}).get("shape", "box").replace("_", " ")
        name = shape if shape in ("box", "beam") else f"bounding box of the {shape}"
        rows.append((name, " × ".join(map(look.length, s["box_m"])) + " mm"))
    rows.append(("particles", s.get("particles")))
    if s.get("voids"):
        rows.append(("air voids with cells", s["voids"]))
    if s.get("specimen", {}).get("seed") is not None:
        rows.append(("seed", s["specimen"]["seed"]))
    fractions = s.get("volume_fractions") or {}
    for key, name in (("aggregate", "aggregate"), ("mastic", "mastic"), ("void", "air voids")):
        if fractions.get(key):
            rows.append(
                (
                    f"{name}, of the box",
                    f"{look.percent(fractions[key])} by spheres, "
                    f"{look.percent(fractions.get(key + '_cells'))} by cells",
                )
            )
    if recipe:
        rows += [
            ("binder, of the mix's mass", look.percent(recipe.get("binder"))),
            ("effective binder, of the mix's mass", look.percent(recipe.get("effective_binder"))),
            ("maximum density", f"{look.number(recipe.get('maximum_density'), 4)} kg/m³"),
            ("bulk density", f"{look.number(recipe.get('bulk_density'), 4)} kg/m³"),
            ("air voids", look.percent(recipe.get("air_voids"))),
            ("voids in the mineral aggregate (VMA)", look.percent(recipe.get("vma"))),
            ("voids filled with binder (VFB)", look.percent(recipe.get("vfb"))),
            ("density of the mastic", f"{look.number(recipe.get('mastic', {}).get('density'), 4)} kg/m³"),
        ]
    return rows


# Adds tables of the size classes: one table for at most ABREAST folders, otherwise one per folder.
def _composition(page: Page, folders: list[Folder]) -> None:
    with_classes = [f for f in folders if f.summary.get("composition")]
    for folder in (f for f in folders if f not in with_classes):
        page.leave_out(folder.label, "size classes", "the specimen comes from a file without classes")
    if 1 < len(with_classes) <= ABREAST:
        names = _from_coarse_to_fine({p["class"]: None for f in with_classes for p in f.summary["composition"]})
        of = [{p["class"]: p for p in f.summary["composition"]} for f in with_classes]
        rows = [
            [_class(n)]
            + [
                f"{look.number(c[n].get('count'))}  ({look.percent(c[n].get('fraction'), 4)})" if n in c else "–"
                for c in of
            ]
            for n in names
        ]
        page.table(
            ["class"] + [f.label for f in with_classes],
            rows,
            "Number of aggregates, or of spheres of mastic or voids, "
            "in the specimen, with the fraction of the box that they fill.",
        )
    else:
        for folder in with_classes:
            rows = [
                [
                    _class(p.get("class", "")),
                    p.get("count_asked"),
                    p.get("count"),
                    look.percent(p.get("fraction_asked"), 4),
                    look.percent(p.get("fraction"), 4),
                ]
                for p in folder.summary["composition"]
            ]
            page.table(
                ["class", "number requested", "number reached", "fraction of box requested", "fraction of box reached"],
                rows,
                f"{folder.label}: numbers and volumes requested by the mix and reached in the specimen.",
            )
    for folder in with_classes:
        short = [_class(p["class"]) for p in folder.summary["composition"] if p.get("count") != p.get("count_asked")]
        if short:
            page.text(f"{folder.label}: not all requested aggregates could be placed: {', '.join(short)}.", "warning")


def _from_coarse_to_fine(names: Iterable[str]) -> list[str]:
    """Returns the classes of several mixes, the coarsest first. Classes without sizes, such as mastic, follow in the
    given order."""
    return sorted(names, key=lambda name: -float(sizes[2]) if (sizes := SIZES.match(name)) else 0.0)


def _class(name: str) -> str:
    return name.replace("-", "–")


# Draws the gradation curve of a mix design, the curve reached and the envelope.
def _gradation(folder: Folder) -> Any:
    recipe = folder.summary["recipe"]
    rows, cut = recipe["gradation"], recipe["cut_m"]
    sieve, asked, reached = (np.array([float(r[k]) for r in rows]) for k in ("sieve_m", "asked", "reached"))
    figure, axes = look.figure(look.WIDE, 2.8)
    envelope = sorted((p["sieve_m"], p["least"], p["most"]) for p in recipe.get("envelope") or [])
    if envelope:
        size, least, most = np.array(envelope).T
        axes.fill_between(1e3 * size, 100 * least, 100 * most, color="#e9ebee", label="envelope of the specification")
    axes.axvspan(1e3 * sieve.min() * 0.8, 1e3 * cut, color=phases.MASTIC, alpha=0.15, lw=0, label="in the mastic")
    axes.plot(1e3 * sieve, 100 * asked, "o-", color=look.INK, lw=1, ms=3.5, label="asked for")
    if folder.aggregates is not None and recipe.get("classes"):
        size, passing = _between_sieves(folder, recipe, float(reached[np.argmin(abs(sieve - cut))]))
        axes.step(1e3 * size, 100 * passing, where="post", color=phases.AGGREGATE, lw=1, label="single aggregates")
    axes.plot(1e3 * sieve, 100 * reached, "x", color=look.COLOURS[0], ms=5, label="reached")
    axes.set_xscale("log")
    ticks: list[float] = []
    for size in 1e3 * sieve:
        if all(max(size / t, t / size) > 1.25 for t in ticks):
            ticks.append(float(size))
    axes.set_xticks(ticks, [f"{t:.4g}" for t in ticks])
    axes.minorticks_off()
    axes.set(
        xlabel="sieve (mm)", ylabel="passing by mass (%)", ylim=(0, 104), xlim=(800 * sieve.min(), 1250 * sieve.max())
    )
    axes.legend(loc="upper left")
    return figure


def _between_sieves(folder: Folder, recipe: dict[str, Any], at_cut: float) -> tuple[np.ndarray, np.ndarray]:
    """Returns sizes [m] and, for each size, the fraction of the aggregate's mass that passes. The curve has one step
    per aggregate that is coarser than the cut. at_cut: the fraction that passes at the cut."""
    density = {c["class"]: float(c["density"]) for c in recipe["classes"]}
    grains = folder.aggregates.sort_values("size")
    mass = grains["volume"].to_numpy() * grains["class"].map(density).fillna(np.mean(list(density.values()))).to_numpy()
    passing = at_cut + (1 - at_cut) * np.cumsum(mass) / mass.sum()
    return np.append(recipe["cut_m"], grains["size"]), np.append(at_cut, passing)


def _gradation_caption(folder: Folder) -> str:
    recipe = folder.summary["recipe"]
    off = max(abs(r["asked"] - r["reached"]) for r in recipe["gradation"])
    outside = recipe.get("outside_of_envelope_m") or []
    words = (
        f"Gradation of {folder.label}: the curve of the mix design and of the specimen. At the sieves they "
        f"differ by {look.bound(100 * off, ' %')} of the mass at most. Aggregate finer than "
        f"{look.number(1e3 * recipe['cut_m'], 3)} mm is part of the mastic and has no particles."
    )
    if outside:
        words += (
            " The curve leaves the envelope at " + ", ".join(f"{look.number(1e3 * s, 3)} mm" for s in outside) + "."
        )
    return words


# Draws the size distribution by volume, for specimens without a mix design.
def _sizes(folders: list[Folder]) -> Any:
    figure, axes = look.figure(look.WIDE, 2.3)
    for f in folders:
        grains = f.aggregates.sort_values("size")
        share = 100 * grains["volume"].cumsum() / grains["volume"].sum()
        axes.step(1e3 * grains["size"], share, where="post", color=f.colour, label=f.label)
    axes.set(xlabel="size of the aggregate (mm)", ylabel="finer, by volume (%)", ylim=(0, 104))
    if len(folders) > 1:
        axes.legend(loc="upper left")
    return figure


def _sizes_caption(folders: list[Folder]) -> str:
    counts = "; ".join(
        f"{f.label}: {look.number(len(f.aggregates))} aggregates from "
        f"{look.number(1e3 * float(f.aggregates['size'].min()), 3)} to "
        f"{look.number(1e3 * float(f.aggregates['size'].max()), 3)} mm"
        for f in folders
    )
    return (
        "Cumulative volume of the aggregates that are particles, over their size; each step of a curve is one aggregate. "
        f"Finer grains are part of the mastic. {counts}."
    )
