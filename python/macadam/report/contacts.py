# SPDX-License-Identifier: GPL-3.0-or-later
"""Section of the report on contacts: their number and area by type, the fraction of E* that each type carries, and the
sensitivities of |E*| and phase angle to the parameters of the laws."""

from __future__ import annotations

from typing import Any

import numpy as np
import pandas as pd

from macadam.report import look
from macadam.report.folders import Folder
from macadam.report.page import Page

NAMES = {
    "M-M": "mastic – mastic",
    "M-A": "mastic – aggregate",
    "A-A": "aggregate – aggregate",
    "inner": "inside aggregates",
    "A-W": "aggregate – wall",
    "M-W": "mastic – wall",
}
MOST = 10  # largest number of parameters in the picture of sensitivities


# Adds the sections on contacts and sensitivities for the folders that are runs.
def add(page: Page, folders: list[Folder]) -> None:
    runs = [f for f in folders if f.kind == "run" and f.summary.get("contacts")]
    if runs:
        page.section("Contacts by type")
        page.figure(_numbers(runs), _numbers_caption(runs), "number of contacts of each type")
    for folder in runs:
        if folder.has("contacts.csv"):
            _areas(page, folder)
        else:
            page.leave_out(
                folder.label,
                "areas of the contacts",
                "no contacts.csv: the scene does not say contacts = true in [output]",
            )
    sensitive = [f for f in runs if any(r.get("sensitivities") for r in f.by_frequency)]
    for folder in (f for f in runs if f.by_frequency and f not in sensitive):
        page.leave_out(
            folder.label,
            "sensitivities",
            "not requested: they need sensitivities = true in [output] and method harmonic",
        )
    if sensitive:
        page.section("Sensitivity of the result")
    for folder in sensitive:
        if len(sensitive) > 1:
            page.heading(folder.label)
        _shares(page, folder)
        _sensitivities(page, folder)
    if sensitive:
        page.data("sensitivities", pd.DataFrame(_rows_of_sensitivities(sensitive)))


def _rows_of_sensitivities(folders: list[Folder]) -> list[dict[str, Any]]:
    """Returns one row per folder, temperature, frequency and parameter: the change of |E*| [Pa] and of the phase angle
    [degrees] per unit of the parameter's natural logarithm."""
    return [
        {"folder": f.label, "temperature_c": r.get("temperature_c"), "frequency_hz": r["frequency_hz"], "e_star_pa": r["e_star_pa"]}
        | {key: s[key] for key in ("parameter", "d_e_star_pa", "d_phase_deg")}
        for f in folders
        for r in f.by_frequency
        for s in r.get("sensitivities") or []
    ]


# Draws the number of contacts of each type.
def _numbers(folders: list[Folder]) -> Any:
    pairs = [p for p in NAMES if any(f.summary["contacts"].get(p) for f in folders)]
    figure, axes = look.figure(look.WIDE, 0.6 + 0.2 * len(pairs) * (1 + 0.5 * len(folders)))
    height = 0.8 / len(folders)
    for k, f in enumerate(folders):
        values = [f.summary["contacts"].get(p) or 0 for p in pairs]
        at = np.arange(len(pairs)) + (k - (len(folders) - 1) / 2) * height
        bars = axes.barh(at, values, height * 0.92, color=f.colour, label=f.label)
        axes.bar_label(bars, [look.number(v) for v in values], padding=2, fontsize=6.5)
    axes.set_yticks(range(len(pairs)), [NAMES[p] for p in pairs])
    axes.invert_yaxis()
    axes.grid(False)
    axes.margins(x=0.12)
    axes.set_xlabel("number of contacts")
    if len(folders) > 1:
        axes.legend(loc="lower right")
    return figure


def _numbers_caption(folders: list[Folder]) -> str:
    words = []
    for f in folders:
        contacts, dropped = f.summary["contacts"], f.summary.get("dropped") or {}
        total = sum(v or 0 for v in contacts.values())
        text = f"{f.label}: {look.number(total)} contacts"
        if contacts.get("A-A"):
            text += f", {look.percent(contacts['A-A'] / total, 2)} of them between aggregates"
        if f.summary.get("contact_points"):
            text += f"; {look.number(f.summary['contact_points'])} contact points in all"
        gone = [
            f"{look.number(dropped[k])} {why}"
            for k, why in (("gap", "because the spheres are too far apart"), ("area", "because the facet is too small"))
            if dropped.get(k)
        ]
        if gone:
            text += "; left out were " + " and ".join(gone)
        if f.summary.get("loose_particles"):
            text += f"; {look.number(f.summary['loose_particles'])} particles have no contact"
        words.append(text + ".")
    return " ".join(words)


