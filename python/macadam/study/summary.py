# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the report of a study: main effects, scatter over seeds, a map over two factors, failures."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pandas as pd

from macadam.report import look
from macadam.report.document import write
from macadam.report.page import Page
from macadam.study import table
from macadam.study.design import Design, number_and_unit
from macadam.study.effects import FEW, Effect, Quantity, continuous, effects, numeric, quantities, scatter, short
from macadam.study.programs import error_line

if TYPE_CHECKING:
    from macadam.study.driver import Study

MOST = 4  # largest number of factors in one picture
NOTES = 20  # largest number of sentences about points with equal scenes


def write_report(design: Design, study: Study, folder: Path) -> Path:
    """Writes report.html into the study's folder and returns its path."""
    page = Page()
    with look.style():
        _fill(page, design, study, folder)
    rows = study.table
    versions = ", ".join(sorted(set(rows["macadam"].dropna()))) if "macadam" in rows else ""
    return write(
        page,
        folder / "report.html",
        f"Study {folder.name}",
        f"Report of a study{', macadam ' + versions if versions else ''}.",
    )


# Adds all sections of the report to the page.
def _fill(page: Page, design: Design, study: Study, folder: Path) -> None:
    found, failed, missing = study.table, study.failures, study.missing
    done = found["key"].nunique() if len(found) else 0
    page.section("In short")
    if missing:
        page.text(
            f"{missing} of {len(design.results)} results are missing: {study.reason}. "
            "Run the same command again to continue.",
            "failure",
        )
    if failed:
        number = table.failed_results(failed)
        page.text(f"{number} of {len(design.results)} failed; they are listed below.", "warning")
    page.text(f"{done} results at {_count(design)}.", "lead")
    for note in study.notes[:NOTES]:
        page.text(f"{note}.", "warning")
    if len(study.notes) > NOTES:
        page.text(f"{len(study.notes) - NOTES} more points have the same scene as another point.", "warning")
    values = quantities(found, design) if len(found) else []
    for q in values:
        words = f"{q.title}: {_value(q, q.jobs['value'].min())} to {_value(q, q.jobs['value'].max())}{_strongest_factor_words(q)}"
        page.text(words[:1].upper() + words[1:] + ".")
    page.table(["factor", "values", "number"], _factors(design), "Factors that differ between the points.", words=2)
    page.section("Main effects")
    for q in values:
        _main_effects(page, q)
    page.section("Maps")
    for q in values:
        drawn = design_map(q)
        if drawn:
            page.figure(*drawn, f"map of {q.title}")
    page.section("Scatter over seeds")
    _seeds(page, values)
    page.section("Failures")
    if failed:
        page.table(
            ["experiment", "at", "message"],
            [
                [
                    f["experiment"] or "–",
                    "; ".join(f"{k} = {v}" for k, v in f["values"].items()),
                    error_line(f["message"]),
                ]
                for f in failed
            ],
            words=3,
        )
    page.section("Where it was computed")
    _machines(page, design, folder)


def _strongest_factor_words(q: Quantity) -> str:
    """Returns the end of a sentence that names the factor with the largest effect on a quantity; empty if no factor
    differs."""
    found = effects(q)
    if not found:
        return ""
    first = found[0]
    name, change = short(first.factor), _change_words(q, first) + _from_to(first)
    if first.within_scatter:
        most = "the change" if len(found) == 1 else "the largest change,"
        return f"; {most} with {name} ({change}) is within the scatter of seeds ({_chance(q, first)})"
    if len(found) == 1:
        low, high = (_level(first.levels[k]) for k in first.at_ends)
        return f"; if {name} changes from {low} to {high}, {q.name} changes by {_change_words(q, first)}"
    share = look.percent(first.share, 2)
    return f"; it depends most on {name} ({change}), which causes {share} of the variance between points"


# Returns the number of points, seeds and experiments in words.
def _count(design: Design) -> str:
    seeds: dict[str, set[str]] = {}
    for job in design.jobs:
        others = str([(k, v) for k, v in job.values.items() if k.split(".")[-1] != "seed"])
        seeds.setdefault(others, set()).add(str(job.values))
    numbers = {len(s) for s in seeds.values()}
    experiments = sorted({job.experiment for job in design.jobs if job.experiment})
    each = (
        "" if numbers == {1} else f", each with {numbers.pop()} seeds" if len(numbers) == 1 else ", with several seeds"
    )
    return f"{len(seeds)} points of the study{each}" + (
        f", in each of {len(experiments)} experiments ({', '.join(experiments)})" if len(experiments) > 1 else ""
    )


def _value(q: Quantity, value: float) -> str:
    return f"{look.number(float(value))}{'' if q.unit == '°' else ' '}{q.unit}"


