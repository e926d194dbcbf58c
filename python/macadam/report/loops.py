# SPDX-License-Identifier: GPL-3.0-or-later
"""Sections of the report on loops of stress over strain, and on the master curve of a sweep over temperatures."""

from __future__ import annotations

from typing import Any

import numpy as np

from macadam.report import look
from macadam.report.folders import Folder, modulus_symbol
from macadam.report.modulus import decades
from macadam.report.page import Page

MOST = 6  # largest number of loops drawn of one folder


# Adds the loops of all runs over frequencies, then their master curves.
def add(page: Page, folders: list[Folder]) -> None:
    runs = [f for f in folders if f.kind == "run" and f.by_frequency]
    for folder in runs:
        several = len(runs) > 1
        if folder.has("response.csv"):
            figure, words = _stepped(folder)
        else:
            figure, words = _from_moduli(folder)
        page.figure(figure, (f"{folder.label}: " if several else "") + words, "loops of stress over strain", third=True)
    page.section("Master curve")
    for folder in runs:
        _add_master_curve(page, folder)


def _stepped(folder: Folder) -> tuple[Any, str]:
    """Draws the recorded samples of the last cycle of each frequency. Returns figure and caption."""
    table = folder.table("response.csv", ["frequency_hz", "time_s", "strain", "stress_pa"])
    figure, axes = look.figure(look.THIRD, 2.2)
    groups = list(table.groupby("frequency_hz"))
    peak = 1e-6
    for k, (f, rows) in enumerate(_evenly_chosen(groups)):
        last = rows[rows["time_s"] >= rows["time_s"].iloc[-1] - (1 + 1e-6) / float(f)]
        axes.plot(
            1e6 * last["strain"],
            1e-3 * last["stress_pa"],
            color=look.steps(k, min(len(groups), MOST)),
            label=look.hertz(f),
        )
        peak = max(peak, float(last["stress_pa"].abs().max()))
    axes.set(xlabel="strain (µm/m)", ylabel="stress (kPa)")
    axes.legend(fontsize=6, handlelength=1, labelspacing=0.2)
    return figure, (
        f"Stress over strain in the last cycle computed with time steps, for each frequency; tension is positive. The "
        f"stress reaches {look.modulus(peak)}. The area within a loop is the energy dissipated per cycle; "
        "the slope is the stiffness."
    )


