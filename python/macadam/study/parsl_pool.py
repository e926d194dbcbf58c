# SPDX-License-Identifier: GPL-3.0-or-later
"""Starts Parsl's workers, on this machine or as jobs of Slurm, and ends them within a bounded time."""

from __future__ import annotations

import atexit
import contextlib
import os
import re
import shlex
import signal
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from macadam.study.errors import StudyError

# Parsl's shutdown waits without a limit for answers of its interchange (the process between the study and the workers),
# which may have died. So the shutdown gets this many seconds; then Parsl's processes are killed.
AFTER_INTERRUPT = 2.0
AT_THE_END = 30.0  # at the end of a study; longer, because scancel may be slow
_BEAT = 5  # seconds between heartbeats of workers; a worker is lost after six missing heartbeats
# Starts the interchange in its own session, so that a signal to the study's process group does not reach it. The kernel
# kills the interchange when the study ends in any way (prctl 1 is PR_SET_PDEATHSIG, 9 is SIGKILL). Without this, the
# interchange of a killed study would wait forever, and its workers would wait for the interchange.
_INTERCHANGE = (
    "import ctypes, os, sys; os.setsid(); ctypes.CDLL(None).prctl(1, 9); os.execvp(sys.argv[1], sys.argv[1:])"
)


@dataclass
class Trouble:
    """The reason in words why workers could not start; empty if they could. `refused`: the request itself was refused,
    so another attempt is useless."""

    words: str = ""
    refused: bool = False


@contextlib.contextmanager
def parsl_pool(
    place: str, folder: Path, slurm: dict[str, Any], workers: int | None, threads: int, gpus: int
) -> Iterator[tuple[Any, Callable[[], Trouble]]]:
    """A context with the pool of workers, and a function that returns why workers could not start.

    place: "local" or "slurm". slurm: options of Parsl's SlurmProvider. workers: number of workers per machine; None: as
    many as its cores allow. threads: CPU threads of each worker. gpus: number of GPUs per machine. Parsl's logs go into
    `folder`/parsl."""
    try:
        from parsl.concurrent import ParslPoolExecutor
    except ImportError:
        raise StudyError(
            f"run.on: found {place!r} without the Python package parsl, expected parsl to be installed; "
            'on = "threads" runs on this machine without it'
        ) from None
    # Parsl starts its own programs by name, so the search path begins with the folder of this Python, which has them
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ.get('PATH', '')}"
    with _environment({"PATH": path, "PYTHONPATH": _python_path()}):
        executor = _executor(place, slurm, workers, threads, gpus)
        config = _config(executor, folder)
        pool, seconds = None, AFTER_INTERRUPT
        try:
            pool = ParslPoolExecutor(config)
            yield pool, lambda: _trouble(executor)
            seconds = AT_THE_END
        finally:
            _end(pool, executor, config, seconds)


# Returns Parsl's executor for the given place, with its provider of workers.
def _executor(place: str, slurm: dict[str, Any], workers: int | None, threads: int, gpus: int) -> Any:
    from parsl.executors import HighThroughputExecutor
    from parsl.executors.high_throughput.executor import DEFAULT_LAUNCH_CMD
    from parsl.providers import LocalProvider, SlurmProvider

    more: dict[str, Any] = {}
    if place == "slurm":
        asked = {"init_blocks": 0, "walltime": "24:00:00", **slurm}
        # the shell of a Slurm job may not inherit these variables, so the job sets them
        begin = f"export PATH={shlex.quote(os.environ['PATH'])} PYTHONPATH={shlex.quote(os.environ['PYTHONPATH'])}"
        asked["worker_init"] = f"{begin}\n{asked.get('worker_init', '')}"
        provider: Any = SlurmProvider(**asked)
    else:
        provider = LocalProvider(init_blocks=1, min_blocks=1, max_blocks=1)
        watched = f"{shlex.quote(sys.executable)} -m macadam.study.manager {os.getpid()} {8 * _BEAT}"
        more = {"address": "127.0.0.1", "launch_cmd": f"{watched} {DEFAULT_LAUNCH_CMD}"}
    return HighThroughputExecutor(
        label="macadam",
        interchange_launch_cmd=[sys.executable, "-c", _INTERCHANGE, "interchange.py"],
        provider=provider,
        cores_per_worker=0.01 if gpus else threads,
        max_workers_per_node=workers,
        available_accelerators=gpus or [],
        heartbeat_period=_BEAT,
        heartbeat_threshold=6 * _BEAT,
        encrypted=False,
        **more,
    )


