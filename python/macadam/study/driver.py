# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs a study from its file to its table. It computes only the results that its folder does not have yet, so a study
that was interrupted in any way can be continued."""

from __future__ import annotations

import concurrent.futures
import contextlib
import shutil
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pandas as pd

from macadam.study import executors, summary, table
from macadam.study.design import Design, Job, read_design
from macadam.study.errors import StudyError
from macadam.study.job import compute
from macadam.study.locks import Taken, is_locked, locked
from macadam.study.parsl_pool import Trouble
from macadam.study.program import find_program, version_of

_IDLE_ROUNDS = 3  # number of consecutive rounds without a new result after which the study gives up
STOPPED = "the study was stopped"
DIED = "their workers died; the logs are in the folder parsl"


@dataclass
class Study:
    """The results of a study. `table`: one row per frequency, temperature or time of each result, SI units; `failures`:
    key, experiment, values, exit_code and message of each failed point, in which points with the same scene have the
    same key; `missing`: number of results that were not computed, and `reason`: why not; `notes`: sentences about points
    that have the same scene as another point."""

    folder: Path
    table: pd.DataFrame
    failures: list[dict[str, Any]]
    missing: int
    reason: str = ""
    notes: list[str] = field(default_factory=list)


def study(
    source: str | Path | dict[str, Any],
    out: str | Path,
    *,
    executor: concurrent.futures.Executor | None = None,
    on: str | None = None,
    workers: int | None = None,
    program: str | None = None,
    retry_failed: bool = False,
    progress: Callable[[int, int, int], None] | None = None,
) -> Study:
    """Computes the results of a study that are not in its folder yet; then writes its tables and its report.

    source: STUDY.toml, or its content as a dictionary. out: the study's folder. executor: any executor of
    concurrent.futures; it replaces the one that [run] describes. on, workers: replace those of [run]. program: path of
    macadam; by default it is searched for. retry_failed: compute failed results again. progress: called every few
    seconds and after each result with the numbers of results that are done, failed and asked for. Raises StudyError if
    the input is wrong or another study runs in the folder. After a KeyboardInterrupt, workers end within seconds,
    tables and report are written, and the exception is raised again."""
    folder = Path(out).resolve()
    program = program or find_program()
    version = version_of(program)
    design = checked_design(source, version, on, workers)
    if executor is None:
        executors.check_programs(design.run)
    if folder.exists() and not folder.is_dir():
        raise StudyError(f"{folder}: found a file, expected a folder")
    for name in ("results", "failures", "running"):
        (folder / name).mkdir(parents=True, exist_ok=True)
    with contextlib.ExitStack() as stack:
        try:
            stack.enter_context(locked(folder / "study.lock", wait=False))
        except Taken:
            raise StudyError(f"{folder}: another study runs in this folder") from None
        if isinstance(source, (str, Path)):
            shutil.copyfile(source, folder / "study.toml")
        if retry_failed:
            for job in design.results:
                (folder / "failures" / f"{job.key}.json").unlink(missing_ok=True)
        reason = STOPPED
        try:
            reason = _compute_all(design, folder, program, executor, progress or (lambda *_: None))
        except KeyboardInterrupt:
            _write_results(design, folder, reason)
            raise
        try:
            return _write_results(design, folder, reason)
        except KeyboardInterrupt:
            _write_results(design, folder, reason)
            raise


def checked_design(source: str | Path | dict[str, Any], version: str, on: str | None, workers: int | None) -> Design:
    """Reads the design of a study, and checks all its sections. on, workers: replace those of [run] if they are not
    None. Raises StudyError if the study or these values are wrong."""
    if workers is not None:
        executors.check_count("workers", workers)
    design = read_design(source, version)
    asked = {"on": on, "workers": workers}
    design.run = {**design.run, **{key: value for key, value in asked.items() if value is not None}}
    executors.check(design.run)
    table.check(design.report)
    if not design.jobs:
        raise StudyError("the study has no points")
    return design


def _write_results(design: Design, folder: Path, reason: str) -> Study:
    """Writes tables and report of the results that are in the folder, and returns the results. reason: why some are
    missing."""
    missing = sum(not _has_result_or_failure(folder, job) for job in design.results)
    found = Study(
        folder,
        table.read(design, folder),
        table.failures(design, folder),
        missing,
        reason if missing else "",
        design.notes,
    )
    if not missing:
        shutil.rmtree(folder / "running", ignore_errors=True)
    table.write(found.table, found.failures, folder)
    summary.write_report(design, found, folder)
    return found


# Returns whether the folder has the job's result or its failure.
def _has_result_or_failure(folder: Path, job: Job) -> bool:
    return (folder / "results" / job.key).is_dir() or (folder / "failures" / f"{job.key}.json").is_file()


def _compute_all(
    design: Design,
    folder: Path,
    program: str,
    given: concurrent.futures.Executor | None,
    progress: Callable[[int, int, int], None],
) -> str:
    """Computes all results in rounds. If a worker dies, its unfinished jobs are given to new workers in the next round.
    Returns why results are missing; empty if no result is missing."""
    idle = 0
    limits = None if given is not None or design.run.get("on") == "threads" else executors.patience(design.run)
    while idle < _IDLE_ROUNDS:
        left = [job for job in design.results if not _has_result_or_failure(folder, job)]
        _report_progress(design, folder, progress)
        if not left:
            return ""
        jobs = [_job_arguments(job, folder, program, design.run) for job in left]
        died, trouble = "", Trouble()
        try:
            with _pool(given, design.run, folder) as (pool, asked):
                died = _round(pool, jobs, lambda: _report_progress(design, folder, progress), limits)
                trouble = asked()
        except (concurrent.futures.BrokenExecutor, RuntimeError):  # the executor accepts no more jobs
            if given is not None:
                return died or DIED
        idle = idle + 1 if all(not _has_result_or_failure(folder, job) for job in left) else 0
        if idle and trouble.refused:
            return f"no worker could start: {trouble.words}"
    return f"{DIED}{f' ({trouble.words or died})' if trouble.words or died else ''}"


# A context with the caller's executor if there is one, otherwise with the executor that [run] describes.
def _pool(given: concurrent.futures.Executor | None, run: dict[str, Any], folder: Path) -> Any:
    return contextlib.nullcontext((given, Trouble)) if given is not None else executors.executor(run, folder)


def _round(
    pool: concurrent.futures.Executor,
    jobs: list[dict[str, Any]],
    said: Callable[[], None],
    patience: tuple[float, float] | None,
) -> str:
    """Submits the jobs and waits until all have ended, or until no worker has been working for too long. `patience` has
    two times [s]: the longest wait until the first worker begins, and the longest time without a working worker
    afterwards. If it is None, the wait has no limit. `said` is called to report progress. Returns the last error of a
    worker that died or did not start. Errors of the program are in the study's folder."""
    died = ""
    waiting = {pool.submit(compute, job) for job in jobs}
    locks = [Path(job["folder"]) / "running" / f"{job['key']}.lock" for job in jobs]
    quiet, begun = time.monotonic(), False
    try:
        while waiting:
            done, waiting = concurrent.futures.wait(waiting, 2.0, concurrent.futures.FIRST_COMPLETED)
            for future in done:
                error = future.exception()
                if isinstance(error, (StudyError, OSError)):
                    raise error
                died = f"{type(error).__name__}: {error}" if error else died
            said()
            if done or patience and any(map(is_locked, locks)):
                quiet, begun = time.monotonic(), True
            elif patience and time.monotonic() - quiet > patience[begun]:
                return died
    except BaseException:  # also KeyboardInterrupt: jobs that still wait must not begin
        for future in waiting:
            # Parsl cannot cancel jobs; its workers end when the pool is closed
            with contextlib.suppress(NotImplementedError):
                future.cancel()
        raise
    return died


# Returns the job as the dictionary that compute() of job.py expects.
def _job_arguments(job: Job, folder: Path, program: str, run: dict[str, Any]) -> dict[str, Any]:
    command = [*job.command]
    if job.command[0] == "run" and "--threads" not in {word.partition("=")[0] for word in command}:
        command += ["--threads", str(executors.threads(run))]
    return {
        "key": job.key,
        "scene": job.scene,
        "command": command,
        "values": job.values,
        "experiment": job.experiment,
        "threads": executors.threads(run),
        "program": program,
        "folder": str(folder),
    }


# Reports the numbers of results that are done, failed and asked for.
def _report_progress(design: Design, folder: Path, progress: Callable[[int, int, int], None]) -> None:
    done = sum((folder / "results" / job.key).is_dir() for job in design.results)
    failed = sum((folder / "failures" / f"{job.key}.json").is_file() for job in design.results)
    progress(done, failed, len(design.results))
