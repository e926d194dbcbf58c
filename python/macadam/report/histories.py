# SPDX-License-Identifier: GPL-3.0-or-later
"""Sections of the report on tests in time (relaxation, creep with recovery, constant strain rate) and on the mixture's
Prony series."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.ticker import FuncFormatter

from macadam.report import look, prony
from macadam.report.folders import Folder, ReportError
from macadam.report.modulus import decades
from macadam.report.page import Page


# Adds a section for each kind of test in time, and one section for Prony series. A kind of test without its own
# drawing gets the drawing that fits every test.
def add(page: Page, folders: list[Folder]) -> None:
    with_points = [f for f in folders if f.kind == "run" and f.in_time and f.in_time.get("points")]
    kinds = {f.in_time["kind"] for f in with_points}
    for kind in [*(k for k in _DRAWINGS if k in kinds), *sorted(kinds - {*_DRAWINGS})]:
        found = [f for f in with_points if f.in_time["kind"] == kind]
        title = _DRAWINGS[kind][0] if kind in _DRAWINGS else kind.capitalize()
        page.section(title)
        figure, words = drawing(found)
        page.figure(figure, words + _error_note(found), f"curves of {title.lower()}")
    series = [f for f in folders if f.kind == "run" and f.in_time and (f.in_time.get("prony") or {}).get("units")]
    if series:
        page.section("Viscoelastic constants of the mixture")
        page.figure(prony.spectrum(series), prony.caption(series), "Prony series")


def drawing(found: list[Folder]) -> tuple[Any, str]:
    """Draws the tests in time of these folders, which are of one kind and have points. Returns figure and caption."""
    kind = found[0].in_time["kind"]
    return (_DRAWINGS[kind][1] if kind in _DRAWINGS else _any_test)(found)


def _points(folder: Folder, *keys: str) -> list[np.ndarray]:
    """Returns columns of the test's points. A value that a point does not have (a compliance after the release) is
    NaN."""
    return [
        np.array([float("nan") if p[k] is None else float(p[k]) for p in folder.in_time["points"]]) for k in keys
    ]


def _errors(folder: Folder) -> np.ndarray:
    """Returns the relative error of each point. In a stepped test each point has its own error; otherwise all points
    have the error of the test."""
    error_of_test = folder.in_time.get("error") or 0
    errors = np.array([float(p.get("error") or error_of_test) for p in folder.in_time["points"]])
    if folder.in_time.get("rupture"):
        errors[-1] = 0  # the specimen is in two pieces and not in equilibrium, so the difference is not an error
    return errors


def _is_stepped(folder: Folder) -> bool:
    return folder.in_time.get("method") in ("explicit", "quasi_static")


def _bars(folder: Folder) -> np.ndarray:
    """Returns the error bars of a stepped test. Returns NaN for other tests: their bars would be smaller than the
    line."""
    return _errors(folder) if _is_stepped(folder) else np.full(len(folder.in_time["points"]), np.nan)


# Returns the sentences of a caption about the errors of the points, and about side walls that are held in place.
def _error_note(found: list[Folder]) -> str:
    words = ""
    for stepped, what in (
        (False, "The relative error of the curves is at most"),
        (
            True,
            "Error bars of stepped points show the difference from the solution without time steps, or an estimate "
            "of this difference: at most",
        ),
    ):
        worst = max((_errors(f).max() for f in found if _is_stepped(f) == stepped), default=0)
        words += f" {what} {look.percent(float(worst), 2)}." if worst else ""
    held = [f.label for f in found if f.in_time.get("sides") == "held"]
    return words + (f" The sides of {', '.join(held)} are held: the modulus is a confined one." if held else "")


def _axes(found: list[Folder], columns: int = 2) -> tuple[Any, Any]:
    return look.figure(look.WIDE, 2.7, 1, columns)


def _finish(figure: Any, first: Any, found: list[Folder], along: list[Any], up: list[Any]) -> None:
    """Makes axes logarithmic if their numbers cover a wide range: times (`along`) more than a factor of 30, moduli
    (`up`) more than a factor of four. Adds a legend if there are several folders."""
    times = np.concatenate([_points(f, "time_s")[0] for f in found])
    if times.min() > 0 and times.max() > 30 * times.min():
        for axes in along:
            axes.set_xscale("log")
            decades(axes.xaxis)
    elif times.max() < 0.1:
        for axes in along:
            axes.xaxis.set_major_formatter(FuncFormatter(lambda t, _: f"{1e3 * t:g}"))
            axes.set_xlabel("time (ms)")
    for axes in up:
        values = np.concatenate([line.get_ydata() for line in axes.lines])
        values = values[np.isfinite(values)]
        if len(values) and values.min() > 0 and values.max() > 4 * values.min():
            axes.set_yscale("log")
            decades(axes.yaxis)
        elif len(values) and values.min() > 0:
            axes.set_ylim(bottom=0)
    if len(found) > 1:
        figure.legend(*first.get_legend_handles_labels(), loc="outside lower center", ncols=min(4, len(found)))


# Draws relaxation modulus and stress over time. Returns figure and caption.
def _relaxation(found: list[Folder]) -> tuple[Any, str]:
    figure, (left, right) = _axes(found)
    factor, unit = look.modulus_unit(p["modulus_pa"] for f in found for p in f.in_time["points"])
    words = []
    for f in found:
        t, stress, e = _points(f, "time_s", "stress_pa", "modulus_pa")
        bars = _bars(f)
        left.errorbar(t, factor * e, factor * e * bars, fmt="o-", color=f.colour, ms=2.5, label=f.label)
        right.errorbar(t, 1e-3 * stress, 1e-3 * np.abs(stress) * bars, fmt="o-", color=f.colour, ms=2.5)
        words.append(
            f"{f.label}: the modulus falls from {look.modulus(e[0])} at {look.seconds(t[0])} to {look.modulus(e[-1])} "
            f"at {look.seconds(t[-1])}."
        )
    left.set(xlabel="time (s)", ylabel=f"relaxation modulus E(t) ({unit})")
    right.set(xlabel="time (s)", ylabel="stress (kPa)")
    _finish(figure, left, found, [left, right], [left])
    strain = found[0].in_time.get("strain")
    return figure, (
        f"A strain{'' if strain is None else f' of {look.number(1e6 * strain, 3)} µm/m'} is applied and held. Left: the "
        "modulus after a step of strain. Right: the stress in this test. " + " ".join(words)
    )


# Draws strain and creep compliance over time. Returns figure and caption.
def _creep(found: list[Folder]) -> tuple[Any, str]:
    figure, (left, right) = _axes(found)
    words = []
    for f in found:
        t, strain, j = _points(f, "time_s", "strain", "compliance_1_pa")
        bars = _bars(f)
        largest = float(np.abs(strain).max())
        left.errorbar(t, 1e6 * strain, 1e6 * largest * bars, fmt="o-", color=f.colour, ms=2.5, label=f.label)
        right.errorbar(t, 1e9 * j, 1e9 * j * bars, fmt="o-", color=f.colour, ms=2.5)
        release, stress = f.in_time.get("release_s"), f.in_time.get("stress_pa")
        text = f"{f.label}: a stress of {look.modulus(stress)} is held" if stress else f"{f.label}: a stress is held"
        if release:
            left.axvline(release, color=f.colour, lw=0.7, ls=":")
            text += f" until {look.seconds(release)} (dotted)"
            if (t > release).any() and largest:
                left_over = look.percent(abs(float(strain[-1])) / largest)
                text += f"; of the largest strain, {look.number(1e6 * largest, 3)} µm/m, {left_over} is left at "
                text += look.seconds(t[-1])
        words.append(text + ".")
    left.set(xlabel="time (s)", ylabel="strain (µm/m)")
    right.set(xlabel="time (s)", ylabel="creep compliance J(t) (1/GPa)")
    _finish(figure, left, found, [left, right], [right])
    return figure, "The strain under this load (left), and the compliance after a step of stress (right). " + " ".join(
        words
    )


# Draws stress over strain, and the secant modulus over time. Returns figure and caption.
def _monotonic(found: list[Folder]) -> tuple[Any, str]:
    figure, (left, right) = _axes(found)
    factor, unit = look.modulus_unit(p["secant_pa"] for f in found for p in f.in_time["points"])
    words = []
    for f in found:
        t, strain, stress, secant = _points(f, "time_s", "strain", "stress_pa", "secant_pa")
        bars = _bars(f)
        left.errorbar(
            1e6 * strain, 1e-3 * stress, 1e-3 * np.abs(stress) * bars, fmt="o-", color=f.colour, ms=2.5, label=f.label
        )
        right.errorbar(t, factor * secant, factor * secant * bars, fmt="o-", color=f.colour, ms=2.5)
        if f.in_time.get("strength_pa") is not None:
            peak = 1e6 * f.in_time["strain_at_peak"], 1e-3 * f.in_time["strength_pa"]
            left.plot(*peak, "x", color=f.colour, ms=7, mew=1.5)
            words.append(
                f"{f.label}: the largest stress (cross) is {look.modulus(f.in_time['strength_pa'])}, at a strain of "
                f"{look.number(peak[0], 3)} µm/m"
                + (", from a fit of the peak." if f.in_time.get("strength_from") == "fit" else ".")
            )
        rate = f.in_time.get("rate_1_s")
        loading = (
            ""
            if rate is None
            else f"{'compression' if rate < 0 else 'tension'} at {look.number(1e6 * abs(rate), 3)} µm/m per second, "
        )
        words.append(
            f"{f.label}: {loading}the secant modulus goes from {look.modulus(secant[0])} to {look.modulus(secant[-1])}."
        )
    left.set(xlabel="strain (µm/m)", ylabel="stress (kPa)")
    right.set(xlabel="time (s)", ylabel=f"stress over strain ({unit})")
    _finish(figure, left, found, [right], [right])
    return (
        figure,
        "Stress over strain (left), and the secant modulus over time (right); tension is positive. " + " ".join(words),
    )


# Draws strain and stress over time, which every test in time has. Returns figure and caption.
def _any_test(found: list[Folder]) -> tuple[Any, str]:
    figure, (left, right) = _axes(found)
    for f in found:
        missing = [key for key in ("time_s", "strain", "stress_pa") if key not in f.in_time["points"][0]]
        if missing:
            raise ReportError(
                f"{f.path}: test {f.in_time['kind']}: found points without {', '.join(missing)}, expected time_s, strain "
                "and stress_pa"
            )
        t, strain, stress = _points(f, "time_s", "strain", "stress_pa")
        left.plot(t, 1e6 * strain, "o-", color=f.colour, ms=2.5, label=f.label)
        right.plot(t, 1e-3 * stress, "o-", color=f.colour, ms=2.5)
    left.set(xlabel="time (s)", ylabel="strain (µm/m)")
    right.set(xlabel="time (s)", ylabel="stress (kPa)")
    _finish(figure, left, found, [left, right], [])
    return figure, "Strain (left) and stress (right) over time; tension is positive."


# Draws the load over the displacement of the strips or rollers, and over time.
def _load_curve(found: list[Folder]) -> tuple[Any, str]:
    figure, (left, right) = _axes(found)
    for f in found:
        t, moved, load = _points(f, "time_s", "displacement_m", "load_n")
        left.plot(1e3 * moved, 1e-3 * load, "o-", color=f.colour, ms=2.5, label=f.label)
        right.plot(t, 1e-3 * load, "o-", color=f.colour, ms=2.5)
    left.set(xlabel="displacement (mm)", ylabel="load (kN)")
    right.set(xlabel="time (s)", ylabel="load (kN)")
    for axes in (left, right):
        axes.set_ylim(bottom=0)
    _finish(figure, left, found, [], [])
    return figure, "Load over the approach of the strips or rollers (left) and over time (right)."


# Draws the stress of specimens that cool between two platens, over the temperature. Returns figure and caption.
def _cooling(found: list[Folder]) -> tuple[Any, str]:
    figure, axes = look.figure(look.WIDE, 2.7)
    words = []
    for f in found:
        temperature, stress = _points(f, "temperature_c", "stress_pa")
        axes.plot(temperature, 1e-6 * stress, "o-", color=f.colour, ms=2.5, label=f.label)
        at = look.number(f.in_time["temperature_at_largest_stress_c"], 3)
        largest = look.modulus(f.in_time["largest_stress_pa"])
        if f.in_time["broke"]:
            axes.plot(
                f.in_time["fracture_temperature_c"], 1e-6 * f.in_time["fracture_stress_pa"], "x", color=f.colour, ms=7, mew=1.5
            )
            words.append(f"{f.label}: fracture (cross) at {at} °C under {largest}.")
        else:
            words.append(f"{f.label}: the specimen did not break; the largest stress is {largest} at {at} °C.")
    axes.set(xlabel="temperature (°C)", ylabel="stress (MPa)")
    axes.invert_xaxis()  # time runs to the right, as the specimen cools
    if len(found) > 1:
        axes.legend()
    return figure, "Stress of a specimen that cools while its ends are held; tension is positive. " + " ".join(words)


# Title and drawing of the tests in time, in the order of the report.
_DRAWINGS = {
    "relaxation": ("Relaxation", _relaxation),
    "creep": ("Creep", _creep),
    "monotonic": ("Constant rate of strain", _monotonic),
    "indirect_tensile_strength": ("Indirect tensile strength", _load_curve),
    "semicircular_bending": ("Semicircular bending", _load_curve),
    "three_point_bending": ("Three-point bending", _load_curve),
    "cooling": ("Thermal stress while cooling", _cooling),
}
