# SPDX-License-Identifier: GPL-3.0-or-later
"""The report of a mixture: master curve, table of |E*| and phase, the scales and their laws, the fit of the binder."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from macadam.report import look
from macadam.report.document import write
from macadam.report.modulus import decades
from macadam.report.page import Page, points

if TYPE_CHECKING:
    import pandas

    from macadam.mixture.driver import Chain
    from macadam.mixture.steps import Step

_PREDICTED = (
    ("e_star_hirsch_pa", "Hirsch (prediction)", "x"),
    ("e_star_witczak_pa", "Witczak 1-37A (prediction)", "+"),
)


def report(chain: Chain, table: pandas.DataFrame, file: Path) -> Path:
    """Writes the report of a mixture to one HTML file. table: of mixture.csv."""
    with look.style():
        page = Page()
        _overview(page, chain, table)
        _results(page, chain, table)
        _scales(page, chain)
        _binder(page, chain)
        page.section("Decisions")
        page.columns([("", look.COLOURS[0], points(chain.decisions))])
    title = chain.design.title or chain.design.file.stem
    return write(page, file, title, f"Report of a mixture, from its binder to its modulus; {chain.version}.")


def _overview(page: Page, chain: Chain, table: pandas.DataFrame) -> None:
    page.section("In short")
    for words in chain.warnings:
        page.text(f"warning: {words}", "warning")
    order = table.sort_values("reduced_frequency_hz")
    ends = [
        f"{look.modulus(r.e_star_pa)} and {r.phase_deg:.1f}° at {r.temperature_c:g} °C and {look.hertz(r.frequency_hz)}"
        for r in (order.iloc[-1], order.iloc[0])
    ]
    page.text(f"|E*| and φ of the mixture are {ends[0]}, and {ends[1]}.", "lead")
    page.text(
        "They are computed from the binder's measurements and the mix design. No factor was fitted to tests of a "
        "mixture, and the result has not been compared with a measurement of this mixture."
    )


def _results(page: Page, chain: Chain, table: pandas.DataFrame) -> None:
    page.section("Stiffness modulus |E*| and phase angle φ")
    page.figure(
        _master(chain, table),
        f"Master curves of all scales at {chain.design.binder.reference_temperature:g} °C. Bars: standard deviation "
        "over the seeds. Hirsch and Witczak 1-37A are predictions by regressions to tests of other mixtures; they "
        "are not measurements. Grey: between the bounds of Hashin and Shtrikman for the magnitudes of the moduli; "
        "the lower bound is for aggregate and binder without air voids.",
        "master curves of all scales",
    )
    factor, unit = look.modulus_unit(table.e_star_pa)
    number = look.number
    rows = []
    for r in table.itertuples():
        moduli = (r.e_star_hirsch_pa, r.e_star_witczak_pa, r.hashin_shtrikman_lower_pa, r.hashin_shtrikman_upper_pa)
        rows.append(
            [f"{r.temperature_c:g}", f"{r.frequency_hz:g}", number(factor * r.e_star_pa)]
            + [number(100 * r.e_star_std_pa / r.e_star_pa, 2), number(r.phase_deg, 3), number(r.phase_std_deg, 2)]
            + [number(factor * value, 3) for value in moduli]
        )
    head = ["T (°C)", "f (Hz)", f"|E*| ({unit})", "std (%)", "φ (°)", "std (°)"]
    page.table(
        head + [f"{name} ({unit})" for name in ("Hirsch", "1-37A", "lower bound", "upper bound")],
        rows,
        "The mixture. Standard deviations (std) are over the seeds, and include the scatter of all scales.",
        words=0,
    )


def _master(chain: Chain, table: pandas.DataFrame) -> Any:
    figure, (left, right) = look.figure(look.WIDE, 3.2, 1, 2)
    factor, unit = look.modulus_unit(table.e_star_pa)
    shown = table.sort_values("reduced_frequency_hz")
    x = shown.reduced_frequency_hz
    left.fill_between(
        x, factor * shown.hashin_shtrikman_lower_pa, factor * shown.hashin_shtrikman_upper_pa, color="#e9ebee", lw=0
    )
    for k, step in enumerate(chain.steps):
        last = step is chain.steps[-1]
        more = {
            "color": look.COLOURS[k % len(look.COLOURS)],
            "label": step.name,
            "marker": "o" if last else "",
            "ms": 3,
        }
        left.errorbar(
            step.frequency, factor * step.e_star, np.nan_to_num(factor * step.e_star * step.e_scatter), **more
        )
        right.errorbar(step.frequency, step.phase, np.nan_to_num(step.phase_scatter), **more)
    for key, label, marker in _PREDICTED:
        left.plot(x, factor * shown[key], ls="", marker=marker, color="black", ms=4, label=label)
    right.plot(x, shown.phase_hirsch_deg, ls="", marker="x", color="black", ms=4)
    left.set(xscale="log", yscale="log", xlabel="reduced frequency (Hz)", ylabel=f"|E*| ({unit})")
    right.set(xscale="log", xlabel="reduced frequency (Hz)", ylabel="phase angle φ (°)", ylim=(0, None))
    for axis in (left.xaxis, right.xaxis, left.yaxis):
        decades(axis, 6)
    figure.legend(*left.get_legend_handles_labels(), loc="outside lower center", ncols=4)
    return figure


def _scales(page: Page, chain: Chain) -> None:
    page.section("The scales")
    page.table(
        ["scale", "how", "box", "aggregate in the solid (%)", "cells of aggregate (%)", "particles", "seeds"],
        [_row_of(step) for step in chain.steps[1:]],
        "Each scale holds its aggregate in the material of the scale above it in this table; the first one in the "
        "binder. The aggregate in the solid is by the mix design, without air voids; cells of aggregate are those of "
        "the specimens, relative to the box.",
        words=3,
    )
    for step in chain.steps:
        if step.kind == "rule":
            rows = step.facts["stiffening"]
            page.table(
                ["reduced frequency (Hz)"] + list(rows[0])[1:],
                [[f"{value:.3g}" for value in row.values()] for row in rows],
                f"|E*| of the {step.name} over |E*| of the binder by each rule. The computation uses "
                f"{step.facts['rule']}.",
                words=0,
            )
    page.table(
        ["law", "units", "holds from (Hz)", "to (Hz)", "largest difference (%)"],
        [
            [law.name, len(law.E), f"{law.valid_hz[0]:.2g}", f"{law.valid_hz[1]:.2g}", look.number(100 * law.misfit, 2)]
            for step in chain.steps
            for law in step.laws
        ],
        "Laws of the scales, with the range of reduced frequencies in which they hold and their largest difference "
        "from the computed values.",
    )


def _row_of(step: Step) -> list[Any]:
    """Returns the row of one scale in the table of scales."""
    facts = step.facts
    if step.kind == "rule":
        how = f"rule {facts['rule']}, below {1e3 * facts['below_m']:g} mm"
        return [step.name, how, "–", look.number(100 * facts["filler_volume_fraction"], 3), "–", "–", "–"]
    low, high = (1e3 * s for s in facts["sieves_m"])
    cells = [v["aggregate_cells"] for v in facts["volume_fractions"] if "aggregate_cells" in v]
    return [
        step.name,
        f"specimens of {low:g}–{high:g} mm",
        " × ".join(f"{1e3 * e:g}" for e in facts["box_m"]) + " mm",
        look.number(100 * facts["aggregate_volume_fraction"], 3),
        look.number(100 * float(np.mean(cells)), 3) if cells else "–",
        round(float(np.mean([p or 0 for p in facts["particles"]]))),
        len(facts["seeds"]),
    ]


def _binder(page: Page, chain: Chain) -> None:
    found, model = chain.binder, chain.binder.model
    page.section("The binder")
    modulus, phase, stiffness = found.errors
    creep = "" if stiffness is None else f", and {100 * stiffness:.2g} % of the creep stiffness"
    page.figure(
        _binder_figure(chain),
        "Measurements of the binder, and the fitted 2S2P1D model with the WLF shift (line). Its rms errors are "
        f"{100 * modulus:.2g} % of |G*| and {phase:.2g}°{creep}. Grey: the reduced frequencies that the test needs.",
        "master curve of the binder",
    )
    values = (
        model.glass / 1e9,
        model.k,
        model.h,
        model.delta,
        model.tau,
        model.beta,
        model.c1,
        model.c2,
        float(model.reference),
    )
    page.table(
        ["glass |G*| (GPa)", "k", "h", "δ", "τ (s)", "β", "C1", "C2 (K)", "reference (°C)"],
        [[look.number(value) for value in values]],
        "Constants of the binder.",
        words=0,
    )


def _binder_figure(chain: Chain) -> Any:
    found, model = chain.binder, chain.binder.model
    figure, (left, right) = look.figure(look.WIDE, 2.7, 1, 2)
    reduced = model.reduced(found.dsr.temperature, found.dsr.frequency)
    along = np.geomspace(min(reduced.min(), chain.needed[0]), max(reduced.max(), chain.needed[1]), 200)
    shear = model.shear(along)
    left.plot(along, abs(shear) / 1e6, color="black", lw=0.8)
    right.plot(along, np.degrees(np.angle(shear)), color="black", lw=0.8)
    warm = sorted(set(np.round(found.dsr.temperature)))
    for k, temperature in enumerate(warm):
        of = np.round(found.dsr.temperature) == temperature
        more = {"ls": "", "marker": "o", "ms": 2.5, "color": look.warmth(k, len(warm)), "label": f"{temperature:g} °C"}
        left.plot(reduced[of], found.dsr.modulus[of] / 1e6, **more)
        right.plot(reduced[of], found.dsr.phase[of], **more)
    for axes in (left, right):
        axes.axvspan(*chain.needed, color="#e9ebee", lw=0)
        axes.set(xscale="log", xlabel="reduced frequency (Hz)")
        decades(axes.xaxis, 6)
    left.set(yscale="log", ylabel="|G*| (MPa)")
    right.set(ylabel="phase angle δ (°)")
    decades(left.yaxis, 6)
    figure.legend(*left.get_legend_handles_labels(), loc="outside lower center", ncols=8)
    return figure
