# SPDX-License-Identifier: GPL-3.0-or-later
"""Main effects of studies, compared with the scatter of seeds, and their sentences in the report."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from macadam.study.design import Design, read_design
from macadam.study.driver import Study
from macadam.study.effects import effects, quantities, scatter, student_95
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
    assert "share of the variance" not in page and "of the variance between points" not in page  # one factor
    assert "standard error from the scatter of seeds" in page


def test_without_several_seeds_nothing_is_said_of_chance(tmp_path: Path) -> None:
    design = asked(grid={"binder": [0, 1], "b": ["x", "y"]})
    rows = rows_of(0.2, {1: 0.0}, ("x", "y")).drop(columns="seed")
    (quantity,) = quantities(rows, design)
    assert all(e.scatter is None and e.errors is None and not e.within_scatter for e in effects(quantity))
    write_report(design, Study(tmp_path, rows.assign(key="k"), [], 0), tmp_path)
    page = (tmp_path / "report.html").read_text("utf-8")
    assert "scatter of seeds" not in page and "share of the variance" in page


def test_the_scatter_of_a_line() -> None:
    """For ten values of a factor with two seeds each, the error of the slope is that of the textbook formula."""
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
    # error of the slope; seeds deviate by sqrt(2), two per point
    error = 2**0.5 / 2**0.5 / ((x - x.mean()) ** 2).sum() ** 0.5
    assert np.isclose(effect.scatter, student_95(10) * 9 * error)


def test_students_t() -> None:
    stats = pytest.importorskip("scipy.stats")
    for freedom in (1, 2, 3, 4, 5, 6, 8, 20, 1000):
        assert np.isclose(student_95(freedom), stats.t.ppf(0.975, freedom), rtol=2e-3)  # three digits


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