def _factors(design: Design) -> list[list[Any]]:
    rows = []
    for factor in design.factors:
        values = list(dict.fromkeys(str(job.values[factor]) for job in design.jobs if factor in job.values))
        parts = [number_and_unit(v) for v in values]
        if len(values) > FEW and all(number is not None for number, _ in parts):
            ends = [pick(parts) for pick in (min, max)]
            shown = f"{_level(ends[0][0])} … {_level(ends[1][0])} {ends[1][1]}"
        else:
            shown = ", ".join(v if len(v) < 40 else v[:37] + "…" for v in values[:FEW]) + " …" * (len(values) > FEW)
        rows.append([factor, shown, len(values)])
    return rows


# Adds pictures and the table of the main effects on a quantity.
def _main_effects(page: Page, q: Quantity) -> None:
    found = effects(q)
    if not found:
        return
    points = q.points
    for first in range(0, len(found), MOST):
        shown = found[first : first + MOST]
        figure, axes = look.figure(
            look.WIDE if len(shown) > 1 else look.WIDE / 2, 2.4, 1, len(shown), sharey=True, squeeze=False
        )
        for axis, effect in zip(axes[0], shown, strict=True):
            _panel(axis, effect, points)
        axes[0, 0].set_ylabel(f"{q.name} ({q.unit})")
        words = "; ".join(f"{short(e.factor)}: {_change_words(q, e)}{_from_to(e)}" for e in shown)
        bars = any(e.errors for e in shown)
        dots = "Dots with bars" if bars else "Dots"
        error = ", and its standard error from the scatter of seeds" if bars else ""
        page.figure(
            figure,
            f"Main effects on {q.title}. {dots}: mean over all points at that value{error}. "
            f"Changes: {words}.",
            f"main effects on {q.title}",
        )
    _table_of_effects(page, q, found)


def _table_of_effects(page: Page, q: Quantity, found: list[Effect]) -> None:
    """Adds the table of effects. The table has the scatter of seeds if it is known, and the fractions of the variance
    if there are several factors."""
    heads, notes = ["factor", "from … to", f"change of {q.name}"], []
    rows = [[e.factor, " … ".join(_level(e.levels[k]) for k in e.at_ends), _change_words(q, e)] for e in found]
    if any(e.scatter is not None for e in found):
        heads.append("scatter of seeds (95 %)")
        for row, e in zip(rows, found, strict=True):
            row.append(_chance(q, e) + (": the effect is within the scatter" if e.within_scatter else ""))
        notes.append(
            "The scatter of seeds is the change between these two values that other seeds alone may cause. It is half the "
            "width of a 95 % interval, for seeds that are independent of each other. An F-test over all values of the factor decides "
            "whether its effect is within the scatter. Such an effect may be chance."
        )
    if len(found) > 1:
        heads.append("fraction of the variance")
        for row, e in zip(rows, found, strict=True):
            row.append(look.percent(e.share))
        notes.append("The fractions need not add up to 100 %, because joint effects of factors and chance also cause variance.")
    page.table(heads, rows, f"{q.title}. {' '.join(notes)}", words=2)


def _level(value: Any) -> str:
    if not isinstance(value, (int, float)):
        return str(value) if len(str(value)) < 40 else f"{str(value)[:37]}…"
    text = f"{value:.4g}"
    return look.number(float(value), 3) if "e" in text else text.replace("-", "−")


def _change_words(q: Quantity, effect: Effect) -> str:
    """Returns the change of an effect as text: in degrees for an angle, otherwise in per cent of the mean at the first
    of the two levels."""
    first, last = effect.ends
    text = f"{last - first:+.2g}°" if q.unit == "°" else f"{100 * (last / first - 1):+.3g} %" if first else "–"
    return text.replace("-", "−")


def _from_to(effect: Effect) -> str:
    """Returns the two values of the factor between which the quantity changes, as the end of a sentence. Returns an
    empty text if the factor is a number and the two values are the first and the last one."""
    first, last = effect.at_ends
    if isinstance(effect.levels[0], (int, float)) and (first, last) == (0, len(effect.levels) - 1):
        return ""
    return f" from {_level(effect.levels[first])} to {_level(effect.levels[last])}"


def _chance(q: Quantity, effect: Effect) -> str:
    """Returns the scatter of the change as text, in the same unit as the change."""
    if effect.scatter is None:
        return "–"
    first = abs(effect.ends[0])
    return f"±{effect.scatter:.2g}°" if q.unit == "°" else f"±{100 * effect.scatter / first:.2g} %" if first else "–"


