# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks the scenes of all points with `macadam check`, which computes nothing."""

from __future__ import annotations

import concurrent.futures
import subprocess
import tempfile
from pathlib import Path

from macadam.study.design import Design, Job

# options of `macadam run` that `macadam check` accepts too; each takes a value
_OPTIONS = ("--backend", "--precision", "--method", "--linear", "--threads", "--device", "--devices")


def wrong_scenes(design: Design, program: str, workers: int) -> list[tuple[Job, str]]:
    """Returns the jobs whose scene the program refuses, each with the program's message. workers: number of checks at a
    time."""
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(workers) as pool:

        def message(job: Job) -> str:
            file = Path(folder) / f"{job.key}.toml"
            file.write_text(job.scene, encoding="utf-8")
            line = [program, "check", str(file), *_options(job.command)]
            done = subprocess.run(line, capture_output=True, text=True, errors="replace")
            file.unlink()
            if done.returncode == 0:
                return ""
            return done.stderr.strip().replace(str(file), "scene.toml") or f"exit code {done.returncode}"

        jobs = design.results
        return [(job, said) for job, said in zip(jobs, pool.map(message, jobs), strict=True) if said]


def _options(command: list[str]) -> list[str]:
    """Returns the options of a run that `macadam check` accepts, with their values."""
    found = []
    for word, following in zip(command[1:], [*command[2:], ""], strict=False):
        if word in _OPTIONS:
            found += [word, following]
        elif word.partition("=")[0] in _OPTIONS:
            found.append(word)
    return found
