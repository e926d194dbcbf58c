# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers of a study: one value a job of each quantity, main effects of factors, scatter over seeds."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
import pandas as pd

from macadam.study import table
from macadam.study.design import Design

FEW = 8  # different values up to which a factor has levels; one with more is continuous


@dataclass
class Quantity:
    """One number a job. `jobs`: a row a job, the factors' columns and `value`; `seeds`: names of the factors that draw
    another specimen of the same mix; `factors`: the others that differ at all."""

    name: str
    unit: str
    at: str  # such as "10 Hz, 20 °C"
    experiment: str
    jobs: pd.DataFrame
    factors: list[str] = field(default_factory=list)
    seeds: list[str] = field(default_factory=list)

    @property
    def title(self) -> str:
        where = f"{self.name} at {self.at}" if self.at else self.name
        return f"{where} ({self.experiment})" if self.experiment else where

    @property
    def points(self) -> pd.DataFrame:
        """Means over the seeds: a row a point."""
        if not self.factors:
            return pd.DataFrame({"value": [self.jobs["value"].mean()]})
        return self.jobs.groupby(self.factors, sort=False, dropna=False)["value"].mean().reset_index()


_AT = (
    ("frequency_hz", "frequency", 10.0, "Hz"),
    ("temperature_c", "temperature", 20.0, "°C"),
    ("time_s", "", np.inf, "s"),
)
# column of the table, and name, unit and factor of the report; larger values of a modulus are in GPa
_SHOWN = (
    ("e_star_pa", "|E*|", "MPa", 1e-6),
    ("phase_deg", "phase angle", "°", 1.0),
    ("modulus_pa", "relaxation modulus", "MPa", 1e-6),
    ("secant_pa", "secant modulus", "MPa", 1e-6),
    ("compliance_1_pa", "creep compliance", "1/GPa", 1e9),
)


def quantities(found: pd.DataFrame, design: Design) -> list[Quantity]:
    """|E*| and phase angle at the frequency (and temperature) of [report], else next to 10 Hz (20 °C); for tests in time
    the moduli and compliances at the last time."""
    units = table.units(design)
    names = {column: f"{f} ({units[f]})" if units[f] else f for f, column in table.columns(design).items()}
    experiments = found["experiment"].unique() if "experiment" in found else [None]
    out = []
    for experiment in experiments:
        rows = found if experiment is None else found[found["experiment"] == experiment]
        rows, at = _nearest(rows, design.report)
        for column, name, unit, scale in _SHOWN:
            if column in rows and rows[column].notna().any():
                jobs = rows[[n for n in names if n in rows] + [column]].rename(columns=names | {column: "value"})
                jobs["value"] *= scale
                if unit == "MPa" and jobs["value"].abs().max() >= 1e3:
                    jobs["value"], unit = 1e-3 * jobs["value"], "GPa"
                differ = [n for n in names.values() if n in jobs and jobs[n].nunique(dropna=False) > 1]
                seeds = [n for n in differ if n.split(".")[-1] == "seed"]
                factors = [n for n in differ if n not in seeds]
                out.append(
                    Quantity(name, unit, ", ".join(at), experiment or "", jobs.reset_index(drop=True), factors, seeds)
                )
    return out


def _nearest(rows: pd.DataFrame, report: dict[str, float]) -> tuple[pd.DataFrame, list[str]]:
    """The rows at the frequency, temperature or time to show, and these in words."""
    at = []
    for column, key, default, unit in _AT:
        if column in rows and rows[column].notna().any():
            rows = rows[rows[column].notna()]
            values, wanted = rows[column].unique(), report.get(key, default)
            nearest = values.max() if wanted == np.inf else values[np.argmin(np.abs(values - wanted))]
            rows = rows[rows[column] == nearest]
            at.append(f"{nearest:.4g} {unit}")
    return rows, at


def short(factor: str) -> str:
    """The end of a factor's key, enough to know it by: `air voids (%)`, `M-A.delta`."""
    key, _, unit = factor.partition(" (")
    parts = key.split(".")
    name = ".".join(parts[-2:]) if parts[0] == "contacts" else parts[-1].replace("_", " ")
    return f"{name} ({unit}" if unit else name


def numeric(points: pd.DataFrame, factor: str) -> bool:
    return pd.api.types.is_numeric_dtype(points[factor])


@dataclass
class Effect:
    """What a factor does to a quantity, the others averaged. `share`: of the variance between points (0 to 1)."""

    factor: str
    levels: list[Any]  # from where to where
    means: list[float]
    share: float
    errors: list[float] | None = None  # standard errors of the means, from the scatter of seeds; None: it is unknown
    scatter: float | None = None  # half the 95 % interval of the change between the ends, from the same

    @property
    def ends(self) -> tuple[float, float]:
        """Means at the first level and the last; of names the lowest and the highest."""
        if isinstance(self.levels[0], (int, float)):
            return self.means[0], self.means[-1]
        return min(self.means), max(self.means)

    @property
    def within_scatter(self) -> bool:
        """Whether other seeds could have given such a change without any effect; false if the scatter is unknown."""
        first, last = self.ends
        return self.scatter is not None and abs(last - first) <= self.scatter


