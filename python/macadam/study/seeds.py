# SPDX-License-Identifier: GPL-3.0-or-later
"""Computes one scene with several seeds of its specimen, as a study with a grid over the seed, and the mean, standard
deviation and count of each result over the seeds. `macadam run SCENE --seeds N` calls this code."""

from __future__ import annotations

import json
import math
import statistics
from collections.abc import Callable
from pathlib import Path
from typing import Any

from macadam import _toml
from macadam._files import write_text
from macadam.study.design import AT
from macadam.study.errors import StudyError
from macadam.study.scenes import read_toml
from macadam.study.table import read_json

KEY = "specimen.seed"
MOST_SEEDS = 10_000
# results that are averaged over the seeds, in the order in which they are printed
QUANTITIES = (
    "e_star_pa",
    "g_star_pa",
    "phase_deg",
    "storage_pa",
    "loss_pa",
    "poisson_ratio",
    "poisson_phase_deg",
    "modulus_pa",
    "secant_pa",
    "compliance_1_pa",
    "stress_pa",
    "strain",
    "strength_pa",
    "strain_at_peak",
    "work_of_fracture_j",
    "peak_load_n",
    "displacement_at_peak_m",
    "indirect_tensile_strength_pa",
    "bending_strength_pa",
    "fracture_toughness_pa_sqrt_m",
    "fracture_energy_j_m2",
    "ct_index",
    "flexibility_index",
    "fracture_stress_pa",
    "fracture_temperature_c",
)
_LARGEST_SEED = 2**63 - 1  # TOML's largest whole number
_ROWS = 24  # largest number of printed rows


def study_of(scene: str | Path, number: int, first: int | None, options: list[str], workers: int | None) -> dict[str, Any]:
    """Returns the study of a scene with `number` seeds, from `first` on (None: from the seed of the scene on). options:
    of `macadam run`. workers: number of runs at a time (None: as many as the threads of each allow). Raises StudyError
    if the specimen of the scene has no seed or a value is out of range."""
    if not 2 <= number <= MOST_SEEDS:
        raise StudyError(f"--seeds: found {number}, expected a whole number from 2 to {MOST_SEEDS}")
    specimen = read_toml(Path(scene)).get("specimen", {})
    if isinstance(specimen, dict) and "file" in specimen:
        raise StudyError(
            f"{scene}: --seeds: found the specimen of the file {specimen['file']!r}, which has no seed, expected a scene "
            "whose specimen is generated"
        )
    given = specimen.get("seed", 1) if isinstance(specimen, dict) else 1
    start = first if first is not None else given if isinstance(given, int) else 1
    if not 0 <= start <= _LARGEST_SEED - number:
        raise StudyError(f"--first-seed: found {start}, expected a whole number from 0 to {_LARGEST_SEED - number}")
    threads = _threads(options)
    run = {"on": "threads", "threads": threads} | ({"workers": workers} if workers else {})
    return {
        "scene": str(Path(scene).resolve()),
        "command": "run",
        "arguments": options,
        "grid": {KEY: list(range(start, start + number))},
        "run": run,
    }


def _threads(options: list[str]) -> int:
    """Returns the number of threads that the options of a run give, 1 without such an option."""
    for word, following in zip(options, [*options[1:], ""], strict=False):
        name, _, value = word.partition("=")
        if name == "--threads" and (value or following).isdigit():
            return int(value or following)
    return 1


def compute(asked: dict[str, Any], out: str | Path, **how: Any) -> tuple[Any, dict[str, Any]]:
    """Computes the study that study_of() returned, except for results that are in the folder already. Writes
    summary.json, and the study as study.toml. how: as for study(). Returns the study and the content of summary.json."""
    from macadam.study.design import read_design
    from macadam.study.driver import study
    from macadam.study.program import find_program, version_of

    found = study(asked, out, **how)
    design = read_design(asked, version_of(how.get("program") or find_program()))
    summary = summary_of(asked["scene"], {job.values[KEY]: job.key for job in design.jobs}, found.folder)
    write_text(found.folder / "study.toml", _toml.dumps(asked))
    write_text(found.folder / "summary.json", json.dumps(summary, indent=2, ensure_ascii=False) + "\n")
    return found, summary


