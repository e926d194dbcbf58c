# SPDX-License-Identifier: GPL-3.0-or-later
"""Main effects of studies, compared with the scatter of seeds, and their sentences in the report."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from macadam.study.design import Design, read_design
from macadam.study.driver import Study
from macadam.study.effects import Quantity, effects, quantities, scatter
from macadam.study.quantiles import fisher_95, student_95
from macadam.study.summary import write_report


def asked(**factors: dict | list) -> Design:
    """Returns the design of a study with these factors and an empty scene."""
    return read_design({"scene": {}, **factors}, "1")


def test_effects_and_scatter_are_what_the_numbers_say(tmp_path: Path) -> None:
    rows = []
    for a in (1.0, 2.0, 3.0):
        for b in ("x", "y"):
            for seed, off in ((1, -0.1), (2, 0.1)):
                rows.append(
                    {
                        "a": a,
                        "b": b,
                        "seed": seed,
                        "frequency_hz": 10.0,
                        "e_star_pa": 1e6 * (10 * a + (b == "y")) * (1 + off),
                    }
                )
    design = asked(grid={"a": [1.0, 2.0, 3.0], "b": ["x", "y"], "seed": [1, 2]})
    (quantity,) = quantities(pd.DataFrame(rows), design)
    assert quantity.factors == ["a", "b"] and quantity.seeds == ["seed"] and quantity.title == "|E*| at 10 Hz"
    first, second = effects(quantity)
    assert first.factor == "a" and np.allclose(first.means, [10.5, 20.5, 30.5]) and second.factor == "b"
    assert np.allclose(second.ends, (20, 21)) and np.isclose(first.share + second.share, 1)
    chance = scatter(quantity)
    assert np.isclose(chance.relative, 0.1 * 2**0.5) and (chance.points, chance.fewest, chance.freedom) == (6, 2, 6)


def rows_of(change: float, offs: dict[int, float], b: tuple[str, ...] = ("x",)) -> pd.DataFrame:
    """Returns a table with a binder of 10 GPa and one of 10 GPa + change. offs: deviation of each seed; all in GPa."""
    return pd.DataFrame(
        [
            {"binder": k, "b": other, "seed": seed, "frequency_hz": 10.0, "e_star_pa": 1e9 * (10 + k * change + off)}
            for k in (0, 1)
            for other in b
            for seed, off in offs.items()
        ]
    )


@pytest.mark.parametrize("change, within", [(0.2, True), (0.45, True), (0.47, False), (2.0, False)])
def test_an_effect_within_the_scatter_of_seeds_is_told(change: float, within: bool, tmp_path: Path) -> None:
    """Three seeds of each binder with a standard deviation of 0.2 GPa have 4 degrees of freedom, so t = 2.776, and the
    half interval of the change is 0.2 GPa sqrt(2/3) t = 0.453 GPa."""
    design = asked(grid={"binder": [0, 1], "seed": [1, 2, 3]})
    (quantity,) = quantities(rows_of(change, {1: -0.2, 2: 0.0, 3: 0.2}), design)
    (effect,) = effects(quantity)
    assert np.isclose(effect.scatter, 0.4533, rtol=1e-3) and effect.within_scatter is within
    assert np.allclose(effect.errors, 0.2 / 3**0.5)
    write_report(design, Study(tmp_path, rows_of(change, {1: -0.2, 2: 0.0, 3: 0.2}).assign(key="k"), [], 0), tmp_path)
    page = (tmp_path / "report.html").read_text("utf-8")
    assert ("is within the scatter of seeds (±4.5 %)" in page) is within
    assert "fraction of the variance" not in page and "of the variance between points" not in page  # one factor
    assert "standard error from the scatter of seeds" in page


def test_without_several_seeds_nothing_is_said_of_chance(tmp_path: Path) -> None:
    design = asked(grid={"binder": [0, 1], "b": ["x", "y"]})
    rows = rows_of(0.2, {1: 0.0}, ("x", "y")).drop(columns="seed")
    (quantity,) = quantities(rows, design)
    assert all(e.scatter is None and e.errors is None and not e.within_scatter for e in effects(quantity))
    write_report(design, Study(tmp_path, rows.assign(key="k"), [], 0), tmp_path)
    page = (tmp_path / "report.html").read_text("utf-8")
    assert "scatter of seeds" not in page and "fraction of the variance" in page


def test_the_scatter_of_a_line() -> None:
    """For ten values of a factor with two seeds each, the error of the slope equals the textbook formula."""
    x = np.arange(10.0)
    rows = pd.DataFrame(
        [
            {"a": v, "seed": k, "frequency_hz": 10.0, "e_star_pa": 1e6 * (100 + v + off)}
            for v in x
            for k, off in ((1, -1.0), (2, 1.0))
        ]
    )
    design = asked(grid={"a": list(x), "seed": [1, 2]})
    (effect,) = effects(quantities(rows, design)[0])
    # Standard error of the slope. The two seeds of a point have a standard deviation of sqrt(2), and each
    # mean is of two seeds.
    error = 2**0.5 / 2**0.5 / ((x - x.mean()) ** 2).sum() ** 0.5
    assert np.isclose(effect.scatter, student_95(10) * 9 * error)


def of_levels(means: dict, offs: tuple[float, ...] = (-0.2, 0.0, 0.2)) -> pd.DataFrame:
    """Returns a table with a binder of each mean. offs: deviation of each seed; all in GPa."""
    return pd.DataFrame(
        [
            {"binder": level, "seed": seed, "frequency_hz": 10.0, "e_star_pa": 1e9 * (mean + off)}
            for level, mean in means.items()
            for seed, off in enumerate(offs)
        ]
    )


def test_a_course_that_goes_up_and_down_is_an_effect(tmp_path: Path) -> None:
    """The first and the last level have the same mean. The largest minus the smallest one is the change."""
    rows = of_levels({4: 10.02, 5: 14.0, 6: 10.02})
    design = asked(grid={"binder": [4, 5, 6], "seed": [0, 1, 2]})
    (effect,) = effects(quantities(rows, design)[0])
    assert not effect.within_scatter and np.allclose(effect.ends, (10.02, 14.0)) and effect.at_ends == (0, 1)
    # Scheffé's interval with F(2, 6) = 5.143 from a table
    assert np.isclose(effect.scatter, 0.2 * (2 / 3 * 2 * 5.143) ** 0.5, rtol=1e-3)
    write_report(design, Study(tmp_path, rows.assign(key="k"), [], 0), tmp_path)
    page = (tmp_path / "report.html").read_text("utf-8")
    assert "if binder changes from 4 to 5, |E*| changes by +39.7 %" in page and "4 … 5" in page
    assert "within the scatter of seeds (" not in page and "the effect is within the scatter" not in page
    (falling,) = effects(quantities(of_levels({4: 14.0, 5: 11.0, 6: 10.0}), design)[0])
    assert np.allclose(falling.ends, (14.0, 10.0))


def test_small_differences_between_levels_are_within_the_scatter(tmp_path: Path) -> None:
    rows = of_levels({4: 10.0, 5: 10.2, 6: 10.1})
    design = asked(grid={"binder": [4, 5, 6], "seed": [0, 1, 2]})
    (effect,) = effects(quantities(rows, design)[0])
    assert effect.within_scatter and np.isclose(np.diff(effect.ends)[0], 0.2) and effect.scatter > 0.2
    write_report(design, Study(tmp_path, rows.assign(key="k"), [], 0), tmp_path)
    page = (tmp_path / "report.html").read_text("utf-8")
    assert "the change with binder (+2 % from 4 to 5) is within the scatter of seeds (±5.2 %)" in page
    assert "the effect is within the scatter" in page


def test_names_of_pure_scatter_are_an_effect_in_one_of_twenty_studies() -> None:
    """A thousand studies have a factor with twelve names and three seeds each. All values have one normal distribution,
    so there is no effect. In most studies the difference between the largest and the smallest mean exceeds the
    confidence interval for the difference of two means."""
    draw = np.random.default_rng(1)
    names, seeds = np.repeat([f"binder {k}" for k in range(12)], 3), np.tile([1, 2, 3], 12)
    found = []
    for _ in range(1000):
        jobs = pd.DataFrame({"binder": names, "seed": seeds, "value": 10 + draw.normal(size=36)})
        (effect,) = effects(Quantity("|E*|", "GPa", "", "", jobs, ["binder"], ["seed"]))
        first, last = effect.ends
        of_two = student_95(24) * 2**0.5 * effect.errors[0]
        found.append((not effect.within_scatter, last - first > effect.scatter, last - first > of_two))
    effect, beyond, beyond_of_two = np.mean(found, axis=0)
    assert 0.03 < effect < 0.07  # 5 % ± three standard deviations of a fraction of a thousand trials
    assert beyond <= effect and beyond_of_two > 0.5


def test_each_point_counts_with_its_own_number_of_seeds() -> None:
    """The two points of level 0 have one seed and three seeds, the two points of level 1 have four seeds and two
    seeds."""
    seeds = {(0, "x"): 1, (0, "y"): 3, (1, "x"): 4, (1, "y"): 2}
    jobs = pd.DataFrame(
        [
            {"a": a, "b": b, "seed": k, "value": 10.0 + a + 0.1 * (-1) ** k}
            for (a, b), number in seeds.items()
            for k in range(number)
        ]
    )
    quantity = Quantity("|E*|", "GPa", "", "", jobs, ["a", "b"], ["seed"])
    chance = scatter(quantity)
    assert (chance.points, chance.fewest, chance.most, chance.freedom) == (3, 1, 4, 2 + 3 + 1)
    effect = next(e for e in effects(quantity) if e.factor == "a")
    # for each level, the variance of the mean of two points, in units of the variance of a single seed
    variances = [(1 / 1 + 1 / 3) / 4, (1 / 4 + 1 / 2) / 4]
    assert np.allclose(effect.errors, chance.deviation * np.sqrt(variances))
    assert np.isclose(effect.scatter, student_95(6) * chance.deviation * sum(variances) ** 0.5)


def test_a_line_has_the_error_of_points_with_unequal_numbers_of_seeds() -> None:
    x, numbers = np.arange(10.0), np.array([1, 1, 1, 5, 2, 2, 3, 1, 1, 4])
    jobs = pd.DataFrame(
        [
            {"a": v, "seed": k, "value": 100 + v + (-1) ** k}
            for v, number in zip(x, numbers, strict=True)
            for k in range(number)
        ]
    )
    quantity = Quantity("|E*|", "GPa", "", "", jobs, ["a"], ["seed"])
    (effect,), chance = effects(quantity), scatter(quantity)
    off = x - x.mean()
    error = chance.deviation * (off**2 / numbers).sum() ** 0.5 / (off**2).sum()  # standard error of the slope
    assert np.isclose(effect.scatter, student_95(chance.freedom) * 9 * error) and effect.errors is None


@pytest.mark.parametrize(
    "numerator, denominator, value",
    [(1, 1, 161.4), (1, 4, 7.709), (2, 6, 5.143), (4, 10, 3.478), (7, 60, 2.167), (30, 1, 250.1)],
)
def test_quantiles_are_those_of_tables(numerator: int, denominator: int, value: float) -> None:
    assert np.isclose(fisher_95(numerator, denominator), value, rtol=3e-4)  # the tables have four digits


def test_quantiles_are_those_of_scipy() -> None:
    stats = pytest.importorskip("scipy.stats")
    for freedom in (1, 2, 3, 4, 5, 6, 8, 20, 1000, 10000):
        assert np.isclose(student_95(freedom), stats.t.ppf(0.975, freedom), rtol=1e-5)
        for numerator in (2, 3, 7, 30, 500):
            wanted = stats.f.ppf(0.95, numerator, freedom)
            assert np.isclose(fisher_95(numerator, freedom), wanted, rtol=1e-5)


def test_a_factor_of_a_hypercube_does_not_count_as_another() -> None:
    """Two factors are correlated by chance, and one of them has no effect."""
    draw = np.random.default_rng(3)
    a = draw.random(30)
    b = a + 0.2 * draw.random(30)
    rows = pd.DataFrame({"a": a, "b": b, "frequency_hz": 10.0, "e_star_pa": 1e6 * (5 + 2 * a)})
    design = asked(list=[{"a": x, "b": y} for x, y in zip(a, b, strict=True)])
    (quantity,) = quantities(rows, design)
    first, second = effects(quantity)
    assert first.factor == "a" and np.isclose(first.share, 1) and np.isclose(np.diff(first.means), 2 * np.ptp(a))
    assert second.share < 1e-20