def _from_moduli(folder: Folder) -> tuple[Any, str]:
    """Draws the ellipses that follow from |E*| and the phase angle for a strain of amplitude one. Returns figure and
    caption."""
    warm = sorted({r.get("temperature_c") for r in folder.by_frequency}, key=lambda t: -1e9 if t is None else t)
    shown = warm[len(warm) // 2]
    rows = sorted((r for r in folder.by_frequency if r.get("temperature_c") == shown), key=lambda r: r["frequency_hz"])
    figure, axes = look.figure(look.THIRD, 2.2)
    factor, unit = look.modulus_unit(r["e_star_pa"] for r in rows)
    turn = np.linspace(0, 2 * np.pi, 181)
    chosen = _evenly_chosen([(r["frequency_hz"], r) for r in rows])
    for k, (f, r) in enumerate(chosen):
        axes.plot(
            np.sin(turn),
            factor * r["e_star_pa"] * np.sin(turn + np.radians(r["phase_deg"])),
            color=look.steps(k, len(chosen)),
            label=look.hertz(f),
        )
    axes.set(xlabel="strain over its amplitude", ylabel=f"stress over\nthe strain's amplitude ({unit})")
    axes.legend(fontsize=6, handlelength=1, labelspacing=0.2)
    at = "" if shown is None else f" at {shown:g} °C"
    return figure, (
        f"Loops of the steady state{at}, drawn from {modulus_symbol([folder])} and φ: the method is harmonic, nothing was stepped. A "
        "wide loop dissipates much energy per cycle, a thin loop is nearly elastic."
    )


def _evenly_chosen(groups: list[tuple[Any, Any]]) -> list[tuple[Any, Any]]:
    """Returns all groups, or MOST of them at even distances if there are more."""
    if len(groups) <= MOST:
        return groups
    return [groups[round(k)] for k in np.linspace(0, len(groups) - 1, MOST)]


# Adds the master curve of a run at several temperatures, or the reason why it is missing.
def _add_master_curve(page: Page, folder: Folder) -> None:
    rows = folder.by_frequency
    temperatures = sorted({r["temperature_c"] for r in rows if r.get("temperature_c") is not None})
    if len(temperatures) < 2:
        if len(rows) > 6:
            page.leave_out(
                folder.label,
                "master curve",
                f"all frequencies are tested at one temperature; the figure of {modulus_symbol([folder])} over frequency shows that curve",
            )
        return
    if any(r.get("reduced_frequency_hz") is None for r in rows):
        words = "reduced frequencies are missing, because the laws do not all have the same shift"
        page.leave_out(folder.label, "master curve", words)
        return
    page.figure(*master_curve(folder), "master curve")


def master_curve(folder: Folder) -> tuple[Any, str]:
    """Draws |E*| and phase angle over the reduced frequency, and the shift over the temperature. Returns figure and
    caption. All results of the folder have a reduced frequency."""
    rows = folder.by_frequency
    temperatures = sorted({r["temperature_c"] for r in rows})
    factor, unit = look.modulus_unit(r["e_star_pa"] for r in rows)
    figure, (left, middle, right) = look.figure(look.WIDE, 2.7, 1, 3, width_ratios=[3, 3, 2])
    shifts = []
    for k, t in enumerate(temperatures):
        of = sorted((r for r in rows if r.get("temperature_c") == t), key=lambda r: r["reduced_frequency_hz"])
        colour = look.warmth(k, len(temperatures))
        f = [r["reduced_frequency_hz"] for r in of]
        left.plot(f, [factor * r["e_star_pa"] for r in of], "o", color=colour, ms=3.2, label=f"{t:g} °C")
        middle.plot(f, [r["phase_deg"] for r in of], "o", color=colour, ms=3.2)
        shifts.append(of[0]["log10_a_T"])
    line = sorted(rows, key=lambda r: r["reduced_frequency_hz"])
    along = [r["reduced_frequency_hz"] for r in line]
    for axes, up in ((left, [factor * r["e_star_pa"] for r in line]), (middle, [r["phase_deg"] for r in line])):
        axes.plot(along, up, "-", color="#b9bec6", lw=1, zorder=1)
    reference = _reference_temperature(temperatures, shifts)
    right.plot(temperatures, shifts, "o-", color=look.INK, ms=3.2)
    left.set(xscale="log", yscale="log", ylabel=f"{modulus_symbol([folder])} ({unit})")
    middle.set(xscale="log", ylabel="phase angle φ (°)")
    right.set(xlabel="temperature (°C)", ylabel="log₁₀ of the shift a$_T$")
    for axes in (left, middle):
        axes.set_xlabel("reduced frequency (Hz)" + ("" if reference is None else f" at {reference}"))
        decades(axes.xaxis, 5)
    decades(left.yaxis)
    figure.legend(loc="outside lower center", ncols=len(temperatures))
    low, high = (pick(r["e_star_pa"] for r in rows) for pick in (min, max))
    ends = [pick(r["reduced_frequency_hz"] for r in rows) for pick in (min, max)]
    return figure, (
        f"Master curve of {folder.label}: the frequencies of each temperature multiplied by its shift a_T"
        + ("" if reference is None else f"; the reference temperature, where a_T is 1, is {reference}")
        + ". "
        f"Over {look.number(float(np.log10(ends[1] / ends[0])), 2)} decades {modulus_symbol([folder])} goes from {look.modulus(low)} to "
        f"{look.modulus(high)}. Dots of neighbouring "
        "temperatures lie on one curve if the shift is valid for the whole specimen. The line connects all dots."
    )


def _reference_temperature(temperatures: list[float], shifts: list[float]) -> str | None:
    """Returns the temperature at which log10 of the shift is 0, as text: one of the temperatures, or "about" a value from
    linear interpolation between two of them. Returns None if it is outside the temperatures."""
    for temperature, shift in zip(temperatures, shifts, strict=True):
        if abs(shift) < 1e-9:
            return f"{temperature:g} °C"
    order = np.argsort(shifts)
    low, high = shifts[order[0]], shifts[order[-1]]
    if not low <= 0 <= high:
        return None
    between = float(np.interp(0, np.array(shifts)[order], np.array(temperatures, float)[order]))
    return f"about {between:.0f} °C"
