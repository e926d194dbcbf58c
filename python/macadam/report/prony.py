# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the mixture's Prony series in the section of the report on tests in time."""

from __future__ import annotations

from typing import Any

from macadam.report import look
from macadam.report.folders import Folder
from macadam.report.modulus import decades


def spectrum(found: list[Folder]) -> Any:
    """Draws the moduli of the units of Prony series over their relaxation times. Returns the figure."""
    figure, axes = look.figure(look.WIDE, 2.3)
    for f in found:
        units = f.in_time["prony"]["units"]
        axes.plot(
            [u["time_s"] for u in units],
            [1e-6 * u["modulus_pa"] for u in units],
            "o",
            color=f.colour,
            ms=3,
            label=f.label,
        )
        axes.vlines([u["time_s"] for u in units], 0, [1e-6 * u["modulus_pa"] for u in units], color=f.colour, lw=1)
    axes.set(xscale="log", xlabel="relaxation time (s)", ylabel="modulus of the unit (MPa)")
    axes.set_ylim(bottom=0)
    decades(axes.xaxis)
    if len(found) > 1:
        axes.legend()
    return figure


def caption(found: list[Folder]) -> str:
    """Returns the caption of the figure."""
    words = ["Prony series of the specimen, with one line per unit. High lines mark the times at "
             "which the specimen relaxes most."]
    for f in found:
        prony = f.in_time["prony"]
        words.append(
            f"{f.label}: {len(prony['units'])} units, "
            f"{look.modulus(f.in_time.get('instantaneous_pa') or 0)} at time 0 and "
            f"{look.modulus(prony.get('long_term_pa') or 0)} at infinite time; valid from "
            f"{look.seconds(f.in_time['shortest_s'])} to {look.seconds(f.in_time['longest_s'])}."
        )
    tables = [n for n in ("prony.csv", "prony_abaqus.inp", "prony_ansys.txt") if found[0].has(n)]
    return " ".join(words) + (
        f" Tables for finite-element programs are in the folder: {', '.join(tables)}." if tables else ""
    )
