# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the points of a study: grids crossed with Latin hypercubes, lists and named choices."""

from __future__ import annotations

import itertools
import json
import math
from typing import Any

from macadam.study.errors import StudyError
from macadam.study.scenes import Table, normal

MOST = 1_000_000  # largest number of points: more than anyone computes, and few enough to hold all of them in memory


def table_of(asked: Table, name: str) -> Table:
    """Returns a section of the study; an empty one if the study has no such section."""
    value = asked.get(name, {})
    if not isinstance(value, dict):
        raise StudyError(f"{name}: found {value!r}, expected a table [{name}]")
    return value


def grid(asked: Table) -> dict[str, list[Any]]:
    """Returns the values of each key of `[grid]`. Raises StudyError if a key has the same value twice."""
    axes: dict[str, list[Any]] = {}
    for key, values in _flat(table_of(asked, "grid")).items():
        if not isinstance(values, list) or not values:
            raise StudyError(f"grid.{key}: found {values!r}, expected a list of values")
        axes[key] = values
        first: dict[str, Any] = {}
        for value in values:
            same = _text(value)
            if same in first:
                raise StudyError(
                    f"grid.{key}: found {first[same]!r} and {value!r}, which are the same value, expected each value once"
                )
            first[same] = value
    return axes


def _text(value: Any) -> str:
    """Returns a text that is the same for equal values, such as 1 and 1.0, or "2 %" and "2.0 %"."""
    number, unit = number_and_unit(value)
    return json.dumps(normal([number, unit] if unit else value), default=str)


def samples(asked: Table) -> list[dict[str, Any]]:
    """Returns the points of all hypercubes and lists. Raises StudyError if a point has no value for a key for which
    another point has one."""
    out: list[dict[str, Any]] = []
    places: list[str] = []
    for name, points in (("latin_hypercube", _hypercube), ("list", lambda block: [_flat(block)])):
        for number, block in enumerate(_list(asked, name), 1):
            found = points(block)
            out += found
            places += [f"{name} {number}"] * len(found)
    keys = dict.fromkeys(key for point in out for key in point)
    for point, place in zip(out, places, strict=True):
        for key in keys:
            if key not in point:
                gives = next(p for p, other in zip(places, out, strict=True) if key in other)
                raise StudyError(
                    f"{place}: found no value for {key}, which {gives} gives, expected a value of this key in every point"
                )
    return out


def choices(asked: Table) -> dict[str, dict[str, Table]]:
    """Returns the alternatives of each `[choice]` by their names."""
    found = table_of(asked, "choice")
    for name, options in found.items():
        if not isinstance(options, dict) or not all(isinstance(o, dict) for o in options.values()) or not options:
            raise StudyError(f"choice.{name}: expected tables [choice.{name}.NAME] of scene keys")
    return found


def crossed(sampled: list[dict[str, Any]], axes: dict[str, list[Any]]) -> list[dict[str, Any]]:
    """Returns the values of all factors at each point: every sample combined with every combination of the axes'
    values."""
    number = max(1, len(sampled)) * math.prod(len(values) for values in axes.values())
    if number > MOST:
        raise StudyError(f"points: found {number:,}, expected at most {MOST:,}")
    rows = [dict(zip(axes, row, strict=True)) for row in itertools.product(*axes.values())]
    return [{**sample, **row} for sample in sampled or [{}] for row in rows]


def _flat(table: Table, leaf: Any = lambda value: False, before: str = "") -> Table:
    """Returns a table without nested tables, as one dotted key per value: TOML reads a dotted key as tables in tables.
    leaf: says whether a table is itself a value."""
    out: Table = {}
    for key, value in table.items():
        if isinstance(value, dict) and not leaf(value):
            out |= _flat(value, leaf, f"{before}{key}.")
        else:
            out[before + key] = value
    return out


# Returns the tables of an array of tables of the study; also accepts a single table.
def _list(asked: Table, name: str) -> list[Table]:
    value = asked.get(name, [])
    value = [value] if isinstance(value, dict) else value
    if not isinstance(value, list) or not all(isinstance(v, dict) for v in value):
        raise StudyError(f"{name}: expected tables [[{name}]]")
    return value


def _hypercube(block: Table) -> list[dict[str, Any]]:
    """Returns the points of a Latin hypercube: each range is divided into as many equal parts as there are points, and
    each part contains one point."""
    block = _flat(block, lambda value: "low" in value or "high" in value)
    number, seed = block.pop("points", None), block.pop("seed", 1)
    if isinstance(number, bool) or not isinstance(number, int) or not 1 <= number <= MOST:
        raise StudyError(f"latin_hypercube: points: found {number!r}, expected a number of points from 1 to {MOST:,}")
    if isinstance(seed, bool) or not isinstance(seed, int) or seed < 0:
        raise StudyError(f"latin_hypercube: seed: found {seed!r}, expected a whole number, at least 0")
    if not block:
        raise StudyError("latin_hypercube: found no key with a range, expected at least one")
    try:
        from scipy.stats import qmc
    except ImportError:
        raise StudyError("latin_hypercube: found no Python package SciPy, expected it to be installed") from None
    ranges = {key: _range(key, value) for key, value in block.items()}
    # random-cd: values are exchanged between points to lower the discrepancy, so that factors are hardly correlated by
    # chance
    asked = {"d": len(ranges), "optimization": "random-cd"}
    try:
        sampler = qmc.LatinHypercube(**asked, rng=seed)
    except TypeError:  # the argument's name before SciPy 1.15
        sampler = qmc.LatinHypercube(**asked, seed=seed)
    unit = sampler.random(number)
    points = []
    for row in unit:
        point = {}
        for (key, (low, high, log, unit_text)), u in zip(ranges.items(), row, strict=True):
            value = low * (high / low) ** u if log else low + (high - low) * u
            value = float(f"{value:.9g}")
            point[key] = f"{value!r} {unit_text}" if unit_text else value
        points.append(point)
    return points


# Returns low, high, whether the scale is logarithmic, and the unit of a key's range.
def _range(key: str, value: Any) -> tuple[float, float, bool, str]:
    log = isinstance(value, dict) and value.get("scale") == "log"
    ends = [value.get("low"), value.get("high")] if isinstance(value, dict) else value
    where = f"latin_hypercube.{key}: found {json.dumps(value, default=str)}"
    if (
        not isinstance(ends, list)
        or len(ends) != 2
        or any(isinstance(e, bool) or not isinstance(e, (int, float, str)) for e in ends)
    ):
        raise StudyError(f'{where}, expected [low, high] or {{ low = …, high = …, scale = "log" }}')
    (low, unit), (high, other) = (number_and_unit(e) for e in ends)
    if low is None or high is None or unit != other:
        raise StudyError(f"{where}, expected two numbers of one unit")
    if not low < high or log and low <= 0:
        raise StudyError(f"{where}, expected low below high{', both above 0' if log else ''}")
    return low, high, log, unit


def number_and_unit(value: Any) -> tuple[float | None, str]:
    """Splits a number, or a text such as "3 %", into number and unit. Returns (None, "") for anything else."""
    if isinstance(value, bool):
        return None, ""
    if isinstance(value, (int, float)):
        return (float(value), "") if abs(value) < 1e300 else (None, "")
    if isinstance(value, str):
        parts = value.strip().split(None, 1)
        try:
            return float(parts[0]), parts[1] if len(parts) > 1 else ""
        except (ValueError, IndexError):
            pass
    return None, ""
