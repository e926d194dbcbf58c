# SPDX-License-Identifier: GPL-3.0-or-later
"""The points of a study: grids, Latin hypercubes, lists and named choices, crossed with one another, by experiments."""

from __future__ import annotations

import difflib
import itertools
import json
import math
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from macadam.study.errors import StudyError
from macadam.study.scenes import Table, key_of, located, merged, read_toml, text_of, with_value

_KEYS = {"scene", "command", "arguments", "grid", "latin_hypercube", "list", "choice", "experiment", "run", "report"}
_COMMANDS = ("run", "specimen")
_MOST = 1_000_000  # points; far more than anyone computes, and held in memory at once


@dataclass
class Job:
    """One experiment at one point: what the worker is given."""

    key: str
    scene: str  # TOML
    command: list[str]  # of macadam, without scene and folder
    values: dict[str, Any]  # of the factors
    experiment: str


@dataclass
class Design:
    """What a study asks for."""

    folder: Path  # that paths in it are relative to
    jobs: list[Job] = field(default_factory=list)
    factors: list[str] = field(default_factory=list)
    run: Table = field(default_factory=dict)
    report: Table = field(default_factory=dict)


def read_design(source: str | Path | Table, version: str) -> Design:
    """The design of a study: a TOML file, or its content as a dictionary, whose paths are relative to the current
    folder. `version`: of macadam; another one makes other results."""
    asked, folder = (source, Path.cwd()) if isinstance(source, dict) else (read_toml(Path(source)), Path(source).parent)
    _known(asked, _KEYS, "study")
    if not isinstance(asked.get("scene"), (str, dict)):
        raise StudyError("scene: expected the file of the scene that the study varies")
    base, beside = asked["scene"], folder
    if isinstance(base, str):
        file = folder / base
        base, beside = read_toml(file), file.parent
    command = asked.get("command", "run")
    if command not in _COMMANDS:
        raise StudyError(f"command: found {command!r}, expected {' or '.join(_COMMANDS)}")
    if not isinstance(asked.get("arguments", []), list):
        raise StudyError(f"arguments: found {asked['arguments']!r}, expected a list of words")
    arguments = [str(a) for a in asked.get("arguments", [])]
    design = Design(folder, run=_table(asked, "run"), report=_table(asked, "report"))
    seen = set()
    for values in _points(asked):
        scene = base
        for name, value in values.items():
            scene = _applied(scene, name, value, asked, folder)
        for experiment, changes in (_table(asked, "experiment") or {"": {}}).items():
            if not isinstance(changes, dict):
                raise StudyError(f"experiment.{experiment}: expected a table of scene keys")
            whole = scene
            for key, value in changes.items():
                whole = with_value(whole, key, value)
            whole, digests = located(whole, beside)
            words = [command, *arguments]
            key = key_of(whole, digests, words, version)
            if key not in seen:  # two ways to one point
                seen.add(key)
                design.jobs.append(Job(key, text_of(whole), words, values, experiment))
    design.factors = list(dict.fromkeys(name for job in design.jobs for name in job.values))
    return design


def _known(table: Table, names: set[str], where: str) -> None:
    for key in table:
        if key not in names:
            near = difflib.get_close_matches(key, names, 1)
            hint = f"; did you mean {near[0]}?" if near else f", expected {', '.join(sorted(names))}"
            raise StudyError(f"{where}: found the unknown key {key}{hint}")


def _table(asked: Table, name: str) -> Table:
    value = asked.get(name, {})
    if not isinstance(value, dict):
        raise StudyError(f"{name}: found {value!r}, expected a table [{name}]")
    return value


def _flat(table: Table, leaf: Any = lambda value: False, before: str = "") -> Table:
    """Dotted keys that TOML took for tables in tables, as one key each; a table that is a `leaf` is a value."""
    out: Table = {}
    for key, value in table.items():
        if isinstance(value, dict) and not leaf(value):
            out |= _flat(value, leaf, f"{before}{key}.")
        else:
            out[before + key] = value
    return out


def _applied(scene: Table, name: str, value: Any, asked: Table, folder: Path) -> Table:
    """The scene with a factor at a value: at its key, or what a named choice says."""
    if name not in _table(asked, "choice"):
        return with_value(scene, name, value)
    for key, of_choice in asked["choice"][name][value].items():
        if key == "file":
            if not isinstance(of_choice, str):
                raise StudyError(f"choice.{name}.{value}: file: found {of_choice!r}, expected the name of a file")
            scene = merged(scene, read_toml(folder / of_choice))
        else:
            scene = with_value(scene, key, of_choice)
    return scene


def _points(asked: Table) -> list[dict[str, Any]]:
    """Values of all factors at each point."""
    samples: list[dict[str, Any]] = []
    for block in _list(asked, "latin_hypercube"):
        samples += _hypercube(block)
    for block in _list(asked, "list"):
        samples.append(_flat(block))
    axes: dict[str, list[Any]] = {}
    for key, values in _flat(_table(asked, "grid")).items():
        if not isinstance(values, list) or not values:
            raise StudyError(f"grid.{key}: found {values!r}, expected a list of values")
        axes[key] = values
    for name, choices in _table(asked, "choice").items():
        if not isinstance(choices, dict) or not all(isinstance(c, dict) for c in choices.values()) or not choices:
            raise StudyError(f"choice.{name}: expected tables [choice.{name}.NAME] of scene keys")
        axes[name] = list(choices)
    both = set(axes) & {k for s in samples for k in s}
    if both:
        raise StudyError(f"{min(both)}: found in the grid and in a hypercube or list, expected it in one of them")
    number = max(1, len(samples)) * math.prod(len(values) for values in axes.values())
    if number > _MOST:
        raise StudyError(f"points: found {number:,}, expected at most {_MOST:,}")
    crossed = [dict(zip(axes, row, strict=True)) for row in itertools.product(*axes.values())]
    return [{**sample, **row} for sample in samples or [{}] for row in crossed]


def _list(asked: Table, name: str) -> list[Table]:
    value = asked.get(name, [])
    value = [value] if isinstance(value, dict) else value
    if not isinstance(value, list) or not all(isinstance(v, dict) for v in value):
        raise StudyError(f"{name}: expected tables [[{name}]]")
    return value


def _hypercube(block: Table) -> list[dict[str, Any]]:
    """So many points that each range, cut into as many equal parts, has one in each."""
    block = _flat(block, lambda value: "low" in value or "high" in value)
    number, seed = block.pop("points", None), block.pop("seed", 1)
    if not isinstance(number, int) or not 1 <= number <= _MOST:
        raise StudyError(f"latin_hypercube: points: found {number!r}, expected a number of points, at most {_MOST:,}")
    if not block:
        raise StudyError("latin_hypercube: found no key with a range")
    try:
        from scipy.stats import qmc
    except ImportError:
        raise StudyError("latin_hypercube: it takes the Python package SciPy, which is not installed") from None
    ranges = {key: _range(key, value) for key, value in block.items()}
    # random-cd: exchanged until no two factors go together by chance
    asked = {"d": len(ranges), "optimization": "random-cd"}
    try:
        sampler = qmc.LatinHypercube(**asked, rng=seed)
    except TypeError:  # before SciPy 1.15
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
    """A number, or text such as "3 %", as number and unit; nothing where it is neither."""
    if isinstance(value, bool):
        return None, ""
    if isinstance(value, (int, float)):
        return float(value), ""
    if isinstance(value, str):
        parts = value.strip().split(None, 1)
        try:
            return float(parts[0]), parts[1] if len(parts) > 1 else ""
        except (ValueError, IndexError):
            pass
    return None, ""
