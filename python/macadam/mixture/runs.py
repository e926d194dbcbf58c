# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the specimens of a scale at the same time. A result is kept under a digest of its scene and the version of the
program, and is not computed again."""

from __future__ import annotations

import concurrent.futures
import json
import os
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pandas

from macadam.mixture.errors import MixtureError
from macadam.mixture.laws import Curve
from macadam.study import programs, scenes
from macadam.study.errors import StudyError
from macadam.study.job import compute


@dataclass
class Run:
    """The result of one specimen: its folder, its curve over the reduced frequency and its summary."""

    folder: Path
    curve: Curve
    summary: dict[str, Any]


class Runner:
    """Runs scenes by `macadam run` and keeps their results in a folder."""

    def __init__(self, program: str, version: str, folder: Path, workers: int | None = None) -> None:
        self.program, self.version, self.folder = program, version, folder
        self.cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
        self.workers = workers or self.cores
        self.computed = self.reused = 0
        for name in ("results", "failures", "running"):
            (folder / name).mkdir(parents=True, exist_ok=True)

    def run(self, scale: str, made: list[tuple[int, dict[str, Any]]], progress: Callable[[str], object]) -> list[Run]:
        """Runs the scenes of one scale. made: seed and scene of each specimen. Raises MixtureError with the message of
        the program if a run fails. progress: called with a sentence after each specimen."""
        workers = min(self.workers, len(made))
        threads = max(1, self.cores // workers)
        jobs = [self._job(scale, seed, scene, threads) for seed, scene in made]
        waiting = {job["key"] for job in jobs if not (self.folder / "results" / job["key"]).is_dir()}
        self.computed += len(waiting)
        self.reused += len(jobs) - len(waiting)
        pool = concurrent.futures.ThreadPoolExecutor(workers)
        try:
            tasks = {pool.submit(compute, job): job for job in jobs}
            for count, task in enumerate(concurrent.futures.as_completed(tasks), 1):
                job = tasks[task]
                if task.result()["status"] != "done":
                    self._fail(scale, job)
                progress(f"scale {scale}: {count} of {len(jobs)} specimens")
        except BaseException:
            programs.stop(str(self.folder))
            raise
        finally:
            pool.shutdown(wait=True, cancel_futures=True)
        return [self._read(job["key"]) for job in jobs]

    def _job(self, scale: str, seed: int, scene: dict[str, Any], threads: int) -> dict[str, Any]:
        """Returns the job of a scene. A failure of an earlier command is forgotten, so that the scene is run again."""
        try:
            placed, digests = scenes.located(scene, Path.cwd())
            placed = scenes.normal(placed)
            key = scenes.key_of(placed, digests, ["run"], self.version)
            text = scenes.text_of(placed)
        except StudyError as error:
            raise MixtureError(f"scale {scale}: {error}") from None
        (self.folder / "failures" / f"{key}.json").unlink(missing_ok=True)
        return {
            "key": key,
            "experiment": scale,
            "values": {"scale": scale, "seed": seed},
            "command": ["run"],
            "scene": text,
            "threads": threads,
            "program": self.program,
            "folder": str(self.folder),
        }

    def _fail(self, scale: str, job: dict[str, Any]) -> None:
        file = self.folder / "failures" / f"{job['key']}.json"
        if not file.is_file():
            raise KeyboardInterrupt
        failure = json.loads(file.read_text(encoding="utf-8"))
        raise MixtureError(
            f"scale {scale}, seed {job['values']['seed']}: {failure['message']}", 2 if failure["exit_code"] == 2 else 1
        )

    def _read(self, key: str) -> Run:
        folder = self.folder / "results" / key
        table = pandas.read_csv(folder / "sweep.csv", comment="#").sort_values("frequency_hz")
        curve = Curve(*(table[c].to_numpy(float) for c in ("frequency_hz", "e_star_pa", "phase_deg")))
        return Run(folder, curve, json.loads((folder / "summary.json").read_text(encoding="utf-8")))
