# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads and checks the section `[run]` of a study and makes the executor for its jobs: this machine or a Slurm cluster,
both by Parsl, or threads of this process."""

from __future__ import annotations

import concurrent.futures
import contextlib
import os
import re
import shutil
import subprocess
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from macadam.study import programs
from macadam.study.errors import StudyError
from macadam.study.parsl_pool import Trouble, parsl_pool

PLACES = ("local", "slurm", "threads")
KEYS = {"on", "workers", "threads", "gpus", "patience", "slurm"}
# options of Parsl's SlurmProvider, and the types of their values
SLURM = {
    "partition": str,
    "account": str,
    "qos": str,
    "constraint": str,
    "nodes_per_block": int,
    "max_blocks": int,
    "walltime": str,
    "scheduler_options": str,
    "worker_init": str,
    "exclusive": bool,
    "cores_per_node": int,
    "mem_per_node": int,
    "gpus_per_node": int,
}
_KINDS = {str: "text", int: "a whole number above 0", bool: "true or false"}


@contextlib.contextmanager
def executor(run: dict[str, Any], folder: Path) -> Iterator[tuple[concurrent.futures.Executor, Callable[[], Trouble]]]:
    """A context with the executor that `[run]` of a study describes, and a function that returns why its workers could
    not start. After an interrupt the executor ends within seconds."""
    place = run.get("on", "local")
    if place == "threads":
        with _threads(workers(run), folder) as pool:
            yield pool, Trouble
        return
    on_machine = workers(run) if place == "local" else run.get("workers") or _gpus(run) or None
    with parsl_pool(place, folder, run.get("slurm", {}), on_machine, threads(run), _gpus(run)) as found:
        yield found


# A context with threads of this process. After an exception, the programs that they run are ended.
@contextlib.contextmanager
def _threads(number: int, folder: Path) -> Iterator[concurrent.futures.Executor]:
    programs.start(str(folder))
    pool = concurrent.futures.ThreadPoolExecutor(number)
    try:
        yield pool
    except BaseException:
        programs.stop(str(folder))
        # does not wait for the threads: a thread may wait for a lock that a living worker holds
        pool.shutdown(wait=False, cancel_futures=True)
        raise
    pool.shutdown()


def patience(run: dict[str, Any]) -> tuple[float, float]:
    """Returns the longest times [s] for which no worker may be working although there are jobs: one time until the
    first worker begins, and one for afterwards. Then all workers are replaced. This is needed because a Parsl worker
    that is killed while it waits for a job can block the queue for all other workers."""
    slurm = run.get("on", "local") == "slurm"
    later = float(run.get("patience", 600 if slurm else 60))
    # on a cluster, the time until the first worker begins is unlimited, because jobs may be queued for days
    return (float("inf") if slurm else 5 * later), later


def threads(run: dict[str, Any]) -> int:
    """Returns the number of CPU threads of each program, 1 by default."""
    return int(run.get("threads", 1))


def workers(run: dict[str, Any]) -> int:
    """Returns the number of programs that run at a time on a machine. By default it is one per GPU or, without GPUs,
    the number of cores divided by the threads of each program."""
    asked = run.get("workers")
    return int(asked) if asked else _gpus(run) or max(1, len(os.sched_getaffinity(0)) // threads(run))


def check(run: dict[str, Any]) -> None:
    """Raises StudyError if `[run]` has an unknown key or a wrong value."""
    slurm = run.get("slurm", {})
    if not isinstance(slurm, dict):
        raise StudyError(f"run.slurm: found {slurm!r}, expected a table [run.slurm]")
    for table, known, name in ((run, KEYS, "run"), (slurm, SLURM, "run.slurm")):
        for key in table:
            if key not in known:
                raise StudyError(f"{name}: found the unknown key {key}, expected {', '.join(sorted(known))}")
    if run.get("on", "local") not in PLACES:
        raise StudyError(f"run.on: found {run['on']!r}, expected {', '.join(PLACES)}")
    for key in ("workers", "threads", "patience"):
        check_count(f"run.{key}", run.get(key, 1))
    gpus = run.get("gpus", 0)
    if gpus != "all" and (isinstance(gpus, bool) or not isinstance(gpus, int) or gpus < 0):
        raise StudyError(f'run.gpus: found {gpus!r}, expected a number or "all"')
    for key, value in slurm.items():
        kind = SLURM[key]
        if not isinstance(value, kind) or kind is int and (isinstance(value, bool) or value < 1):
            text = ', expected text such as "01:30:00" (hours, minutes, seconds)' if key == "walltime" else ""
            raise StudyError(f"run.slurm.{key}: found {value!r}{text or f', expected {_KINDS[kind]}'}")
    walltime = slurm.get("walltime", "24:00:00")
    if not re.fullmatch(r"\d+:[0-5]?\d:[0-5]?\d", walltime) or re.fullmatch("0+:0?0:.*", walltime):
        raise StudyError(
            f'run.slurm.walltime: found {walltime!r}, expected hours, minutes and seconds such as "01:30:00", at least '
            "a minute"
        )


def check_count(name: str, value: Any) -> None:
    """Raises StudyError if a value is not a whole number above 0. name: the name of the value, for the message."""
    if isinstance(value, bool) or not isinstance(value, int) or value < 1:
        raise StudyError(f"{name}: found {value!r}, expected a whole number above 0")


def check_programs(run: dict[str, Any]) -> None:
    """Raises StudyError if a program that the place of computation needs is not installed."""
    if run.get("on", "local") == "slurm" and not shutil.which("sbatch"):
        raise StudyError('run.on: found "slurm", but no program sbatch in the search path: Slurm is not installed here')


def _gpus(run: dict[str, Any]) -> int:
    """Returns the number of GPUs on a machine: the given number or, for "all", the number that nvidia-smi lists
    here."""
    asked = run.get("gpus", 0)
    if asked != "all":
        return int(asked)
    try:
        listed = subprocess.run(["nvidia-smi", "--list-gpus"], capture_output=True, text=True, check=True).stdout
    except (OSError, subprocess.CalledProcessError):
        raise StudyError('run.gpus: "all" asks nvidia-smi, which found no GPU on this machine; give the number of GPUs') from None
    return len(listed.splitlines())
