# SPDX-License-Identifier: GPL-3.0-or-later
"""Evaluates a study: one value per job of each quantity, main effects of the factors, scatter over seeds."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
import pandas as pd

from macadam.study import table
from macadam.study.design import Design
from macadam.study.quantiles import fisher_95

FEW = 8  # largest number of levels of a factor; a numeric factor with more different values is continuous


@dataclass
class Quantity:
    """One number per job. `jobs`: one row per job, with the columns of the factors and `value`; `seeds`: names of the
    factors that only choose another random specimen of the same mix; `factors`: the other factors whose values
    differ."""

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
        """Means over the seeds, one row per point."""
        if not self.factors:
            return pd.DataFrame({"value": [self.jobs["value"].mean()]})
        return self.jobs.groupby(self.factors, sort=False, dropna=False)["value"].mean().reset_index()

    @property
    def repetitions(self) -> np.ndarray:
        """Number of seeds of each point, in the order of `points`."""
        if not self.factors:
            return np.array([len(self.jobs)])
        return self.jobs.groupby(self.factors, sort=False, dropna=False)["value"].size().to_numpy()


# Coordinates at which quantities are shown: column of the table, key of [report], default value, unit. The default
# infinity means the largest value in the table.
_AT = (
    ("frequency_hz", "frequency", 10.0, "Hz"),
    ("temperature_c", "temperature", 20.0, "°C"),
    ("time_s", "", np.inf, "s"),
)
# column of the table, and its name, unit and factor in the report; moduli of 1000 MPa or more are shown in
# GPa
_SHOWN = (
    ("e_star_pa", "|E*|", "MPa", 1e-6),
    ("g_star_pa", "|G*|", "MPa", 1e-6),
    ("phase_deg", "phase angle", "°", 1.0),
    ("modulus_pa", "relaxation modulus", "MPa", 1e-6),
    ("secant_pa", "secant modulus", "MPa", 1e-6),
    ("compliance_1_pa", "creep compliance", "1/GPa", 1e9),
)


def quantities(found: pd.DataFrame, design: Design) -> list[Quantity]:
    """Returns the quantities that the report shows: |E*| and phase angle at the frequency (and temperature) of [report]
    or, by default, at those nearest to 10 Hz (20 °C); for tests in time the moduli and compliances at the last time."""
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
    """Returns the rows at the frequency, temperature or time to show, and these values as texts."""
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
    """Returns the end of a factor's key, by which it can be recognised: `air voids (%)`, `M-A.delta`."""
    key, _, unit = factor.partition(" (")
    parts = key.split(".")
    name = ".".join(parts[-2:]) if parts[0] == "contacts" else parts[-1].replace("_", " ")
    return f"{name} ({unit}" if unit else name


def numeric(points: pd.DataFrame, factor: str) -> bool:
    return pd.api.types.is_numeric_dtype(points[factor])


@dataclass
class Effect:
    """The main effect of a factor on a quantity: its means at the factor's levels, averaged over the other factors.
    `share`: the fraction of the variance between points that the factor explains (0 to 1)."""

    factor: str
    levels: list[Any]  # values of the factor; for a continuous factor, the lowest and the highest
    means: list[float]  # mean of the quantity at each level
    share: float
    errors: list[float] | None = None  # standard errors of the means, from the scatter of seeds; None: it is unknown
    # half of the 95 % interval of the change between the two ends, from the scatter of seeds; None:
    # it is unknown
    scatter: float | None = None
    within_scatter: bool = False  # whether different seeds alone can explain all differences between the means

    @property
    def at_ends(self) -> tuple[int, int]:
        """The indices of the two levels whose difference is the change. If the levels are numbers and the means only
        rise or only fall, these are the first and the last level, otherwise the levels with the smallest and the
        largest mean."""
        steps = np.diff(self.means)
        if all(isinstance(v, (int, float)) for v in self.levels) and ((steps >= 0).all() or (steps <= 0).all()):
            return 0, len(self.levels) - 1
        return int(np.argmin(self.means)), int(np.argmax(self.means))

    @property
    def ends(self) -> tuple[float, float]:
        """The means at the two levels of `at_ends`."""
        first, last = self.at_ends
        return self.means[first], self.means[last]

    def compare(self, variances: np.ndarray, chance: Scatter) -> None:
        """Compares the means with the scatter of seeds by an F-test over all levels, which compares the mean square
        between the levels with the variance of seeds. Sets `scatter` to half of Scheffé's 95 % interval of the change
        (for two levels this is Student's interval). So the change is never larger than `scatter` if the test finds no
        effect. variances: variance of each mean, divided by the variance of a single seed."""
        means, freedom = np.array(self.means), len(self.means) - 1
        limit = freedom * fisher_95(freedom, chance.freedom) * chance.deviation**2
        between = (((means - np.average(means, weights=1 / variances)) ** 2) / variances).sum()
        self.errors = [float(e) for e in chance.deviation * variances**0.5]
        self.scatter = float((limit * variances[list(self.at_ends)].sum()) ** 0.5)
        self.within_scatter = bool(between <= limit)


