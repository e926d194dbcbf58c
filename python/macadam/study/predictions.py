# SPDX-License-Identifier: GPL-3.0-or-later
"""Words the predictions of `macadam check` for the points of a study: a table with a row per point, the warnings, and
the totals."""

from __future__ import annotations

from typing import Any

from macadam.study.checks import Checked
from macadam.study.design import Design

# headings of the columns after the values of the factors
_HEADINGS = ("test", "method", "particles", "steps", "solutions", "memory", "device", "time")


def lines(design: Design, checked: list[Checked], workers: int) -> list[str]:
    """Returns the lines about all points of a study: a table, the warnings, and the totals. checked: the results of
    check_scenes(). workers: number of programs that the study runs at a time."""
    by_key = {one.job.key: one for one in checked}
    only_specimen = design.jobs[0].command[0] == "specimen"
    names = [*design.factors, *(["experiment"] if any(job.experiment for job in design.jobs) else [])]
    rows = [[*names, *_HEADINGS]]
    for job in design.jobs:
        values = [str(job.values.get(name, "")) for name in design.factors]
        values += [job.experiment] if len(names) > len(values) else []
        rows.append([*values, *_cells(by_key[job.key], only_specimen)])
    out = _aligned(_without_empty_columns(rows, keep=len(names)))
    return [*out, *_warnings(checked), _totals(design, checked, workers, only_specimen)]


def _cells(one: Checked, only_specimen: bool) -> list[str]:
    """Returns the cells of a point, in the order of _HEADINGS."""
    f = one.forecast
    if not f:
        return ["wrong"] + [""] * (len(_HEADINGS) - 1)
    cells = [f["kind"], f["method"], f"{f['particles']:,}"]
    steps = sum(s["steps"] for s in f.get("steps", []))
    cells += [rounded(steps) if steps else "", str(f["solutions"]) if f["solutions"] else ""]
    cells += [bytes_in_words(f["host_bytes"]), bytes_in_words(f["device_bytes"]) if f["device_bytes"] else ""]
    if only_specimen:
        cells[0:2], cells[3:5], cells[6] = ["specimen", ""], ["", ""], ""
    return [*cells, time_in_words(_seconds(f, only_specimen))]


def _seconds(f: dict[str, Any], only_specimen: bool) -> float:
    return f["specimen_s"] + f["network_s"] if only_specimen else f["seconds"]


def _warnings(checked: list[Checked]) -> list[str]:
    """Returns a line for each different warning, with the points that have it."""
    points: dict[str, list[str]] = {}
    for one in checked:
        for warning in one.forecast.get("warnings", []):
            points.setdefault(warning, []).append(one.job.label)
    return [
        f"warning: {warning} ({'all points' if len(at) == len(checked) else at[0] + more(len(at) - 1)})"
        for warning, at in points.items()
    ]


def more(number: int) -> str:
    """Returns the end of a list of points of which only the first is named."""
    return f" and {number} more" if number else ""


def _totals(design: Design, checked: list[Checked], workers: int, only_specimen: bool) -> str:
    right = [one.forecast for one in checked if one.forecast]
    head = f"{len(design.jobs)} points, {len(checked)} scenes checked, {len(checked) - len(right)} wrong"
    if not right:
        return head
    times = sorted((_seconds(f, only_specimen) for f in right), reverse=True)
    at_once = min(workers, len(right))
    # a worker takes the next scene when it is free, so the time is at least that of the longest scene
    wall = max(times[0], sum(times) / at_once)
    memory = sum(sorted((f["host_bytes"] for f in right), reverse=True)[:at_once])
    return (
        f"{head}; about {time_in_words(sum(times))} of computing, {time_in_words(wall)} with {at_once} at a time, which "
        f"take up to {bytes_in_words(memory)} of memory"
    )


def rounded(value: float) -> str:
    """Returns a number with two digits, because a prediction is not more accurate."""
    return f"{float(f'{value:.2g}'):,.0f}" if value < 1e6 else f"{value:.1e}"


def bytes_in_words(number: float) -> str:
    return f"{number / 1e6:.0f} MB" if number < 1e9 else f"{number / 1e9:.1f} GB"


def time_in_words(seconds: float) -> str:
    if seconds < 100:
        return f"{seconds:.1f} s"
    return f"{seconds / 60:.0f} min" if seconds < 6000 else f"{seconds / 3600:.1f} h"


def _without_empty_columns(rows: list[list[str]], keep: int) -> list[list[str]]:
    """Returns the rows without the columns that are empty below their heading. keep: number of the first columns that
    stay in any case."""
    stay = [k for k in range(len(rows[0])) if k < keep or any(row[k] for row in rows[1:])]
    return [[row[k] for k in stay] for row in rows]


def _aligned(rows: list[list[str]]) -> list[str]:
    widths = [max(len(row[k]) for row in rows) for k in range(len(rows[0]))]
    return ["  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip() for row in rows]