# Adds a table of the facets' areas by type of contact.
def _areas(page: Page, folder: Folder) -> None:
    table = folder.table("contacts.csv", ["pair", "area", "distance"])
    rows = []
    total = float(table["area"].sum())
    for pair, name in NAMES.items():
        area = table.loc[table["pair"] == pair, "area"]
        if len(area):
            rows.append(
                [
                    name,
                    len(area),
                    look.percent(float(area.sum()) / total),
                    look.number(1e6 * float(area.mean()), 3),
                    look.number(1e6 * float(area.median()), 3),
                ]
            )
    page.table(
        ["contact", "number", "fraction of the area of all facets", "mean area (mm²)", "median area (mm²)"],
        rows,
        f"{folder.label}: the areas of the facets that act as contacts.",
    )


# Adds a picture of the fraction of E* that each type of contact carries, for at most 12 frequencies.
def _shares(page: Page, folder: Folder) -> None:
    rows = _at_first_temperature([r for r in folder.by_frequency if r.get("shares")])[:12]
    if not rows:
        return
    figure, axes = look.figure(look.WIDE, 0.75 + 0.2 * len(rows))
    base = np.zeros(len(rows))
    for pair in NAMES:
        percent = np.array([100 * (r["shares"].get(pair) or 0) for r in rows])
        if percent.any():
            axes.barh(range(len(rows)), percent, 0.7, left=base, color=look.PAIRS[pair], label=NAMES[pair])
            base += percent
    axes.set_yticks(range(len(rows)), [look.hertz(r["frequency_hz"]) for r in rows])
    axes.invert_yaxis()
    axes.set(xlabel="fraction of E* (%)", xlim=(0, 100))
    axes.grid(axis="y", visible=False)
    figure.legend(loc="outside lower center", ncols=6)
    top = max(NAMES, key=lambda p: rows[-1]["shares"].get(p) or 0)
    page.figure(
        figure,
        f"Fraction of E* that each type of contact carries. At {_at(rows[-1])} the largest fraction "
        f"is that of {NAMES[top]}, {look.percent(rows[-1]['shares'][top], 2)}.",
        "shares of E* by type of contact",
    )


# Adds a picture of the changes of |E*| and phase angle that 10 % more of each parameter causes, at the lowest and the
# highest frequency.
def _sensitivities(page: Page, folder: Folder) -> None:
    rows = _at_first_temperature([r for r in folder.by_frequency if r.get("sensitivities")])
    ends = [rows[0]] if len(rows) == 1 else [rows[0], rows[-1]]
    effects = [
        {
            s["parameter"]: (100 * s["d_e_star_pa"] / r["e_star_pa"] * 0.1, 0.1 * s["d_phase_deg"])
            for s in r["sensitivities"]
        }
        for r in ends
    ]
    # a pair's delta scales all its moduli, so its sensitivity would repeat the sensitivities of the moduli
    names = [n for n in effects[0] if not n.endswith(".delta")]
    names.sort(key=lambda n: -max(abs(e.get(n, (0, 0))[0]) for e in effects))
    names = names[:MOST]
    figure, (left, right) = look.figure(look.WIDE, 0.8 + 0.21 * len(names), 1, 2, sharey=True)
    height = 0.8 / len(ends)
    for k, (r, effect) in enumerate(zip(ends, effects)):
        at = np.arange(len(names)) + (k - (len(ends) - 1) / 2) * height
        colour = look.COLOURS[(0, 1)[k]]
        left.barh(at, [effect.get(n, (0, 0))[0] for n in names], height * 0.9, color=colour, label=_at(r))
        right.barh(at, [effect.get(n, (0, 0))[1] for n in names], height * 0.9, color=colour)
    left.set_yticks(range(len(names)), names)
    left.invert_yaxis()
    left.set_xlabel("change of |E*| (%)")
    right.set_xlabel("change of φ (°)")
    for axes in (left, right):
        axes.axvline(0, color="#5a5f68", lw=0.6)
        axes.grid(axis="y", visible=False)
    figure.legend(loc="outside lower center", ncols=2)
    first = names[0]
    page.figure(
        figure,
        f"Change of |E*| and phase angle if a parameter grows by 10 %, to first order, for the "
        f"{len(names)} parameters with the largest effect on |E*| "
        f"({' and '.join(map(_at, ends))}). "
        f"The largest effect is that of {first}: {look.number(float(effects[-1].get(first, (0, 0))[0]), 2)} % of |E*| at "
        f"{_at(ends[-1])}.",
        "sensitivities of |E*| and phase angle",
    )
    head = [f"{what}, {_at(r)}" for r in ends for what in ("|E*| (%)", "φ (°)")]
    table = [[n, *(look.number(float(v), 3) for e in effects for v in e.get(n, (0, 0)))] for n in names]
    page.table(["10 % more of", *head], table, "The changes of the figure as numbers.")


def _at_first_temperature(results: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Returns the results at the temperature of the first result, sorted by frequency, so that only the frequency
    differs between them."""
    return sorted(
        (r for r in results if r.get("temperature_c") == results[0].get("temperature_c")), key=lambda r: r["frequency_hz"]
    )


# Returns frequency and temperature of a result as text.
def _at(result: dict[str, Any]) -> str:
    t = result.get("temperature_c")
    return look.hertz(result["frequency_hz"]) + ("" if t is None else f", {t:g} °C")
