# SPDX-License-Identifier: GPL-3.0-or-later
"""Sections of the report on results of `macadam ct` and `macadam shapes measure`: grains of a scan, twins, phantoms,
shapes of a library."""

from __future__ import annotations

import base64
from typing import Any

import numpy as np

from macadam.report import look
from macadam.report.folders import Folder
from macadam.report.page import Page, facts

_TITLES = {
    "scan": "Grains found in a scan",
    "twin": "The specimen in a scan",
    "phantom": "A synthetic scan",
    "shapes": "Shapes of a library",
}


# Adds a section for each folder of a scan, twin, phantom or library of shapes.
def add(page: Page, folders: list[Folder]) -> None:
    for f in folders:
        if f.kind not in _TITLES:
            continue
        page.section(f"{_TITLES[f.kind]}: {f.label}")
        if f.kind == "scan":
            _scan(page, f)
        elif f.kind == "shapes":
            table = f.table("statistics.csv", [])
            page.table(
                [str(c).replace("_", " ") for c in table.columns],
                [[_cell(v) for v in row] for row in table.itertuples(index=False)],
                "Statistics over all shapes; lengths in metres.",
            )
        else:
            page.columns([(f.label, f.colour, facts(_facts_of_scan(f.summary)))])


def _cell(value: Any) -> Any:
    return (
        look.number(float(value), 3)
        if isinstance(value, (float, np.floating))
        else value.item()
        if isinstance(value, np.integer)
        else value
    )


def _rounded(value: Any) -> Any:
    return 0.0 if isinstance(value, float) and abs(value) < 1e-15 else value  # a zero with a rounding error


# Returns the entries of a summary as names and values; entries of nested tables have the table's name before theirs.
def _facts_of_scan(summary: dict[str, Any], before: str = "") -> list[tuple[str, Any]]:
    rows: list[tuple[str, Any]] = []
    for key, value in summary.items():
        name = before + key.replace("_", " ")
        if isinstance(value, dict):
            rows += _facts_of_scan(value, name + ": ")
        elif isinstance(value, list):
            if all(isinstance(v, (int, float, str)) for v in value) and len(value) <= 6:
                rows.append((name, ", ".join(look.number(_rounded(v)) for v in value)))
        else:
            rows.append((name, value))
    return rows


# Adds gradation, sphericity and pictures of the grains of a scan.
def _scan(page: Page, f: Folder) -> None:
    grains = f.table("grains.csv", ["volume_m3", "d_intermediate_m", "sphericity"])
    size = 1e3 * np.sort(grains["d_intermediate_m"].to_numpy(float))
    whole = int((grains["border"] == 0).sum()) if "border" in grains.columns else len(grains)
    figure, (left, right) = look.figure(look.WIDE, 2.5, 1, 2)
    if f.has("gradation.csv"):
        curve = f.table("gradation.csv", ["sieve_m", "passing_d_intermediate"])
        left.plot(1e3 * curve["sieve_m"], 100 * curve["passing_d_intermediate"], color=f.colour, label="by $D^I$")
        if "passing_square_mesh" in curve.columns:
            left.plot(
                1e3 * curve["sieve_m"],
                100 * curve["passing_square_mesh"],
                color=look.COLOURS[1],
                label="by square mesh",
            )
        left.legend()
        left.set(xlabel="sieve (mm)", ylabel="passing by volume (%)")
    else:
        left.step(size, 100 * np.arange(1, len(size) + 1) / len(size), where="post", color=f.colour)
        left.set(xlabel="$D^I$ (mm)", ylabel="finer, by number (%)")
    right.hist(grains["sphericity"], bins=min(20, max(5, len(grains) // 4)), color=f.colour)
    right.set(xlabel="true sphericity", ylabel="number of grains")
    page.figure(
        figure,
        f"{look.number(len(grains))} grains from {look.number(float(size[0]), 3)} to "
        f"{look.number(float(size[-1]), 3)} mm, "
        f"{look.number(whole)} of them whole; the others are cut by the end of the specimen or of the scan. Gradation "
        "(left) and sphericity, 1 being a sphere (right).",
        "gradation and sphericity of the grains",
    )
    for name, words in (
        ("planes.png", "The three middle planes of the scan with the grains in colour."),
        ("grains.png", "The grains, seen from above and from the front left."),
    ):
        file = f.path / name
        if file.is_file():
            data = base64.b64encode(file.read_bytes()).decode("ascii")
            page.picture(f"data:image/png;base64,{data}", words, words)
        else:
            page.leave_out(f.label, name, "the folder has no such picture")
