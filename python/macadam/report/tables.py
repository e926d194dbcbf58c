# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of |E*| and phase angle: of one folder, of several folders side by side, or of frequencies by temperatures."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pandas as pd

from macadam.report import look
from macadam.report.folders import Folder, modulus_symbol
from macadam.report.page import Page
from macadam.report.scatter import Seeds

ROWS = 40  # largest number of rows of a table; a longer one is cut
ABREAST = 3  # largest number of folders that one table shows side by side

Error = Callable[[dict[str, Any]], tuple[float, float]]


def add(page: Page, folders: list[Folder], error: Error) -> None:
    """Adds tables of these folders. All of them have results over frequencies. error: a function that returns the error
    of a result."""
    if 1 < len(folders) <= ABREAST and not any(_temperatures(f)[1:] for f in folders):
        _abreast(page, folders)
        return
    for folder in folders:
        if _temperatures(folder)[1:]:
            _by_temperature(page, folder)
        else:
            _one(page, folder, error)


def add_seeds(page: Page, groups: list[Seeds]) -> None:
    """Adds a table of mean and standard deviation over seeds for each group, and writes their numbers as means.csv."""
    parts = []
    for seeds in groups:
        factor, unit = look.modulus_unit(seeds.e_star)
        columns = (seeds.frequency, seeds.e_star, seeds.e_scatter, seeds.phase, seeds.phase_scatter)
        rows = [
            [
                f"{f:.4g}",
                f"{look.number(factor * float(e))} ± {look.number(factor * float(s), 2)}",
                look.number(100 * float(s / e), 2),
                f"{look.number(float(phase))} ± {look.number(float(scatter), 2)}",
            ]
            for f, e, s, phase, scatter in zip(*columns, strict=True)
        ]
        page.table(
            ["f (Hz)", f"|E*| ({unit})", "deviation of |E*| (%)", "φ (°)"],
            rows,
            f"{seeds.label[:1].upper()}{seeds.label[1:]}: mean ± standard deviation of single specimens.",
            words=0,
        )
        names = ("frequency_hz", "e_star_pa", "e_star_deviation_pa", "phase_deg", "phase_deviation_deg")
        part = pd.DataFrame(dict(zip(names, columns, strict=True)))
        part.insert(0, "of", seeds.label)
        parts.append(part)
    if parts:
        page.data("means", pd.concat(parts))


def _temperatures(folder: Folder) -> list[float]:
    return sorted({r["temperature_c"] for r in folder.by_frequency if r.get("temperature_c") is not None})


# Returns the caption of a folder's table.
def _of(folder: Folder) -> str:
    rows, s = folder.by_frequency, folder.summary
    warm = _temperatures(folder)
    words = f"{folder.label}: method {rows[0].get('method', '–')}" + (f", {warm[0]:g} °C" if len(warm) == 1 else "")
    confined = any(r.get("modulus") == "confined" for r in rows) or any(
        "confined" in w for w in s.get("warnings") or []
    )
    return words + (". The sides are held: this is a confined modulus" if confined else "")


# Returns the first ROWS rows. If there are more rows, notes on the page that they were left out.
def _cut(page: Page, label: str, rows: list[Any]) -> list[Any]:
    if len(rows) > ROWS:
        page.leave_out(
            label,
            f"{len(rows) - ROWS} rows of the table of |E*|",
            f"the table is cut after {ROWS} rows; summary.json and the pictures have all rows",
        )
    return rows[:ROWS]


# Adds the table of one folder: |E*|, phase angle, E′, E″ and errors over frequency.
def _one(page: Page, folder: Folder, error: Error) -> None:
    factor, unit = look.modulus_unit(r["e_star_pa"] for r in folder.by_frequency)
    symbol = modulus_symbol([folder])
    body = []
    for r in _cut(page, folder.label, folder.by_frequency):
        e, phase, wrong = r["e_star_pa"], np.radians(r["phase_deg"]), error(r)
        body.append(
            [
                f"{r['frequency_hz']:.4g}",
                look.number(factor * e),
                look.number(r["phase_deg"]),
                look.number(float(factor * e * np.cos(phase))),
                look.number(float(factor * e * np.sin(phase))),
                look.bound(100 * wrong[0]),
                look.bound(wrong[1]),
            ]
        )
    page.table(
        ["f (Hz)", f"{symbol} ({unit})", "φ (°)", f"{symbol[1]}′ ({unit})", f"{symbol[1]}″ ({unit})", f"error of {symbol} (%)", "error of φ (°)"],
        body,
        f"{_of(folder)}.",
        words=0,
    )


# Adds one table with |E*| and phase angle of several folders, and the differences of |E*| from the first folder.
def _abreast(page: Page, folders: list[Folder]) -> None:
    factor, unit = look.modulus_unit(r["e_star_pa"] for f in folders for r in f.by_frequency)
    of = [{r["frequency_hz"]: r for r in f.by_frequency} for f in folders]
    first = folders[0].label
    head = ["f (Hz)"]
    for k, f in enumerate(folders):
        symbol = modulus_symbol([f])
        head += [f"{f.label}: {symbol} ({unit})", "φ (°)"] + [f"{symbol} to {first} (%)"] * (k > 0)
    rows = []
    for frequency in _cut(page, first, sorted(set().union(*of))):
        row = [f"{frequency:.4g}"]
        for k, results in enumerate(of):
            r, base = results.get(frequency), of[0].get(frequency)
            row += ["–", "–"] if r is None else [look.number(factor * r["e_star_pa"]), look.number(r["phase_deg"])]
            if k:
                row.append(
                    "–"
                    if r is None or base is None
                    else f"{100 * (r['e_star_pa'] / base['e_star_pa'] - 1):+.2f}".replace("-", "−")
                )
        rows.append(row)
    page.table(head, rows, "; ".join(map(_of, folders)) + ".", words=0)


# Adds two tables of a folder, |E*| and phase angle, with frequencies as rows and temperatures as columns.
def _by_temperature(page: Page, folder: Folder) -> None:
    warm = _temperatures(folder)
    at = {(r["frequency_hz"], r.get("temperature_c")): r for r in folder.by_frequency}
    factor, unit = look.modulus_unit(r["e_star_pa"] for r in folder.by_frequency)
    frequencies = _cut(page, folder.label, sorted({f for f, _ in at}))
    for head, key, digits, scale in (
        (f"{modulus_symbol([folder])} in {unit}", "e_star_pa", 4, factor),
        ("φ in degrees", "phase_deg", 3, 1.0),
    ):
        rows = [
            [f"{f:.4g}"] + [look.number(scale * at[f, t][key], digits) if (f, t) in at else "–" for t in warm]
            for f in frequencies
        ]
        page.table(
            ["f (Hz)"] + [f"{t:g} °C" for t in warm],
            rows,
            f"{_of(folder)}: {head} at {len(warm)} temperatures.",
            words=0,
        )
