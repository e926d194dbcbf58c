# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks the scenes of all points with `macadam check`, which computes nothing, and collects its predictions."""

from __future__ import annotations

import concurrent.futures
import json
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from macadam.study import executors
from macadam.study.design import Design, Job

# options of `macadam run` that `macadam check` accepts too; each takes a value
_OPTIONS = ("--backend", "--precision", "--method", "--linear", "--threads", "--device", "--devices", "--set")


@dataclass
class Checked:
    """A job with the prediction of `macadam check --json` for its scene, or with the program's message if the scene is
    wrong. Exactly one of the two is not empty."""

    job: Job
    forecast: dict[str, Any]
    message: str


def check_scenes(design: Design, program: str, workers: int) -> list[Checked]:
    """Checks the scene of each result of a study. workers: number of checks at a time."""
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(workers) as pool:

        def checked(job: Job) -> Checked:
            file = Path(folder) / f"{job.key}.toml"
            file.write_text(job.scene, encoding="utf-8")
            line = [program, "check", str(file), "--json", *_options(job.command, executors.threads(design.run))]
            done = subprocess.run(line, capture_output=True, text=True, errors="replace")
            file.unlink()
            try:
                forecast = json.loads(done.stdout) if done.returncode == 0 else {}
            except ValueError:
                forecast = {}
            if forecast:
                return Checked(job, forecast, "")
            said = done.stderr.strip().replace(str(file), "scene.toml").removeprefix("macadam: ")
            return Checked(job, {}, said or f"exit code {done.returncode} without a prediction")

        return list(pool.map(checked, design.results))


def _options(command: list[str], threads: int) -> list[str]:
    """Returns the options of a run that `macadam check` accepts, with their values. threads: threads of the run if the
    command does not set them."""
    found = []
    for word, following in zip(command[1:], [*command[2:], ""], strict=False):
        if word in _OPTIONS:
            found += [word, following]
        elif word.partition("=")[0] in _OPTIONS:
            found.append(word)
    if "--threads" not in {word.partition("=")[0] for word in found}:
        found += ["--threads", str(threads)]
    return found
