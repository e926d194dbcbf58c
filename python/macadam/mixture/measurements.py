# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads the tables of a binder's measurements: complex shear moduli (DSR) and creep stiffness (BBR)."""

from __future__ import annotations

import csv
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from macadam.mixture.errors import refuse

_MODULI = {"pa": 1.0, "kpa": 1e3, "mpa": 1e6, "gpa": 1e9}
_FREQUENCY = {"frequency_hz": 1.0, "omega_rad_s": 1 / (2 * np.pi)}
_PHASE = {"phase_deg": 1.0, "phase_rad": 180 / np.pi}
_MODULUS = {f"g_star_{unit}": factor for unit, factor in _MODULI.items()}
_STIFFNESS = {f"stiffness_{unit}": factor for unit, factor in _MODULI.items()}


@dataclass
class Dsr:
    """Measured shear moduli, one row per measurement: temperature [°C], frequency [Hz], |G*| [Pa], phase [degrees]."""

    temperature: np.ndarray
    frequency: np.ndarray
    modulus: np.ndarray
    phase: np.ndarray

    def part(self, kept: np.ndarray) -> Dsr:
        """Returns the measurements that a mask keeps."""
        return Dsr(self.temperature[kept], self.frequency[kept], self.modulus[kept], self.phase[kept])


@dataclass
class Bbr:
    """Measured creep stiffness, one row per measurement: temperature [°C], loading time [s], stiffness [Pa]."""

    temperature: np.ndarray
    time: np.ndarray
    stiffness: np.ndarray


def read_dsr(file: Path) -> Dsr:
    """Reads the columns temperature_c (or temperature_k), frequency_hz (or omega_rad_s), g_star_pa (or _kpa, _mpa,
    _gpa) and phase_deg (or phase_rad). Raises MixtureError that names file, line and column."""
    names, rows = _table(file)
    temperature = _temperature(file, names, rows)
    frequency = _column(file, names, rows, _FREQUENCY, lambda v: v > 0, "a positive number")
    modulus = _column(file, names, rows, _MODULUS, lambda v: v > 0, "a positive number")
    phase = _column(file, names, rows, _PHASE, lambda v: -5 < v < 95, "an angle between -5 and 95 degrees")
    if len(modulus) < 12 or len(np.unique(np.round(temperature))) < 3:
        refuse(
            file,
            "measurements",
            f"{len(modulus)} at {len(np.unique(np.round(temperature)))} temperatures",
            "at least 12 at three temperatures or more, which the shift over temperature needs",
        )
    if modulus.max() > 1e10 or np.median(modulus) < 10:
        refuse(
            file,
            "|G*|",
            f"{modulus.min():.3g} to {modulus.max():.3g} Pa",
            "moduli of a binder; is the unit of the column right?",
        )
    return Dsr(temperature, frequency, modulus, phase)


def read_bbr(file: Path) -> Bbr:
    """Reads the columns temperature_c (or temperature_k), time_s and stiffness_mpa (or _pa, _kpa, _gpa)."""
    names, rows = _table(file)
    return Bbr(
        _temperature(file, names, rows),
        _column(file, names, rows, {"time_s": 1.0}, lambda v: v > 0, "a positive number"),
        _column(file, names, rows, _STIFFNESS, lambda v: v > 0, "a positive number"),
    )


def _table(file: Path) -> tuple[list[str], list[tuple[int, list[str]]]]:
    """Returns the names of the columns, and the cells of each row with its line number. Decimal commas are replaced if
    semicolons or tabs separate the cells."""
    try:
        lines = file.read_text(encoding="utf-8-sig").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        refuse(file, "table", getattr(error, "strerror", None) or str(error), "a CSV file")
    shown = [(k, line) for k, line in enumerate(lines, 1) if line.strip() and not line.lstrip().startswith("#")]
    if len(shown) < 2:
        refuse(file, "table", f"{len(shown)} lines", "a line of column names and measurements")
    separator = next((s for s in (";", "\t") if s in shown[0][1]), ",")
    rows = []
    for number, line in shown:
        cells = [c.strip() for c in next(csv.reader([line], delimiter=separator))]
        rows.append((number, [c.replace(",", ".") for c in cells] if separator != "," else cells))
    return [c.lower() for c in rows[0][1]], rows[1:]


def _column(
    file: Path, names: list[str], rows: list[tuple[int, list[str]]], known: dict[str, float], rule, expected: str
):
    """Returns the numbers of the one column that has a name out of `known`, times the factor of this name."""
    present = [name for name in known if name in names]
    if len(present) != 1:
        refuse(file, "columns", ", ".join(present) if present else ", ".join(names), "one of " + ", ".join(known))
    at, out = names.index(present[0]), []
    for number, cells in rows:
        try:
            value = float(cells[at])
        except (IndexError, ValueError):
            refuse(f"{file}:{number}", present[0], repr(cells[at]) if at < len(cells) else "nothing", expected)
        if not (np.isfinite(value) and rule(value * known[present[0]])):
            refuse(f"{file}:{number}", present[0], f"{value:g}", expected)
        out.append(value * known[present[0]])
    return np.array(out)


def _temperature(file: Path, names: list[str], rows: list[tuple[int, list[str]]]) -> np.ndarray:
    if "temperature_k" in names and "temperature_c" not in names:
        kelvins = _column(file, names, rows, {"temperature_k": 1.0}, lambda v: 200 < v < 500, "kelvins from 200 to 500")
        return kelvins - 273.15
    return _column(
        file, names, rows, {"temperature_c": 1.0}, lambda v: -60 < v < 200, "degrees Celsius from -60 to 200"
    )