# Draws one factor's effect: all points in grey, and the means or the fitted line.
def _panel(axis: Any, effect: Effect, points: pd.DataFrame) -> None:
    axis.set_xlabel(short(effect.factor))
    x, y = points[effect.factor], points["value"]
    if not numeric(points, effect.factor):
        axis.plot([effect.levels.index(v) for v in x], y, "o", color="#c3c7cc", ms=2.5)
        axis.errorbar(range(len(effect.levels)), effect.means, effect.errors, fmt="o", color=look.COLOURS[0])
        axis.set_xticks(range(len(effect.levels)), [str(v)[:14] for v in effect.levels])
        axis.margins(x=0.2)
        return
    axis.plot(x, y, "o", color="#c3c7cc", ms=2.5)
    if continuous(points, effect.factor):
        axis.plot(effect.levels, effect.means, "-", color=look.COLOURS[0])
    else:
        axis.errorbar(effect.levels, effect.means, effect.errors, fmt="o-", color=look.COLOURS[0])
        axis.set_xticks(effect.levels)
    axis.margins(x=0.08)


def design_map(q: Quantity) -> tuple[Any, str] | None:
    """Draws a quantity over the two numeric factors with the largest effects, averaged over the other factors. Returns
    figure and caption; None if there are fewer than two numeric factors."""
    points = q.points
    two = sorted([e.factor for e in effects(q) if numeric(points, e.factor)][:2])
    if len(two) < 2:
        return None
    figure, axis = look.figure(look.WIDE * 0.72, 3.3)
    mean = points.groupby(two)["value"].mean().reset_index()
    grid = mean.pivot(index=two[1], columns=two[0], values="value")
    x, y = grid.columns.to_numpy(float), grid.index.to_numpy(float)
    if grid.notna().all().all() and min(grid.shape) > 1 and max(grid.shape) <= 4 * FEW:
        drawn = axis.contourf(x, y, grid.to_numpy(), levels=12, cmap="viridis")
        for i, j in np.ndindex(grid.shape) if grid.size <= 60 else ():
            value = grid.to_numpy()[i, j]
            axis.annotate(
                look.number(float(value), 3),
                (x[j], y[i]),
                ha="center",
                va="center",
                fontsize=6.5,
                bbox={"boxstyle": "round,pad=0.2", "fc": "white", "alpha": 0.8, "lw": 0},
            )
        axis.grid(False)
        axis.set_xticks(x)
        axis.set_yticks(y)
        for ends, reach in ((x, axis.set_xlim), (y, axis.set_ylim)):  # space for the numbers at the edge
            reach(ends[0] - 0.09 * np.ptp(ends), ends[-1] + 0.09 * np.ptp(ends))
        how = "The numbers belong to the points; colours are interpolated between them."
    else:
        drawn = axis.scatter(mean[two[0]], mean[two[1]], c=mean["value"], cmap="viridis", s=28)
        how = "Each dot is a point."
    figure.colorbar(drawn, ax=axis, label=f"{q.name} ({q.unit})")
    axis.set(xlabel=short(two[0]), ylabel=short(two[1]))
    best, worst = mean.loc[mean["value"].idxmax()], mean.loc[mean["value"].idxmin()]
    return figure, (
        f"Map of {q.title} over {short(two[0])} and {short(two[1])}, the mean over seeds and other factors. "
        f"It is largest, "
        f"{_value(q, best['value'])}, at {_level(float(best[two[0]]))} and {_level(float(best[two[1]]))}, and "
        f"smallest, {_value(q, worst['value'])}, at {_level(float(worst[two[0]]))} and "
        f"{_level(float(worst[two[1]]))}. {how}"
    )


def _seeds(page: Page, values: list[Quantity]) -> None:
    rows = []
    for q in values:
        known = scatter(q)
        if known:
            of_mean = look.percent(known.relative / known.fewest**0.5)
            numbers = f"{known.fewest} to {known.most}" if known.fewest < known.most else known.fewest
            rows.append([q.title, look.percent(known.relative), of_mean, known.points, numbers])
    if rows:
        page.table(
            ["quantity", "standard deviation", "of the mean over seeds", "points with several seeds", "seeds per point"],
            rows,
            "Deviation of single specimens of a mix from the mean of its point, relative to this mean, pooled over the "
            "points. The third column is the standard deviation of the mean of a point with the fewest seeds. "
            "Smaller differences between points may be chance.",
            words=1,
        )


def _machines(page: Page, design: Design, folder: Path) -> None:
    rows: dict[tuple[str, str], list[float]] = {}
    for job in design.results:
        file = folder / "results" / job.key / "study.json"
        if file.is_file():
            record = table.read_json(file)
            rows.setdefault((record["machine"]["name"], record["machine"]["processor"]), []).append(record["wall_s"])
    page.table(
        ["machine", "processor", "results", "median time", "sum of times"],
        [
            [name, processor, len(times), look.seconds(float(np.median(times))), look.seconds(sum(times))]
            for (name, processor), times in rows.items()
        ],
        words=2,
    )
