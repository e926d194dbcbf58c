# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads the table of a study from the folders of its results, and writes it as CSV and Parquet."""

from __future__ import annotations

import csv
import json
import re
from pathlib import Path
from typing import Any

import pandas as pd

from macadam._files import write_with
from macadam.study.design import AT, MEASURED, Design, number_and_unit
from macadam.study.errors import StudyError

_REPORT = {"frequency", "temperature"}
_UNITS = {"%": "percent", "°C": "c"}


def check(report: dict[str, Any]) -> None:
    """Raises StudyError if `[report]` has an unknown key or a value that is not a number."""
    for key, value in report.items():
        if key not in _REPORT:
            raise StudyError(f"report: found the unknown key {key}, expected {', '.join(sorted(_REPORT))}")
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            raise StudyError(f"report.{key}: found {value!r}, expected a number")


def units(design: Design) -> dict[str, str]:
    """Returns the unit of each factor; empty if its values are not all numbers with the same unit."""
    out = {}
    for factor in design.factors:
        parts = [number_and_unit(job.values[factor]) for job in design.jobs if factor in job.values]
        found = {unit for _, unit in parts}
        numeric = all(number is not None for number, _ in parts)
        out[factor] = found.pop() if numeric and len(found) == 1 else ""
    return out


def columns(design: Design) -> dict[str, str]:
    """Returns the name of each factor's column: its key, followed by the unit that its values have in the study."""
    return {factor: f"{factor}_{_suffix(unit)}" if unit else factor for factor, unit in units(design).items()}


def _suffix(unit: str) -> str:
    return _UNITS.get(unit, re.sub(r"\W+", "_", unit.lower()))


def _cell(value: Any, unit: str) -> Any:
    """Returns the content of a cell in a factor's column: only the number if the column has a unit."""
    if unit:
        return number_and_unit(value)[0]
    return value if isinstance(value, (str, int, float, bool)) else json.dumps(value, ensure_ascii=False)


def read(design: Design, folder: Path) -> pd.DataFrame:
    """Returns one row for every frequency, temperature or time of every existing result of the study. Units are SI, but
    a factor has the unit of its values in the study."""
    names, of = columns(design), units(design)
    rows = []
    for job in design.jobs:
        place = folder / "results" / job.key
        if not place.is_dir():
            continue
        summary = read_json(place / "summary.json")
        common = {names[f]: _cell(v, of[f]) for f, v in job.values.items()}
        if job.experiment:
            common["experiment"] = job.experiment
        for result in _results(summary):
            row = {name: result[name] for name in (*AT, *MEASURED) if result.get(name) is not None}
            rows.append(
                {
                    **common,
                    **row,
                    "particles": summary.get("particles"),
                    "warnings": "; ".join(summary.get("warnings", [])),
                    "macadam": summary.get("macadam"),
                    "key": job.key,
                }
            )
    return pd.DataFrame(rows)


def _results(summary: dict[str, Any]) -> list[dict[str, Any]]:
    """Returns one entry per frequency or time; a single empty entry if only the specimen was made."""
    found: list[dict[str, Any]] = []
    for result in summary.get("results") or []:
        found += result.get("points") or [result]
    return found or [{}]


def failures(design: Design, folder: Path) -> list[dict[str, Any]]:
    """Returns the record of each failed job of the study, one per job. Points with the same scene share a record, and
    an earlier study with other factors may have written it, so experiment and values come from this study's jobs."""
    files = {job.key: folder / "failures" / f"{job.key}.json" for job in design.results}
    records = {key: read_json(file) for key, file in files.items() if file.is_file()}
    return [
        records[job.key] | {"experiment": job.experiment, "values": job.values}
        for job in design.jobs
        if job.key in records
    ]


def failed_results(failed: list[dict[str, Any]]) -> int:
    """Returns the number of failed results. Points with the same scene have one result. failed: from failures()."""
    return len({failure["key"] for failure in failed})


def write(found: pd.DataFrame, failed: list[dict[str, Any]], folder: Path) -> None:
    """Writes table.csv, table.parquet if pyarrow is installed, and failures.csv if there are failures. An error leaves
    no incomplete file."""
    write_with(folder / "table.csv", lambda file: found.to_csv(file, index=False, encoding="utf-8"))
    try:
        import pyarrow  # noqa: F401
    except ImportError:
        (folder / "table.parquet").unlink(missing_ok=True)
    else:
        write_with(folder / "table.parquet", lambda file: found.to_parquet(file, index=False))
    if not failed:
        (folder / "failures.csv").unlink(missing_ok=True)
        return

    def rows(file: Path) -> None:
        with open(file, "w", newline="", encoding="utf-8") as out:
            writer = csv.writer(out)
            writer.writerow(["key", "experiment", "values", "exit_code", "message"])
            for f in failed:
                values = "; ".join(f"{k} = {v}" for k, v in f["values"].items())
                writer.writerow([f["key"], f["experiment"], values, f["exit_code"], f["message"]])

    write_with(folder / "failures.csv", rows)


def read_json(file: Path) -> dict[str, Any]:
    try:
        return json.loads(file.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise StudyError(f"{file}: {error}; remove the folder {file.parent} to compute it again") from None
