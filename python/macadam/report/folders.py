# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads result folders of macadam: the kind of a folder, its summary, and its tables, which are read when they are
used."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

import pandas as pd

from macadam.report import look

# The file that identifies each kind of folder. If a folder has several of these files, the first one in this order
# decides.
KINDS = {
    "summary.json": "run",
    "calibration.json": "calibration",
    "fit.json": "fit",
    "grains.csv": "scan",
    "phantom.json": "phantom",
    "twin.json": "twin",
    "statistics.csv": "shapes",
}


# columns of a test's points that are moduli [Pa]
MODULI = ("modulus_pa", "secant_pa")


class ReportError(ValueError):
    """The folder or the request is wrong. The message names the culprit, the value found and the value expected."""


@dataclass
class Folder:
    """One result folder. `label` is its name in the report, different from the names of all other folders; `colour` is
    the colour of its curves."""

    path: Path
    kind: str
    label: str = ""
    colour: str = look.COLOURS[0]
    summary: dict[str, Any] = field(default_factory=dict)
    scene_text: str | None = None  # the scene that was computed, if the caller knows it

    def has(self, name: str) -> bool:
        return (self.path / name).is_file()

    def table(self, name: str, columns: list[str]) -> pd.DataFrame:
        """Reads a CSV file of the folder without its lines that begin with #. Raises ReportError if a column is missing
        or the table has no rows."""
        file = self.path / name
        try:
            table = pd.read_csv(file, comment="#")
        except (OSError, ValueError) as error:  # pandas' parser errors are ValueErrors
            raise ReportError(f"{file}: {_one_line(error)}") from None
        missing = [c for c in columns if c not in table.columns]
        if missing:
            raise ReportError(
                f"{file}: found the columns {', '.join(map(str, table.columns))}; expected also {', '.join(missing)}"
            )
        if table.empty:
            raise ReportError(f"{file}: found no rows below the header")
        return table

    @cached_property
    def specimen(self) -> pd.DataFrame | None:
        """The particles (x, y, z, radius [m], phase, body); None if the folder has no specimen.csv."""
        return (
            self.table("specimen.csv", ["x", "y", "z", "radius", "phase", "body"]) if self.has("specimen.csv") else None
        )

    @cached_property
    def aggregates(self) -> pd.DataFrame | None:
        """The aggregates as generated (body, size_class, class, size [m], volume [m3]); None if the specimen has no such file or no aggregates."""
        if not self.has("aggregates.csv"):
            return None
        file = self.path / "aggregates.csv"
        if file.read_text(encoding="utf-8").count("\n") < 2:  # only a header: the specimen has no aggregates
            return None
        return self.table("aggregates.csv", ["body", "size_class", "class", "size", "volume"])

    @cached_property
    def of_study(self) -> dict[str, Any]:
        """The data that a study added to the result: values of its factors, machine; empty if it is not a study's
        result."""
        return _json(self.path / "study.json") if self.has("study.json") else {}

    @property
    def results(self) -> list[dict[str, Any]]:
        return self.summary.get("results") or []

    @property
    def by_frequency(self) -> list[dict[str, Any]]:
        """The results at single frequencies that have a modulus [Pa] and a phase angle [degrees]. The modulus is
        `e_star_pa`, also |G*| of a torsion test; modulus_symbol() tells them apart."""
        rows = [{key.replace("g_star", "e_star"): value for key, value in r.items()} for r in self.results]
        return [
            r
            for r in rows
            if r.get("e_star_pa") is not None and r.get("phase_deg") is not None and r.get("frequency_hz") is not None
        ]

    @property
    def in_time(self) -> dict[str, Any] | None:
        """The result of a test over time, which has a `kind` and, unless the run was stopped before, `points`; None for
        tests over frequencies."""
        return next((r for r in self.results if "kind" in r), None)

    @property
    def modulus_column(self) -> str | None:
        """The column of `points` with the modulus [Pa] of a test over time; None if the test yields another quantity,
        for example a compliance."""
        points = (self.in_time or {}).get("points") or [{}]
        return next((key for key in points[0] if key in MODULI), None)


def modulus_symbol(found: list[Folder]) -> str:
    """Returns the symbol of the modulus in the results over frequency of these folders, for tables and figures."""
    of = {"|G*|" if r.get("modulus") == "torsion" else "|E*|" for f in found for r in f.by_frequency[:1]}
    return " or ".join(sorted(of)) or "|E*|"


def read(path: str | Path) -> Folder:
    """Reads the results folder at `path`. Raises ReportError if it is not a results folder."""
    path = Path(path)
    if not path.exists():
        raise ReportError(f"{path}: no such folder")
    if not path.is_dir():
        raise ReportError(f"{path}: found a file, expected the results folder that holds the file")
    kind = next((kind for name, kind in KINDS.items() if (path / name).is_file()), None)
    # a study of seeds has a summary.json too
    if (kind is None or kind == "run" and _json(path / "summary.json").get("kind") == "seeds") and (
        path / "study.toml"
    ).is_file():
        raise ReportError(
            f"{path}: found a study; its own report is {path / 'report.html'}, its results are in {path / 'results'}"
        )
    if kind is None:
        raise ReportError(f"{path}: not a results folder of macadam: found none of the files {', '.join(KINDS)}")
    folder = Folder(path, kind)
    name = next(name for name, of in KINDS.items() if of == kind)
    if name.endswith(".json"):
        folder.summary = _json(path / name)
    if kind == "run" and "status" not in folder.summary:
        raise ReportError(f'{path / name}: found no key "status", expected a summary.json that macadam wrote')
    return folder


def read_all(paths: list[str | Path]) -> list[Folder]:
    """Reads the folders and gives each a colour and a label. Labels are the ends of the paths, as short as possible and
    all different."""
    if not paths:
        raise ReportError("no result folder given")
    folders = [read(path) for path in paths]
    parts = [f.path.resolve().parts for f in folders]
    if len(set(parts)) < len(parts):
        twice = next(f.path for f, p in zip(folders, parts) if parts.count(p) > 1)
        raise ReportError(f"{twice}: the folder is given twice")
    tails = 1
    while len({p[-tails:] for p in parts}) < len(parts):
        tails += 1
    for k, folder in enumerate(folders):
        folder.label = "/".join(parts[k][-tails:])
        folder.colour = look.COLOURS[k % len(look.COLOURS)]
    return folders


# Reads a JSON file that holds an object. Raises ReportError for anything else.
def _json(file: Path) -> dict[str, Any]:
    try:
        value = json.loads(file.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise ReportError(f"{file}: {_one_line(error)}") from None
    if not isinstance(value, dict):
        raise ReportError(f"{file}: found a {type(value).__name__}, expected an object")
    return value


def _one_line(error: Exception) -> str:
    return " ".join(str(error).split()) or type(error).__name__