def summary_of(scene: str, keys: dict[int, str], folder: Path) -> dict[str, Any]:
    """Returns the content of summary.json. keys: name of the folder of each seed in the study's folder `results`; a
    seed without this folder has failed or was not computed."""
    summaries = {}
    for seed, key in keys.items():
        place = folder / "results" / key
        if place.is_dir():
            summaries[seed] = read_json(place / "summary.json")
    warnings = [f"seed {seed}: {w}" for seed, s in summaries.items() for w in s.get("warnings", [])]
    return {
        "status": "done" if len(summaries) == len(keys) else f"failed: {len(keys) - len(summaries)} of {len(keys)} seeds",
        "kind": "seeds",
        "warnings": warnings,
        "macadam": next((s.get("macadam") for s in summaries.values()), None),
        "scene": scene,
        "seeds": [
            {"seed": seed, "folder": f"results/{key}" if seed in summaries else None} for seed, key in keys.items()
        ],
        "results": over_seeds(list(summaries.values())),
    }


def over_seeds(summaries: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Returns one entry per frequency, temperature or time, and one for the results of a whole test, such as its
    strength. An entry has these coordinates, and for each quantity its mean, standard deviation (of a sample: the sum
    of squares over count - 1; None if the count is 1) and count. summaries: content of summary.json of each seed."""
    values: dict[tuple[tuple[str, float], ...], dict[str, list[float]]] = {}
    for summary in summaries:
        for result in summary.get("results") or []:
            for entry in [{k: v for k, v in result.items() if k != "points"}, *result.get("points", [])]:
                at = tuple((name, entry[name]) for name in AT if entry.get(name) is not None)
                for name in QUANTITIES:
                    if _is_number(entry.get(name)):
                        values.setdefault(at, {}).setdefault(name, []).append(entry[name])
    return [{**dict(at), **{name: _moments(v) for name, v in of.items()}} for at, of in values.items()]


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


def _moments(values: list[float]) -> dict[str, Any]:
    """Returns mean, standard deviation and count."""
    return {
        "mean": statistics.fmean(values),
        "standard_deviation": statistics.stdev(values) if len(values) > 1 else None,
        "count": len(values),
    }


def lines(summary: dict[str, Any]) -> list[str]:
    """Returns the results over the seeds as lines of a table: those of the whole test, and then those at times or
    frequencies. Of a long table the first rows of the second kind are left out."""
    whole, rows = [], []
    for entry in summary["results"]:
        to = rows if any(name in entry for name in AT) else whole
        at = ", ".join(f"{name} {entry[name]:.6g}" for name in AT if name in entry)
        for name in QUANTITIES:
            if name not in entry:
                continue
            mean, deviation, count = (entry[name][key] for key in ("mean", "standard_deviation", "count"))
            relative = f"{100 * abs(deviation / mean):.2g} %" if deviation is not None and mean else ""
            to.append(
                [at, name, f"{mean:.6g}", f"{deviation:.3g}" if deviation is not None else "", relative, str(count)]
            )
    left_out = max(0, len(rows) - _ROWS)
    table = [["at", "result", "mean", "standard deviation", "of the mean", "count"], *whole, *rows[left_out:]]
    widths = [max(len(row[k]) for row in table) for k in range(6)]
    out = ["  ".join(cell.ljust(w) for cell, w in zip(row, widths, strict=True)).rstrip() for row in table]
    return out + ([f"{left_out} more rows are in summary.json"] if left_out else [])


def run(options: Any, progress: Callable[[int, int, int], None]) -> tuple[Any, dict[str, Any]]:
    """Computes what the command line of `macadam study SCENE --seeds N` asks for."""
    asked = study_of(options.study, options.seeds, options.first_seed, options.run_option, options.workers)
    return compute(asked, options.out, on=options.on, retry_failed=options.retry_failed, progress=progress)