# Whether a factor is numeric and has more than FEW different values.
def continuous(points: pd.DataFrame, factor: str) -> bool:
    return numeric(points, factor) and points[factor].nunique() > FEW


def _lines(points: pd.DataFrame, factors: list[str], repetitions: np.ndarray) -> dict[str, tuple[float, float]]:
    """Returns the slope of each continuous factor, and the standard error that the slope would have if every seed had a
    standard deviation of 1. All factors are fitted together by least squares; a factor with levels has a column of 0
    and 1 per level. The values of a hypercube are slightly correlated, and a fit of single factors would attribute the
    effect of one factor to another.
    repetitions: number of seeds of each point. As in the means of levels, each point counts once."""
    smooth = [f for f in factors if continuous(points, f)]
    if not smooth:
        return {}
    columns = [points[f].to_numpy(float) for f in smooth]
    scales = [c.std() for c in columns]
    matrix = [(c - c.mean()) / s for c, s in zip(columns, scales, strict=True)]
    for factor in (f for f in factors if f not in smooth):
        codes = pd.factorize(points[factor])[0]
        matrix += [(codes == k).astype(float) for k in range(1, codes.max() + 1)]
    inverse = np.linalg.pinv(np.column_stack([*matrix, np.ones(len(points))]))
    found = inverse @ points["value"].to_numpy(float)
    errors = np.sqrt(inverse**2 @ (1 / repetitions))
    return {f: (float(v / s), float(e / s)) for f, v, e, s in zip(smooth, found, errors, scales, strict=False)}


def effects(quantity: Quantity) -> list[Effect]:
    """Returns one effect per factor, the largest fraction of the variance first. A continuous factor has two levels, the
    ends of its fitted line."""
    points, repetitions, out = quantity.points, quantity.repetitions, []
    total = float(((points["value"] - points["value"].mean()) ** 2).sum())
    lines, chance = _lines(points, quantity.factors, repetitions), scatter(quantity)
    for factor in quantity.factors:
        if factor in lines:
            x, (slope, error) = points[factor].to_numpy(float), lines[factor]
            ends = [float(x.min()), float(x.max())]
            means = [float(points["value"].mean() + slope * (e - x.mean())) for e in ends]
            effect = Effect(factor, ends, means, float(((slope * (x - x.mean())) ** 2).sum()) / total if total else 0.0)
            if chance:
                # The means at the two ends depend on the same slope, so their errors are not independent. Half of the
                # variance of the change is given to each end.
                effect.compare(np.full(2, 0.5 * (error * (ends[1] - ends[0])) ** 2), chance)
                effect.errors = None  # a fitted line has no means at single levels
            out.append(effect)
            continue
        by = points[factor]
        groups = points["value"].groupby(by, sort=numeric(points, factor), dropna=False)
        mean, number = groups.mean(), groups.size()
        between = float((number * (mean - points["value"].mean()) ** 2).sum())
        levels = [v.item() if isinstance(v, np.generic) else v for v in mean.index]
        effect = Effect(factor, levels, list(map(float, mean)), between / total if total else 0.0)
        # the mean of a level is over the points of the level, and the value of each point is a mean over seeds
        if chance:
            inverse = pd.Series(1 / repetitions, points.index).groupby(by, sort=numeric(points, factor), dropna=False)
            effect.compare(inverse.sum().to_numpy() / number.to_numpy() ** 2, chance)
        out.append(effect)
    return sorted(out, key=lambda e: -e.share)


@dataclass
class Scatter:
    """The scatter between seeds of one point, pooled over the points that have several seeds."""

    deviation: float  # standard deviation, in the quantity's unit
    relative: float  # the standard deviation as a fraction of the mean of each point
    points: int  # number of points with several seeds
    fewest: int  # smallest number of seeds of a point, 1 if a point has a single seed
    most: int  # largest number of seeds of a point
    freedom: int  # degrees of freedom


def scatter(quantity: Quantity) -> Scatter | None:
    """Returns the scatter of seeds; None if no point has several seeds."""
    if not quantity.seeds:
        return None
    groups = quantity.jobs.groupby(quantity.factors, dropna=False)["value"] if quantity.factors else None
    values = [g.to_numpy(float) for _, g in groups] if groups is not None else [quantity.jobs["value"].to_numpy(float)]
    several = [v for v in values if len(v) > 1]
    if not several:
        return None
    freedom = sum(len(v) - 1 for v in several)
    squares = sum(float(((v - v.mean()) ** 2).sum()) for v in several)
    relative = sum(float(((v / v.mean() - 1) ** 2).sum()) for v in several if v.mean())
    numbers = [len(v) for v in values]
    return Scatter(
        (squares / freedom) ** 0.5, (relative / freedom) ** 0.5, len(several), min(numbers), max(numbers), freedom
    )
