# SPDX-License-Identifier: GPL-3.0-or-later
"""Computes one result, in a worker. The program runs in the folder `running/KEY`, which is renamed to `results/KEY`
when the program has succeeded.

So a result exists if and only if `results/KEY` exists, and there is no other record of progress. A worker may be killed
at any moment. Then only `running/KEY` is left, and a stepped run continues from the checkpoint in it. The program is
killed together with its worker."""

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

# A program may be killed by a signal, for example because memory ran out. It is then started again, at most this
# number of times. If it is killed once more, the job has failed.
KILLS = 3
_LINES = 12  # number of lines of the program's messages that are kept
_LIBC = ctypes.CDLL(None)  # loaded here, because loading is not safe between fork and exec


def compute(job: dict[str, Any]) -> dict[str, Any]:
    """Computes the result of a job, unless the study's folder has it. job: key, scene (TOML), command, threads, values,
    experiment, program, folder (of the study). Returns the key and the status: done, failed or stopped. A failure of
    the program does not raise an exception; it is recorded in `failures/KEY.json`."""
    folder, key = Path(job["folder"]), job["key"]
    done, failed, work = (folder / name / key for name in ("results", "failures", "running"))
    failed = failed.with_suffix(".json")
    # if an earlier study was killed, one of its workers may still be computing this job; waits for the
    # lock until that worker has ended
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
        # the checkpoint stays in `running`, so that the study can be continued
        if code != 0 and programs.stopped(job["folder"]):
            return {"key": key, "status": "stopped"}
        record = {name: job[name] for name in ("key", "experiment", "values", "command")}
        record |= {"wall_s": round(time.time() - began, 3), "processor_s": round(_processor_time() - spent, 3)}
        record |= {"machine": machine()}
        if code == 0:
            _write(work / "study.json", record)
            (work / "checkpoint.h5").unlink(missing_ok=True)
            work.rename(done)
            return {"key": key, "status": "done"}
        _write(failed, record | {"exit_code": code, "message": message_of(code, said).replace(f"{work}/", "")})
        shutil.rmtree(work, ignore_errors=True)
        return {"key": key, "status": "failed"}


def _processor_time() -> float:
    """Returns the processor time [s] of all programs that this process has run. If the workers are threads of one
    process, it includes the programs of all of them."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def _run(job: dict[str, Any], work: Path) -> tuple[int, str]:
    """Runs the program in `work`, from its checkpoint if there is one. Returns its exit code (below 0: a signal) and
    its messages."""
    command, *arguments = job["command"]
    resume = ["--resume"] if command == "run" and (work / "checkpoint.h5").is_file() else []
    if not resume:
        shutil.rmtree(work, ignore_errors=True)
        work.mkdir(parents=True)
        (work / "scene.toml").write_text(job["scene"], encoding="utf-8")
    line = [job["program"], command, str(work / "scene.toml"), "--out", str(work), *arguments, *resume]
    try:
        # OMP_NUM_THREADS sets the number of threads, because `macadam specimen` has no option --threads.
        # OMP_WAIT_POLICY makes waiting threads sleep, unless the user wants another policy: if other programs use the
        # cores, threads that spin while they wait cost more time than an additional thread saves.
        environment = {"OMP_WAIT_POLICY": "passive", **os.environ, "OMP_NUM_THREADS": str(job["threads"])}
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
    if resume and code == 2:  # code 2: the program refuses the checkpoint, so the job begins again without it
        shutil.rmtree(work)
        return _run(job, work)
    return code, said


def _die_with_parent() -> None:
    """Runs in the child process. Asks the kernel to kill the child when its worker ends in any way, so that two
    programs never compute the same result."""
    _LIBC.prctl(1, signal.SIGKILL)  # PR_SET_PDEATHSIG


def message_of(code: int, said: str) -> str:
    """Returns the message of a failure: the program's error and the last lines of its messages, or the signal that
    killed it. code: exit code of the program; said: all its messages."""
    lines = said.strip().splitlines()
    error, kept = programs.error_line(said), lines[-_LINES:]
    text = "\n".join([error] * (error not in kept) + kept)
    if code < 0:
        text = (
            f"macadam: killed by signal {-code} ({signal.Signals(-code).name}) {KILLS + 1} times; the machine may have run "
            f"out of memory\n{text}"
        )
    return text.strip() or f"exit code {code} without a message"


def machine() -> dict[str, Any]:
    """Returns name, processor and cores of this machine, and the GPUs and the Slurm job if the environment names
    them."""
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
    """Writes a JSON file completely and flushes it to the disk, or leaves no file."""
    part = file.with_name(f".{file.name}.{os.getpid()}.part")
    with open(part, "w", encoding="utf-8") as out:
        json.dump(value, out, indent=1, ensure_ascii=False, default=str)
        out.flush()
        os.fsync(out.fileno())
    part.replace(file)
