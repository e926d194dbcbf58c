# SPDX-License-Identifier: GPL-3.0-or-later
"""Section of the report on |E*| and phase angle over frequency: table, curves with error bars, Cole–Cole and black
diagram."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from macadam.report import look, tables
from macadam.report.folders import Folder, modulus_symbol
from macadam.report.page import Page
from macadam.report.scatter import scatter

_OF_SEEDS = {"color": "black", "marker": "_", "lw": 0.9, "ms": 6, "zorder": 3}


@dataclass
class Curve:
    """The results of one folder at one temperature: frequencies [Hz], |E*| [Pa], phase [degrees], their errors
    (relative and in degrees)."""

    folder: Folder
    temperature: float | None
    frequency: np.ndarray
    e_star: np.ndarray
    phase: np.ndarray
    e_error: np.ndarray
    phase_error: np.ndarray
    colour: Any = "#000000"
    marker: str = "o"
    label: str = ""


    @property
    def model_error(self) -> str:
        """A sentence about the error of the model, which is the difference between contact network and continuum. The error
        bars do not include it."""
        found = self.folder.summary.get("model_error")
        if found:
            return str(found["words"])
        return (
            "error of the model: unknown, because the rule centres uses the factors delta of the scene; only a "
            "comparison with measurements or with a continuum shows this error"
        )


# Adds the section on |E*| and phase angle, and notes the runs that have none.
def add(page: Page, folders: list[Folder]) -> None:
    runs = [f for f in folders if f.kind == "run"]
    for f in runs:
        if not f.by_frequency:
            why = {"prepared": "the folder holds a specimen but no test"}.get(f.summary["status"], "")
            if f.in_time:
                why = f"the test gives results over time ({f.in_time['kind']}), not over frequency"
            page.leave_out(f.label, "|E*| and phase angle", why or f"no result in it; status: {f.summary['status']}")
    found = curves(runs)
    if not found:
        return
    symbol = _symbol(found)
    page.section(f"{'Shear' if symbol == '|G*|' else 'Stiffness'} modulus {symbol} and phase angle φ")
    tables.add_seeds(page, scatter(found))
    tables.add(page, [f for f in runs if f.by_frequency], error)
    page.figure(over_frequency(found), _caption(found), f"{symbol} and phase angle over frequency")
    if len({(c.folder.label, f) for c in found for f in c.frequency}) > 1:
        page.figure(cole_cole(found), _cole_cole_caption(found), "Cole–Cole diagram", third=True)
        page.figure(
            black(found),
            f"Black diagram: {symbol} over the phase angle. The diagram does not show frequency, so "
            "curves of different temperatures coincide if a shift of frequency makes one master curve of them."
            + _colour_note(found),
            "black diagram",
            third=True,
        )


def curves(folders: list[Folder]) -> list[Curve]:
    """Returns one curve per folder and temperature, with the colours and labels that they have in all pictures."""
    found: list[Curve] = []
    for folder in folders:
        rows = folder.by_frequency
        temperatures = sorted({r.get("temperature_c") for r in rows}, key=lambda t: -1e9 if t is None else t)
        for k, t in enumerate(temperatures):
            of = sorted((r for r in rows if r.get("temperature_c") == t), key=lambda r: r["frequency_hz"])
            errors = np.array([error(r) for r in of])
            curve = Curve(
                folder,
                t,
                *(np.array([float(r[key]) for r in of]) for key in ("frequency_hz", "e_star_pa", "phase_deg")),
                errors[:, 0],
                errors[:, 1],
            )
            single = len(folders) == 1 and len(temperatures) > 1
            curve.colour = look.warmth(k, len(temperatures)) if single else folder.colour
            curve.marker = "o" if single else "os^Dv<>"[k % 7]
            parts = ([] if len(folders) == 1 else [folder.label]) + ([] if t is None else [f"{t:g} °C"])
            curve.label = ", ".join(parts)
            found.append(curve)
    return found


def error(result: dict[str, Any]) -> tuple[float, float]:
    """Returns the known error of a result: of |E*| (relative) and of the phase (degrees); NaN if it is unknown. The
    error of a stepped result is the difference from the harmonic solution. The error of a harmonic result is the
    difference between the reactions of the two walls, which are equal in exact equilibrium."""
    known = result.get("difference_from_harmonic") or result.get("predicted_error")
    if known and known.get("e_star") is not None:
        return abs(known["e_star"]), float(np.degrees(abs(known.get("phase_rad") or 0)))
    if result.get("e_star_bottom_pa"):
        return (
            abs(result["e_star_bottom_pa"] / result["e_star_pa"] - 1),
            abs((result.get("phase_bottom_deg") or result["phase_deg"]) - result["phase_deg"]),
        )
    return float("nan"), float("nan")


def decades(axis: Any, largest_number: int = 9) -> None:
    """Labels a logarithmic axis with at most `largest_number` plain numbers, not powers of ten. An axis of few decades
    also gets labels between the decades."""
    low, high = sorted(axis.get_view_interval())
    few = np.log10(high / low) < 2.2
    axis.set_major_locator(LogLocator(base=10, subs=(1, 2, 5) if few else (1,), numticks=largest_number))
    axis.set_major_formatter(
        FuncFormatter(lambda v, _: f"{v:g}" if 1e-3 <= v < 1e5 else f"$10^{{{round(np.log10(v))}}}$")
    )
    axis.set_minor_formatter(NullFormatter())


def over_frequency(found: list[Curve]) -> Any:
    """Draws |E*| and phase angle over frequency, with error bars and the means over seeds."""
    factor, unit = look.modulus_unit(e for c in found for e in c.e_star)
    figure, (left, right) = look.figure(look.WIDE, 2.7, 1, 2)
    for c in found:
        more = {"color": c.colour, "label": c.label, "marker": c.marker, "ms": 3.2}
        left.errorbar(c.frequency, factor * c.e_star, np.nan_to_num(factor * c.e_star * c.e_error), **more)
        right.errorbar(c.frequency, c.phase, np.nan_to_num(c.phase_error), **more)
    for seeds in scatter(found):
        left.errorbar(seeds.frequency, factor * seeds.e_star, factor * seeds.e_scatter, **_OF_SEEDS, label=seeds.label)
        right.errorbar(seeds.frequency, seeds.phase, seeds.phase_scatter, **_OF_SEEDS)
    wide = _covers_wide_range(found)
    several = min(c.frequency.min() for c in found) < max(c.frequency.max() for c in found)
    along = "log" if several else "linear"
    left.set(xscale=along, yscale="log" if wide else "linear", xlabel="frequency (Hz)", ylabel=f"{_symbol(found)} ({unit})")
    right.set(xscale=along, xlabel="frequency (Hz)", ylabel="phase angle φ (°)")
    right.set_ylim(bottom=0)
    for axes in (left, right):
        if several:
            decades(axes.xaxis)
    if wide:
        decades(left.yaxis)
    elif max(c.e_star.max() for c in found) > 1.5 * min(c.e_star.min() for c in found) or len(found[0].e_star) == 1:
        left.set_ylim(bottom=0)
    if len(found) > 1:
        figure.legend(*left.get_legend_handles_labels(), loc="outside lower center", ncols=min(6, len(found)))
    return figure


def _caption(found: list[Curve]) -> str:
    words = []
    for c in found[:3]:
        name = f"{c.label}: " if c.label else ""
        a, b = look.modulus(c.e_star[0]), look.modulus(c.e_star[-1])
        if len(c.frequency) == 1:
            words.append(
                f"{name}|E*| is {a} and φ {look.number(float(c.phase[0]), 3)}° at {look.hertz(c.frequency[0])}."
            )
            continue
        top = int(np.argmax(c.phase))
        turn = (
            f"φ is largest, {look.number(float(c.phase[top]), 3)}°, at {look.hertz(c.frequency[top])}"
            if 0 < top < len(c.phase) - 1
            else f"φ goes from {look.number(float(c.phase[0]), 3)}° to {look.number(float(c.phase[-1]), 3)}°"
        )
        words.append(
            f"{name}{'f' if name else 'F'}rom {look.hertz(c.frequency[0])} to {look.hertz(c.frequency[-1])} "
            f"|E*| goes from {a} to {b}, "
            f"and {turn}."
        )
    if len(found) > 3:
        words.append(f"{len(found) - 3} more {'curve is' if len(found) == 4 else 'curves are'} not described.")
    wrong = np.concatenate([c.e_error for c in found])
    if np.isfinite(wrong).any():
        words.append(
            f"Error bars: {look.bound(100 * float(np.nanmax(wrong)), ' %')} of |E*| at most; a bar that is not "
            "visible is smaller than its dot. The error of a stepped result is its difference from the harmonic "
            "solution, the error of a harmonic result is the difference between the reactions of its two walls. "
            "Error bars do not include the scatter between specimens of the mix."
        )
    for said in dict.fromkeys(c.model_error for c in found):
        words.append(f"{said[0].upper()}{said[1:]}.")
    for seeds in scatter(found):
        words.append(
            f"Black: {seeds.label}, with their standard deviation as bars; the deviation is "
            f"{look.percent(float((seeds.e_scatter / seeds.e_star).max()), 2)} of |E*| and "
            f"{look.number(float(seeds.phase_scatter.max()), 2)}° at most."
        )
    return " ".join(words).replace("|E*|", _symbol(found))


# Returns the symbol of the modulus of the curves.
def _symbol(found: list[Curve]) -> str:
    return modulus_symbol([c.folder for c in found])


# Returns storage and loss modulus, E′ and E″ [Pa].
def _parts(c: Curve) -> tuple[np.ndarray, np.ndarray]:
    return c.e_star * np.cos(np.radians(c.phase)), c.e_star * np.sin(np.radians(c.phase))


def cole_cole(found: list[Curve]) -> Any:
    """Draws the loss modulus over the storage modulus."""
    factor, unit = look.modulus_unit(e for c in found for e in c.e_star)
    figure, axes = look.figure(look.THIRD, 2.2)
    for c in found:
        storage, loss = _parts(c)
        axes.plot(factor * storage, factor * loss, marker=c.marker, color=c.colour, ms=3, label=c.label)
    letter = "G" if _symbol(found) == "|G*|" else "E"
    axes.set(xlabel=f"{letter}′ ({unit})", ylabel=f"{letter}″ ({unit})")
    axes.set_xlim(left=0)
    axes.set_ylim(bottom=0)
    return figure


def _cole_cole_caption(found: list[Curve]) -> str:
    best = max(found, key=lambda c: _parts(c)[1].max())
    storage, loss = _parts(best)
    k = int(np.argmax(loss))
    letter = "G" if _symbol(found) == "|G*|" else "E"
    return (
        f"Cole–Cole diagram: loss modulus {letter}″ over storage modulus {letter}′. {letter}″ is largest, {look.modulus(loss[k])}, at "
        f"{look.hertz(best.frequency[k])}{', ' + best.label if best.label else ''}."
    )


def black(found: list[Curve]) -> Any:
    """Draws |E*| over the phase angle."""
    factor, unit = look.modulus_unit(e for c in found for e in c.e_star)
    figure, axes = look.figure(look.THIRD, 2.2)
    for c in found:
        axes.plot(c.phase, factor * c.e_star, marker=c.marker, color=c.colour, ms=3, label=c.label)
    axes.set(xlabel="phase angle φ (°)", ylabel=f"{_symbol(found)} ({unit})")
    if _covers_wide_range(found):
        axes.set_yscale("log")
        decades(axes.yaxis)
    return figure


def _covers_wide_range(found: list[Curve]) -> bool:
    """Whether |E*| covers more than a factor of four, so that its axis is logarithmic."""
    return max(c.e_star.max() for c in found) > 4 * min(c.e_star.min() for c in found)


def _colour_note(found: list[Curve]) -> str:
    return " The colours are the same as in the picture above." if len(found) > 1 else ""
