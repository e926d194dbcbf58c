# SPDX-License-Identifier: GPL-3.0-or-later
"""Where jobs run: this machine or a Slurm cluster by Parsl, or threads of this process."""

from __future__ import annotations

import concurrent.futures
import contextlib
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from macadam.study.errors import StudyError

PLACES = ("local", "slurm", "threads")
KEYS = {"on", "workers", "threads", "gpus", "patience", "slurm"}
SLURM = {
    "partition",
    "account",
    "qos",
    "constraint",
    "nodes_per_block",
    "max_blocks",
    "walltime",
    "scheduler_options",
    "worker_init",
    "exclusive",
    "cores_per_node",
    "mem_per_node",
    "gpus_per_node",
}
# begins a program that is killed when this process ends in any way: Parsl's interchange would wait for ever for a study
# that was killed, and its workers for it
_WITH_ME = "import ctypes, os, sys; ctypes.CDLL(None).prctl(1, 9); os.execvp(sys.argv[1], sys.argv[1:])"
_BEAT = 5  # s between signs of life of workers; after six missing ones a worker is lost


@contextlib.contextmanager
def executor(run: dict[str, Any], folder: Path) -> Iterator[concurrent.futures.Executor]:
    """The executor that `[run]` of a study asks for; logs of Parsl go into `folder`/parsl."""
    place = run.get("on", "local")
    if place == "threads":
        with concurrent.futures.ThreadPoolExecutor(workers(run)) as pool:
            yield pool
        return
    try:
        from parsl.concurrent import ParslPoolExecutor
    except ImportError:
        raise StudyError(
            f"on = {place!r} takes the Python package parsl, which is not installed; "
            'on = "threads" runs on this machine without it'
        ) from None
    # Parsl starts its own programs by their names: they are beside this Python
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ.get('PATH', '')}"
    with _environment({"PATH": path, "PYTHONPATH": _python_path()}):
        pool = ParslPoolExecutor(_config(run, place, folder))
        try:
            yield pool.__enter__()
        finally:
            pool.shutdown(
                wait=False
            )  # what is not done is not waited for: its workers are of no use, or Ctrl-C ended it


def patience(run: dict[str, Any]) -> tuple[float, float]:
    """Seconds for which no worker may be at work while there is something to do: before the first one is, and later.
    Then all are replaced. A worker of Parsl that is killed while it waits can take the queue of all others with it."""
    slurm = run.get("on", "local") == "slurm"
    later = float(run.get("patience", 600 if slurm else 60))
    return (float("inf") if slurm else 5 * later), later  # a cluster may let jobs wait for days


def threads(run: dict[str, Any]) -> int:
    """CPU threads of each program, 1 where nothing is said."""
    return int(run.get("threads", 1))


def workers(run: dict[str, Any]) -> int:
    """Programs at a time on a machine: one a GPU, or as many as its cores allow."""
    asked = run.get("workers")
    return int(asked) if asked else _gpus(run) or max(1, len(os.sched_getaffinity(0)) // threads(run))


def check(run: dict[str, Any]) -> None:
    """A StudyError where `[run]` says what is not known."""
    for table, known, name in ((run, KEYS, "run"), (run.get("slurm", {}), SLURM, "run.slurm")):
        for key in table:
            if key not in known:
                raise StudyError(f"{name}: found the unknown key {key}, expected {', '.join(sorted(known))}")
    if run.get("on", "local") not in PLACES:
        raise StudyError(f"run.on: found {run['on']!r}, expected {', '.join(PLACES)}")
    for key in ("workers", "threads", "patience"):
        value = run.get(key, 1)
        if isinstance(value, bool) or not isinstance(value, int) or value < 1:
            raise StudyError(f"run.{key}: found {value!r}, expected a whole number above 0")
    gpus = run.get("gpus", 0)
    if gpus != "all" and (isinstance(gpus, bool) or not isinstance(gpus, int) or gpus < 0):
        raise StudyError(f'run.gpus: found {gpus!r}, expected a number or "all"')


def _gpus(run: dict[str, Any]) -> int:
    """Number of GPUs on a machine: as given, or all that the driver lists here."""
    asked = run.get("gpus", 0)
    if asked != "all":
        return int(asked)
    try:
        listed = subprocess.run(["nvidia-smi", "--list-gpus"], capture_output=True, text=True, check=True).stdout
    except (OSError, subprocess.CalledProcessError):
        raise StudyError('run.gpus: "all" asks nvidia-smi, which found none here; give their number') from None
    return len(listed.splitlines())


def _config(run: dict[str, Any], place: str, folder: Path) -> Any:
    from parsl.config import Config
    from parsl.executors import HighThroughputExecutor
    from parsl.executors.high_throughput.executor import DEFAULT_LAUNCH_CMD
    from parsl.providers import LocalProvider, SlurmProvider

    more: dict[str, Any] = {}
    if place == "slurm":
        asked = {"init_blocks": 0, "walltime": "24:00:00", **run.get("slurm", {})}
        # the job's shell need not know what is set here
        begin = f"export PATH={_quoted(os.environ['PATH'])} PYTHONPATH={_quoted(os.environ['PYTHONPATH'])}"
        asked["worker_init"] = f"{begin}\n{asked.get('worker_init', '')}"
        provider: Any = SlurmProvider(**asked)
        more = {"max_workers_per_node": run.get("workers") or _gpus(run) or None}
    else:
        provider = LocalProvider(init_blocks=1, min_blocks=1, max_blocks=1)
        watched = f"{_quoted(sys.executable)} -m macadam.study.manager {os.getpid()} {8 * _BEAT}"
        more = {
            "max_workers_per_node": workers(run),
            "address": "127.0.0.1",
            "launch_cmd": f"{watched} {DEFAULT_LAUNCH_CMD}",
        }
    gpus = _gpus(run)
    pool = HighThroughputExecutor(
        label="macadam",
        interchange_launch_cmd=[sys.executable, "-c", _WITH_ME, "interchange.py"],
        provider=provider,
        cores_per_worker=0.01 if gpus else threads(run),
        available_accelerators=gpus or [],
        heartbeat_period=_BEAT,
        heartbeat_threshold=6 * _BEAT,
        encrypted=False,
        **more,
    )
    return Config(
        executors=[pool],
        run_dir=str(folder / "parsl"),
        strategy_period=1,
        usage_tracking=0,
        retries=3,
        initialize_logging=False,
    )


def _quoted(text: str) -> str:
    import shlex

    return shlex.quote(text)


def _python_path() -> str:
    """Workers find this package where it is here."""
    here = str(Path(__file__).resolve().parents[2])
    return os.pathsep.join(filter(None, [here, os.environ.get("PYTHONPATH")]))


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