def continuous(points: pd.DataFrame, factor: str) -> bool:
    return numeric(points, factor) and points[factor].nunique() > FEW


def _lines(points: pd.DataFrame, factors: list[str]) -> dict[str, tuple[float, float]]:
    """Returns the slope of each continuous factor, and its standard error if the points have a standard deviation of 1.
    It fits all factors at once: values of a hypercube are not quite independent, and one factor's effect must not count
    as another's."""
    smooth = [f for f in factors if continuous(points, f)]
    if not smooth:
        return {}
    columns = [points[f].to_numpy(float) for f in smooth]
    scales = [c.std() for c in columns]
    matrix = [(c - c.mean()) / s for c, s in zip(columns, scales, strict=True)]
    for factor in (f for f in factors if f not in smooth):
        codes = pd.factorize(points[factor])[0]
        matrix += [(codes == k).astype(float) for k in range(1, codes.max() + 1)]
    all_of_them = np.column_stack([*matrix, np.ones(len(points))])
    found = np.linalg.lstsq(all_of_them, points["value"].to_numpy(float), rcond=None)[0]
    errors = np.sqrt(np.diag(np.linalg.pinv(all_of_them.T @ all_of_them)))
    return {f: (float(v / s), float(e / s)) for f, v, e, s in zip(smooth, found, errors, scales, strict=False)}


def effects(quantity: Quantity) -> list[Effect]:
    """One effect per factor, the largest share of the variance first. The levels of a continuous factor are the ends of
    its line."""
    points, out = quantity.points, []
    total = float(((points["value"] - points["value"].mean()) ** 2).sum())
    lines, chance = _lines(points, quantity.factors), scatter(quantity)
    for factor in quantity.factors:
        if factor in lines:
            x, (slope, error) = points[factor].to_numpy(float), lines[factor]
            ends = [float(x.min()), float(x.max())]
            means = [float(points["value"].mean() + slope * (e - x.mean())) for e in ends]
            effect = Effect(factor, ends, means, float(((slope * (x - x.mean())) ** 2).sum()) / total if total else 0.0)
            if chance:  # the error of the change; points are means over seeds
                each = error * (ends[1] - ends[0]) * chance.deviation / chance.fewest**0.5
                effect.scatter = student_95(chance.freedom) * each
            out.append(effect)
            continue
        groups = points.groupby(factor, sort=numeric(points, factor), dropna=False)["value"]
        mean, number = groups.mean(), groups.size()
        between = float((number * (mean - points["value"].mean()) ** 2).sum())
        levels = [v.item() if isinstance(v, np.generic) else v for v in mean.index]
        effect = Effect(factor, levels, list(map(float, mean)), between / total if total else 0.0)
        if chance:
            effect.errors = [chance.deviation / (n * chance.fewest) ** 0.5 for n in number]
            first, last = (effect.errors[effect.means.index(e)] for e in effect.ends)
            effect.scatter = student_95(chance.freedom) * (first**2 + last**2) ** 0.5
        out.append(effect)
    return sorted(out, key=lambda e: -e.share)


@dataclass
class Scatter:
    """How much the seeds of one point differ, pooled over the points that have several."""

    deviation: float  # standard deviation, in the quantity's unit
    relative: float  # the same, relative to each point's mean
    points: int
    fewest: int  # seeds of a point
    freedom: int  # degrees of freedom


def scatter(quantity: Quantity) -> Scatter | None:
    """The scatter of seeds; None if no point has several."""
    if not quantity.seeds:
        return None
    groups = quantity.jobs.groupby(quantity.factors, dropna=False)["value"] if quantity.factors else None
    values = [g.to_numpy(float) for _, g in groups] if groups is not None else [quantity.jobs["value"].to_numpy(float)]
    values = [v for v in values if len(v) > 1]
    if not values:
        return None
    freedom = sum(len(v) - 1 for v in values)
    squares = sum(float(((v - v.mean()) ** 2).sum()) for v in values)
    relative = sum(float(((v / v.mean() - 1) ** 2).sum()) for v in values if v.mean())
    return Scatter(
        (squares / freedom) ** 0.5, (relative / freedom) ** 0.5, len(values), min(map(len, values)), freedom
    )


def student_95(freedom: int) -> float:
    """Student's t: how many standard errors hold 95 % of the differences that chance makes. To three digits."""
    few = (12.71, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228)
    if freedom <= len(few):
        return few[freedom - 1]
    z = 1.959964  # the normal distribution's, and the first terms of the series in 1/freedom
    return z + (z**3 + z) / (4 * freedom) + (5 * z**5 + 16 * z**3 + 3 * z) / (96 * freedom**2)
