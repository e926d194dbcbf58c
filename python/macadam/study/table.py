# SPDX-License-Identifier: GPL-3.0-or-later
"""The table of a study: a row a result, read from the folders; CSV that Excel opens, and Parquet."""

from __future__ import annotations

import csv
import json
import os
from pathlib import Path
from typing import Any

import pandas as pd

from macadam.study.design import Design, number_and_unit
from macadam.study.errors import StudyError

_REPORT = {"frequency", "temperature"}
# of a result: key in summary.json, column, factor
_COLUMNS = (
    ("temperature_c", "temperature (degC)", 1.0),
    ("frequency_hz", "frequency (Hz)", 1.0),
    ("time_s", "time (s)", 1.0),
    ("e_star_pa", "E* (MPa)", 1e-6),
    ("phase_deg", "phase angle (deg)", 1.0),
    ("strain", "strain (um/m)", 1e6),
    ("stress_pa", "stress (kPa)", 1e-3),
    ("modulus_pa", "relaxation modulus (MPa)", 1e-6),
    ("secant_pa", "secant modulus (MPa)", 1e-6),
    ("compliance_1_pa", "creep compliance (1/GPa)", 1e9),
)
QUANTITIES = [
    name for key, name, _ in _COLUMNS if key not in ("temperature_c", "frequency_hz", "time_s", "strain", "stress_pa")
]


def check(report: dict[str, Any]) -> None:
    """A StudyError where `[report]` says what is not known."""
    for key, value in report.items():
        if key not in _REPORT:
            raise StudyError(f"report: found the unknown key {key}, expected {', '.join(sorted(_REPORT))}")
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            raise StudyError(f"report.{key}: found {value!r}, expected a number")


def columns(design: Design) -> dict[str, str]:
    """Name of each factor in the table: its key, with the unit where all its values have the same one."""
    names = {}
    for factor in design.factors:
        parts = [number_and_unit(job.values[factor]) for job in design.jobs if factor in job.values]
        units = {unit for number, unit in parts}
        numeric = all(number is not None for number, _ in parts)
        names[factor] = f"{factor} ({units.pop()})" if numeric and len(units) == 1 and units != {""} else factor
    return names


def _cell(value: Any, numeric: bool) -> Any:
    if numeric:
        return number_and_unit(value)[0]
    return value if isinstance(value, (str, int, float, bool)) else json.dumps(value, ensure_ascii=False)


def read(design: Design, folder: Path) -> pd.DataFrame:
    """A row for every frequency, temperature or time of every result that the study asks for and that is there."""
    names = columns(design)
    numeric = {f: names[f] != f for f in design.factors}
    rows = []
    for job in design.jobs:
        place = folder / "results" / job.key
        if not place.is_dir():
            continue
        summary = read_json(place / "summary.json")
        common = {names[f]: _cell(v, numeric[f]) for f, v in job.values.items()}
        if job.experiment:
            common["experiment"] = job.experiment
        for result in _results(summary):
            row = {column: result[key] * factor for key, column, factor in _COLUMNS if result.get(key) is not None}
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
    """One entry a frequency or time; one without either where only the specimen was made."""
    found: list[dict[str, Any]] = []
    for result in summary.get("results") or []:
        found += result.get("points") or [result]
    return found or [{}]


def failures(design: Design, folder: Path) -> list[dict[str, Any]]:
    """What is known of each job that the study asks for and that failed."""
    files = (folder / "failures" / f"{job.key}.json" for job in design.jobs)
    return [read_json(file) for file in files if file.is_file()]


def write(found: pd.DataFrame, failed: list[dict[str, Any]], folder: Path) -> None:
    """table.csv, table.parquet where pyarrow is there, failures.csv where there are any; each whole or not at all."""
    # the mark at the beginning tells Excel that the text is UTF-8
    _whole(folder / "table.csv", lambda file: found.to_csv(file, index=False, encoding="utf-8-sig"))
    try:
        import pyarrow  # noqa: F401
    except ImportError:
        (folder / "table.parquet").unlink(missing_ok=True)
    else:
        _whole(folder / "table.parquet", lambda file: found.to_parquet(file, index=False))
    if not failed:
        (folder / "failures.csv").unlink(missing_ok=True)
        return

    def rows(file: Path) -> None:
        with open(file, "w", newline="", encoding="utf-8-sig") as out:
            writer = csv.writer(out)
            writer.writerow(["key", "experiment", "values", "exit code", "message"])
            for f in failed:
                values = "; ".join(f"{k} = {v}" for k, v in f["values"].items())
                writer.writerow([f["key"], f["experiment"], values, f["exit_code"], f["message"]])

    _whole(folder / "failures.csv", rows)


def _whole(file: Path, fill: Any) -> None:
    part = file.with_name(f".{file.name}.{os.getpid()}.part")
    try:
        fill(part)
        part.replace(file)
    finally:
        part.unlink(missing_ok=True)


def read_json(file: Path) -> dict[str, Any]:
    try:
        return json.loads(file.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise StudyError(f"{file}: {error}; remove the folder {file.parent} to compute it again") from None