def _config(executor: Any, folder: Path) -> Any:
    from parsl.config import Config

    return Config(
        executors=[executor],
        run_dir=str(folder / "parsl"),
        strategy_period=1,
        usage_tracking=0,
        retries=3,
        initialize_logging=False,
    )


def _trouble(executor: Any) -> Trouble:
    """Returns the message of sbatch if it refused a job, or of a job that failed or disappeared."""
    from parsl.jobs.states import JobState

    for status in [*executor.status_facade.values()]:
        if status.state in (JobState.FAILED, JobState.MISSING):
            message = status.message or ""
            words = f"{message}\n{status.stderr_summary or ''}"
            text = "; ".join(slurm_lines(words)) or " ".join(words.split()) or f"exit code {status.exit_code}"
            return Trouble(text, message.startswith("Failed to start block"))
    return Trouble()


def slurm_lines(message: str) -> list[str]:
    """Returns the lines of sbatch and slurmstepd in a message of Parsl, without the names of these programs. A version
    of Parsl may write line ends as `\\n`, and quotes around the text."""
    found = []
    for line in re.findall(r"(?:sbatch|slurmstepd): *(.*?) *(?:\\n|\n|$)", message):
        # this quote closes a quote that began before the line
        lone = line[-1:] in ("'", '"') and line.count(line[-1]) == 1
        found.append(line[:-1] if lone else line)
    return found


def _end(pool: Any, executor: Any, config: Any, seconds: float) -> None:
    """Shuts Parsl down. Waits for at most `seconds`; then kills Parsl's processes and cancels its Slurm jobs."""
    closing = threading.Thread(target=_close, args=(pool,), daemon=True)
    groups = _groups(executor.provider)
    try:
        if pool is not None:
            closing.start()
            closing.join(seconds)
    finally:
        if closing.is_alive() or pool is None:
            groups |= _groups(executor.provider)
            _cancel(executor.provider)
        _kill(groups, executor.interchange_proc)
        _forget(config)


def _close(pool: Any) -> None:
    with contextlib.suppress(Exception):  # ignores errors about processes that have already ended
        pool.shutdown(wait=False)


def _groups(provider: Any) -> set[int]:
    """Returns the process groups of the workers on this machine, except the process group of this process."""
    found = set()
    for job in list(provider.resources.values()):
        with contextlib.suppress(KeyError, ProcessLookupError):  # ignores a job of Slurm, and a process that has ended
            found.add(os.getpgid(job["remote_pid"]))
    return found - {os.getpgrp()}


def _cancel(provider: Any) -> None:
    """Asks Slurm to end the jobs, and does not wait for the answer."""
    jobs = [name for name, job in provider.resources.items() if "remote_pid" not in job and not job["status"].terminal]
    if jobs:
        with contextlib.suppress(OSError):
            subprocess.Popen(
                ["scancel", *jobs],
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
                start_new_session=True,
            )


# Kills the process groups of the workers, and the interchange.
def _kill(groups: set[int], interchange: Any) -> None:
    for group in groups:
        with contextlib.suppress(ProcessLookupError):
            os.killpg(group, signal.SIGKILL)
    if interchange is not None:
        interchange.kill()
        interchange.wait()


def _forget(config: Any) -> None:
    """Removes Parsl's state in this process after a shutdown that did not finish, so that Parsl can be started
    again."""
    import parsl
    from parsl.errors import NoDataFlowKernelError

    with contextlib.suppress(NoDataFlowKernelError):
        kernel = parsl.dfk()
        if kernel.config is config:
            atexit.unregister(kernel.atexit_cleanup)
            parsl.clear()


def _python_path() -> str:
    """Returns PYTHONPATH for the workers, which begins with the folder of this package."""
    here = str(Path(__file__).resolve().parents[2])
    return os.pathsep.join(filter(None, [here, os.environ.get("PYTHONPATH")]))


# Sets environment variables while the block runs.
@contextlib.contextmanager
def _environment(values: dict[str, str]) -> Iterator[None]:
    before = {name: os.environ.get(name) for name in values}
    os.environ.update(values)
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                os.environ.pop(name, None)
            else:
                os.environ[name] = value
