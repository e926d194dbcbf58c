# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests in time: relaxation, creep with recovery, a constant rate of strain; and the Prony series of the mixture."""

from __future__ import annotations

from typing import Any

import numpy as np

from macadam.report import look
from macadam.report.folders import Folder
from macadam.report.modulus import decades
from macadam.report.page import Page


def add(page: Page, folders: list[Folder]) -> None:
    for kind, title, draw in (
        ("relaxation", "Relaxation", _relaxation),
        ("creep", "Creep", _creep),
        ("monotonic", "Constant rate of strain", _monotonic),
    ):
        found = [
            f
            for f in folders
            if f.kind == "run" and f.in_time and f.in_time["kind"] == kind and f.in_time.get("points")
        ]
        if not found:
            continue
        page.section(title)
        figure, words = draw(found)
        page.figure(figure, words + _known(found), f"curves of {title.lower()}")
    series = [f for f in folders if f.kind == "run" and f.in_time and (f.in_time.get("prony") or {}).get("units")]
    if series:
        page.section("The mixture's own material")
        page.figure(_spectrum(series), _spectrum_caption(series), "Prony series")


def _points(folder: Folder, *keys: str) -> list[np.ndarray]:
    return [np.array([float(p[k]) for p in folder.in_time["points"]]) for k in keys]


def _known(found: list[Folder]) -> str:
    worst = max(float(f.in_time.get("error") or 0) for f in found)
    held = [f.label for f in found if f.in_time.get("sides") == "held"]
    words = f" The curves are known to {look.percent(worst, 2)}." if worst else ""
    return words + (f" The sides of {', '.join(held)} are held: the modulus is a confined one." if held else "")


def _axes(found: list[Folder], columns: int = 2) -> tuple[Any, Any]:
    return look.figure(look.WIDE, 2.7, 1, columns)


def _finish(figure: Any, first: Any, found: list[Folder]) -> None:
    if len(found) > 1:
        figure.legend(*first.get_legend_handles_labels(), loc="outside lower center", ncols=min(4, len(found)))


def _relaxation(found: list[Folder]) -> tuple[Any, str]:
    figure, (left, right) = _axes(found)
    factor, unit = look.modulus_unit(p["modulus_pa"] for f in found for p in f.in_time["points"])
    words = []
    for f in found:
        t, stress, e = _points(f, "time_s", "stress_pa", "modulus_pa")
        left.plot(t, factor * e, "o-", color=f.colour, ms=2.5, label=f.label)
        right.plot(t, 1e-3 * stress, "o-", color=f.colour, ms=2.5)
        words.append(
            f"{f.label}: the modulus falls from {look.modulus(e[0])} at {look.seconds(t[0])} to {look.modulus(e[-1])} "
            f"at {look.seconds(t[-1])}."
        )
    left.set(xscale="log", yscale="log", xlabel="time (s)", ylabel=f"relaxation modulus E(t) ({unit})")
    right.set(xscale="log", xlabel="time (s)", ylabel="stress (kPa)")
    for axis in (left.xaxis, left.yaxis, right.xaxis):
        decades(axis)
    _finish(figure, left, found)
    strain = found[0].in_time.get("strain")
    return figure, (
        f"A strain{'' if strain is None else f' of {look.number(1e6 * strain, 3)} µm/m'} is put on and held: the "
        "modulus after a step (left) and the stress under the load of this test (right). " + " ".join(words)
    )


def _creep(found: list[Folder]) -> tuple[Any, str]:
    figure, (left, right) = _axes(found)
    words = []
    for f in found:
        t, strain, j = _points(f, "time_s", "strain", "compliance_1_pa")
        left.plot(t, 1e6 * strain, "o-", color=f.colour, ms=2.5, label=f.label)
        right.plot(t, 1e9 * j, "o-", color=f.colour, ms=2.5)
        release, stress = f.in_time.get("release_s"), f.in_time.get("stress_pa")
        text = f"{f.label}: a stress of {look.modulus(stress)} is held" if stress else f"{f.label}: a stress is held"
        if release:
            left.axvline(release, color=f.colour, lw=0.7, ls=":")
            peak = float(strain[t <= release].max()) if (t <= release).any() else float(strain.max())
            text += f" until {look.seconds(release)} (dotted)"
            if (t > release).any() and peak:
                left_over = look.percent(float(strain[-1]) / peak)
                text += f"; of the largest strain, {look.number(1e6 * peak, 3)} µm/m, {left_over} is left at "
                text += look.seconds(t[-1])
        words.append(text + ".")
    left.set(xscale="log", xlabel="time (s)", ylabel="strain (µm/m)")
    right.set(xscale="log", yscale="log", xlabel="time (s)", ylabel="creep compliance J(t) (1/GPa)")
    for axis in (left.xaxis, right.xaxis, right.yaxis):
        decades(axis)
    _finish(figure, left, found)
    return figure, "The strain under this load (left), and the compliance after a step of stress (right). " + " ".join(
        words
    )


def _monotonic(found: list[Folder]) -> tuple[Any, str]:
    figure, (left, right) = _axes(found)
    factor, unit = look.modulus_unit(p["secant_pa"] for f in found for p in f.in_time["points"])
    words = []
    for f in found:
        t, strain, stress, secant = _points(f, "time_s", "strain", "stress_pa", "secant_pa")
        left.plot(1e6 * strain, 1e-3 * stress, "o-", color=f.colour, ms=2.5, label=f.label)
        right.plot(t, factor * secant, "o-", color=f.colour, ms=2.5)
        rate = f.in_time.get("rate_1_s")
        way = (
            ""
            if rate is None
            else f"{'compression' if rate < 0 else 'tension'} at {look.number(1e6 * abs(rate), 3)} µm/m a second, "
        )
        words.append(
            f"{f.label}: {way}the secant modulus falls from {look.modulus(secant[0])} to {look.modulus(secant[-1])}."
        )
    left.set(xlabel="strain (µm/m)", ylabel="stress (kPa)")
    right.set(xscale="log", yscale="log", xlabel="time (s)", ylabel=f"stress over strain ({unit})")
    decades(right.xaxis)
    decades(right.yaxis)
    _finish(figure, left, found)
    return (
        figure,
        "Stress over strain (left), and the secant modulus over time (right); tension is positive. " + " ".join(words),
    )


def _spectrum(found: list[Folder]) -> Any:
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


def _spectrum_caption(found: list[Folder]) -> str:
    words = ["The Prony series of the whole specimen, a line for every unit: where the lines are high it relaxes most."]
    for f in found:
        prony = f.in_time["prony"]
        words.append(
            f"{f.label}: {len(prony['units'])} units, "
            f"{look.modulus(f.in_time.get('instantaneous_pa') or 0)} at once and "
            f"{look.modulus(prony.get('long_term_pa') or 0)} in the end; it holds from "
            f"{look.seconds(f.in_time['shortest_s'])} to {look.seconds(f.in_time['longest_s'])}."
        )
    tables = [n for n in ("prony.csv", "prony_abaqus.inp", "prony_ansys.txt") if found[0].has(n)]
    return " ".join(words) + (
        f" Tables for finite-element programs are in the folder: {', '.join(tables)}." if tables else ""
    )
