# SPDX-License-Identifier: GPL-3.0-or-later
"""One result, made by a worker: the program runs in a folder of its own, which takes its place when it is done.

The folder of a study says all: `results/KEY` is there or not. A worker may be killed at any moment; then `running/KEY`
is left, from which a stepped run goes on, and nothing else. The program dies with its worker."""

from __future__ import annotations

import ctypes
import json
import os
import platform
import resource
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

from macadam.study import programs
from macadam.study.locks import locked

KILLS = 3  # of the program by a signal, such as when memory ends; then it has failed
_LINES = 12  # of the program's messages that are kept
_LIBC = ctypes.CDLL(None)  # before any fork


def compute(job: dict[str, Any]) -> dict[str, Any]:
    """Makes the result of a job unless it is there. `job`: key, scene (TOML), command, threads, values, experiment,
    program, folder (of the study). Returns its key and status: done, failed or stopped. A failure of the program
    raises no exception."""
    folder, key = Path(job["folder"]), job["key"]
    done, failed, work = (folder / name / key for name in ("results", "failures", "running"))
    failed = failed.with_suffix(".json")
    # the same job may still be at work, of a study that was killed: it is waited for
    with locked(folder / "running" / f"{key}.lock", wait=True):
        if done.is_dir():
            return {"key": key, "status": "done"}
        if failed.is_file():
            return {"key": key, "status": "failed"}
        began, spent = time.time(), _processor_time()
        code, said = _run(job, work)
        kills = 0
        while code < 0 and kills < KILLS and not programs.stopped(job["folder"]):
            kills += 1
            code, said = _run(job, work)
        if code != 0 and programs.stopped(job["folder"]):  # `running` keeps its checkpoint
            return {"key": key, "status": "stopped"}
        record = {name: job[name] for name in ("key", "experiment", "values", "command")}
        record |= {"wall_s": round(time.time() - began, 3), "processor_s": round(_processor_time() - spent, 3)}
        record |= {"machine": machine()}
        if code == 0:
            _write(work / "study.json", record)
            (work / "checkpoint.h5").unlink(missing_ok=True)
            work.rename(done)
            return {"key": key, "status": "done"}
        _write(failed, record | {"exit_code": code, "message": _message(code, said).replace(f"{work}/", "")})
        shutil.rmtree(work, ignore_errors=True)
        return {"key": key, "status": "failed"}


def _processor_time() -> float:
    """Seconds for which programs of this process have computed; of workers that are threads of one, those of all."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def _run(job: dict[str, Any], work: Path) -> tuple[int, str]:
    """Exit code (below 0: a signal) and messages of the program."""
    command, *arguments = job["command"]
    resume = ["--resume"] if command == "run" and (work / "checkpoint.h5").is_file() else []
    if not resume:
        shutil.rmtree(work, ignore_errors=True)
        work.mkdir(parents=True)
        (work / "scene.toml").write_text(job["scene"], encoding="utf-8")
    line = [job["program"], command, str(work / "scene.toml"), "--out", str(work), *arguments, *resume]
    try:
        # also what the option does not reach: threads that wait for a core which others have cost more than they give
        environment = {"OMP_NUM_THREADS": str(job["threads"]), "OMP_WAIT_POLICY": "passive", **os.environ}
        code, said = programs.run(
            job["folder"],
            line,
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            preexec_fn=_die_with_parent if sys.platform == "linux" else None,
        )
    except OSError as error:
        return 127, f"{job['program']}: {error.strerror}"
    if resume and code == 2:  # a checkpoint that this program refuses
        shutil.rmtree(work)
        return _run(job, work)
    return code, said


def _die_with_parent() -> None:
    """In the child: it is killed when its worker ends in any way, so that no result is computed by two."""
    _LIBC.prctl(1, signal.SIGKILL)  # PR_SET_PDEATHSIG


def _message(code: int, said: str) -> str:
    text = "\n".join(said.strip().splitlines()[-_LINES:])
    if code < 0:
        text = (
            f"killed by signal {-code} ({signal.Signals(-code).name}) {KILLS + 1} times; memory may have ended\n{text}"
        )
    return text.strip() or f"exit code {code} without a message"


def machine() -> dict[str, Any]:
    """Where it was computed."""
    model = platform.processor() or platform.machine()
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as lines:
            model = next((line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")), model)
    except OSError:
        pass
    found = {"name": platform.node(), "processor": model, "cores": os.cpu_count()}
    for variable in ("CUDA_VISIBLE_DEVICES", "SLURM_JOB_ID"):
        if os.environ.get(variable):
            found[variable.lower()] = os.environ[variable]
    return found


def _write(file: Path, value: dict[str, Any]) -> None:
    """The whole file, on the disk, or nothing of it."""
    part = file.with_name(f".{file.name}.{os.getpid()}.part")
    with open(part, "w", encoding="utf-8") as out:
        json.dump(value, out, indent=1, ensure_ascii=False, default=str)
        out.flush()
        os.fsync(out.fileno())
    part.replace(file)
