# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads the design of a study: its jobs, one for each experiment at each point."""

from __future__ import annotations

import difflib
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from macadam.study import points
from macadam.study.errors import StudyError
from macadam.study.points import number_and_unit, table_of
from macadam.study.scenes import Table, key_of, located, normal, read_toml, text_of
from macadam.study.sources import Changes, applied, changes_of, refuse_clashes

__all__ = ["Design", "Job", "number_and_unit", "read_design"]

_KEYS = {"scene", "command", "arguments", "grid", "latin_hypercube", "list", "choice", "experiment", "run", "report"}
_COMMANDS = ("run", "specimen")
# Columns of the table other than the factors, named as in summary.json. AT: the coordinates of a result (temperature,
# frequency or time). MEASURED: the computed quantities.
AT = ("temperature_c", "frequency_hz", "time_s")
MEASURED = (
    "e_star_pa",
    "g_star_pa",
    "phase_deg",
    "strain",
    "stress_pa",
    "modulus_pa",
    "secant_pa",
    "compliance_1_pa",
)
COLUMNS = {"experiment", *AT, *MEASURED, "particles", "warnings", "macadam", "key"}


@dataclass
class Job:
    """One experiment at one point, in the form that a worker gets. Points with the same scene have the same key."""

    key: str
    scene: str  # TOML
    command: list[str]  # arguments of macadam, without scene and folder
    values: dict[str, Any]  # value of each factor
    experiment: str

    @property
    def label(self) -> str:
        """The values of the factors, and the experiment, as text."""
        words = [f"{key} = {value}" for key, value in self.values.items()]
        return ", ".join(words + [f"experiment {self.experiment}"] * bool(self.experiment)) or "the scene"


@dataclass
class Design:
    """The jobs of a study, its factors and options. `jobs` has a job for each point, also for a point that has the same
    scene as another; `notes` names such points."""

    folder: Path  # paths in the study are relative to it
    jobs: list[Job] = field(default_factory=list)
    factors: list[str] = field(default_factory=list)
    run: Table = field(default_factory=dict)
    report: Table = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)

    @property
    def results(self) -> list[Job]:
        """The jobs to compute: one for each different scene."""
        return list({job.key: job for job in reversed(self.jobs)}.values())[::-1]


def read_design(source: str | Path | Table, version: str) -> Design:
    """Reads the design of a study from a TOML file or from its content as a dictionary, in which paths are relative to
    the current folder. version: of macadam; it is part of each result's key, because another version may give other
    results."""
    asked, folder = (source, Path.cwd()) if isinstance(source, dict) else (read_toml(Path(source)), Path(source).parent)
    _require_known_keys(asked, _KEYS, "study")
    if not isinstance(asked.get("scene"), (str, dict)):
        raise StudyError(f"scene: found {asked.get('scene')!r}, expected the file of the scene that the study varies")
    base, folder_of_scene = asked["scene"], folder
    if isinstance(base, str):
        file = folder / base
        base, folder_of_scene = read_toml(file), file.parent
    words = _command(asked)
    axes, sampled = points.grid(asked), points.samples(asked)
    options = {
        name: {option: changes_of(f"choice.{name}.{option}", keys, folder) for option, keys in of.items()}
        for name, of in points.choices(asked).items()
    }
    experiments = _experiments(asked)
    _refuse_names(options, [*axes, *(sampled[0] if sampled else {})])
    refuse_clashes(
        [
            [Changes("grid", axes)],
            [Changes("latin_hypercube" if "latin_hypercube" in asked else "list", sampled[0] if sampled else {})],
            *(list(of.values()) for of in options.values()),
            list(experiments.values()),
        ],
        base,
    )
    design = Design(folder, run=table_of(asked, "run"), report=table_of(asked, "report"))
    equal: dict[str, list[Job]] = {}  # jobs with the same scene, by a key that is the same for 1 and 1.0
    for values in points.crossed(sampled, axes | {name: list(of) for name, of in options.items()}):
        chosen = [options[name][value] for name, value in values.items() if name in options]
        factors = Changes("point", {key: value for key, value in values.items() if key not in options})
        for experiment, changes in experiments.items():
            scene, digests = located(applied(base, [*chosen, factors, changes]), folder_of_scene)
            job = Job(key_of(scene, digests, words, version), text_of(scene), words, values, experiment)
            _add(design, job, equal.setdefault(key_of(normal(scene), digests, words, version), []))
    design.factors = list(dict.fromkeys(name for job in design.jobs for name in job.values))
    return design


def _add(design: Design, job: Job, equal: list[Job]) -> None:
    """Adds a job to the design. equal: earlier jobs with the same scene; the new job uses their result. If the new job
    also has the same values and experiment as one of these earlier jobs, it is not added."""
    if any(normal(job.values) == normal(o.values) and job.experiment == o.experiment for o in equal):
        design.notes.append(f"{job.label}: this point occurs more than once in the study; it has one row in the table")
        return
    if equal:
        design.notes.append(
            f"{job.label}: this point has the same scene as {equal[0].label}; the scene is computed once, and both points "
            "have a row in the table"
        )
        job.key, job.scene = equal[0].key, equal[0].scene
    equal.append(job)
    design.jobs.append(job)


# Returns the command and arguments of macadam that the study asks for.
def _command(asked: Table) -> list[str]:
    command = asked.get("command", "run")
    if command not in _COMMANDS:
        raise StudyError(f"command: found {command!r}, expected {' or '.join(_COMMANDS)}")
    if not isinstance(asked.get("arguments", []), list):
        raise StudyError(f"arguments: found {asked['arguments']!r}, expected a list of words")
    return [command, *map(str, asked.get("arguments", []))]


def _experiments(asked: Table) -> dict[str, Changes]:
    """Returns the changes of each experiment by its name; a single one without changes if the study has no
    experiments."""
    found = table_of(asked, "experiment")
    for name, keys in found.items():
        if not isinstance(keys, dict):
            raise StudyError(f"experiment.{name}: expected a table of scene keys")
    return {name: Changes(f"experiment.{name}", keys) for name, keys in found.items()} or {"": Changes("experiment")}


# Raises StudyError if a choice has the name of a factor or of a column of the table.
def _refuse_names(options: dict[str, Any], keys: list[str]) -> None:
    for name in options:
        if name in keys:
            raise StudyError(f"choice.{name}: found a key of the same name among the factors, expected another name")
        if name in COLUMNS:
            raise StudyError(f"choice.{name}: found the name of a column of the table, expected another name")


# Raises StudyError for an unknown key and suggests a similar known one.
def _require_known_keys(table: Table, names: set[str], where: str) -> None:
    for key in table:
        if key not in names:
            near = difflib.get_close_matches(key, names, 1)
            hint = f"; did you mean {near[0]}?" if near else f", expected {', '.join(sorted(names))}"
            raise StudyError(f"{where}: found the unknown key {key}{hint}")
