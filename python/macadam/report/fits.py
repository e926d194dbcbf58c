# SPDX-License-Identifier: GPL-3.0-or-later
"""Sections of the report on results of `macadam calibrate` and `macadam fit`: the parameters found, and measured and
predicted moduli in one picture."""

from __future__ import annotations

from typing import Any

import numpy as np
import pandas as pd

from macadam.report import look
from macadam.report.folders import Folder
from macadam.report.modulus import decades
from macadam.report.page import Page


# Adds a section for each folder that is a calibration or a fit.
def add(page: Page, folders: list[Folder]) -> None:
    for f in folders:
        if f.kind == "calibration":
            page.section(f"Calibration: {f.label}")
            _calibration(page, f)
        elif f.kind == "fit":
            page.section(f"Contact law from measurements: {f.label}")
            _fit(page, f)


def main_result(f: Folder) -> str:
    """Returns the result of a calibration or a fit in one sentence, and an empty text for other folders."""
    if f.kind == "calibration":
        errors = f.summary.get("errors") or {}
        parameters = f.summary.get("parameters") or []
        values = ", ".join(f"{p.get('name')} = {look.number(p.get('value'), 4)}" for p in parameters[:4])
        return (
            f"{values}{' …' if len(parameters) > 4 else ''}; |E*| is met within "
            f"{look.percent(errors.get('e_star_rms'), 2)} (rms), φ within {look.number(errors.get('phase_rms_deg'), 2)}°"
        )
    if f.kind == "fit":
        e_star, phase = _errors_of_fit(_fitted(f))
        units = len((f.summary.get("law") or {}).get("E_pa") or [])
        law = f"a chain with {units} Kelvin units" if units else f"model {f.summary.get('model', '–')}"
        return f"{law}; |E*| is met within {look.percent(e_star, 2)} (rms), φ within {look.number(phase, 2)}°"
    return ""


# Returns the table of measured and fitted moduli of a fit.
def _fitted(f: Folder) -> pd.DataFrame:
    return f.table("fit.csv", ["frequency_hz", "e_star_pa", "phase_deg", "fitted_e_star_pa", "fitted_phase_deg"])


def _errors_of_fit(table: pd.DataFrame) -> tuple[float, float]:
    """Returns the root mean square of the relative differences of |E*|, and of the differences of φ [degrees]."""
    e_star = np.sqrt(np.mean((table["fitted_e_star_pa"] / table["e_star_pa"] - 1) ** 2))
    return float(e_star), float(np.sqrt(np.mean((table["fitted_phase_deg"] - table["phase_deg"]) ** 2)))


def _calibration(page: Page, f: Folder) -> None:
    s = f.summary
    rows = [
        [
            p.get("name"),
            look.number(p.get("value")),
            look.number(p.get("standard_deviation"), 2),
            look.number(p.get("start")),
            f"{look.number(p.get('low'), 3)} … {look.number(p.get('high'), 3)}",
            "yes" if p.get("at_bound") else "no",
        ]
        for p in s.get("parameters") or []
    ]
    page.table(
        ["parameter", "found", "standard deviation", "before", "bounds", "at a bound"],
        rows,
        "Free parameters of the contact laws. The measurements do not determine a parameter that has no standard "
        "deviation.",
    )
    e = s.get("errors") or {}
    seeds = s.get("seeds") or []
    words = (
        f"|E*| is met within {look.percent(e.get('e_star_rms'), 2)} (rms), "
        f"φ within {look.number(e.get('phase_rms_deg'), 2)}°. "
        + (f"Means of {len(seeds)} specimens are compared." if len(seeds) > 1 else "One specimen is compared.")
    )
    table = f.table(
        "predicted.csv", ["frequency_hz", "e_star_pa", "phase_deg", "predicted_e_star_pa", "predicted_phase_deg"]
    )
    page.figure(
        _measured(table, "predicted_e_star_pa", "predicted_phase_deg", "e_star_scatter", "phase_scatter_deg"),
        f"Measured (dots) and predicted (lines). {words}",
        "measured and predicted moduli",
    )
    for words in s.get("combinations") or []:
        page.text(f"Not determined by the measurements alone: {words}", "warning")


def _fit(page: Page, f: Folder) -> None:
    s = f.summary
    table = _fitted(f)
    e_star, phase = _errors_of_fit(table)
    law = s.get("law") or {}
    if law.get("E_m_pa"):
        units = list(zip(law.get("E_pa") or [], law.get("C_pa_s") or []))
        dashpot = law.get("C_m_pa_s")
        rows = [
            ["Maxwell", look.modulus(law["E_m_pa"]), "–" if dashpot is None else look.number(float(dashpot), 3), "–"]
        ]
        rows += [
            [f"Kelvin {k}", look.modulus(e), look.number(float(c), 3), look.seconds(c / e)]
            for k, (e, c) in enumerate(units, 1)
        ]
        page.table(
            ["unit", "spring", "dashpot (Pa s)", "retardation time"],
            rows,
            f"Fitted law (model {s.get('model', '–')}).",
        )
    page.figure(
        _measured(table, "fitted_e_star_pa", "fitted_phase_deg"),
        f"Measured (dots) and fitted (lines): |E*| within {look.percent(e_star, 2)} (rms), "
        f"φ within {look.number(phase, 2)}°.",
        "measured and fitted moduli",
    )


# Draws measured and predicted |E*| and phase over frequency, one colour per temperature. scatter: columns with the
# standard deviations between seeds, drawn as bands.
def _measured(table: pd.DataFrame, e_star: str, phase: str, scatter: str = "", phase_scatter: str = "") -> Any:
    figure, (left, right) = look.figure(look.WIDE, 2.8, 1, 2)
    if "temperature_c" not in table.columns:
        table = table.assign(temperature_c=np.nan)
    groups = list(table.groupby("temperature_c", dropna=False))
    factor, unit = look.modulus_unit(table["e_star_pa"])
    for k, (t, rows) in enumerate(groups):
        rows = rows.sort_values("frequency_hz")
        colour = look.warmth(k, len(groups)) if len(groups) > 1 else look.COLOURS[0]
        f = rows["frequency_hz"]
        for axes, measured, predicted, spread, scale in (
            (left, rows["e_star_pa"], rows[e_star], scatter, factor),
            (right, rows["phase_deg"], rows[phase], phase_scatter, 1.0),
        ):
            axes.plot(f, scale * measured, "o", color=colour, ms=3.5, label="" if pd.isna(t) else f"{t:g} °C")
            axes.plot(f, scale * predicted, "-", color=colour, lw=1)
            if spread and spread in rows.columns and rows[spread].notna().any():
                band = rows[spread] * (predicted if scale != 1.0 else 1.0)
                axes.fill_between(
                    f, scale * (predicted - band), scale * (predicted + band), color=colour, alpha=0.15, lw=0
                )
    wide = table["e_star_pa"].max() > 4 * table["e_star_pa"].min()
    left.set(xscale="log", yscale="log" if wide else "linear", xlabel="frequency (Hz)", ylabel=f"|E*| ({unit})")
    right.set(xscale="log", xlabel="frequency (Hz)", ylabel="phase angle φ (°)")
    for axis in (left.xaxis, right.xaxis) + ((left.yaxis,) if wide else ()):
        decades(axis)
    if len(groups) > 1:
        handles, labels = left.get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside lower center", ncols=len(groups))
    return figure
